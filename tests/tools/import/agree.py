"""Scenes of Mitsuba beside its own pictures of them.

    agree.py RTC OUT SAMPLES SCENES [NAME...]

SCENES is a folder with `reference/A__B__C.exr` for each `A/B/C.xml`. A scene agrees when at most
2 % of its blocks of 8 x 8 pixels are off, in their largest channel, by more than 3 % of the block's
or of the picture's mean, the larger. Those of agree.txt have to, with as many times the samples as
the number behind the name says, and where the word `own` follows, if there is a reference of our
own; others are told. Such a reference, in the folder OUT/references, by references.py, takes the
place of that of the scenes: some of these are so noisy that Mitsuba with another seed is off from
them. It takes NumPy and OpenEXR (from PyPI).
"""
import glob
import os
import subprocess
import sys

import numpy
import OpenEXR

BLOCK, TOLERANCE, PART = 8, 0.03, 0.02


def read(path):
    channels = OpenEXR.File(path).channels()
    for name in ("RGB", "RGBA"):
        if name in channels:
            return numpy.asarray(channels[name].pixels, dtype=float)[..., :3]
    names = "RGB" if "R" in channels else "YYY"
    return numpy.stack([numpy.asarray(channels[c].pixels, dtype=float) for c in names], -1)


def part_off(made, right):
    """The part of blocks that are off."""
    limit = right.mean((0, 1)).max()
    off = []
    for y in range(0, right.shape[0], BLOCK):
        for x in range(0, right.shape[1], BLOCK):
            area = (slice(y, y + BLOCK), slice(x, x + BLOCK))
            a, b = made[area].mean((0, 1)), right[area].mean((0, 1))
            off.append(abs(a - b).max() > TOLERANCE * max(b.max(), limit))
    return numpy.mean(off)


def compare(rtc, out, samples, scene, reference):
    """The part of blocks that are off and the ratio of the means, or what went wrong."""
    right = read(reference)
    made = os.path.join(out, os.path.basename(reference))
    height, width = right.shape[:2]
    run = subprocess.run(
        [rtc, scene, "--width", str(width), "--height", str(height), "--spp", samples, "--quiet",
         "--out", made], capture_output=True, text=True, check=False)
    if run.returncode != 0:
        return None, run.stderr.strip().split("\n")[-1]
    picture = read(made)
    return part_off(picture, right), f"ratio {picture.mean() / max(right.mean(), 1e-9):.4f}"


def main():
    rtc, out, samples, scenes, *names = sys.argv[1:]
    with open(os.path.join(os.path.dirname(__file__), "agree.txt"), encoding="ascii") as file:
        lines = [line.split() for line in file]
    os.makedirs(out, exist_ok=True)
    better = {os.path.basename(path)[:-4]: path
              for path in glob.glob(os.path.join(out, "references", "*.exr"))}
    expected = {name: int(more[0]) if more else 1
                for name, *more in lines if "own" not in more or name in better}
    agreed, lost, count = 0, [], 0
    for reference in sorted(glob.glob(os.path.join(scenes, "reference", "*.exr"))):
        name = os.path.basename(reference)[:-4]
        if names and not any(word in name for word in names):
            continue
        count += 1
        scene = os.path.join(scenes, name.replace("__", os.sep) + ".xml")
        spp = str(int(samples) * expected.get(name, 1))
        part, said = compare(rtc, out, spp, scene, better.get(name, reference))
        is_good = part is not None and part <= PART
        agreed += is_good
        if not is_good and name in expected:
            lost.append(name)
        shown = "" if part is None else f"{100 * part:.1f} % off, "
        word = "ok    " if is_good else "lost  " if name in expected else "off   "
        print(word, name, shown + said, flush=True)
    print(f"{agreed} of {count} agree, {len(lost)} of those that did do not")
    return 1 if lost else 0


if __name__ == "__main__":
    sys.exit(main())
