#!/usr/bin/env python3
"""Path tracing speed of Mitsuba 3 on the Cornell box of tests/bench/cornell32.rts.

    pip install mitsuba
    python3 mitsuba_cornell.py [--runs N] [--spp N] [--size N] [--out FILE.exr]

Prints millions of camera samples a second, the median of the runs, as the last line:

    mitsuba llvm_ad_rgb 3.2 Msamples/s

A first render, not counted, compiles Mitsuba's kernels. --out keeps the last render as .exr or
.pfm, to be compared with ours.

What the two programs must agree on, and how it is said in each:
- The scene: camera, triangles, colours and max_depth are read from that very file.
- Path length: Mitsuba's max_depth counts the segments of a path from the eye, the last one to the
  light included (2 is direct light alone), and so does the scene language's.
- Russian roulette starts at the fifth segment in Mitsuba (rr_depth 5, its default).
- Box filter and light sampling with multiple importance sampling in both; Mitsuba's default
  sampler, independent random numbers.
"""
import argparse
import os
import re
import statistics
import sys
import tempfile
import time

HERE = os.path.dirname(os.path.abspath(__file__))
SCENE = os.path.join(HERE, os.pardir, "cornell32.rts")
sys.path.insert(0, os.path.join(HERE, os.pardir, os.pardir, "peers"))
import mitsuba_llvm  # noqa: E402


def read_scene(path):
    """The blocks of a scene file of one block a line, as (word, name, {field: [word, ...]})."""
    blocks = []
    with open(path, encoding="utf-8") as file:
        for line in (line.split("#", 1)[0].strip() for line in file):
            match = re.fullmatch(r"(\w+)\s*(\w*)\s*\{(.*)\}", line)
            if match:
                blocks.append((match.group(1), match.group(2), read_fields(match.group(3).split())))
            elif line:
                sys.exit(f"{path}: not one block on one line: {line}")
    return blocks


def read_fields(words):
    """Every field has at least one value, so a name behind a value begins the next field."""
    fields, values = {}, ["none is awaited before the first name"]
    for word in words:
        if values and re.fullmatch(r"[a-z]\w*", word):
            values = fields[word] = []
        else:
            values.append(word)
    return fields


def numbers(words):
    return [float(word) for word in words]


def single_blocks(blocks):
    return {word: fields for word, _, fields in blocks if word in ("camera", "film", "render")}


def write_ply(path, triangles):
    with open(path, "w", encoding="ascii") as file:
        file.write(f"ply\nformat ascii 1.0\nelement vertex {3 * len(triangles)}\n")
        file.write("property float x\nproperty float y\nproperty float z\n")
        file.write(f"element face {len(triangles)}\n")
        file.write("property list uchar int vertex_indices\nend_header\n")
        for triangle in triangles:
            for corner in "abc":
                file.write(" ".join(triangle[corner]) + "\n")
        for first in range(0, 3 * len(triangles), 3):
            file.write(f"3 {first} {first + 1} {first + 2}\n")


def describe(mi, blocks, directory, size):
    """The scene as a dictionary for Mitsuba; one mesh a material, written to directory."""
    single = single_blocks(blocks)
    camera = {name: numbers(words) for name, words in single["camera"].items()}
    scene = {
        "type": "scene",
        "integrator": {"type": "path", "max_depth": int(single["render"]["max_depth"][0])},
        "sensor": {
            "type": "perspective", "fov": camera["fov"][0], "fov_axis": "x",
            "to_world": mi.ScalarTransform4f().look_at(
                camera["eye"], camera["look_at"], camera["up"]),
            "film": {"type": "hdrfilm", "width": size, "height": size, "rfilter": {"type": "box"},
                     "pixel_format": "rgb", "component_format": "float32"},
        },
    }
    for material in (block for block in blocks if block[0] == "material"):
        name, reflectance = material[1], numbers(material[2]["kd"])
        triangles = [fields for word, _, fields in blocks
                     if word == "triangle" and fields["material"] == [name]]
        path = os.path.join(directory, name + ".ply")
        write_ply(path, triangles)
        bsdf = {"type": "diffuse", "reflectance": {"type": "rgb", "value": reflectance}}
        scene[name] = {"type": "ply", "filename": path, "face_normals": True, "bsdf": bsdf}
        if "radiance" in triangles[0]:
            radiance = {"type": "rgb", "value": numbers(triangles[0]["radiance"])}
            scene[name]["emitter"] = {"type": "area", "radiance": radiance}
    return scene


def main():
    parser = argparse.ArgumentParser(description=__doc__.split("\n", 1)[0])
    parser.add_argument("--runs", type=int, default=5, help="counted renders")
    parser.add_argument("--spp", type=int, help="samples a pixel, instead of the scene's")
    parser.add_argument("--size", type=int, help="width and height, instead of the scene's")
    parser.add_argument("--variant", default="llvm_ad_rgb", help="variant of Mitsuba")
    parser.add_argument("--out", help="keep the last render here, .exr or .pfm")
    arguments = parser.parse_args()

    mi = mitsuba_llvm.start(arguments.variant)
    import drjit as dr

    blocks = read_scene(SCENE)
    size = arguments.size or int(single_blocks(blocks)["film"]["width"][0])
    spp = arguments.spp or int(single_blocks(blocks)["render"]["spp"][0])
    with tempfile.TemporaryDirectory() as directory:
        scene = mi.load_dict(describe(mi, blocks, directory, size))
    samples = size * size * spp
    rates = []
    for run in range(arguments.runs + 1):
        start = time.perf_counter()
        image = mi.render(scene, spp=spp, seed=run)
        dr.eval(image)
        dr.sync_thread()
        if run > 0:
            rates.append(samples / (time.perf_counter() - start) / 1e6)
    if arguments.out:
        mi.Bitmap(image).write(arguments.out)
    print("runs:", " ".join(f"{rate:.3f}" for rate in rates))
    print(f"mitsuba {arguments.variant} {statistics.median(rates):.3f} Msamples/s")


if __name__ == "__main__":
    main()
