#!/usr/bin/env python3
"""Measures techniques beside those of SmallVCM: the error of pictures that took equal time.

    smallvcm.py DIR [--build DIR] [--seconds S] [--size N] [--scene N,...] [--only NAME,...]
                [--same-radius] [--keep]

DIR holds the program `smallvcm`, whose scenes 0 to 3 scenes/smallvcm rebuilds. Both programs render
each of them by each technique, with as many threads as there are cores: SmallVCM, which counts the
processor time of its threads, for SECONDS (5) of each core, and then ours for as long by the clock,
without start and compilation. The error is the root of the mean squared difference from the truth,
over the mean of that. References are ours, two of independent noise for both programs: the mean
product of a picture's differences from the one and from the other is free of their noise. The means
of SmallVCM's pictures over those of the references tell that the scenes agree. For techniques that
leave out some light references are by these, and else by techniques without bias where these find
all light. They are made once, and kept in build/bench/smallvcm with the pictures.

Merging begins with SmallVCM's radius times RADII, or with the same by --same-radius. A SIZE other
than 512 needs a smallvcm with the option `-r WIDTHxHEIGHT`. --keep begins with the figures of an
earlier run. Run from the top directory.
"""
import argparse
import array
import json
import math
import os
import sys

from tree import Failed, Tree, names, run

TECHNIQUES = {  # by SmallVCM's names
    "pt": ["--mode", "path", "--spp", 1000000],
    "lt": ["--mode", "vcm", "--techniques", "camera"],
    # SmallVCM gathers on the glossy floor, too, whose exponent of 90 is a roughness of 0.147.
    "ppm": ["--mode", "photon", "--direct", "photons", "--gather-roughness", 0.1, "--passes",
            1000000, "--radius-rule", "knaus"],
    "bpm": ["--mode", "vcm", "--techniques", "bpm"],
    "bpt": ["--mode", "vcm", "--techniques", "bpt"],
    "vcm": ["--mode", "vcm"],
}
SCENES = ["0", "1", "2", "3"]
RADIUS = 0.003 * math.sqrt(3 * 2.56004**2) / 2  # SmallVCM's, of the first merging
RADII = {"ppm": 4, "bpm": 4, "vcm": 3}
REFERENCE_SEEDS = (1000, 1001)
REFERENCES = {  # what finds as much light; the samples are those of 256 x 256 pixels
    "pt": ["--mode", "path", "--spp", 1000],
    "lt": ["--mode", "vcm", "--techniques", "camera", "--spp", 800],
    "bpt": ["--mode", "vcm", "--techniques", "bpt", "--spp", 300],
    "vcm": ["--mode", "vcm", "--radius", 2 * RADIUS, "--spp", 300],
}


def reference_of(scene, technique):
    """Delta lights, in scenes 0 and 2, are not met by paths: the techniques differ there."""
    if technique == "lt":
        return "lt"
    if scene in ("1", "3"):
        return "bpt"
    return technique if technique in ("pt", "bpt") else "vcm"


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


def read_pfm(path):
    """The values of a picture in PFM, bottom row first."""
    with open(path, "rb") as file:
        if file.readline().strip() != b"PF":
            raise Failed(f"{path} is not a PFM picture in colour")
        width, height = map(int, file.readline().split())
        big_endian = float(file.readline()) > 0.0
        values = array.array("f")
        values.fromfile(file, 3 * width * height)
    if big_endian != (sys.byteorder == "big"):
        values.byteswap()
    return values


def write_pfm(path, width, height, values):
    with open(path, "wb") as file:
        file.write(f"PF\n{width} {height}\n-1.0\n".encode())
        for y in reversed(range(height)):
            values[3 * width * y:3 * width * (y + 1)].tofile(file)


