#!/usr/bin/env python3
"""Makes puff.grid, the smoke of plume.rts: python3 scenes/media/make.py

A column that widens and bends as it rises, its edge cut up by gradient noise (Perlin: "Improving
Noise", SIGGRAPH 2002).
"""
import array
import math
import os
import random
import struct

SIZE = (40, 44, 40)  # voxels along x, y and z; y is up

_table = list(range(256))
random.Random(7).shuffle(_table)
_table *= 2


def _slope(corner, x, y, z):
    """Along the gradient at a corner: one of the twelve to the edges of a cube."""
    corner &= 15
    u = x if corner < 8 else y
    v = y if corner < 4 else x if corner in (12, 14) else z
    return (-u if corner & 1 else u) + (-v if corner & 2 else v)


def noise(x, y, z):
    """From -1 to 1."""
    at = [math.floor(c) for c in (x, y, z)]
    p = [c - f for c, f in zip((x, y, z), at)]
    s = [t * t * t * (t * (6 * t - 15) + 10) for t in p]
    total = 0.0
    for corner in range(8):
        bits = [corner >> axis & 1 for axis in range(3)]
        index = 0
        for axis in range(3):
            index = _table[index + (at[axis] + bits[axis] & 255)]
        weight = math.prod(t if bit else 1 - t for t, bit in zip(s, bits))
        total += weight * _slope(index, *(c - bit for c, bit in zip(p, bits)))
    return total


def billows(x, y, z):
    """From 0, where lumps meet, to about 1 on top of them."""
    return sum(2 * abs(noise(x * 2 ** o, y * 2 ** o, z * 2 ** o)) / 2 ** o for o in range(3))


def density(x, y, z):
    """At a point of the unit cube."""
    bend = 0.16 * math.sin(4.5 * y + 0.6) * y
    radius = 0.09 + 0.29 * y ** 0.75
    body = 1 - math.hypot(x - 0.5 - bend, z - 0.5 + 0.5 * bend) / radius
    edge = min(1.0, 10 * y, 6 * (1 - y), 8 * min(x, z, 1 - x, 1 - z))
    if body < -0.5 or edge <= 0:
        return 0.0
    thick = body + 0.75 * (billows(3.5 * x, 3.5 * y - 3, 3.5 * z) - 0.75)
    return max(0.0, min(1.0, 3 * thick)) * edge / (1 + 1.5 * y)


def main():
    nx, ny, nz = SIZE
    values = array.array("f", (density((i + 0.5) / nx, (j + 0.5) / ny, (k + 0.5) / nz)
                               for k in range(nz) for j in range(ny) for i in range(nx)))
    if array.array("H", [1]).tobytes() != b"\1\0":
        values.byteswap()
    path = os.path.join(os.path.dirname(os.path.abspath(__file__)), "puff.grid")
    with open(path, "wb") as file:
        file.write(b"RTGRID1\n" + struct.pack("<3I", *SIZE) + values.tobytes())


if __name__ == "__main__":
    main()
