"""The scenes of compare.sh for Mitsuba 3: each function is one scene file, number by number.

Of what the two programs leave to convention:
- Lengths, right-handed axes, horizontal field of view, box filter, linear sRGB and the count of
  segments in max_depth are the same.
- Mitsuba's matte surfaces show one side only; wrapped in `twosided`, both, as ours do.
- The falloff of its spot light is linear in the angle, ours a cubic of the cosine: both have a hard
  edge here.
- Its masking-shadowing function is separable, ours is height-correlated (Heitz 2014): at the
  roughness of these scenes they differ by less than 1 in 1000 up to 80 degrees from the normal.
- Its sky has texels at the first and last row, and at the middle of each column; ours at the middle
  of each. Both are given samples of the same formula, where they want them.
- v = 0 is the first row of its textures, the last of ours: they are turned over here.
- The internal reflectance of its rough coats is a mean over 64 nodes, the ends among them, and
  1.5 % too low: what lies below is darker, by 1 % for kd 0.7, and by 2 % where it is not deepened.
- From behind, its maps are mirrored in the surface, where we show the back of what the front has.
  No scene shows that.
- Where a map tilts the normal away from the eye it flips that, or shows black; ours shows what the
  normal has. Scenes show such places only at the rims of balls. Its shadowing function for maps is
  turned off where ours is.
"""
from functools import partial

import mitsuba as mi
import numpy as np

Transform = mi.ScalarTransform4f
SIZE = 256


def rgb(*value):
    return {"type": "rgb", "value": list(value) if len(value) == 3 else [value[0]] * 3}


def matte(*kd):
    return {"type": "twosided", "bsdf": {"type": "diffuse", "reflectance": rgb(*kd)}}


def quad(corner, edge1, edge2, bsdf, **more):
    """A rectangle of Mitsuba's reaches from -1 to 1 in x and y, with its normal along z."""
    corner, edge1, edge2 = (np.array(v, dtype=float) for v in (corner, edge1, edge2))
    normal = np.cross(edge1, edge2)
    to_world = np.eye(4)
    middle = corner + (edge1 + edge2) / 2
    to_world[:3] = np.stack([edge1 / 2, edge2 / 2, normal / np.linalg.norm(normal), middle], 1)
    return {"type": "rectangle", "to_world": Transform(to_world), "bsdf": bsdf, **more}


def ball(centre, radius, bsdf):
    return {"type": "sphere", "center": list(centre), "radius": radius, "bsdf": bsdf}


def scene(max_depth, eye, look_at, fov, aperture=0.0, focal_distance=1.0, **parts):
    lens = {"type": "perspective"}
    if aperture > 0.0:
        lens = {"type": "thinlens", "aperture_radius": aperture, "focus_distance": focal_distance}
    film = {"type": "hdrfilm", "width": SIZE, "height": SIZE, "pixel_format": "rgb",
            "component_format": "float32", "rfilter": {"type": "box"}}
    camera = {**lens, "fov": fov, "fov_axis": "x", "film": film,
              "to_world": Transform().look_at(list(eye), list(look_at), [0, 1, 0])}
    integrator = {"type": "path", "max_depth": max_depth}
    return {"type": "scene", "integrator": integrator, "camera": camera, **parts}


# ---- The box, scenes/parts ------------------------------------------------------

def box(max_depth, **parts):
    white, red, green = matte(0.73), matte(0.65, 0.05, 0.05), matte(0.12, 0.45, 0.15)
    return scene(
        max_depth, (0, 0, -3.5), (0, 0, 0), 38,
        floor=quad((-1, -1, -1), (0, 0, 2), (2, 0, 0), white),
        ceiling=quad((-1, 1, -1), (2, 0, 0), (0, 0, 2), white),
        back=quad((-1, -1, 1), (0, 2, 0), (2, 0, 0), white),
        left=quad((1, -1, -1), (0, 0, 2), (0, 2, 0), red),
        right=quad((-1, -1, -1), (0, 2, 0), (0, 0, 2), green),
        **parts)


def box_light():
    black = {"type": "diffuse", "reflectance": rgb(0)}
    return quad((-0.25, 0.999, -0.25), (0.5, 0, 0), (0, 0, 0.5), black,
                emitter={"type": "area", "radiance": rgb(12)})


def box_balls(front, back):
    return {"back_ball": ball((0.5, -0.7, 0.25), 0.3, back),
            "front_ball": ball((-0.5, -0.7, -0.25), 0.3, front)}


def box_point():
    light = {"type": "point", "position": [0, 0.5, 0], "intensity": rgb(1)}
    return box(16, light=light, **box_balls(matte(0.2, 0.4, 0.8), matte(0.8, 0.6, 0.2)))


def box_area():
    return box(16, light=box_light(), **box_balls(matte(0.2, 0.4, 0.8), matte(0.8, 0.6, 0.2)))


def box_caustic():
    glass = {"type": "dielectric", "int_ior": 1.5, "ext_ior": 1.0}
    mirror = {"type": "conductor", "material": "none"}
    return box(24, light=box_light(), **box_balls(glass, mirror))


# ---- Rough gold and glass under a sky -------------------------------------------

SKY_WIDTH, SKY_HEIGHT = 1024, 512


