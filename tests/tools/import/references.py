"""References of more samples than those of the scenes, by Mitsuba.

    references.py SCENES OUT PASSES NAME...

Renders SCENES/A/B/C.xml of each NAME, A__B__C, as large as SCENES/reference/NAME.exr, PASSES times
with 1024 samples and a seed of its own, and writes the mean to OUT/NAME.exr, for agree.py. The
integrator `direct` samples lights and BSDFs, whatever the scene says: the mean is the same. Prints
the part of blocks by which the first pass, and the mean, are off from the reference that there is:
that of the first is what noise alone does. It takes Mitsuba, NumPy and OpenEXR (from PyPI).
"""
import os
import sys

import agree
import mitsuba as mi
import numpy
import OpenEXR

SAMPLES = 1024


def load(path, size):
    try:
        scene = mi.load_file(path)
    except RuntimeError:
        scene = mi.load_file(path, spp=16)  # one that asks for it
    parameters = mi.traverse(scene)
    for key in parameters.keys():
        if key.endswith("film.size") or key.endswith("film.crop_size"):
            parameters[key] = size
    parameters.update()
    return scene


def main():
    scenes, out, passes, *names = sys.argv[1:]
    mi.set_variant("llvm_ad_rgb")
    os.makedirs(out, exist_ok=True)
    for name in names:
        right = agree.read(os.path.join(scenes, "reference", name + ".exr"))
        scene = load(os.path.join(scenes, name.replace("__", os.sep) + ".xml"),
                     [right.shape[1], right.shape[0]])
        is_direct = str(scene.integrator()).startswith("DirectIntegrator")
        by = mi.load_dict({"type": "direct"}) if is_direct else scene.integrator()
        total = 0
        for i in range(int(passes)):
            made = numpy.array(mi.render(scene, spp=SAMPLES, seed=1000 + i, integrator=by))
            total = total + made[..., :3]
            if i == 0:
                first = agree.part_off(total, right)
        total = (total / int(passes)).astype("float32")
        header = {"compression": OpenEXR.ZIP_COMPRESSION, "type": OpenEXR.scanlineimage}
        OpenEXR.File(header, {"RGB": total}).write(os.path.join(out, name + ".exr"))
        print(f"{name}: another seed {100 * first:.1f} % off, "
              f"all {100 * agree.part_off(total, right):.1f} %", flush=True)


if __name__ == "__main__":
    main()
