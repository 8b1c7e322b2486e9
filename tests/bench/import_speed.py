"""Seconds and memory that a mesh of 1.5 million triangles takes, from each format.

    import_speed.py RTC OUT [--mitsuba PYTHON] [--blender PYTHON] [--triangles N]

Each file is read three times; the middle time counts. rtc: `rtc check FILE`, the whole process,
which reads the file, checks it and measures its solids. Mitsuba and Blender: the call that loads
the file, with modules loaded and the program started before; their memory is what the call adds.
PYTHON has the module mitsuba (variant llvm_ad_rgb, or scalar_rgb where there is no LLVM) or bpy.
It takes NumPy.
"""
import argparse
import json
import os
import statistics
import struct
import subprocess
import sys
import time
import zlib

import numpy


def read_ply(path):
    """Positions, normals, uv and triangles of a file by `rtc mesh`."""
    with open(path, "rb") as file:
        data = file.read()
    head = data.index(b"end_header\n") + len(b"end_header\n")
    counts = [int(line.split()[2]) for line in data[:head].split(b"\n") if line[:7] == b"element"]
    vertices = numpy.frombuffer(data, "<f4", counts[0] * 8, head).reshape(-1, 8)
    faces = numpy.frombuffer(data, [("n", "u1"), ("v", "<u4", 3)], counts[1],
                             head + counts[0] * 32)["v"]
    return vertices, faces


def write_obj(path, vertices, faces):
    with open(path, "w", encoding="ascii") as file:
        for word, columns in (("v", slice(0, 3)), ("vn", slice(3, 6)), ("vt", slice(6, 8))):
            for row in vertices[:, columns]:
                file.write(word + " " + " ".join(f"{x:.7g}" for x in row) + "\n")
        for a, b, c in faces + 1:
            file.write(f"f {a}/{a}/{a} {b}/{b}/{b} {c}/{c}/{c}\n")


def write_text_ply(path, vertices, faces):
    with open(path, "w", encoding="ascii") as file:
        file.write(f"ply\nformat ascii 1.0\nelement vertex {len(vertices)}\n")
        file.writelines(f"property float {name}\n" for name in "x y z nx ny nz u v".split())
        file.write(f"element face {len(faces)}\nproperty list uchar int vertex_indices\n"
                   "end_header\n")
        file.writelines(" ".join(f"{x:.7g}" for x in row) + "\n" for row in vertices)
        file.writelines(f"3 {a} {b} {c}\n" for a, b, c in faces)


def write_off(path, vertices, faces):
    with open(path, "w", encoding="ascii") as file:
        file.write(f"OFF\n{len(vertices)} {len(faces)} 0\n")
        file.writelines(" ".join(f"{x:.7g}" for x in row[:3]) + "\n" for row in vertices)
        file.writelines(f"3 {a} {b} {c}\n" for a, b, c in faces)


def write_stl(path, vertices, faces):
    rows = numpy.zeros(len(faces), [("f", "<f4", (4, 3)), ("a", "<u2")])
    rows["f"][:, 1:] = vertices[faces, :3]
    with open(path, "wb") as file:
        file.write(bytes(80) + struct.pack("<I", len(faces)) + rows.tobytes())


def write_glb(path, vertices, faces):
    parts = [vertices[:, :3], vertices[:, 3:6], vertices[:, 6:], faces.astype("<u4")]
    views, at = [], 0
    for part in parts:
        views.append({"buffer": 0, "byteOffset": at, "byteLength": part.nbytes})
        at += part.nbytes
    accessors = [{"bufferView": i, "componentType": 5126, "count": len(vertices), "type": kind}
                 for i, kind in enumerate(("VEC3", "VEC3", "VEC2"))]
    accessors[0].update(min=vertices[:, :3].min(0).tolist(), max=vertices[:, :3].max(0).tolist())
    accessors.append({"bufferView": 3, "componentType": 5125, "count": faces.size,
                      "type": "SCALAR"})
    mesh = {"attributes": {"POSITION": 0, "NORMAL": 1, "TEXCOORD_0": 2}, "indices": 3}
    text = json.dumps({"asset": {"version": "2.0"}, "buffers": [{"byteLength": at}],
                       "bufferViews": views, "accessors": accessors,
                       "meshes": [{"primitives": [mesh]}], "nodes": [{"mesh": 0}],
                       "scenes": [{"nodes": [0]}], "scene": 0}).encode()
    text += b" " * (-len(text) % 4)
    with open(path, "wb") as file:
        file.write(struct.pack("<4sII", b"glTF", 2, 28 + len(text) + at))
        file.write(struct.pack("<I4s", len(text), b"JSON") + text)
        file.write(struct.pack("<I4s", at, b"BIN\0"))
        file.write(b"".join(numpy.ascontiguousarray(part).tobytes() for part in parts))