def sky(longitude, latitude):
    """Radiance [rows][columns][3]: from -z to the right, and from the top down, both in radians."""
    longitude, latitude = np.meshgrid(longitude, latitude)
    x, y = np.sin(longitude) * np.sin(latitude), np.cos(latitude)
    z = -np.cos(longitude) * np.sin(latitude)
    sun = np.array([0.7, 0.45, -0.55])
    sun /= np.linalg.norm(sun)
    near_sun = np.exp(40.0 * (x * sun[0] + y * sun[1] + z * sun[2] - 1.0))[..., None]
    blue, sunlight = np.array([0.35, 0.45, 0.6]), np.array([12.0, 10.0, 7.0])
    return (0.7 + 0.3 * y)[..., None] * blue + near_sun * sunlight


def our_sky():
    columns, rows = np.arange(SKY_WIDTH) + 0.5, np.arange(SKY_HEIGHT) + 0.5
    return sky((columns / SKY_WIDTH - 0.5) * 2 * np.pi, rows / SKY_HEIGHT * np.pi)


def mitsuba_sky():
    columns, rows = np.arange(SKY_WIDTH) + 0.5, np.arange(SKY_HEIGHT)
    return sky(columns / SKY_WIDTH * 2 * np.pi, rows / (SKY_HEIGHT - 1) * np.pi)


def bitmap(pixels):
    return mi.Bitmap(pixels.astype(np.float32))


def metal_glass():
    gold = {"type": "roughconductor", "distribution": "ggx", "alpha": 0.15,
            "eta": rgb(0.143, 0.375, 1.442), "k": rgb(3.983, 2.386, 1.603)}
    frost = {"type": "roughdielectric", "distribution": "ggx", "alpha": 0.1,
             "int_ior": 1.5, "ext_ior": 1.0}
    return scene(
        24, (0, 1.1, -4.2), (0, 0.45, 0), 36,
        light={"type": "envmap", "bitmap": bitmap(mitsuba_sky())},
        ground=quad((-3, 0, -3), (0, 0, 6), (6, 0, 0), matte(0.5, 0.45, 0.4)),
        gold=ball((0.6, 0.5, 0.3), 0.5, gold),
        frost=ball((-0.6, 0.5, -0.3), 0.5, frost))


# ---- Coats over diffuse bodies under a sky -----------------------------------------

def plastic():
    def coated(ior, nonlinear, *kd):
        return {"type": "plastic", "int_ior": ior, "ext_ior": 1.0, "nonlinear": nonlinear,
                "diffuse_reflectance": rgb(*kd)}
    floor = {"type": "twosided", "bsdf": coated(1.33, True, 0.5, 0.45, 0.4)}
    return scene(
        16, (0, 1.1, -4.2), (0, 0.45, 0), 36,
        light={"type": "envmap", "bitmap": bitmap(mitsuba_sky())},
        floor=quad((-3, 0, -3), (0, 0, 6), (6, 0, 0), floor),
        deep=ball((0.6, 0.5, 0.3), 0.5, coated(1.5, True, 0.7, 0.2, 0.1)),
        pale=ball((-0.6, 0.5, -0.3), 0.5, coated(1.9, False, 0.1, 0.3, 0.7)))


# ---- Thin glass before matte bodies under a sky -------------------------------------

def panes():
    def sheet(ior, *kt):
        return {"type": "thindielectric", "int_ior": ior, "ext_ior": 1.0,
                "specular_reflectance": rgb(*kt), "specular_transmittance": rgb(*kt)}
    return scene(
        24, (0, 1.1, -4.2), (0, 0.45, 0), 36,
        light={"type": "envmap", "bitmap": bitmap(mitsuba_sky())},
        floor=quad((-3, 0, -3), (0, 0, 6), (6, 0, 0), matte(0.5, 0.45, 0.4)),
        inner=ball((0.6, 0.5, 0.3), 0.3, matte(0.7, 0.2, 0.1)),
        bubble=ball((0.6, 0.5, 0.3), 0.5, sheet(1.8, 1, 1, 1)),
        pane=quad((-1.3, 0, 0.2), (1.1, 0, -0.6), (0, 1.2, 0), sheet(1.5, 0.9, 0.8, 0.6)),
        behind=ball((-0.6, 0.4, 0.9), 0.4, matte(0.7, 0.2, 0.1)))


# ---- Normal maps and a bump map under a sky --------------------------------------

MAP_SIZE = 64


def waves():
    return np.meshgrid(*2 * [np.arange(MAP_SIZE) / MAP_SIZE * 4 * np.pi])


def normals(scale=(1, 1, 1)):
    x, y = waves()
    slope_x, slope_y = 0.2 * np.cos(x), 0.15 * np.sin(y + 0.5 * x)
    normal = np.stack([slope_x, slope_y, np.sqrt(1 - slope_x**2 - slope_y**2)], -1)
    return (normal * scale + 1) / 2


def heights():
    x, y = waves()
    return np.stack(3 * [(np.sin(x) * np.cos(y) + 1) / 2], -1)


UPRIGHT = Transform().translate([0, 1, 0]).scale([1, -1, 1])


def diffuse(*kd):
    return {"type": "diffuse", "reflectance": rgb(*kd)}


def mapped(kind, image, inner, place=UPRIGHT, shadowing=False, **more):
    """Images are turned over on quads; on balls v = 0 is the north pole, the top of ours."""
    texture = {"type": "bitmap", "bitmap": bitmap(image), "raw": True, "to_uv": place}
    return {"type": "twosided", "bsdf": {
        "type": kind, kind: texture, "inner": inner, "use_shadowing_function": shadowing, **more}}


