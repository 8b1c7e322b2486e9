#!/usr/bin/env python3
"""Renders a scene of mitsuba_suite.py, and times it.

    mitsuba_bench.py SCENE SPP... [--sampler NAME] [--seed N] [--size WxH] [--until S] [--out DIR]
    mitsuba_bench.py --sky OUT.exr
    mitsuba_bench.py --half IN OUT.exr

Prints lines of a name and a figure: `load S`, the seconds in which the scene was read and its
hierarchy built, and for each SPP `SPP S`, those of a render. A first render, not counted, compiles
the kernels. --until leaves out the rest once a render took that long. --out keeps the pictures
there as SPP.pfm. --sky writes the sky of image_sky.rts, --half a picture with 16 bits a value.
Run from the top directory.
"""
import argparse
import os
import sys
import time

HERE = os.path.dirname(os.path.abspath(__file__))
sys.path.insert(0, os.path.join(HERE, os.pardir, os.pardir, "peers"))
import mitsuba_llvm  # noqa: E402

mi = mitsuba_llvm.start()

import drjit as dr  # noqa: E402
import numpy as np  # noqa: E402

import mitsuba_suite  # noqa: E402

mi.set_log_level(mi.LogLevel.Error)

PASS = 24 * 2**20  # paths at once, for the sake of memory


def render_once(scene, spp, seed):
    start = time.perf_counter()
    image = mi.render(scene, spp=spp, seed=seed)
    dr.eval(image)
    dr.sync_thread()
    return image, time.perf_counter() - start


def render(scene, pixels, spp, seed):
    """
    The picture, and the seconds it took: of several renders where memory wants it. Some samplers
    have a kernel for each SPP, so each part is rendered twice, and the second one counts.
    """
    parts = 1
    while pixels * spp > PASS * parts:
        parts *= 4
    total, seconds = 0.0, 0.0
    for part in range(parts):
        image = render_once(scene, spp // parts, seed * 1000 + part)[0]
        total = total + np.array(image, dtype=np.float64)
        seconds += render_once(scene, spp // parts, seed * 1000 + part)[1]
    return total / parts, seconds


def main():
    parser = argparse.ArgumentParser(description=__doc__.split("\n", 1)[0])
    parser.add_argument("scene", nargs="?")
    parser.add_argument("spp", type=int, nargs="*")
    parser.add_argument("--sampler", default="independent")
    parser.add_argument("--seed", type=int, default=1)
    parser.add_argument("--size", help="WIDTHxHEIGHT, instead of the scene's")
    parser.add_argument("--until", type=float, default=float("inf"))
    parser.add_argument("--out")
    parser.add_argument("--sky")
    parser.add_argument("--half", nargs=2)
    arguments = parser.parse_args()
    if arguments.sky:
        mitsuba_suite.our_sky().write(arguments.sky)
        return
    if arguments.half:
        mi.Bitmap(arguments.half[0]).convert(
            mi.Bitmap.PixelFormat.RGB, mi.Struct.Type.Float16, srgb_gamma=False
        ).write(arguments.half[1])
        return

    description = mitsuba_suite.plain(arguments.scene)
    film = description["camera"]["film"]
    if arguments.size:
        film["width"], film["height"] = map(int, arguments.size.split("x"))
    description["camera"]["sampler"] = {"type": arguments.sampler}
    start = time.perf_counter()
    scene = mi.load_dict(description)
    dr.sync_thread()
    print("load", time.perf_counter() - start)
    render_once(scene, arguments.spp[0], 0)
    for spp in arguments.spp:
        image, seconds = render(scene, film["width"] * film["height"], spp, arguments.seed)
        print(spp, seconds, flush=True)
        if arguments.out:
            mitsuba_suite.bitmap(image).write(os.path.join(arguments.out, f"{spp}.pfm"))
        if seconds > arguments.until:
            break


if __name__ == "__main__":
    main()
