#!/usr/bin/env python3
"""Measures cost against work, and draws it.

    scaling.py [--build DIR] [--device NAME] [--only NAME,...]

Run from the top directory; `make bench-scaling` does. Each study grows one quantity, the rest being
the same, and prints seconds and peak memory of the process, and the slope over the upper half of
the range: of the line through the logarithms, so 1 is proportional and 0 constant. The plots,
NAME.svg, and the figures, scaling.json, go to DIR/bench.
"""
import argparse
import json
import math
import os
import sys

from tree import Failed, Tree, names

BOX = "tests/bench/cornell32.rts"


def seconds_of(stats):
    return (stats["emit_seconds"] + stats["gather_seconds"] if stats["mode"] == "photon"
            else stats["render_seconds"])


def render(tree, scene, *options):
    stats = tree.render(scene, *options)
    return {"render": seconds_of(stats), "build": stats["build_seconds"],
            "memory": stats["memory"]}


def triangles(tree, count):
    """A knot of that many, at a size where rays count more than the start."""
    folder = os.path.join(tree.build, "bench")
    tree.rtc("mesh", "knot", "--triangles", count, "--out", os.path.join(folder, "knot.ply"))
    scene = os.path.join(folder, "knot.rts")
    with open(os.path.join(tree.top, "tests/bench/scenes/mesh.rts"), encoding="utf-8") as file:
        text = file.read().replace("../../../build/bench/mesh.ply", "knot.ply")
    with open(scene, "w", encoding="utf-8") as file:
        file.write(text)
    return render(tree, scene, "--width", 512, "--height", 512, "--spp", 4)


def lights(tree, count):
    """Small area lights under the ceiling of a hall, all of the same power together."""
    side = math.isqrt(count)
    scene = os.path.join(tree.build, "bench", "lights.rts")
    with open(scene, "w", encoding="utf-8") as file:
        file.write(f"""# Area lights in a hall.
camera {{ eye 0 2.4 -5.8  look_at 0 0.3 -0.5  up 0 1 0  fov 46 }}
material white {{ kd 0.7 }}
quad {{ corner -4 0 -6  edge1 0 0 12  edge2 8 0 0  material white }}
quad {{ corner -4 0 6  edge1 0 3 0  edge2 8 0 0  material white }}
repeat i from 0 to {side - 1} {{ repeat j from 0 to {side - 1} {{
    quad {{ corner (-4 + 8 * i / {side}) 2.8 (-6 + 12 * j / {side})
           edge1 {2 / side} 0 0  edge2 0 0 {2 / side}  material white  radiance 20 20 20 }}
}} }}
render {{ max_depth 8 }}
""")
    return render(tree, scene, "--width", 256, "--height", 256, "--spp", 16)


def photons(tree, count):
    return render(tree, "scenes/cornell.rts", "--mode", "photon", "--photons", count, "--spp", 1,
                  "--width", 256, "--height", 256)


def samples(tree, count):
    return render(tree, BOX, "--spp", count, "--width", 256, "--height", 256)


def pixels(tree, count):
    """Four samples of each; 7680 x 4320 at the end."""
    width = round(math.sqrt(count * 16 / 9))
    return render(tree, BOX, "--spp", 4, "--width", width, "--height", round(count / width))


def threads(tree, count):
    return render(tree, BOX, "--spp", 32, "--threads", count)


def threads_apart(tree):
    """How many times as much two renders at once do, of one thread each, as one alone."""
    alone = seconds_of(tree.render(BOX, "--spp", 32, "--threads", 1))
    return sum(alone / seconds_of(stats) for stats in tree.render_twice(BOX, "--spp", 32))


# What grows, how far, and the study of one value.
STUDIES = {
    "triangles": ([200, 2000, 20000, 200000, 1000000, 5000000, 10000000], triangles),
    "samples": ([4, 16, 64, 256], samples),
    "lights": ([1, 9, 100, 900, 10000], lights),
    "photons": ([10000, 100000, 1000000, 10000000], photons),
    "pixels": ([65536, 518400, 2073600, 8294400, 33177600], pixels),
    "threads": ([1, 2], threads),
}
COLOURS = {"render": "#1f5fa8", "build": "#b5521b"}


