"""Scenes of Mitsuba in mode photon and in mode vcm beside path tracing of the same file.

    modes.py RTC OUT SAMPLES SCENES [NAME...]

NAME stands for SCENES/NAME.xml, the scenes of modes.txt where none is given. Each is rendered 96
pixels wide, with so many samples of path tracing, a quarter as many of vcm, and in photon mode
a sixteenth as many passes. The mean may be off by 0.5 % beyond three standard errors, and no block
of 16 x 16 pixels by more than 2 % beyond four.
"""
import os
import re
import subprocess
import sys

WIDTH, MEAN, BLOCK = "96", 0.005, "0.02"


def render(rtc, scene, picture, *options):
    run = subprocess.run(
        [rtc, scene, "--width", WIDTH, "--height", WIDTH, "--filter", "box", "--quiet", "--out",
         picture, *options], capture_output=True, text=True, check=False)
    if run.returncode != 0:
        sys.exit(f"{scene}: {run.stderr.strip()}")


def compare(rtc, picture, right):
    """Whether a picture agrees, and what was measured."""
    said = subprocess.run(
        [rtc, "compare", picture, right, "--tolerance", BLOCK, "--max-off", "0"],
        capture_output=True, text=True, check=False)
    ratio, error = map(float, re.search(r"^ratio: (\S+) \+- (\S+)", said.stdout, re.M).groups())
    off = int(re.search(r"^blocks off: (\d+)", said.stdout, re.M).group(1))
    return abs(ratio - 1) <= MEAN + 3 * error and off == 0, \
        f"ratio {ratio:.4f} +- {error:.4f}, {off} blocks off"


def main():
    rtc, out, samples, scenes, *names = sys.argv[1:]
    with open(os.path.join(os.path.dirname(__file__), "modes.txt"), encoding="ascii") as file:
        listed = file.read().split()
    os.makedirs(out, exist_ok=True)
    count = int(samples)
    modes = {"photon": ("--passes", str(count // 16), "--spp", "8"),
             "vcm": ("--spp", str(count // 4))}
    failed = 0
    for name in names or listed:
        scene = os.path.join(scenes, name + ".xml")
        base = os.path.join(out, name.replace("/", "__"))
        render(rtc, scene, base + ".path.exr", "--spp", samples)
        for mode, options in modes.items():
            picture = f"{base}.{mode}.exr"
            render(rtc, scene, picture, "--mode", mode, *options)
            good, said = compare(rtc, picture, base + ".path.exr")
            failed += not good
            print("ok    " if good else "not ok", name, f"{mode} beside path: {said}", flush=True)
    print(f"{failed} failed")
    return 1 if failed else 0


if __name__ == "__main__":
    sys.exit(main())
