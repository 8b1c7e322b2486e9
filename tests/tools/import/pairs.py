"""Materials, textures, lights, shapes and media of pbrt beside their equals in Mitsuba 3.

    pairs.py RTC FOLDER [SAMPLES [NAME...]]

A room with a ball, written once for each case as FOLDER/NAME.pbrt and rendered by RTC, and by
Mitsuba as a dictionary. Prints the worst block of 8 x 8 pixels, relative to the block or the
picture's mean, the larger, and fails where one is off by more than 4 %. It takes Mitsuba, NumPy
and OpenEXR (from PyPI).
"""
import pathlib
import subprocess
import sys

import mitsuba as mi
import numpy
import OpenEXR

mi.set_variant("llvm_ad_rgb")
T = mi.ScalarTransform4f
SIZE, BLOCK, TOLERANCE = 64, 8, 0.04


def rgb(*v):
    return {"type": "rgb", "value": list(v) if len(v) == 3 else [v[0]] * 3}


def numbers(values):
    return " ".join(f"{v:.9g}" for v in values)


# ---- The room ----------------------------------------------------------------------------------

HEAD = f"""Film "rgb" "integer xresolution" {SIZE} "integer yresolution" {SIZE}
PixelFilter "box" "float xradius" 0.5 "float yradius" 0.5
Integrator "volpath" "integer maxdepth" 31
Scale -1 1 1
LookAt 0 1.4 4.5  0 0.8 0  0 1 0
Camera "perspective" "float fov" 38
WorldBegin
"""
LAMP = """AttributeBegin
AreaLightSource "diffuse" "rgb L" [9 8 7]
Material "diffuse" "rgb reflectance" [0 0 0]
Shape "trianglemesh" "point3 P" [-0.8 3 -0.3  0.8 3 -0.3  0.8 3 1.3  -0.8 3 1.3]
  "integer indices" [0 1 2 0 2 3]
AttributeEnd
"""
WALLS = """AttributeBegin
Material "diffuse" "rgb reflectance" [0.6 0.55 0.5]
Shape "bilinearmesh" "point3 P" [-3 0 -3  3 0 -3  -3 0 3  3 0 3]
Shape "bilinearmesh" "point3 P" [-3 0 -2  3 0 -2  -3 4 -2  3 4 -2]
AttributeEnd
"""
BALL = 'Translate 0 0.8 0\nShape "sphere" "float radius" 0.8\n'


def square(width, height):
    return T().scale([width, height, 1])


def walls():
    bsdf = {"type": "twosided", "bsdf": {"type": "diffuse", "reflectance": rgb(0.6, 0.55, 0.5)}}
    return {"floor": {"type": "rectangle", "bsdf": bsdf,
                      "to_world": T().rotate([1, 0, 0], -90) @ square(3, 3)},
            "wall": {"type": "rectangle", "bsdf": bsdf,
                     "to_world": T().translate([0, 2, -2]) @ square(3, 2)}}


def lamp():
    return {"type": "rectangle", "emitter": {"type": "area", "radiance": rgb(9, 8, 7)},
            "bsdf": {"type": "diffuse", "reflectance": rgb(0)},
            "to_world": T().translate([0, 3, 0.5]) @ T().rotate([1, 0, 0], 90) @ square(0.8, 0.8)}


def scene(things):
    return {"type": "scene", "integrator": {"type": "volpath", "max_depth": 32},
            "sensor": {"type": "perspective", "fov": 38,
                       "to_world": T().look_at([0, 1.4, 4.5], [0, 0.8, 0], [0, 1, 0]),
                       "film": {"type": "hdrfilm", "width": SIZE, "height": SIZE,
                                "rfilter": {"type": "box"}, "pixel_format": "rgb"}},
            **walls(), **things}


def ball(bsdf, **more):
    return {"type": "sphere", "center": [0, 0.8, 0], "radius": 0.8, "bsdf": bsdf, **more}


# ---- The cases: what pbrt has behind the walls, and Mitsuba beside them ------------------------

def material(text, bsdf):
    return LAMP + text + BALL, {"lamp": lamp(), "ball": ball(bsdf)}


def twosided(bsdf):
    return {"type": "twosided", "bsdf": bsdf}


def light(text, emitter):
    grey = {"type": "diffuse", "reflectance": rgb(0.5)}
    return (text + 'Material "diffuse" "rgb reflectance" [0.5 0.5 0.5]\n' + BALL,
            {"light": emitter, "ball": ball(grey)})


