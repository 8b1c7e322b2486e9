"""The scenes of the benchmark for Mitsuba 3: each function is one scene file, number by number.

The box scenes are those of tests/peers/mitsuba_scenes.py, which tells what the two programs leave
to convention.
"""
import os
import sys

import numpy as np

HERE = os.path.dirname(os.path.abspath(__file__))
sys.path.insert(0, os.path.join(HERE, os.pardir, os.pardir, "peers"))
from mitsuba_scenes import (  # noqa: E402
    Transform, ball, bitmap, box_area, box_caustic, box_point, matte, quad, rgb, scene)

from cornell32 import cornell32  # noqa: E402


def plain(name):
    """The scene of that name, at its own size."""
    function, size = SCENES[name]
    parts = function()
    parts["camera"]["film"].update(width=size[0], height=size[1])
    return parts


def area_light(corner, edge1, edge2, *radiance):
    black = {"type": "diffuse", "reflectance": rgb(0)}
    return quad(corner, edge1, edge2, black, emitter={"type": "area", "radiance": rgb(*radiance)})


def even_sky(*radiance):
    return {"type": "constant", "radiance": rgb(*radiance)}


def metal(eta, k, alpha):
    return {"type": "roughconductor", "distribution": "ggx", "alpha": alpha, "eta": rgb(*eta),
            "k": rgb(*k)}


def gold(alpha):
    return metal((0.143, 0.375, 1.442), (3.983, 2.386, 1.603), alpha)


def flat_mesh(path, scale, place, bsdf):
    return {"type": "ply", "filename": path, "face_normals": True, "bsdf": bsdf,
            "to_world": Transform().translate(place).scale(scale)}


def mesh():
    return scene(
        8, (0.6, 1.4, -4.2), (0, 0.75, 0), 34,
        sky=even_sky(0.4, 0.5, 0.7),
        ground=quad((-4, 0, -4), (0, 0, 8), (8, 0, 0), matte(0.5)),
        light=area_light((-0.5, 2.8, -1.5), (1, 0, 0), (0, 0, 1), 12, 11, 9),
        knot=flat_mesh("build/bench/mesh.ply", 0.8, [0, 0.8, 0], matte(0.7, 0.5, 0.35)))


def glass_metal():
    copper = metal((0.2, 0.924, 1.102), (3.912, 2.452, 2.142), 0.3)
    clear = {"type": "dielectric", "int_ior": 1.5, "ext_ior": 1.0}
    frost = {"type": "roughdielectric", "distribution": "ggx", "alpha": 0.1,
             "int_ior": 1.5, "ext_ior": 1.0}
    return scene(
        16, (0, 1.6, -4.6), (0, 0.45, 0), 36,
        sky=even_sky(0.2, 0.25, 0.3),
        ground=quad((-4, 0, -4), (0, 0, 8), (8, 0, 0), matte(0.5, 0.45, 0.4)),
        wall=quad((-4, 0, 3), (0, 4, 0), (8, 0, 0), matte(0.4, 0.5, 0.6)),
        light=area_light((-2, 3, -2.5), (4, 0, 0), (0, 0, 4), 2, 1.9, 1.7),
        gold=ball((1.1, 0.5, 0.6), 0.5, gold(0.15)),
        copper=ball((-1.2, 0.5, 0.7), 0.5, copper),
        clear=ball((0.5, 0.4, -0.7), 0.4, clear),
        frost=ball((-0.5, 0.4, -0.5), 0.4, frost))


def many_lights():
    white, brick = matte(0.7), matte(0.6, 0.3, 0.2)
    parts = scene(
        8, (0, 2.4, -5.8), (0, 0.3, -0.5), 46,
        floor=quad((-4, 0, -6), (0, 0, 12), (8, 0, 0), white),
        ceiling=quad((-4, 3, -6), (8, 0, 0), (0, 0, 12), white),
        back=quad((-4, 0, 6), (0, 3, 0), (8, 0, 0), white),
        left=quad((-4, 0, -6), (0, 3, 0), (0, 0, 12), brick),
        right=quad((4, 0, -6), (0, 0, 12), (0, 3, 0), brick))
    for i in range(24):
        for j in range(24):
            bright = (1.02 + np.cos(np.radians(97 * i + 31 * j))) ** 2
            red = 0.5 + 0.5 * np.cos(np.radians(40 * i))
            blue = 0.5 + 0.5 * np.sin(np.radians(25 * j))
            parts[f"light_{i}_{j}"] = area_light(
                (-3.8 + 0.325 * i, 2.8, -5.8 + 0.5 * j), (0.06, 0, 0), (0, 0, 0.06),
                20 * bright * (0.2 + red), 15 * bright, 20 * bright * (0.2 + blue))
    for i in range(5):
        parts[f"screen_{i}"] = quad((-3.2 + 1.4 * i, 0, -1 + i), (0, 2.4, 0), (0.7, 0, 0.4), white)
    return parts


