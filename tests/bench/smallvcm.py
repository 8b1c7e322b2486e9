#!/usr/bin/env python3
"""Measures techniques beside those of SmallVCM: the error of pictures that took equal time.

    smallvcm.py DIR [--build DIR] [--seconds S] [--reference S] [--scene N,...] [--only NAME,...]
                [--keep]

DIR holds the program `smallvcm`. Its scenes 0 to 3 are rebuilt in scenes/smallvcm. Both programs
render each of them by each technique for as many seconds by the clock (10), with as many threads as
there are cores; start, reading and the compilation of kernels are left out. The error is the root
of the mean squared difference from a reference, over the mean of that. The floors differ, see
scenes/smallvcm/box.rts, so each program has references of its own, of REFERENCE seconds (300): by
connection and merging, and for techniques that leave out some light by these. They are made once,
and kept in build/bench/smallvcm with the pictures. Run from the top directory. --keep begins with
the figures of an earlier run.
"""
import argparse
import array
import json
import math
import os
import statistics
import sys

from tree import Failed, Tree, names, run

TECHNIQUES = {  # by SmallVCM's names
    "pt": ["--mode", "path"],
    "lt": ["--mode", "vcm", "--techniques", "camera"],
    "ppm": ["--mode", "photon", "--direct", "photons", "--passes", 1000000, "--photons", 512 * 512,
            "--radius-rule", "knaus"],
    "bpm": ["--mode", "vcm", "--techniques", "bpm"],
    "bpt": ["--mode", "vcm", "--techniques", "bpt"],
    "vcm": ["--mode", "vcm"],
}
REFERENCES = {"pt": "pt", "lt": "lt", "bpt": "bpt", "ppm": "vcm", "bpm": "vcm", "vcm": "vcm"}
SCENES = ["0", "1", "2", "3"]
RADIUS = 0.003 * math.sqrt(2.56004**2 + 2.56004**2 + 2.56004**2) / 2  # of the first merging
REFERENCE_SEED = 1000


def read_rgbe(path):
    """Width, height and values of a Radiance picture that is not compressed, as SmallVCM's are."""
    with open(path, "rb") as file:
        line = file.readline()
        while line.strip():
            line = file.readline()
        size = file.readline().split()
        data = file.read()
    height, width = int(size[1]), int(size[3])
    if len(data) != 4 * width * height:
        raise Failed(f"{path}: {len(data)} bytes are not {width} x {height} pixels")
    scales = [0.0] + [math.ldexp(1.0, e - 136) for e in range(1, 256)]
    values = array.array("f")
    for i in range(0, len(data), 4):
        scale = scales[data[i + 3]]
        values.extend(((data[i + c] + 0.5) * scale for c in range(3)))
    return width, height, values


def write_pfm(path, width, height, values):
    with open(path, "wb") as file:
        file.write(f"PF\n{width} {height}\n-1.0\n".encode())
        for y in reversed(range(height)):
            values[3 * width * y:3 * width * (y + 1)].tofile(file)


def ours(tree, scene, technique, seconds, seed, out):
    """What --stats tells."""
    radius = ["--radius", RADIUS] if technique in ("ppm", "bpm", "vcm") else []
    return tree.render(f"tests/bench/scenes/smallvcm/scene{scene}.rts", *TECHNIQUES[technique],
                       *radius, "--time", seconds, "--seed", seed, out=out)


def theirs(folder, scene, technique, seconds, out):
    """The seconds by the clock; it counts the processor time of all threads."""
    hdr = os.path.splitext(out)[0] + ".hdr"
    _, wall, _ = run([os.path.join(folder, "smallvcm"), "-s", scene, "-a", technique, "-t",
                         str(seconds * os.cpu_count()), "-o", hdr])
    write_pfm(out, *read_rgbe(hdr))
    os.remove(hdr)
    return wall


def relative_error(tree, picture, reference):
    """One block is the whole picture."""
    told = json.loads(tree.rtc("compare", picture, reference, "--block", 4096, "--json")[0])
    return told["rmse"] / statistics.mean(told["worst"]["reference"])


def make_references(tree, folder, place, scene, technique, seconds):
    paths = [os.path.join(place, f"{who}{scene}_{technique}_reference.pfm")
             for who in ("ours", "theirs")]
    if not os.path.exists(paths[0]):
        ours(tree, scene, technique, seconds, REFERENCE_SEED, paths[0])
    if not os.path.exists(paths[1]):
        theirs(folder, scene, technique, seconds, paths[1])
    return paths


def measure(tree, folder, place, scene, technique, seconds, reference_seconds):
    references = make_references(tree, folder, place, scene, REFERENCES[technique],
                                 reference_seconds)
    pictures = [os.path.join(place, f"{who}{scene}_{technique}.pfm") for who in ("ours", "theirs")]
    stats = ours(tree, scene, technique, seconds, 1, pictures[0])
    wall = theirs(folder, scene, technique, seconds, pictures[1])
    errors = [relative_error(tree, *pair) for pair in zip(pictures, references)]
    return {"ours": errors[0], "theirs": errors[1], "wall": wall, "stats": stats}


def page(found):
    lines = ["| scene | technique | SmallVCM | ours | ratio |", "|---|---|---|---|---|"]
    for scene in SCENES:
        for technique in TECHNIQUES:
            entry = found.get(scene, {}).get(technique)
            if entry:
                lines.append(f"| {scene} | {technique} | {entry['theirs']:.4f} | "
                             f"{entry['ours']:.4f} | {entry['theirs'] / entry['ours']:.2f} |")
    return "\n".join(lines)


def main():
    parser = argparse.ArgumentParser(description=__doc__.split("\n", 1)[0])
    parser.add_argument("folder", metavar="DIR", help="the folder of smallvcm")
    parser.add_argument("--build", default="build")
    parser.add_argument("--seconds", type=float, default=10)
    parser.add_argument("--reference", type=float, default=300, help="seconds of the references")
    parser.add_argument("--scene", help="numbers of scenes")
    parser.add_argument("--only", help="names of techniques")
    parser.add_argument("--keep", action="store_true")
    arguments = parser.parse_args()
    scenes = names(arguments.scene, SCENES, "--scene") or SCENES
    techniques = names(arguments.only, TECHNIQUES, "--only")
    if techniques is None:
        techniques = list(TECHNIQUES)
    tree = Tree(os.getcwd(), os.path.abspath(arguments.build))
    place = os.path.join(tree.build, "bench", "smallvcm")
    os.makedirs(place, exist_ok=True)
    path = os.path.join(place, "figures.json")
    found = {}
    if arguments.keep and os.path.exists(path):
        with open(path, encoding="utf-8") as file:
            found = json.load(file)
    for scene in scenes:
        for technique in techniques:
            found.setdefault(scene, {})[technique] = measure(
                tree, arguments.folder, place, scene, technique, arguments.seconds,
                arguments.reference)
    with open(path, "w", encoding="utf-8") as file:
        json.dump(found, file, indent=1)
    print(page(found))


if __name__ == "__main__":
    try:
        main()
    except Failed as error:
        sys.exit(str(error))
