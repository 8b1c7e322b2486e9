"""Renders Mitsuba's own scenes: mitsuba_render.py SAMPLES SCENE.xml PICTURE.exr ..."""
import pathlib
import sys

sys.path.insert(0, str(pathlib.Path(__file__).resolve().parents[2] / "peers"))
import mitsuba_llvm  # noqa: E402 pylint: disable=wrong-import-position

mitsuba = mitsuba_llvm.start()
for scene, picture in zip(sys.argv[2::2], sys.argv[3::2]):
    mitsuba.util.write_bitmap(picture, mitsuba.render(mitsuba.load_file(scene),
                                                      spp=int(sys.argv[1])), write_async=False)