def textured(kind, **texture):
    texture = {"type": kind, **texture}
    return {"type": "twosided", "bsdf": {"type": "diffuse", "reflectance": texture}}


def doorway():
    upright = Transform().translate([0, 1, 0]).scale([3, -3, 1])
    letter = textured("bitmap", filename="scenes/textures/letter.png", to_uv=upright)
    tiles = textured("checkerboard", color0=rgb(0.75), color1=rgb(0.25, 0.3, 0.4),
                     to_uv=Transform().scale([4, 2.5, 1]))
    white, red = matte(0.75), matte(0.65, 0.2, 0.15)
    walls = [
        ((2, 0, -2), (-4, 0, 0), (0, 0, 4), letter),
        ((-2, 2.5, -2), (4, 0, 0), (0, 0, 4), white),
        ((-2, 0, 2), (4, 0, 0), (0, 2.5, 0), tiles),
        ((-2, 0, -2), (4, 0, 0), (0, 2.5, 0), white),
        ((-2, 0, -2), (0, 0, 4), (0, 2.5, 0), red),
        ((2, 0, -2), (0, 0, 0.8), (0, 2.5, 0), white),
        ((2, 0, 1), (0, 0, 1), (0, 2.5, 0), white),
        ((2, 2.2, -1.2), (0, 0, 2.2), (0, 0.3, 0), white),
        ((2, 0, -2), (0, 0, 4), (3, 0, 0), white),
        ((2, 2.5, -2), (3, 0, 0), (0, 0, 4), white),
        ((2, 0, 2), (3, 0, 0), (0, 2.5, 0), white),
        ((2, 0, -2), (3, 0, 0), (0, 2.5, 0), white),
        ((5, 0, -2), (0, 0, 4), (0, 2.5, 0), white)]
    return scene(
        16, (1.2, 1.5, -1.8), (-0.6, 0.8, 1), 70,
        light=area_light((2.2, 2.4, -1.6), (1.6, 0, 0), (0, 0, 3.2), 12, 11, 9.5),
        ball=ball((-0.2, 0.4, 0.9), 0.4, white),
        red_ball=ball((-0.8, 0.25, 0.1), 0.25, red),
        **{f"wall_{i}": quad(*wall) for i, wall in enumerate(walls)})


SKY = (1024, 512)


def sky(longitude, latitude):
    """Radiance [rows][columns][3]: from -z to the right, and from the top down, both in radians."""
    longitude, latitude = np.meshgrid(longitude, latitude)
    x, y = np.sin(longitude) * np.sin(latitude), np.cos(latitude)
    z = -np.cos(longitude) * np.sin(latitude)
    sun = np.array([0.7, 0.5, -0.55])
    sun /= np.linalg.norm(sun)
    near_sun = np.exp(200.0 * (x * sun[0] + y * sun[1] + z * sun[2] - 1.0))[..., None]
    blue, sunlight = np.array([0.35, 0.45, 0.6]), np.array([50.0, 45.0, 35.0])
    return (0.7 + 0.3 * y)[..., None] * blue + near_sun * sunlight


def our_sky():
    """Samples at the middle of each pixel, the middle column towards -z."""
    columns, rows = np.arange(SKY[0]) + 0.5, np.arange(SKY[1]) + 0.5
    return bitmap(sky((columns / SKY[0] - 0.5) * 2 * np.pi, rows / SKY[1] * np.pi))


def mitsuba_sky():
    """Samples at the left edge of each column, and from pole to pole."""
    columns, rows = np.arange(SKY[0]), np.arange(SKY[1])
    return bitmap(sky(columns / SKY[0] * 2 * np.pi, rows / (SKY[1] - 1) * np.pi))


def image_sky():
    clay, blue = matte(0.7, 0.5, 0.35), matte(0.2, 0.35, 0.7)
    return scene(
        12, (0.4, 1.5, -4.6), (0, 0.5, 0), 38,
        light={"type": "envmap", "bitmap": mitsuba_sky()},
        ground=quad((-5, 0, -5), (0, 0, 10), (10, 0, 0), matte(0.5, 0.45, 0.4)),
        knot=flat_mesh("scenes/meshes/knot.ply", 0.6, [-0.9, 0.6, 0.2], clay),
        gold=ball((0.5, 0.45, -0.5), 0.45, gold(0.2)),
        ball=ball((1.3, 0.5, 0.6), 0.5, blue),
        sail=quad((-0.4, 0, 1.2), (1.3, 0, 0.3), (-0.5, 1.3, 0.2), blue))


# What each is called, and its width and height.
SCENES = {
    "cornell32": (cornell32, (512, 512)),
    "box_area": (box_area, (128, 128)),
    "box_point": (box_point, (128, 128)),
    "box_caustic": (box_caustic, (128, 128)),
    **{function.__name__: (function, (128, 96))
       for function in (mesh, glass_metal, many_lights, doorway, image_sky)}}