class Bench:
    """Both programs, what they render, and for how long."""

    def __init__(self, arguments):
        self.tree = Tree(os.getcwd(), os.path.abspath(arguments.build))
        self.folder, self.seconds, self.size = arguments.folder, arguments.seconds, arguments.size
        self.radii = {} if arguments.same_radius else RADII
        self.place = os.path.join(self.tree.build, "bench", "smallvcm")
        os.makedirs(self.place, exist_ok=True)

    def path(self, name):
        return os.path.join(self.place, name)

    def ours(self, scene, *options, out):
        return self.tree.render(f"tests/bench/scenes/smallvcm/scene{scene}.rts", "--width",
                                self.size, "--height", self.size, *options, out=out)

    def render_ours(self, scene, technique, seconds, out):
        options = [*TECHNIQUES[technique], "--time", seconds]
        if technique in ("ppm", "bpm", "vcm"):
            options += ["--radius", RADIUS * self.radii.get(technique, 1)]
        if technique == "ppm":
            options += ["--photons", self.size**2]
        return self.ours(scene, *options, out=out)

    def render_theirs(self, scene, technique, out):
        """The seconds by the clock."""
        hdr = os.path.splitext(out)[0] + ".hdr"
        size = [] if self.size == 512 else ["-r", f"{self.size}x{self.size}"]
        _, wall, _ = run([os.path.join(self.folder, "smallvcm"), "-s", scene, "-a", technique,
                          "-t", str(self.seconds * os.cpu_count()), "-o", hdr, *size])
        write_pfm(out, *read_rgbe(hdr))
        os.remove(hdr)
        return wall

    def references(self, scene, technique):
        kind = reference_of(scene, technique)
        found = []
        for seed in REFERENCE_SEEDS:
            path = self.path(f"{scene}_{kind}_reference_{seed}.pfm")
            if not os.path.exists(path):
                *options, samples = REFERENCES[kind]
                samples = max(8, round(samples * (256 / self.size) ** 2))
                self.ours(scene, *options, samples, "--seed", seed, out=path)
            found.append(read_pfm(path))
        return found

    def compare(self, picture, references):
        """The relative error, and the mean over that of the references."""
        values, (first, second) = read_pfm(picture), references
        mean = (sum(first) + sum(second)) / 2
        products = sum((v - a) * (v - b) for v, a, b in zip(values, first, second))
        return math.sqrt(max(products, 0.0) * len(values)) / mean, sum(values) / mean

    def measure(self, scene, technique):
        references = self.references(scene, technique)
        pictures = [self.path(f"{who}{scene}_{technique}.pfm") for who in ("ours", "theirs")]
        wall = self.render_theirs(scene, technique, pictures[1])
        self.render_ours(scene, technique, wall, pictures[0])
        found = {"seconds": wall}
        for who, picture in zip(("ours", "theirs"), pictures):
            found[who], found[who + "_mean"] = self.compare(picture, references)
        return found


def page(found):
    lines = ["| scene | technique | SmallVCM | its mean | ours | our mean | SmallVCM / ours |",
             "|---|---|---|---|---|---|---|"]
    for scene in SCENES:
        for technique in TECHNIQUES:
            entry = found.get(scene, {}).get(technique)
            if entry:
                lines.append(f"| {scene} | {technique} | {entry['theirs']:.3f} | "
                             f"{entry['theirs_mean']:.3f} | {entry['ours']:.3f} | "
                             f"{entry['ours_mean']:.3f} | {entry['theirs'] / entry['ours']:.2f} |")
    return "\n".join(lines)


def main():
    parser = argparse.ArgumentParser(description=__doc__.split("\n", 1)[0])
    parser.add_argument("folder", metavar="DIR", help="the folder of smallvcm")
    parser.add_argument("--build", default="build")
    parser.add_argument("--seconds", type=float, default=5)
    parser.add_argument("--size", type=int, default=512, help="pixels along each side")
    parser.add_argument("--scene", help="numbers of scenes")
    parser.add_argument("--only", help="names of techniques")
    parser.add_argument("--same-radius", action="store_true")
    parser.add_argument("--keep", action="store_true")
    arguments = parser.parse_args()
    scenes = names(arguments.scene, SCENES, "--scene") or SCENES
    techniques = names(arguments.only, TECHNIQUES, "--only")
    bench = Bench(arguments)
    path = bench.path("figures.json")
    found = {}
    if arguments.keep and os.path.exists(path):
        with open(path, encoding="utf-8") as file:
            found = json.load(file)
    for scene in scenes:
        for technique in TECHNIQUES if techniques is None else techniques:
            found.setdefault(scene, {})[technique] = bench.measure(scene, technique)
            with open(path, "w", encoding="utf-8") as file:
                json.dump(found, file, indent=1)
    print(page(found))


if __name__ == "__main__":
    try:
        main()
    except Failed as error:
        sys.exit(str(error))