def shape(text, shapes):
    bsdf = twosided({"type": "diffuse", "reflectance": rgb(0.3, 0.5, 0.7)})
    made = {f"shape{i}": {**s, "bsdf": bsdf} for i, s in enumerate(shapes)}
    return (LAMP + 'Material "diffuse" "rgb reflectance" [0.3 0.5 0.7]\n' + text,
            {"lamp": lamp(), **made})


def checks(a, b):
    return {"type": "checkerboard", "color0": rgb(*a), "color1": rgb(*b),
            "to_uv": T().scale([2, 2, 1])}


def patch(bsdf):
    """A square with u to the right and v up, which pbrt has as a bilinear mesh."""
    return {"type": "rectangle", "bsdf": twosided(bsdf),
            "to_world": T().translate([0, 1, 0]) @ square(1, 1)}


PATCH = 'Shape "bilinearmesh" "point3 P" [-1 0 0  1 0 0  -1 2 0  1 2 0]\n'


def texture(text, bsdf):
    return LAMP + text + PATCH, {"lamp": lamp(), "patch": patch(bsdf)}


def medium(text, inside):
    return (LAMP + text + 'MediumInterface "fog" ""\nMaterial "interface"\n' + BALL,
            {"lamp": lamp(), "ball": ball({"type": "null"}, interior=inside)})


GOLD = ([0.155, 0.425, 1.383], [3.603, 2.472, 1.915])


def metal(**more):
    return {"type": "roughconductor", "distribution": "ggx", "eta": rgb(*GOLD[0]),
            "k": rgb(*GOLD[1]), **more}