def write_serialized(path, vertices, faces):
    body = struct.pack("<I", 0x1 | 0x2 | 0x1000) + b"knot\0"
    body += struct.pack("<QQ", len(vertices), len(faces))
    for columns in (slice(0, 3), slice(3, 6), slice(6, 8)):
        body += numpy.ascontiguousarray(vertices[:, columns]).tobytes()
    body += faces.astype("<u4").tobytes()
    packed = zlib.compress(body, 1)
    with open(path, "wb") as file:
        file.write(struct.pack("<HH", 0x041C, 4) + packed + struct.pack("<QI", 0, 1))


def write_pbrt(path, vertices, faces):
    with open(path, "w", encoding="ascii") as file:
        file.write('Translate 0 0 5\nCamera "perspective"\nWorldBegin\nLightSource "infinite"\n'
                   'Shape "trianglemesh"\n')
        for name, kind, values in (("P", "point3", vertices[:, :3]),
                                   ("N", "normal", vertices[:, 3:6]),
                                   ("uv", "point2", vertices[:, 6:]),
                                   ("indices", "integer", faces)):
            file.write(f' "{kind} {name}" [\n')
            file.writelines(" ".join(f"{x:.7g}" for x in row) + "\n" for row in values)
            file.write(" ]\n")


WRITERS = {"ply": None, "text.ply": write_text_ply, "obj": write_obj, "stl": write_stl,
           "off": write_off, "glb": write_glb, "serialized": write_serialized, "pbrt": write_pbrt}

MITSUBA = """
import mitsuba as mi
try: mi.set_variant("llvm_ad_rgb")
except Exception: mi.set_variant("scalar_rgb")
mi.load_dict({"type": "sphere"})
def load(path):
    return mi.load_dict({"type": path.rsplit(".", 1)[1], "filename": path})
"""
BLENDER = """
import bpy
ways = {"obj": bpy.ops.wm.obj_import, "ply": bpy.ops.wm.ply_import, "stl": bpy.ops.wm.stl_import,
        "glb": bpy.ops.import_scene.gltf}
def load(path):
    return ways[path.rsplit(".", 1)[1]](filepath=path)
"""
MEASURE = """
import resource, sys, time
before = resource.getrusage(resource.RUSAGE_SELF).ru_maxrss
begin = time.perf_counter()
load(sys.argv[1])
print("took", time.perf_counter() - begin,
      (resource.getrusage(resource.RUSAGE_SELF).ru_maxrss - before) / 1024)
"""
PEERS = {"mitsuba": (MITSUBA, ("ply", "text.ply", "obj", "serialized")),
         "blender": (BLENDER, ("ply", "text.ply", "obj", "stl", "glb"))}


def time_peer(python, program, path):
    """Seconds and MiB, or None where it fails."""
    run = subprocess.run([python, "-c", program + MEASURE, path], capture_output=True, text=True,
                         check=False)
    lines = [line.split() for line in run.stdout.split("\n") if line.startswith("took")]
    return (float(lines[0][1]), float(lines[0][2])) if lines else None


def time_ours(rtc, path):
    begin = time.perf_counter()
    child = subprocess.Popen([rtc, "check", path], stdout=subprocess.DEVNULL,
                             stderr=subprocess.DEVNULL)
    _, status, usage = os.wait4(child.pid, 0)
    if status != 0:
        sys.exit(f"rtc check {path} failed")
    return time.perf_counter() - begin, usage.ru_maxrss / 1024


def show(runs):
    if None in runs:
        return "cannot read it"
    return f"{statistics.median(r[0] for r in runs):6.2f} s {max(r[1] for r in runs):6.0f} MiB"


def main():
    parser = argparse.ArgumentParser()
    parser.add_argument("rtc")
    parser.add_argument("out")
    parser.add_argument("--mitsuba")
    parser.add_argument("--blender")
    parser.add_argument("--triangles", default="1500000")
    arguments = parser.parse_args()
    os.makedirs(arguments.out, exist_ok=True)
    base = os.path.join(arguments.out, "knot.ply")
    subprocess.run([arguments.rtc, "mesh", "knot", "--triangles", arguments.triangles, "--out",
                    base], check=True)
    vertices, faces = read_ply(base)
    print(f"{len(faces)} triangles, {len(vertices)} vertices")
    for form, write in WRITERS.items():
        path = os.path.abspath(os.path.join(arguments.out, "knot." + form))
        if write:
            write(path, vertices, faces)
        scene = path
        if form == "serialized":
            scene = path + ".xml"
            with open(scene, "w", encoding="ascii") as file:
                file.write('<scene version="3.0.0"><shape type="serialized">'
                           f'<string name="filename" value="{path}"/></shape></scene>\n')
        line = f"{form:10} rtc {show([time_ours(arguments.rtc, scene) for _ in range(3)])}"
        for peer, (program, forms) in PEERS.items():
            python = getattr(arguments, peer)
            if python and form in forms:
                runs = [time_peer(python, program, path) for _ in range(3)]
                line += f"  {peer} {show(runs)}"
        print(line, flush=True)


if __name__ == "__main__":
    main()