def relief():
    gold = {"type": "roughconductor", "distribution": "ggx", "alpha": 0.15,
            "eta": rgb(0.143, 0.375, 1.442), "k": rgb(3.983, 2.386, 1.603)}
    return scene(
        16, (0, 3.4, -3.2), (0, 0.45, 0), 36,
        light={"type": "envmap", "bitmap": bitmap(mitsuba_sky())},
        floor=quad((-3, 0, -3), (0, 0, 6), (6, 0, 0),
                   mapped("normalmap", normals(), diffuse(0.5, 0.45, 0.4))),
        metal=quad((0, 0.1, 0.3), (0, 1, 0.5), (1.1, 0, -0.1),
                   mapped("normalmap", normals(), gold)),
        bumpy=quad((-1.2, 0.1, 0.3), (0, 1, 0.5), (1.1, 0, 0.1),
                   mapped("bumpmap", heights(), diffuse(0.3, 0.5, 0.7), scale=0.05)),
        other=quad((-0.35, 0.05, -1), (0, 0.4, 0.5), (0.7, 0, 0),
                   mapped("normalmap", normals((1, -1, 1)), diffuse(0.6, 0.3, 0.5),
                          shadowing=True)),
        knobs=upright_ball((-0.7, 0.3, -0.6), 0.3,
                           mapped("bumpmap", heights(), diffuse(0.7, 0.4, 0.2), Transform(),
                                  scale=0.01)),
        cloth=upright_ball((0.7, 0.3, -0.6), 0.3,
                           mapped("normalmap", normals((0.4, 0.4, 1)), diffuse(0.3, 0.6, 0.3),
                                  Transform())))


# ---- Anisotropic gold, Beckmann's copper and glass -------------------------------

def brushed():
    def metal(eta, k, **facets):
        bsdf = {"type": "roughconductor", "eta": rgb(*eta), "k": rgb(*k), **facets}
        return {"type": "twosided", "bsdf": bsdf}
    gold = metal((0.143, 0.375, 1.442), (3.983, 2.386, 1.603), distribution="ggx",
                 alpha_u=0.05, alpha_v=0.2)
    copper = metal((0.2, 0.92, 1.1), (3.91, 2.45, 2.14), distribution="beckmann", alpha=0.2)
    frost = {"type": "roughdielectric", "distribution": "beckmann", "alpha": 0.15,
             "int_ior": 1.5, "ext_ior": 1.0}
    # The poles of its spheres are along z, those of ours along y.
    upright = Transform().translate([0.6, 0.4, -0.3]).rotate([1, 0, 0], -90).scale(0.4)
    return scene(
        24, (0, 1.6, -4.2), (0, 0.5, 0), 36,
        light={"type": "constant", "radiance": rgb(0.35, 0.45, 0.6)},
        square=quad((-1, 2.6, -4), (1.6, 0, 0.6), (0, 1.2, 0.8), matte(0),
                    emitter={"type": "area", "radiance": rgb(9, 8, 6)}),
        ground=quad((-3, 0, -3), (0, 0, 6), (6, 0, 0), matte(0.5, 0.45, 0.4)),
        gold=quad((0.05, 0.1, 0.9), (0, 1, 0.5), (1.2, 0, -0.1), gold),
        copper=quad((-1.25, 0.1, 0.8), (0, 1, 0.5), (1.2, 0, 0.1), copper),
        turned={"type": "sphere", "to_world": upright, "bsdf": gold},
        frost=ball((-0.6, 0.4, -0.4), 0.4, frost))


# ---- Principled solids, transmitting solids and sheets --------------------------------

def principled(*base_color, kind="principled", **numbers):
    return {"type": kind, "base_color": rgb(*base_color), "roughness": 0.0, **numbers}


def lit(eye, look_at, fov, ground, max_depth, **parts):
    return scene(
        max_depth, eye, look_at, fov,
        light={"type": "constant", "radiance": rgb(0.35, 0.45, 0.6)},
        square=quad((-1, 2.6, -4), (1.6, 0, 0.6), (0, 1.2, 0.8), matte(0),
                    emitter={"type": "area", "radiance": rgb(9, 8, 6)}),
        ground=quad((-3, 0, -3), (0, 0, 6), (6, 0, 0), ground),
        **parts)


def upright_ball(centre, radius, bsdf):
    """The poles of its spheres are along z, those of ours along y."""
    upright = Transform().translate(list(centre)).rotate([1, 0, 0], -90).scale(radius)
    return {"type": "sphere", "to_world": upright, "bsdf": bsdf}


def paints():
    balls = [
        principled(0.8, 0.1, 0.1, roughness=0.5),
        principled(0.2, 0.4, 0.8, metallic=0.5, roughness=0.2, spec_tint=0.7),
        principled(0.9, 0.65, 0.2, metallic=1.0, roughness=0.35),
        principled(0.7, 0.7, 0.75, metallic=0.9, roughness=0.45, anisotropic=0.8),
        principled(0.1, 0.3, 0.15, roughness=0.8, clearcoat=1.0, clearcoat_gloss=0.2),
        principled(0.1, 0.1, 0.3, metallic=0.3, roughness=0.6, clearcoat=0.8,
                   clearcoat_gloss=0.9, specular=0.2),
        principled(0.4, 0.1, 0.3, roughness=0.9, sheen=1.0, sheen_tint=0.6, eta=1.3),
        principled(0.7, 0.6, 0.4, roughness=0.3, flatness=1.0, eta=1.8, spec_tint=1.0,
                   sheen=0.4)]
    parts = {f"ball{i}": upright_ball((-1.2 + 0.8 * (i % 4), 0.4, 0.9 if i < 4 else -0.3), 0.4, b)
             for i, b in enumerate(balls)}
    ground = principled(0.5, 0.45, 0.4, roughness=0.8, eta=1.5, flatness=0.6)
    return lit((0, 2.2, -4.6), (0, 0.55, 0), 34, {"type": "twosided", "bsdf": ground}, 12,
               **parts)


