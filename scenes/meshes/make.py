#!/usr/bin/env python3
"""Writes goblet.ply, wine.ply, vase.ply and book.ply, the meshes of the show-pieces.

    python3 scenes/meshes/make.py

Each is a smooth surface with vertex normals, in metres, as a binary PLY file.
"""
import math
import os
import struct

FOLDER = os.path.dirname(os.path.abspath(__file__))


def write(name, points, normals, faces, uvs=None):
    with open(os.path.join(FOLDER, name), "wb") as out:
        fields = "x y z nx ny nz" + (" s t" if uvs else "")
        head = ["ply", "format binary_little_endian 1.0", "element vertex %d" % len(points)]
        head += ["property float " + field for field in fields.split()]
        head += ["element face %d" % len(faces), "property list uchar int vertex_indices",
                 "end_header", ""]
        out.write("\n".join(head).encode())
        for i, point in enumerate(points):
            values = tuple(point) + tuple(normals[i]) + (tuple(uvs[i]) if uvs else ())
            out.write(struct.pack("<%df" % len(values), *values))
        for face in faces:
            out.write(struct.pack("<B%di" % len(face), len(face), *face))


def rounded(points, steps=4):
    """Catmull-Rom through a list of (radius, height)."""
    out = []
    for i in range(len(points) - 1):
        p0, p1, p2 = points[max(i - 1, 0)], points[i], points[i + 1]
        p3 = points[min(i + 2, len(points) - 1)]
        for step in range(steps):
            t = step / steps
            out.append(tuple(0.5 * (2 * b + (c - a) * t + (2 * a - 5 * b + 4 * c - d) * t * t +
                                    (3 * b - a - 3 * c + d) * t ** 3)
                             for a, b, c, d in zip(p0, p1, p2, p3)))
    return [(max(r, 0.0), y) for r, y in out + [points[-1]]]


def revolve(name, profile, segments):
    """The profile runs from the axis at the bottom to the axis at the top, outside to its right."""
    points, normals, faces = [], [], []
    last = len(profile) - 1
    for i, (radius, height) in enumerate(profile):
        before, after = profile[max(i - 1, 0)], profile[min(i + 1, last)]
        dr, dy = after[0] - before[0], after[1] - before[1]
        length = math.hypot(dr, dy)
        nr, ny = dy / length, -dr / length
        if i in (0, last):
            nr, ny = 0.0, math.copysign(1.0, ny)
        for j in range(segments):
            angle = 2 * math.pi * j / segments
            c, s = math.cos(angle), math.sin(angle)
            points.append((radius * c, height, radius * s))
            normals.append((nr * c, ny, nr * s))
    for i in range(last):
        for j in range(segments):
            k = (j + 1) % segments
            a, b, c, d = (i * segments + j, i * segments + k, (i + 1) * segments + k,
                          (i + 1) * segments + j)
            if i > 0:
                faces.append((a, d, b) if i == last - 1 else (a, c, b))
            if i < last - 1:
                faces.append((a, d, c))
    write(name, points, normals, faces)


INSIDE = [(0, 0.1120), (0.012, 0.1135), (0.024, 0.1215), (0.034, 0.138), (0.0385, 0.160),
          (0.0365, 0.185), (0.0325, 0.207)]


def goblet():
    outside = [(0, 0), (0.020, 0.0002), (0.036, 0.0010), (0.0365, 0.0022), (0.030, 0.0040),
               (0.012, 0.0085), (0.0050, 0.018), (0.0042, 0.045), (0.0042, 0.080), (0.0060, 0.098),
               (0.013, 0.1105), (0.0255, 0.1195), (0.0355, 0.137), (0.0401, 0.160),
               (0.0381, 0.185), (0.0339, 0.207)]
    lip = [(0.0337, 0.2078), (0.0332, 0.2081), (0.0327, 0.2078)]
    revolve("goblet.ply", rounded(outside)[:-1] + lip + rounded(INSIDE)[::-1], 64)


def wine():
    """It reaches 0.3 mm into the glass; the glass has the higher priority."""
    level = 0.166
    body = [(r + 0.0003 if r else 0, y - 0.0003) for r, y in rounded(INSIDE) if y < level]
    top = body[-1][0] + 0.0001
    steps = [(top, level - 0.0004), (top, level), (top - 0.0006, level + 0.00001)]
    revolve("wine.ply", body + steps + [(0.5 * top, level), (0, level)], 64)


def vase():
    outside = [(0, 0), (0.030, 0.0), (0.036, 0.002), (0.046, 0.020), (0.058, 0.055), (0.060, 0.085),
               (0.050, 0.120), (0.030, 0.150), (0.0205, 0.172), (0.0200, 0.192), (0.0270, 0.214),
               (0.0300, 0.220)]
    inside = [(0.0285, 0.2205), (0.0250, 0.214), (0.0170, 0.192), (0.0175, 0.172), (0.027, 0.149),
              (0.046, 0.119), (0.0555, 0.085), (0.0535, 0.056), (0.041, 0.022), (0.028, 0.009),
              (0, 0.008)]
    revolve("vase.ply", rounded(outside) + rounded(inside), 64)


def page_height(x):
    """Of an open book, by the distance from the fold, from 0 to 1."""
    return 0.15 * math.pow(x, 0.55) * (1 - x) + 0.06 * x + 0.015


def book():
    columns, rows = 48, 2
    points, normals, uvs, faces = [], [], [], []
    for side in (-1, 1):
        first = len(points)
        for i in range(columns + 1):
            t = (i / columns) ** 1.7
            dt = 1e-4
            slope = (page_height(min(t + dt, 1)) - page_height(max(t - dt, 0))) / (
                min(t + dt, 1) - max(t - dt, 0))
            length = math.hypot(slope, 1)
            for j in range(rows + 1):
                points.append((side * t, page_height(t), 1.45 * (j / rows - 0.5)))
                normals.append((-side * slope / length, 1 / length, 0))
                uvs.append((0.5 + 0.5 * side * t, 1 - j / rows))
        for i in range(columns):
            for j in range(rows):
                a = first + i * (rows + 1) + j
                b, c, d = a + 1, a + rows + 2, a + rows + 1
                faces.append((a, b, c, d) if side > 0 else (a, d, c, b))
    write("book.ply", points, normals, faces, uvs)


if __name__ == "__main__":
    goblet()
    wine()
    vase()
    book()