def slope(points):
    """Of the least-squares line through the logarithms of the upper half of the points."""
    points = [(math.log(x), math.log(y)) for x, y in points[len(points) // 2 - 1:] if y > 0]
    if len(points) < 2:
        return 0.0
    middle_x, middle_y = (sum(axis) / len(points) for axis in zip(*points))
    return (sum((x - middle_x) * (y - middle_y) for x, y in points) /
            sum((x - middle_x) ** 2 for x, _ in points))


def plot(path, title, curves):
    """An SVG of curves [(x, y)] by name, both axes logarithmic, a line at each power of ten."""
    width, height, margin = 480, 320, 48
    points = [point for curve in curves.values() for point in curve if point[1] > 0]
    lowest = [math.floor(math.log10(min(axis))) for axis in zip(*points)]
    highest = [max(low + 1, math.ceil(math.log10(max(axis))))
               for low, axis in zip(lowest, zip(*points))]

    def place(point):
        part = [(math.log10(value) - low) / (high - low)
                for value, low, high in zip(point, lowest, highest)]
        return (margin + part[0] * (width - 2 * margin),
                height - margin - part[1] * (height - 2 * margin))

    out = [f'<svg xmlns="http://www.w3.org/2000/svg" width="{width}" height="{height}" '
           'font-family="sans-serif" font-size="11"><rect width="100%" height="100%" fill="#fff"/>',
           f'<text x="{margin}" y="24" font-size="14">{title}</text>']
    for power in range(lowest[0], highest[0] + 1):
        x, bottom = place((10.0**power, 10.0**lowest[1]))
        out.append(f'<path d="M{x:.1f} {bottom:.1f}V{margin}" stroke="#ddd"/>'
                   f'<text x="{x:.1f}" y="{bottom + 16:.1f}" text-anchor="middle">1e{power}</text>')
    for power in range(lowest[1], highest[1] + 1):
        left, y = place((10.0**lowest[0], 10.0**power))
        out.append(f'<path d="M{left:.1f} {y:.1f}H{width - margin}" stroke="#ddd"/>'
                   f'<text x="{left - 4:.1f}" y="{y + 4:.1f}" text-anchor="end">1e{power}</text>')
    for index, (name, curve) in enumerate(curves.items()):
        line = " ".join(f"{x:.1f},{y:.1f}" for x, y in map(place, (p for p in curve if p[1] > 0)))
        colour = COLOURS[name]
        out.append(f'<polyline points="{line}" fill="none" stroke="{colour}" stroke-width="2"/>'
                   f'<text x="{width - margin}" y="{20 + 14 * index}" text-anchor="end" '
                   f'fill="{colour}">{name}, s</text>')
    with open(path, "w", encoding="utf-8") as file:
        file.write("\n".join(out) + "\n</svg>\n")


def main():
    parser = argparse.ArgumentParser(description=__doc__.split("\n", 1)[0])
    parser.add_argument("--build", default="build")
    parser.add_argument("--device")
    parser.add_argument("--only", help="names of studies")
    arguments = parser.parse_args()
    wanted = names(arguments.only, list(STUDIES), "ONLY")
    top = os.getcwd()
    tree = Tree(top, os.path.join(top, arguments.build), arguments.device)
    folder = os.path.join(tree.build, "bench")
    os.makedirs(folder, exist_ok=True)
    results = {}
    for name in STUDIES if wanted is None else wanted:
        counts, study = STUDIES[name]
        study(tree, counts[0])  # compiles
        results[name] = []
        for count in counts:
            print(f"{name}: {count}", file=sys.stderr)
            results[name].append({"count": count, **study(tree, count)})
        print(f"{name:>10}  render s   build s  memory MB")
        for row in results[name]:
            print(f"{row['count']:10d} {row['render']:9.3f} {row['build']:9.3f} "
                  f"{row['memory']:10.0f}")
        curves = {what: [(row["count"], row[what]) for row in results[name]]
                  for what in ("render", "build")}
        if name == "threads":
            one, two = (row["render"] for row in results[name])
            print(f"     2 threads are {one / two:.2f} times as fast as 1; two renders at once, of "
                  f"one thread each, {threads_apart(tree):.2f} times\n")
            continue
        slopes = ", ".join(f"{what} {slope(curve):.2f}" for what, curve in curves.items())
        print(f"     slopes: {slopes}\n", flush=True)
        plot(os.path.join(folder, name + ".svg"), f"{name}: seconds", curves)
    with open(os.path.join(folder, "scaling.json"), "w", encoding="utf-8") as file:
        json.dump(results, file, indent=1)


if __name__ == "__main__":
    try:
        main()
    except Failed as error:
        sys.exit(str(error))