def dyes():
    balls = [
        principled(1.0, spec_trans=1.0, roughness=0.3),
        principled(0.9, 0.5, 0.2, spec_trans=1.0, roughness=0.45, eta=1.33),
        principled(0.5, 0.7, 0.9, spec_trans=0.5, roughness=0.5, spec_tint=0.8, eta=1.7),
        principled(0.8, 0.6, 0.3, spec_trans=0.8, metallic=0.4, roughness=0.4, sheen=0.5),
        principled(0.6, 0.9, 0.7, spec_trans=0.9, roughness=0.5, anisotropic=0.7),
        principled(0.9, 0.3, 0.4, spec_trans=0.7, roughness=0.7, clearcoat=1.0,
                   clearcoat_gloss=0.5, flatness=0.5)]
    parts = {f"ball{i}": upright_ball((-0.9 + 0.9 * (i % 3), 0.41, 0.7 if i < 3 else -0.3), 0.4, b)
             for i, b in enumerate(balls)}
    return lit((0, 2.0, -4.4), (0, 0.45, 0), 32, matte(0.5, 0.45, 0.4), 24, **parts)


def sheets():
    def sheet(*base_color, **numbers):
        return principled(*base_color, kind="principledthin", **numbers)
    leaf = sheet(0.3, 0.6, 0.1, diff_trans=1.2, roughness=0.6, sheen=0.5, sheen_tint=1.0)
    paper = sheet(0.8, diff_trans=0.6, roughness=0.9, flatness=0.7)
    frost = sheet(0.9, 0.8, 0.6, spec_trans=1.0, roughness=0.4, eta=1.5)
    foil = sheet(0.3, 0.5, 0.9, spec_trans=0.6, roughness=0.5, anisotropic=0.6, spec_tint=0.8,
                 diff_trans=0.5, eta=1.8)
    return lit(
        (0, 1.8, -4.4), (0, 0.55, 0), 34, matte(0.5, 0.45, 0.4), 24,
        behind=quad((1.5, 0.2, 3), (-3, 0, 0), (0, 2.5, 0), matte(0),
                    emitter={"type": "area", "radiance": rgb(3, 3.5, 4)}),
        leaf=quad((-1.5, 0.05, 0.3), (0, 1, 0.1), (0.55, 0, -0.1), leaf),
        paper=quad((-0.7, 0.05, 0.4), (0, 1, 0.3), (0.6, 0, 0.1), paper),
        frost=quad((0.05, 0.05, 0.4), (0, 1, 0.3), (0.6, 0, -0.1), frost),
        foil=quad((0.8, 0.05, 0.3), (0, 1, 0.2), (0.6, 0, 0.2), foil),
        bubble=upright_ball((0, 0.35, -0.8), 0.3, frost),
        lantern=upright_ball((0.8, 0.35, -0.8), 0.3, leaf))


def upside_down(place):
    """A map of texture coordinates for images on its balls, whose v = 0 is at the north pole."""
    return UPRIGHT @ place @ UPRIGHT


# ---- Cutouts by a value and by a pattern ---------------------------------------------

def cutouts():
    def cut(opacity, bsdf):
        return {"type": "mask", "opacity": opacity, "nested": bsdf}
    holes = {"type": "checkerboard", "color0": rgb(1), "color1": rgb(0),
             "to_uv": Transform().scale([3, 3, 1])}
    half = {"type": "bitmap", "bitmap": bitmap(np.repeat([[[0.0]], [[1.0]]], 3, 2)),
            "raw": True, "filter_type": "nearest"}
    gold = {"type": "twosided", "bsdf": {
        "type": "roughconductor", "distribution": "ggx", "alpha": 0.15,
        "eta": rgb(0.143, 0.375, 1.442), "k": rgb(3.983, 2.386, 1.603)}}
    varnish = {"type": "twosided", "bsdf": {
        "type": "plastic", "int_ior": 1.5, "ext_ior": 1.0, "nonlinear": True,
        "diffuse_reflectance": rgb(0.7, 0.2, 0.1)}}
    return scene(
        24, (0, 1.6, -4.2), (0, 0.5, 0), 36,
        light={"type": "constant", "radiance": rgb(0.35, 0.45, 0.6)},
        square=quad((-1, 2.6, -4), (1.6, 0, 0.6), (0, 1.2, 0.8), matte(0),
                    emitter={"type": "area", "radiance": rgb(9, 8, 6)}),
        ground=quad((-3, 0, -3), (0, 0, 6), (6, 0, 0), matte(0.5, 0.45, 0.4)),
        leaf=quad((-1.3, 0.7, -0.5), (1.2, 0, 0), (0, 0.3, 1), cut(holes, matte(0.2, 0.6, 0.1))),
        grille=quad((0.05, 0.1, 0.9), (0, 1, 0.5), (1.2, 0, -0.1), cut(holes, gold)),
        gauze=ball((0.6, 0.4, -0.3), 0.4, cut(0.4, varnish)),
        body=ball((-0.6, 0.3, 0.2), 0.3, matte(0.7)),
        cut=quad((-0.3, 0, -0.9), (0.6, 0, 0), (0, 0.7, 0.2), cut(half, matte(0.7, 0.5, 0.1))))


# ---- Blends by a value and by a pattern, and sheets with two sides -----------------------

