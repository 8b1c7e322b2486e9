#!/usr/bin/env python3
"""Times a scene of tests/peers/mitsuba_scenes.py, rendered twice with seeds of their own.

    mitsuba_boxes.py SCENE SPP FIRST.pfm SECOND.pfm

Prints the seconds of the faster render. One before them, not counted, compiles Mitsuba's kernels.
"""
import os
import sys
import time

HERE = os.path.dirname(os.path.abspath(__file__))
sys.path.insert(0, os.path.join(HERE, os.pardir, os.pardir, "peers"))
import mitsuba_llvm  # noqa: E402

mi = mitsuba_llvm.start()

import drjit as dr  # noqa: E402
import mitsuba_scenes  # noqa: E402


def main():
    name, spp, *outs = sys.argv[1:]
    scene = mi.load_dict(mitsuba_scenes.SCENES[name]())
    dr.eval(mi.render(scene, spp=int(spp), seed=0))
    seconds = []
    for seed, out in enumerate(outs, 1):
        start = time.perf_counter()
        image = mi.render(scene, spp=int(spp), seed=seed)
        dr.eval(image)
        dr.sync_thread()
        seconds.append(time.perf_counter() - start)
        mi.Bitmap(image).write(out)
    print(min(seconds))


if __name__ == "__main__":
    main()