def cases(folder):
    tiles = folder / "tiles.png"
    red, blue = (0.6, 0.1, 0.1), (0.1, 0.2, 0.6)
    gold = f'"rgb eta" [{numbers(GOLD[0])}] "rgb k" [{numbers(GOLD[1])}] '
    f0 = (0.9, 0.6, 0.3)
    by_f0 = {"type": "roughconductor", "distribution": "ggx", "alpha": 0.2, "eta": rgb(1),
             "k": rgb(*(2 * (f / (1 - f)) ** 0.5 for f in f0))}
    fine = '"float roughness" 0.2 "bool remaproughness" false\n'
    bitmap = {"type": "bitmap", "filename": str(tiles), "to_uv": T().scale([1, -1, 1])}
    fog = ('MakeNamedMedium "fog" "string type" "homogeneous" "rgb sigma_a" [0.2 0.1 0.05] '
           '"rgb sigma_s" [1 1.2 1.5] "float g" 0.3\n')
    voxels = [1, 2, 0.5, 3, 0, 1, 2, 1]
    grid = ('MakeNamedMedium "fog" "string type" "uniformgrid" "rgb sigma_a" [0.2 0.2 0.2] '
            '"rgb sigma_s" [1 1 1] "integer nx" 2 "integer ny" 2 "integer nz" 2 "point3 p0" '
            f'[-0.8 0 -0.8] "point3 p1" [0.8 1.6 0.8] "float density" [{numbers(voxels)}]\n')
    density = numpy.array(voxels, dtype=numpy.float32).reshape(2, 2, 2)
    box = T().translate([-0.8, 0, -0.8]) @ T().scale([1.6, 1.6, 1.6])
    uv = [-1, 0, 0, 1, 0, 0, 1, 2, 0, -1, 2, 0]
    return {
        "diffuse": material('Material "diffuse" "rgb reflectance" [0.6 0.1 0.1]\n',
                            {"type": "diffuse", "reflectance": rgb(*red)}),
        "conductor": material(f'Material "conductor" {gold}{fine}', twosided(metal(alpha=0.2))),
        "conductor_uv": material(
            f'Material "conductor" {gold}"float uroughness" 0.3 "float vroughness" 0.1 '
            '"bool remaproughness" false\n', twosided(metal(alpha_u=0.3, alpha_v=0.1))),
        "conductor_remapped": material(f'Material "conductor" {gold}"float roughness" 0.09\n',
                                       twosided(metal(alpha=0.3))),
        "conductor_reflectance": material(
            f'Material "conductor" "rgb reflectance" [{numbers(f0)}] {fine}', twosided(by_f0)),
        "dielectric": material('Material "dielectric" "float eta" 1.5\n',
                               {"type": "dielectric", "int_ior": 1.5, "ext_ior": 1.0}),
        "rough_dielectric": material(
            f'Material "dielectric" "float eta" 1.5 {fine}',
            {"type": "roughdielectric", "distribution": "ggx", "alpha": 0.2, "int_ior": 1.5,
             "ext_ior": 1.0}),
        "thindielectric": material('Material "thindielectric" "float eta" 1.5\n',
                                   {"type": "thindielectric", "int_ior": 1.5, "ext_ior": 1.0}),
        "coateddiffuse": material(
            f'Material "coateddiffuse" "rgb reflectance" [0.6 0.1 0.1] {fine}',
            twosided({"type": "roughplastic", "distribution": "ggx", "alpha": 0.2, "int_ior": 1.5,
                      "ext_ior": 1.0, "diffuse_reflectance": rgb(*red), "nonlinear": True})),
        "mix": material(
            'MakeNamedMaterial "a" "string type" "diffuse" "rgb reflectance" [0.6 0.1 0.1]\n'
            f'MakeNamedMaterial "b" "string type" "conductor" {gold}{fine}'
            'Material "mix" "string materials" ["a" "b"] "float amount" 0.3\n',
            twosided({"type": "blendbsdf", "weight": 0.3, "bsdf_0":
                      {"type": "diffuse", "reflectance": rgb(*red)}, "bsdf_1": metal(alpha=0.2)})),
        "alpha": (
            LAMP + 'Material "diffuse" "rgb reflectance" [0.6 0.1 0.1]\nTranslate 0 0.8 0\n'
            'Shape "sphere" "float radius" 0.8 "float alpha" 0.4\n',
            {"lamp": lamp(), "ball": ball({"type": "mask", "opacity": 0.4, "bsdf": twosided(
                {"type": "diffuse", "reflectance": rgb(*red)})})}),
        "imagemap": texture(
            'Texture "t" "spectrum" "imagemap" "string filename" "tiles.png"\n'
            'Material "diffuse" "texture reflectance" "t"\n',
            {"type": "diffuse", "reflectance": bitmap}),
        "imagemap_scaled": texture(
            'Texture "t" "spectrum" "imagemap" "string filename" "tiles.png" "float uscale" 2 '
            '"float vscale" 3 "float udelta" 0.25\n'
            'Material "diffuse" "texture reflectance" "t"\n',
            {"type": "diffuse", "reflectance": {
                **bitmap, "to_uv": T().translate([0.25, 0, 0]) @ T().scale([2, -3, 1])}}),
        "checkerboard": texture(
            'Texture "t" "spectrum" "checkerboard" "rgb tex1" [0.6 0.1 0.1] "rgb tex2" '
            '[0.1 0.2 0.6] "float uscale" 4 "float vscale" 4\n'
            'Material "diffuse" "texture reflectance" "t"\n',
            {"type": "diffuse", "reflectance": checks(red, blue)}),
        "scale": texture(
            'Texture "s" "spectrum" "checkerboard" "rgb tex1" [0.8 0.8 0.8] "rgb tex2" '
            '[0.4 0.4 0.4] "float uscale" 4 "float vscale" 4\n'
            'Texture "t" "spectrum" "scale" "texture tex" "s" "float scale" 0.5\n'
            'Material "diffuse" "texture reflectance" "t"\n',
            {"type": "diffuse", "reflectance": checks((0.4,) * 3, (0.2,) * 3)}),
        "mix_of_textures": texture(
            'Texture "t" "spectrum" "mix" "rgb tex1" [0.6 0.1 0.1] "rgb tex2" [0.1 0.2 0.6] '
            '"float amount" 0.25\nMaterial "diffuse" "texture reflectance" "t"\n',
            {"type": "diffuse", "reflectance": rgb(0.475, 0.125, 0.225)}),
        "point": light('LightSource "point" "rgb I" [9 8 7] "point3 from" [0.5 2.5 2]\n',
                       {"type": "point", "position": [0.5, 2.5, 2], "intensity": rgb(9, 8, 7)}),
        "distant": light(
            'LightSource "distant" "rgb L" [3 2.5 2] "point3 from" [1 2 1.5] "point3 to" [0 0 0]\n',
            {"type": "directional", "direction": [-1, -2, -1.5], "irradiance": rgb(3, 2.5, 2)}),
        "infinite": light('LightSource "infinite" "rgb L" [0.7 0.8 1]\n',
                          {"type": "constant", "radiance": rgb(0.7, 0.8, 1)}),
        "sphere_light": (
            'AttributeBegin\nAreaLightSource "diffuse" "rgb L" [30 25 20] "float scale" 0.5\n'
            'Translate 0.5 2.2 1\nShape "sphere" "float radius" 0.2\nAttributeEnd\n'
            'Material "diffuse" "rgb reflectance" [0.5 0.5 0.5]\n' + BALL,
            {"lamp": {"type": "sphere", "center": [0.5, 2.2, 1], "radius": 0.2,
                      "emitter": {"type": "area", "radiance": rgb(15, 12.5, 10)}},
             "ball": ball({"type": "diffuse", "reflectance": rgb(0.5)})}),
        "sphere": shape(BALL, [{"type": "sphere", "center": [0, 0.8, 0], "radius": 0.8}]),
        "disk": shape('Translate 0 0.8 0\nRotate 30 0 1 0\nShape "disk" "float radius" 0.8\n',
                      [{"type": "disk", "to_world": T().translate([0, 0.8, 0])
                        @ T().rotate([0, 1, 0], 30) @ T().scale([0.8, 0.8, 0.8])}]),
        "cylinder": shape('Rotate -90 1 0 0\nShape "cylinder" "float radius" 0.5 "float zmin" 0.1 '
                          '"float zmax" 1.5\n',
                          [{"type": "cylinder", "p0": [0, 0.1, 0], "p1": [0, 1.5, 0],
                            "radius": 0.5}]),
        "trianglemesh": shape(
            f'Shape "trianglemesh" "point3 P" [{numbers(uv)}] "integer indices" [0 1 2 0 2 3]\n',
            [{"type": "rectangle", "to_world": T().translate([0, 1, 0]) @ square(1, 1)}]),
        "instances": shape(
            'ObjectBegin "o"\nShape "sphere" "float radius" 0.4\nObjectEnd\n'
            'AttributeBegin\nTranslate -0.6 0.4 0\nObjectInstance "o"\nAttributeEnd\n'
            'Translate 0.6 0.8 0\nScale 1.2 1.2 1.2\nObjectInstance "o"\n',
            [{"type": "sphere", "center": [-0.6, 0.4, 0], "radius": 0.4},
             {"type": "sphere", "center": [0.6, 0.8, 0], "radius": 0.48}]),
        "homogeneous": medium(fog, {
            "type": "homogeneous", "sigma_t": rgb(0.12, 0.13, 0.155), "scale": 10,
            "albedo": rgb(1 / 1.2, 1.2 / 1.3, 1.5 / 1.55), "phase": {"type": "hg", "g": 0.3}}),
        "uniformgrid": medium(grid, {
            "type": "heterogeneous", "albedo": rgb(1 / 1.2), "scale": 1.2,
            "sigma_t": {"type": "gridvolume", "grid": mi.VolumeGrid(density), "to_world": box,
                        "filter_type": "trilinear", "wrap_mode": "clamp"}}),
    }


