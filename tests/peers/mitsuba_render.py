#!/usr/bin/env python3
"""Renders a scene of mitsuba_scenes.py, or writes an image that our own scenes read.

    mitsuba_render.py SCENE SPP OUT.exr
    mitsuba_render.py --image sky|normals|heights|cloth OUT.exr|.hdr|.png|.jpg

Run from the top directory.
"""
import sys

import mitsuba_llvm

mi = mitsuba_llvm.start()

import numpy as np  # noqa: E402

import mitsuba_scenes  # noqa: E402

PASS = 64  # samples a pixel at once, for the sake of memory


def render(name, spp):
    scene = mi.load_dict(mitsuba_scenes.SCENES[name]())
    total = 0.0
    for first in range(0, spp, PASS):
        samples = min(PASS, spp - first)
        image = mi.render(scene, spp=samples, seed=first)
        total = total + samples * np.array(image, dtype=np.float64)
    return total / spp


def main():
    match sys.argv[1:]:
        case ["--image", name, out]:
            image = mitsuba_scenes.IMAGES[name]()
        case [name, spp, out] if name in mitsuba_scenes.SCENES and spp.isdigit() and int(spp) > 0:
            image = render(name, int(spp))
        case _:
            sys.exit(f"{__doc__}\nSCENE is one of {', '.join(mitsuba_scenes.SCENES)}.")
    image = mitsuba_scenes.bitmap(image)
    if out.endswith((".png", ".jpg")):
        image = image.convert(component_format=mi.Struct.Type.UInt8, srgb_gamma=True)
    image.write(out)


if __name__ == "__main__":
    main()