def blends():
    def blend(weight, first, second):
        return {"type": "blendbsdf", "weight": weight, "first": first, "second": second}
    squares = {"type": "checkerboard", "color0": rgb(0.9), "color1": rgb(0.1),
               "to_uv": Transform().scale([3, 3, 1])}
    bare = {"type": "roughconductor", "distribution": "ggx", "alpha": 0.15,
            "eta": rgb(0.143, 0.375, 1.442), "k": rgb(3.983, 2.386, 1.603)}
    gold = {"type": "twosided", "bsdf": bare}
    frost = {"type": "roughdielectric", "distribution": "ggx", "alpha": 0.2,
             "int_ior": 1.5, "ext_ior": 1.0}
    paint = matte(0.7, 0.2, 0.1)
    sheet = {"type": "twosided", "front": {"type": "diffuse", "reflectance": rgb(0.2, 0.6, 0.1)},
             "rear": bare}
    dark = {"type": "diffuse", "reflectance": rgb(0.8)}
    return scene(
        24, (0, 1.6, -4.2), (0, 0.5, 0), 36,
        light={"type": "point", "position": [0.5, 3, -3], "intensity": rgb(20, 18, 15)},
        sun={"type": "directional", "direction": [1, -1.5, 1], "irradiance": rgb(1, 1.2, 1.6)},
        rim={"type": "directional", "direction": [-0.5, -1, -1], "irradiance": rgb(1.5, 1.2, 0.8)},
        ground=quad((-3, 0, -3), (0, 0, 6), (6, 0, 0), matte(0.5, 0.45, 0.4)),
        worn=quad((0.05, 0.1, 0.9), (0, 1, 0.5), (1.2, 0, -0.1), blend(squares, paint, gold)),
        front=quad((-1.3, 0.7, -0.5), (0.6, 0, 0), (0, 0.3, 1), sheet),
        back=quad((-0.6, 0.7, -0.5), (0, 0.3, 1), (0.6, 0, 0), sheet),
        bright=quad((0.1, 0.8, -0.2), (0.5, 0, 0.2), (0, 0.5, 0.1), dark),
        dark=quad((0.7, 0.9, 0), (0, 0.5, 0.1), (0.5, 0, 0.2), dark),
        gilded=ball((0.6, 0.4, -0.3), 0.4, blend(0.3, matte(0.1, 0.3, 0.7), gold)),
        dirty=ball((-0.6, 0.35, -0.1), 0.35, blend(0.4, frost, paint)))


# ---- Rough coats --------------------------------------------------------------------

def coats():
    def coated(distribution, alpha, ior, *kd):
        return {"type": "roughplastic", "distribution": distribution, "alpha": alpha,
                "int_ior": ior, "ext_ior": 1.0, "nonlinear": True,
                "diffuse_reflectance": rgb(*kd)}
    tiles = {"type": "checkerboard", "color0": rgb(0.5, 0.45, 0.4), "color1": rgb(0.15, 0.2, 0.3),
             "to_uv": Transform().scale([6, 6, 1])}
    floor = {"type": "twosided", "bsdf": {
        "type": "plastic", "int_ior": 1.5, "ext_ior": 1.0, "nonlinear": True,
        "diffuse_reflectance": tiles}}
    return lit((0, 1.8, -4.4), (0, 0.4, 0), 42, floor, 16,
               satin=ball((-1.05, 0.5, 0.2), 0.5, coated("ggx", 0.2, 1.5, 0.7, 0.2, 0.1)),
               dull=ball((0, 0.5, 0.2), 0.5, coated("beckmann", 0.3, 1.7, 0.1, 0.3, 0.7)),
               pale=ball((1.05, 0.5, 0.2), 0.5, coated("ggx", 0.1, 1.5, 0.2, 0.6, 0.3)))


# ---- Metals by name under a turned sky ----------------------------------------------

METALS = {  # eta and k by rt_metal_index
    "gold": ((0.00703, 0.496, 1.477), (3.613, 2.25, 1.778)),
    "silver": ((0.161, 0.145, 0.136), (3.942, 3.175, 2.326)),
    "copper": ((0.236, 1.045, 1.297), (3.511, 2.626, 2.363)),
    "aluminium": ((1.503, 0.985, 0.606), (7.655, 6.55, 5.351)),
    "chromium": ((3.433, 2.746, 1.968), (4.284, 4.189, 3.825))}


def conductor(name, kind="roughconductor", **facets):
    eta, k = METALS[name]
    return {"type": kind, "eta": rgb(*eta), "k": rgb(*k), **facets}


def metals():
    def metal(name, kind="roughconductor", **facets):
        eta, k = METALS[name]
        return {"type": kind, "eta": rgb(*eta), "k": rgb(*k), **facets}
    # Of numbers, not of colours, its checkerboard begins with color1.
    scratches = {"type": "checkerboard", "color0": rgb(0.4), "color1": rgb(0.1),
                 "to_uv": Transform().scale([4, 4, 1])}
    copper = {"type": "twosided", "bsdf": conductor("copper", distribution="ggx", alpha=scratches)}
    return scene(
        24, (0, 2, -4.6), (0, 0.5, 0), 34,
        light={"type": "envmap", "bitmap": bitmap(mitsuba_sky()),
               "to_world": Transform().rotate(list(np.sqrt([0.5, 0, 0.5])), 40)},
        ground=quad((-3, 0, -3), (0, 0, 6), (6, 0, 0), matte(0.5, 0.45, 0.4)),
        gold=ball((-1, 0.4, 0.7), 0.4, conductor("gold", "conductor")),
        silver=ball((0, 0.4, 0.7), 0.4, conductor("silver", distribution="ggx", alpha=0.1)),
        aluminium=ball((1, 0.4, 0.7), 0.4,
                       conductor("aluminium", distribution="beckmann", alpha=0.3)),
        chromium=upright_ball(
            (-1, 0.4, -0.4), 0.4,
            conductor("chromium", distribution="ggx", alpha_u=0.15, alpha_v=0.05)),
        crown=ball((1, 0.4, -0.4), 0.4, dielectric(1.5168, 1)),
        copper=quad((-0.5, 0.05, -0.3), (0, 0.8, 0.4), (1, 0, 0), copper))