# ---- Beside each other -------------------------------------------------------------------------

def worst_block(made, right):
    least, most = right.mean((0, 1)).max(), 0
    for y in range(0, SIZE, BLOCK):
        for x in range(0, SIZE, BLOCK):
            area = (slice(y, y + BLOCK), slice(x, x + BLOCK))
            a, b = made[area].mean((0, 1)), right[area].mean((0, 1))
            most = max(most, abs(a - b).max() / max(b.max(), least))
    return most


def main():
    rtc, folder, *more = sys.argv[1:]
    folder, samples = pathlib.Path(folder), int(more[0]) if more else 512
    folder.mkdir(parents=True, exist_ok=True)
    scenes = pathlib.Path(__file__).parent / "scenes"
    (folder / "tiles.png").write_bytes((scenes / "tiles.png").read_bytes())
    off = 0
    for name, (text, things) in cases(folder).items():
        if more[1:] and name not in more[1:]:
            continue
        path = folder / f"{name}.pbrt"
        path.write_text(HEAD + WALLS + text, encoding="ascii")
        run = subprocess.run([rtc, path, "--spp", str(samples), "--quiet", "--out",
                              path.with_suffix(".exr")], capture_output=True, text=True,
                             check=False)
        if run.returncode != 0:
            print("failed", name, run.stderr.strip())
            off += 1
            continue
        pixels = OpenEXR.File(str(path.with_suffix(".exr"))).channels()["RGB"].pixels
        right = numpy.array(mi.render(mi.load_dict(scene(things)), spp=samples))[..., :3]
        worst = worst_block(numpy.asarray(pixels, dtype=float), right)
        off += worst > TOLERANCE
        print("ok    " if worst <= TOLERANCE else "off   ", f"{name}: {100 * worst:.1f} %",
              f"ratio {pixels.mean() / right.mean():.4f}", flush=True)
    print(f"{off} off")
    return 1 if off else 0


if __name__ == "__main__":
    sys.exit(main())