# ---- Images and patterns --------------------------------------------------------------

def cloth():
    x, y = np.meshgrid(*2 * [(np.arange(16) + 0.5) / 16 * np.pi])
    return np.stack([0.1 + 0.8 * np.sin(x), 0.9 - 0.7 * np.sin(y), 0.5 + 0.4 * np.cos(x + y)], -1)


def checker(squares, a, b):
    """[8][8][3]: the colours of a pattern of that many squares, its v = 0 in the first row."""
    i, j = np.meshgrid(*2 * [np.arange(8) * squares // 8])
    return np.where(((i + j) % 2 == 0)[..., None], a, b)


def prints():
    def printed(**texture):
        return {"type": "twosided", "bsdf": {
            "type": "diffuse", "reflectance": {"type": "bitmap", **texture}}}

    def image(kind, **texture):
        return printed(filename=f"build/peers/cloth.{kind}", **texture)

    def squares(colours):
        return printed(bitmap=bitmap(colours), raw=True, filter_type="nearest")
    small = checker(8, (0.7, 0.1, 0.08), (0.8, 0.7, 0.5))
    middle = checker(4, (0.9, 0.6, 0.3), (0.3, 0.8, 0.9))
    weight = checker(2, (0.8, 0.8, 0.8), (0.3, 0.3, 0.3))
    nested = np.where(checker(2, (1, 1, 1), (0, 0, 0)) > 0, small, (0.1, 0.25, 0.35))
    colours = {"type": "twosided", "bsdf": {
        "type": "diffuse",
        "reflectance": {"type": "mesh_attribute", "name": "vertex_color", "scale": 0.9}}}
    return lit(
        (0, 2, -4.6), (0, 0.55, 0), 42, matte(0.5, 0.45, 0.4), 12,
        printed=upright_ball((-1, 0.4, -0.3), 0.4, image(
            "png", wrap_mode="mirror", to_uv=upside_down(Transform().scale([2, 1.5, 1])))),
        photo=upright_ball((0, 0.4, -0.3), 0.4, image("jpg", filter_type="nearest")),
        bright=upright_ball((1, 0.4, -0.3), 0.4, image(
            "hdr", wrap_mode="clamp", to_uv=upside_down(
                Transform().rotate([0, 0, 1], 30).scale([1.5, 1.5, 1])))),
        first=quad((-1.5, 0.1, 0.7), (0.8, 0, 0.2), (0, 1, 0.3), squares(nested)),
        second=quad((-0.6, 0.1, 0.9), (0.8, 0, 0), (0, 1, 0.3), squares(small * middle)),
        third=quad((0.3, 0.1, 0.9), (0.8, 0, -0.2), (0, 1, 0.3),
                   squares((1 - weight) * small + weight * middle)),
        pyramid={"type": "ply", "filename": "tests/peers/pyramid.ply", "face_normals": True,
                 "bsdf": colours, "to_world": Transform().translate([1.5, 0, 0.8])})


# ---- A ball of one material, preview/ ------------------------------------------------

def preview(subject, **parts):
    squares = {"type": "checkerboard", "color0": rgb(0.6, 0.58, 0.55),
               "color1": rgb(0.15, 0.2, 0.25), "to_uv": Transform().scale([12, 12, 1])}
    floor = {"type": "twosided", "bsdf": {"type": "diffuse", "reflectance": squares}}
    grey = matte(0.4)
    lights = {"light": {"type": "constant", "radiance": rgb(0.35, 0.45, 0.6)},
              "square": quad((-1, 2.6, -4), (1.6, 0, 0.6), (0, 1.2, 0.8), matte(0),
                             emitter={"type": "area", "radiance": rgb(9, 8, 6)})}
    if subject["type"] == "blendbsdf":
        lights = {"light": {"type": "point", "position": [0.5, 3, -3],
                            "intensity": rgb(20, 18, 15)},
                  "sun": {"type": "directional", "direction": [1, -1.5, 1],
                          "irradiance": rgb(1, 1.2, 1.6)},
                  "rim": {"type": "directional", "direction": [-0.5, -1, 1],
                          "irradiance": rgb(1.5, 1.2, 0.8)}}
    return scene(
        24, (0.9, 1.5, -3.2), (0, 0.6, 0), 28, **lights, **parts,
        floor=quad((-3, 0, -3), (0, 0, 6), (6, 0, 0), floor),
        foot=wall(0.3, 0, 0.15, grey),
        top=level(0.3, 0.15, grey),
        ball=upright_ball((0, 0.7, 0), 0.5, subject),
        ring=wall(0.42, 0, 0.35, matte(0.7, 0.35, 0.1)))


def previews():
    """Subjects by the names of their files."""
    def squares(first, second):
        """Of numbers, its checkerboard begins with color1, on balls at the north pole."""
        return {"type": "checkerboard", "color0": rgb(first), "color1": rgb(second),
                "to_uv": Transform().scale([6, 4, 1])}
    blue = diffuse(0.3, 0.5, 0.7)
    repeated = Transform().scale([4, 3, 1])
    sides = {"type": "twosided", "front": diffuse(0.2, 0.6, 0.1),
             "rear": conductor("silver", distribution="ggx", alpha=0.15)}
    subjects = {
        "diffuse": matte(0.2, 0.4, 0.8),
        "dielectric": dielectric(1.5, 1),
        "thindielectric": {"type": "thindielectric", "int_ior": 1.5, "ext_ior": 1.0,
                           "specular_reflectance": rgb(0.9, 0.8, 0.6),
                           "specular_transmittance": rgb(0.9, 0.8, 0.6)},
        "roughdielectric": {"type": "roughdielectric", "distribution": "ggx", "alpha": 0.15,
                            "int_ior": 1.5, "ext_ior": 1.0},
        "conductor": conductor("gold", "conductor"),
        "roughconductor": conductor("copper", distribution="ggx", alpha=0.2),
        "plastic": {"type": "plastic", "int_ior": 1.5, "ext_ior": 1.0, "nonlinear": True,
                    "diffuse_reflectance": rgb(0.7, 0.2, 0.1)},
        "roughplastic": {"type": "roughplastic", "distribution": "ggx", "alpha": 0.15,
                         "int_ior": 1.5, "ext_ior": 1.0, "nonlinear": True,
                         "diffuse_reflectance": rgb(0.1, 0.3, 0.6)},
        "principled": principled(
            0.8, 0.3, 0.1, metallic=0.3, roughness=0.4, anisotropic=0.5, spec_tint=0.3,
            spec_trans=0.4, clearcoat=0.8, clearcoat_gloss=0.7, sheen=0.5, sheen_tint=0.5,
            flatness=0.3),
        "principledthin": principled(
            0.5, 0.7, 0.3, kind="principledthin", roughness=0.5, spec_trans=0.3, diff_trans=1.2,
            sheen=0.5, anisotropic=0.4),
        "bumpmap": mapped("bumpmap", heights(), blue, repeated, scale=0.02),
        "normalmap": mapped("normalmap", normals((0.5, -0.5, 1)), blue, repeated, shadowing=True),
        "mask": {"type": "mask", "opacity": squares(0.2, 1), "nested": matte(0.2, 0.6, 0.1)},
        "blendbsdf": {"type": "blendbsdf", "weight": squares(0.1, 0.9),
                      "first": diffuse(0.7, 0.2, 0.1),
                      "second": conductor("aluminium", distribution="ggx", alpha=0.1)}}
    scenes = {f"preview/{name}": partial(preview, bsdf) for name, bsdf in subjects.items()}
    scenes["preview/twosided"] = partial(
        preview, sides,
        near=quad((-0.9, 0.05, 0.2), (0.5, 0, -0.1), (0, 0.7, 0.2), sides),
        far=quad((0.9, 0.05, 0.3), (0, 0.7, 0.2), (0.5, 0, -0.1), sides))
    return scenes


# ---- Matte bodies under a spot light, through a lens ------------------------------

def stage():
    letter = {"type": "bitmap", "filename": "scenes/textures/letter.png", "wrap_mode": "clamp",
              "to_uv": UPRIGHT}
    floor = {"type": "twosided", "bsdf": {"type": "diffuse", "reflectance": letter}}
    return scene(
        12, (0.4, 1.5, -4.5), (0, 0.4, 0), 38, aperture=0.08, focal_distance=4.2,
        spot={"type": "spot", "intensity": rgb(30, 27, 24),
              "beam_width": 19.99, "cutoff_angle": 20.01,
              "to_world": Transform().look_at([1.5, 3.5, -2], [0, 0.2, 0], [0, 1, 0])},
        sun={"type": "directional", "direction": [1, -1.5, 1], "irradiance": rgb(0.4, 0.5, 0.7)},
        floor=quad((2, 0, -2), (-4, 0, 0), (0, 0, 4), floor),
        wall=quad((2, 0, 2), (-4, 0, 0), (0, 2.5, 0), matte(0.6)),
        ball=ball((0.8, 0.35, -0.9), 0.35, matte(0.7, 0.2, 0.15)),
        tube={"type": "cylinder", "p0": [-0.9, 0, -0.2], "p1": [-0.9, 0.8, -0.2], "radius": 0.3,
              "bsdf": matte(0.2, 0.35, 0.7)},
        lid={"type": "disk", "bsdf": matte(0.2, 0.35, 0.7),
             "to_world":
                 Transform().translate([-0.9, 0.8, -0.2]).rotate([1, 0, 0], -90).scale(0.3)},
        sail=quad((-0.4, 0, 1.2), (1.3, 0, 0.3), (-0.5, 1.3, 0.2), matte(0.25, 0.6, 0.3)),
        knot={"type": "ply", "filename": "scenes/meshes/knot.ply", "face_normals": True,
              "bsdf": matte(0.7, 0.5, 0.35),
              "to_world": Transform().translate([0.1, 0.6, 0.3]).scale(0.45)})


# ---- Solids that touch: a tumbler of water -----------------------------------------

RING = 1024  # corners of the rim, a polygon


def dielectric(inside, outside):
    """Of indices behind and before the normal."""
    return {"type": "dielectric", "int_ior": float(inside), "ext_ior": float(outside)}


def wall(radius, bottom, top, bsdf, **more):
    return {"type": "cylinder", "p0": [0, bottom, 0], "p1": [0, top, 0], "radius": radius,
            "bsdf": bsdf, **more}


def level(radius, height, bsdf, **more):
    """A disc whose normal points up."""
    place = Transform().translate([0, height, 0]).rotate([1, 0, 0], -90).scale(radius)
    return {"type": "disk", "to_world": place, "bsdf": bsdf, **more}


def rim(inner, outer, height, bsdf):
    """The ring between two circles, its normal up."""
    properties = mi.Properties()
    properties["bsdf"] = mi.load_dict(bsdf)
    properties["face_normals"] = True
    mesh = mi.Mesh("rim", 2 * RING, 2 * RING, props=properties)
    angle = np.arange(RING) * (2 * np.pi / RING)
    circle = np.stack([np.cos(angle), np.zeros(RING), np.sin(angle)], 1)
    corners = np.concatenate([inner * circle, outer * circle]) + [0, height, 0]
    a = np.arange(RING)
    b = (a + 1) % RING
    faces = np.concatenate([np.stack([a, b, a + RING], 1), np.stack([b, b + RING, a + RING], 1)])
    parameters = mi.traverse(mesh)
    parameters["vertex_positions"] = corners.astype(np.float32).ravel()
    parameters["faces"] = faces.astype(np.uint32).ravel()
    parameters.update()
    return mesh


def tumbler():
    water = {"type": "homogeneous", "albedo": rgb(0), "sigma_t": rgb(1, 0.36, 0.12), "scale": 2.5}
    black = {"type": "diffuse", "reflectance": rgb(0)}
    parts = scene(
        64, (0.9, 1.7, -2.6), (0, 0.45, 0), 34,
        light={"type": "constant", "radiance": rgb(0.5, 0.6, 0.8)},
        ground=quad((-3, 0, -3), (0, 0, 6), (6, 0, 0), matte(0.55, 0.5, 0.4)),
        lamp=quad((-2, 0.2, 1), (0, 2, 0), (1.2, 0, 1.2), black,
                  emitter={"type": "area", "radiance": rgb(6, 5, 4)}),
        outside=wall(0.5, 0, 1, dielectric(1.5, 1)),
        rim=rim(0.42, 0.5, 1, dielectric(1.5, 1)),
        dry=wall(0.42, 0.7, 1, dielectric(1, 1.5)),
        wet=wall(0.42, 0.12, 0.7, dielectric(1.33, 1.5), interior=water),
        bottom=level(0.42, 0.12, dielectric(1.5, 1.33), exterior=water),
        surface=level(0.42, 0.7, dielectric(1.33, 1), interior=water))
    parts["integrator"] = {"type": "volpath", "max_depth": 64}
    return parts


# ---- Media that scatter -------------------------------------------------------------


def medium(absorption, scattering, g):
    sigma_a, sigma_s = np.array(absorption), np.array(scattering)
    sigma_t = sigma_a + sigma_s
    return {"type": "homogeneous", "sigma_t": rgb(*(sigma_t / sigma_t.max())),
            "scale": float(sigma_t.max()), "albedo": rgb(*(sigma_s / sigma_t)),
            "phase": {"type": "hg", "g": g}}


def with_media(parts):
    parts["integrator"] = {"type": "volpath", "max_depth": parts["integrator"]["max_depth"]}
    return parts


def smoke():
    inside = medium((0.5, 1, 2), (4, 3, 2), 0.5)
    puff = {**ball((0, -0.3, 0), 0.6, {"type": "null"}), "interior": inside}
    return with_media(box(24, light=box_light(), puff=puff))


def milk():
    inside = medium((0.1, 0.3, 0.8), (3, 4, 5), -0.3)
    turbid = {**ball((0, -0.5, 0), 0.5, dielectric(1.5, 1)), "interior": inside}
    return with_media(box(32, light=box_light(), turbid=turbid))


def haze():
    everywhere = medium((0.02, 0.02, 0.05), (0.15, 0.2, 0.25), 0.7)
    light = {"type": "point", "position": [0.2, 0.5, 0], "intensity": rgb(1), "medium": everywhere}
    parts = with_media(box(16, light=light, ball=ball((0.1, -0.1, 0.1), 0.3, matte(0.8, 0.6, 0.2))))
    parts["camera"]["medium"] = everywhere
    return parts


def puff():
    with open("scenes/media/puff.grid", "rb") as file:
        assert file.read(8) == b"RTGRID1\n"
        size = np.fromfile(file, "<u4", 3)
        density = np.fromfile(file, "<f4").reshape(size[::-1])
    sigma_a, sigma_s = np.array((1, 2, 4)), np.array((16, 12, 8))
    sigma_t = (density[..., np.newaxis] * (sigma_a + sigma_s)).astype(np.float32)
    placed = Transform().translate([-0.7, -0.9, -0.7]).scale(1.4)
    inside = {"type": "heterogeneous", "phase": {"type": "hg", "g": 0.5},
              "sigma_t": {"type": "gridvolume", "grid": mi.VolumeGrid(sigma_t), "raw": True,
                          "to_world": placed},
              "albedo": {"type": "constvolume", "value": rgb(*(sigma_s / (sigma_a + sigma_s)))}}
    around = {"type": "cube", "to_world": Transform().translate([0, -0.2, 0]).scale(0.7),
              "bsdf": {"type": "null"}, "interior": inside}
    return with_media(box(32, light=box_light(), smoke=around))


SCENES = {function.__name__: function
          for function in (box_point, box_area, box_caustic, metal_glass, plastic, panes, relief,
                           brushed, paints, dyes, sheets, cutouts, blends, coats, metals,
                           prints, stage, tumbler, smoke, milk, haze, puff)}
SCENES.update(previews())

# Those that our own scenes read.
IMAGES = {"sky": our_sky, "normals": normals, "heights": heights, "cloth": cloth}
