"""Writes the scenes of tests/tools/import/scenes, each for Mitsuba 3, pbrt-v4 and glTF 2.0.

    python3 tests/tools/import/make_scenes.py tests/tools/import/scenes
"""
import base64
import json
import math
import pathlib
import struct
import sys
import zlib

METAL = {"eta": [1, 1, 1], "f0": [0.9, 0.7, 0.4]}
METAL["k"] = [2 * math.sqrt(f / (1 - f)) for f in METAL["f0"]]


# ---- Affine maps: lists of four rows -----------------------------------------------------------

def multiply(a, b):
    return [[sum(a[i][k] * b[k][j] for k in range(4)) for j in range(4)] for i in range(4)]


def translate(x, y, z):
    return [[1, 0, 0, x], [0, 1, 0, y], [0, 0, 1, z], [0, 0, 0, 1]]


def scale(x, y, z):
    return [[x, 0, 0, 0], [0, y, 0, 0], [0, 0, z, 0], [0, 0, 0, 1]]


def turn(axis, degrees):
    c, s = math.cos(math.radians(degrees)), math.sin(math.radians(degrees))
    c, s = round(c, 9), round(s, 9)
    i, j = {"x": (1, 2), "y": (2, 0), "z": (0, 1)}[axis]
    out = scale(1, 1, 1)
    out[i][i], out[i][j], out[j][i], out[j][j] = c, -s, s, c
    return out


def chain(*steps):
    out = scale(1, 1, 1)
    for step in steps:
        out = multiply(step, out)
    return out


# ---- Meshes: positions, normals, uv with v = 0 at the top, triangles ---------------------------

def rect():
    return ([(-1, -1, 0), (1, -1, 0), (1, 1, 0), (-1, 1, 0)], [(0, 0, 1)] * 4,
            [(0, 0), (1, 0), (1, 1), (0, 1)], [(0, 1, 2), (0, 2, 3)])


def cube():
    positions, normals, uv, triangles = [], [], [], []
    for step in (turn("x", 0), turn("y", 90), turn("y", 180), turn("y", 270), turn("x", 90),
                 turn("x", 270)):
        face = multiply(step, translate(0, 0, 1))
        first = len(positions)
        for x, y in ((-1, -1), (1, -1), (1, 1), (-1, 1)):
            positions.append(tuple(round(face[i][0] * x + face[i][1] * y + face[i][3], 6)
                                   for i in range(3)))
            normals.append(tuple(face[i][2] for i in range(3)))
            uv.append(((x + 1) / 2, (y + 1) / 2))
        triangles += [(first, first + 1, first + 2), (first, first + 2, first + 3)]
    return positions, normals, uv, triangles


def gem():
    """A double pyramid of six sides, flat, each side with the same part of the image."""
    positions, uv, triangles = [], [], []
    ring = [(math.cos(math.radians(60 * i)), 0.0, math.sin(math.radians(60 * i))) for i in range(6)]
    for i in range(6):
        for top, order in ((1.2, (1, 0)), (-0.8, (0, 1))):
            a, b = ring[(i + order[0]) % 6], ring[(i + order[1]) % 6]
            first = len(positions)
            positions += [tuple(round(v, 6) for v in a), tuple(round(v, 6) for v in b), (0, top, 0)]
            uv += [(0, 0.25), (0.5, 0.25), (0.25, 0.875)]
            triangles.append((first, first + 1, first + 2))
    return positions, None, uv, triangles


def angle_normals(positions, triangles):
    """Normals of vertices, each face weighted by its angle there, as Mitsuba weights them."""
    normals = [[0, 0, 0] for _ in positions]
    for t in triangles:
        for i in range(3):
            p, q, r = (positions[t[(i + k) % 3]] for k in range(3))
            a, b = ([v[c] - p[c] for c in range(3)] for v in (q, r))
            cross = [a[(c + 1) % 3] * b[(c + 2) % 3] - a[(c + 2) % 3] * b[(c + 1) % 3]
                     for c in range(3)]
            angle = math.atan2(math.hypot(*cross), sum(v * w for v, w in zip(a, b)))
            for c in range(3):
                normals[t[i]][c] += angle * cross[c] / math.hypot(*cross)
    return [tuple(round(v / math.hypot(*n), 6) for v in n) for n in normals]


def stone():
    """An ellipsoid of few triangles, which share their vertices: an octahedron, split once."""
    points = [(1, 0, 0), (-1, 0, 0), (0, 1, 0), (0, -1, 0), (0, 0, 1), (0, 0, -1)]
    triangles = [(a, c, b) if (a + b + c) % 2 else (a, b, c)
                 for a in (0, 1) for b in (2, 3) for c in (4, 5)]
    halves, split = {}, []

    def half(i, j):
        edge = (min(i, j), max(i, j))
        if edge not in halves:
            middle = [points[i][c] + points[j][c] for c in range(3)]
            halves[edge] = len(points)
            points.append(tuple(v / math.hypot(*middle) for v in middle))
        return halves[edge]

    for a, b, c in triangles:
        ab, bc, ca = half(a, b), half(b, c), half(c, a)
        split += [(a, ab, ca), (ab, b, bc), (ca, bc, c), (ab, bc, ca)]
    positions = [tuple(round(v * s, 6) for v, s in zip(p, (1, 0.6, 0.8))) for p in points]
    return positions, angle_normals(positions, split), [(0, 0)] * len(positions), split


MESHES = {"rect": rect(), "cube": cube(), "gem": gem(), "stone": stone()}


# ---- Scenes: camera, materials, things, lights -------------------------------------------------

def diffuse(*kd):
    return {"kd": kd}


FLOOR = chain(turn("x", -90), scale(3, 1, 3))
LAMP = ("rect", chain(scale(0.6, 0.6, 1), turn("x", 90), translate(0, 2.6, 0.3)), "black",
        (9, 8, 7))
BASE = {"size": (96, 72), "eye": (0, 1.2, 4.5), "target": (0, 0.9, 0), "yfov": 42, "depth": 16,
        "points": [], "suns": [], "lens": None,
        "materials": {"white": diffuse(0.7, 0.7, 0.7), "black": diffuse(0, 0, 0),
                      "red": diffuse(0.6, 0.1, 0.1), "blue": diffuse(0.1, 0.2, 0.5)}}


def walls():
    return [("rect", FLOOR, "white", None),
            ("rect", chain(scale(3, 2, 1), translate(0, 1, -2)), "white", None),
            ("rect", chain(scale(2, 2, 1), turn("y", 90), translate(-2, 1, 0)), "red", None),
            ("rect", chain(scale(2, 2, 1), turn("y", -90), translate(2, 1, 0)), "blue", None)]


SCENES = {
    "room": dict(BASE, things=walls() + [
        LAMP, ("cube", chain(scale(0.4, 0.8, 0.4), turn("y", 25), translate(-0.7, 0.8, -0.6)),
               "white", None),
        ("cube", chain(scale(0.4, 0.4, 0.4), turn("y", -20), translate(0.6, 0.4, 0.4)), "red",
         None)]),
    "metal": dict(BASE, materials=dict(
        BASE["materials"], metal={"metal": METAL, "alpha": 0.25}, glass={"ior": 1.5}),
        things=walls() + [
            LAMP, ("cube", chain(scale(0.4, 0.7, 0.4), turn("y", 30), translate(-0.8, 0.7, -0.5)),
                   "metal", None),
            ("cube", chain(scale(0.35, 0.5, 0.35), turn("y", -25), translate(0.7, 0.51, 0.4)),
             "glass", None)]),
    "picture": dict(BASE, materials=dict(
        BASE["materials"], tiles={"image": "tiles.png", "repeat": (3, 2), "shift": (0.25, 0.5)},
        photo={"image": "tiles.png"}), things=[
            ("rect", FLOOR, "tiles", None), LAMP,
            ("rect", chain(scale(2, 1.3, 1), translate(0, 1.3, -1.5)), "photo", None),
            ("gem", chain(scale(0.6, 0.6, 0.6), turn("y", 15), translate(-0.8, 0.6, 0.2)), "photo",
             None),
            ("gem", chain(scale(0.4, 0.5, 0.4), turn("y", 40), translate(0.8, 0.45, 0.2)), "photo",
             None)]),
    "delta": dict(BASE, points=[((0.8, 2.2, 1.2), (6, 5, 4)), ((-1.2, 1.1, 1.5), (1, 2, 3))],
                  suns=[((-0.4, -1, -0.5), (1.2, 1.1, 0.9))], things=walls()[:2] + [
                      ("cube", chain(scale(0.4, 0.6, 0.4), turn("y", 25),
                                     translate(-0.7, 0.6, -0.3)), "red", None),
                      ("gem", chain(scale(0.5, 0.5, 0.5), translate(0.8, 0.45, 0.2)), "blue",
                       None)]),
    "tall": dict(BASE, size=(60, 100), eye=(1.5, 1.6, 4.2), target=(0, 0.8, 0), lens=(0.12, 4.0),
                 materials=dict(BASE["materials"], photo={"image": "tiles.png"}), things=[
                     ("rect", FLOOR, "white", None), LAMP] + [
                     ("gem", chain(scale(-0.5 if i % 2 else 0.5, 0.7, 0.5), turn("z", 10 * i),
                                   turn("y", 72 * i), translate(0, 0.9, -1 + 0.8 * i)), "photo",
                      None) for i in range(4)]),
    "smooth": dict(BASE, materials=dict(
        BASE["materials"], metal={"metal": METAL, "alpha": 0.25}), things=walls() + [
            LAMP, ("stone", chain(scale(0.7, 0.7, 0.7), turn("z", 60), turn("y", 30),
                                  translate(-0.7, 0.7, -0.3)), "metal", None),
            ("stone", chain(scale(0.6, 0.6, 0.6), turn("y", -20), translate(0.6, 0.4, 0.4)), "red",
             None)]),
}


# ---- Writers -----------------------------------------------------------------------------------

def numbers(values, separator=" "):
    return separator.join(f"{v + 0:.7g}" for v in values)


def flat(matrix):
    return [v for row in matrix for v in row]


def mitsuba(scene):
    def rgb(name, value):
        return f'<rgb name="{name}" value="{numbers(value)}"/>'

    def bsdf(name, m):
        if "metal" in m:
            inner = (f'<bsdf type="roughconductor" id="{name}">'
                     f'<float name="alpha" value="{m["alpha"]}"/>'
                     '<string name="distribution" value="ggx"/>'
                     + rgb("eta", m["metal"]["eta"]) + rgb("k", m["metal"]["k"]) + "</bsdf>")
        elif "ior" in m:
            inner = (f'<bsdf type="dielectric" id="{name}">'
                     f'<float name="int_ior" value="{m["ior"]}"/>'
                     '<float name="ext_ior" value="1"/></bsdf>')
        elif "image" in m:
            x, y = m.get("repeat", (1, 1))
            u, v = m.get("shift", (0, 0))
            inner = (f'<bsdf type="twosided" id="{name}"><bsdf type="diffuse">\n'
                     '    <texture type="bitmap" name="reflectance">'
                     f'<string name="filename" value="{m["image"]}"/>\n'
                     f'      <transform name="to_uv"><scale x="{x}" y="{y}"/>'
                     f'<translate x="{u}" y="{v}"/>'
                     "</transform></texture></bsdf></bsdf>")
        else:
            inner = (f'<bsdf type="twosided" id="{name}"><bsdf type="diffuse">'
                     + rgb("reflectance", m["kd"]) + "</bsdf></bsdf>")
        return "  " + inner

    def shape(kind, matrix, material, radiance):
        tag = {"rect": "rectangle", "cube": "cube"}.get(kind, "obj")
        file = f'<string name="filename" value="{kind}.obj"/>' if tag == "obj" else ""
        light = ""
        if radiance:
            light = '<emitter type="area">' + rgb("radiance", radiance) + "</emitter>"
        return (f'  <shape type="{tag}">{file}<transform name="to_world"><matrix value="'
                f'{numbers(flat(matrix))}"/></transform>\n    <ref id="{material}"/>'
                f"{light}</shape>")

    lens, size = scene["lens"], scene["size"]
    out = ['<scene version="3.0.0">',
           f'  <integrator type="path"><integer name="max_depth" value="{scene["depth"]}"/>'
           "</integrator>",
           f'  <sensor type="{"thinlens" if lens else "perspective"}">',
           f'    <float name="fov" value="{scene["yfov"]}"/><string name="fov_axis" value="y"/>',
           '    <transform name="to_world"><lookat '
           f'origin="{numbers(scene["eye"], ", ")}" target="{numbers(scene["target"], ", ")}" '
           'up="0, 1, 0"/></transform>']
    if lens:
        out.append(f'    <float name="aperture_radius" value="{lens[0]}"/>'
                   f'<float name="focus_distance" value="{lens[1]}"/>')
    out += ['    <sampler type="independent"><integer name="sample_count" value="64"/></sampler>',
            f'    <film type="hdrfilm"><integer name="width" value="{size[0]}"/>'
            f'<integer name="height" value="{size[1]}"/><rfilter type="box"/></film>',
            "  </sensor>"]
    out += [bsdf(name, m) for name, m in scene["materials"].items()]
    out += [shape(*thing) for thing in scene["things"]]
    out += ['  <emitter type="point"><point name="position" value="' + numbers(p) + '"/>'
            + rgb("intensity", i) + "</emitter>" for p, i in scene["points"]]
    out += ['  <emitter type="directional"><vector name="direction" value="' + numbers(d) + '"/>'
            + rgb("irradiance", e) + "</emitter>" for d, e in scene["suns"]]
    return "\n".join(out + ["</scene>", ""])


def pbrt(scene, is_mirrored):
    """is_mirrored: by a Scale -1 1 1, as in scenes made elsewhere; else with x negated."""
    def flip(v):
        return v if is_mirrored else (-v[0], v[1], v[2])

    def material(name, m):
        if "metal" in m:
            body = (f'"string type" "conductor" "float roughness" {m["alpha"]}\n'
                    '    "bool remaproughness" false\n'
                    '    "rgb eta" [ ' + numbers(m["metal"]["eta"]) + ' ] "rgb k" [ '
                    + numbers(m["metal"]["k"]) + " ]")
        elif "ior" in m:
            body = f'"string type" "dielectric" "float eta" {m["ior"]}'
        elif "image" in m:
            body = f'"string type" "diffuse" "texture reflectance" "{name}"'
        else:
            body = '"string type" "diffuse" "rgb reflectance" [ ' + numbers(m["kd"]) + " ]"
        return f'MakeNamedMaterial "{name}" {body}'

    def texture(name, m):
        x, y = m.get("repeat", (1, 1))
        u, v = m.get("shift", (0, 0))
        return (f'Texture "{name}" "spectrum" "imagemap" "string filename" "{m["image"]}"\n'
                f'    "float uscale" {x} "float vscale" {y} "float udelta" {u} "float vdelta" '
                f'{numbers([1 - v - y])}')

    def shape(kind, matrix, name, radiance):
        positions, normals, uv, triangles = MESHES[kind]
        if not is_mirrored:
            matrix = multiply(scale(-1, 1, 1), matrix)
        columns = [matrix[j][i] for i in range(4) for j in range(4)]
        out = ["AttributeBegin", "  Transform [ " + numbers(columns) + " ]"]
        if radiance:
            out.append('  AreaLightSource "diffuse" "rgb L" [ ' + numbers(radiance) + " ]")
        out.append(f'  NamedMaterial "{name}"')
        out.append('  Shape "trianglemesh" "integer indices" [ '
                   + numbers([i for t in triangles for i in t]) + " ]")
        out.append('    "point3 P" [ ' + numbers([v for p in positions for v in p]) + " ]")
        if normals:
            out.append('    "normal N" [ ' + numbers([v for n in normals for v in n]) + " ]")
        out.append('    "point2 uv" [ ' + numbers([v for a, b in uv for v in (a, 1 - b)]) + " ]")
        return "\n".join(out + ["AttributeEnd"])

    size, lens = scene["size"], scene["lens"]
    fov = scene["yfov"]
    if size[1] > size[0]:
        fov = 2 * math.degrees(math.atan(math.tan(math.radians(fov / 2)) * size[0] / size[1]))
    out = ["Scale -1 1 1"] if is_mirrored else []
    out.append("LookAt " + numbers(flip(scene["eye"])) + "  " + numbers(flip(scene["target"]))
               + "  0 1 0")
    out.append(f'Camera "perspective" "float fov" {fov:.7g}'
               + (f' "float lensradius" {lens[0]} "float focaldistance" {lens[1]}' if lens else ""))
    out.append(f'Film "rgb" "integer xresolution" {size[0]} "integer yresolution" {size[1]}')
    out.append('PixelFilter "box" "float xradius" 0.5 "float yradius" 0.5')
    out.append('Sampler "independent" "integer pixelsamples" 64')
    out.append(f'Integrator "path" "integer maxdepth" {scene["depth"] - 1}')
    out.append("WorldBegin")
    out += [texture(n, m) for n, m in scene["materials"].items() if "image" in m]
    out += [material(n, m) for n, m in scene["materials"].items()]
    out += [shape(*thing) for thing in scene["things"]]
    out += ['LightSource "point" "point3 from" [ ' + numbers(flip(p)) + ' ] "rgb I" [ ' + numbers(i)
            + " ]" for p, i in scene["points"]]
    out += ['LightSource "distant" "point3 from" [ 0 0 0 ] "point3 to" [ ' + numbers(flip(d))
            + ' ] "rgb L" [ ' + numbers(e) + " ]" for d, e in scene["suns"]]
    return "\n".join(out) + "\n"


class Buffer:
    """The bytes of a glTF file, with views and accessors of them."""

    def __init__(self):
        self.data, self.views, self.accessors = b"", [], []

    def add(self, rows, kind, code):
        packed = b"".join(struct.pack("<" + code * len(row), *row) for row in rows)
        self.data += b"\0" * (-len(self.data) % 4)
        self.views.append({"buffer": 0, "byteOffset": len(self.data), "byteLength": len(packed)})
        self.data += packed
        accessor = {"bufferView": len(self.views) - 1, "count": len(rows), "type": kind,
                    "componentType": 5126 if code == "f" else 5123}
        if kind == "VEC3":
            accessor["min"] = [min(r[i] for r in rows) for i in range(3)]
            accessor["max"] = [max(r[i] for r in rows) for i in range(3)]
        self.accessors.append(accessor)
        return len(self.accessors) - 1


def look(eye, target):
    d = [e - t for e, t in zip(eye, target)]
    z = [v / math.sqrt(sum(c * c for c in d)) for v in d]
    x = [z[2], 0, -z[0]]
    x = [v / math.sqrt(sum(c * c for c in x)) for v in x]
    y = [z[1] * x[2] - z[2] * x[1], z[2] * x[0] - z[0] * x[2], z[0] * x[1] - z[1] * x[0]]
    return [[x[i], y[i], z[i], eye[i]] for i in range(3)] + [[0, 0, 0, 1]]


def gltf_material(name, m, radiance):
    pbr = {"metallicFactor": 0, "roughnessFactor": 1}
    out = {"name": name, "pbrMetallicRoughness": pbr,
           "extensions": {"KHR_materials_specular": {"specularFactor": 0}}}
    if "metal" in m:
        pbr.update(metallicFactor=1, roughnessFactor=math.sqrt(m["alpha"]),
                   baseColorFactor=list(m["metal"]["f0"]) + [1])
    elif "ior" in m:
        pbr.update(roughnessFactor=0)
        out["extensions"] = {"KHR_materials_ior": {"ior": m["ior"]},
                             "KHR_materials_transmission": {"transmissionFactor": 1},
                             "KHR_materials_volume": {"thicknessFactor": 1}}
    elif "image" in m:
        pbr["baseColorTexture"] = {"index": 0}
        if "repeat" in m:
            pbr["baseColorTexture"]["extensions"] = {
                "KHR_texture_transform": {"scale": m["repeat"], "offset": m["shift"]}}
    else:
        pbr["baseColorFactor"] = list(m["kd"]) + [1]
    if radiance:
        most = max(radiance)
        out["emissiveFactor"] = [v / most for v in radiance]
        out["extensions"]["KHR_materials_emissive_strength"] = {"emissiveStrength": most}
    return out


def gltf(scene, png, is_binary):
    buffer, meshes, materials, nodes, used = Buffer(), {}, {}, [], []
    lights = []
    for kind, matrix, name, radiance in scene["things"]:
        if (name, bool(radiance)) not in materials:
            materials[name, bool(radiance)] = len(used)
            used.append(gltf_material(name, scene["materials"][name], radiance))
        if (kind, name) not in meshes:
            positions, normals, uv, triangles = MESHES[kind]
            attributes = {"POSITION": buffer.add(positions, "VEC3", "f")}
            if normals:
                attributes["NORMAL"] = buffer.add(normals, "VEC3", "f")
            attributes["TEXCOORD_0"] = buffer.add(uv, "VEC2", "f")
            indices = buffer.add([(i,) for t in triangles for i in t], "SCALAR", "H")
            meshes[kind, name] = {"name": kind, "primitives": [
                {"attributes": attributes, "indices": indices,
                 "material": materials[name, bool(radiance)]}]}
        nodes.append({"mesh": list(meshes).index((kind, name)),
                      "matrix": [matrix[j][i] for i in range(4) for j in range(4)]})
    for kind, place, value in ([("point", translate(*p), i) for p, i in scene["points"]] +
                               [("directional", look((0, 0, 0), d), e) for d, e in scene["suns"]]):
        most = max(value)
        nodes.append({"matrix": [place[j][i] for i in range(4) for j in range(4)],
                      "extensions": {"KHR_lights_punctual": {"light": len(lights)}}})
        lights.append({"type": kind, "color": [v / most for v in value], "intensity": 683 * most})
    width, height = scene["size"]
    place = look(scene["eye"], scene["target"])
    nodes.append({"camera": 0, "matrix": [place[j][i] for i in range(4) for j in range(4)]})
    # Two nodes around all, whose half turns and scales cancel.
    inner = list(range(len(nodes)))
    nodes.append({"children": inner, "scale": [2, 2, 2], "rotation": [0, 1, 0, 0]})
    nodes.append({"children": [len(nodes) - 1], "scale": [0.5, 0.5, 0.5], "rotation": [0, 1, 0, 0]})
    file = {"asset": {"version": "2.0"}, "scene": 0, "scenes": [{"nodes": [len(nodes) - 1]}],
            "nodes": nodes, "meshes": list(meshes.values()), "materials": used,
            "cameras": [{"type": "perspective", "perspective": {
                "yfov": math.radians(scene["yfov"]), "aspectRatio": width / height, "znear": 0.1}}],
            "accessors": buffer.accessors, "bufferViews": buffer.views,
            "extensionsUsed": ["KHR_materials_specular", "KHR_materials_emissive_strength"]}
    if lights:
        file["extensions"] = {"KHR_lights_punctual": {"lights": lights}}
    if any("image" in scene["materials"][m["name"]] for m in used):
        file["textures"] = [{"source": 0}]
        file["images"] = [{"uri": "tiles.png"}]
        if is_binary:
            buffer.data += b"\0" * (-len(buffer.data) % 4)
            buffer.views.append({"buffer": 0, "byteOffset": len(buffer.data),
                                 "byteLength": len(png)})
            buffer.data += png
            file["images"] = [{"bufferView": len(buffer.views) - 1, "mimeType": "image/png"}]
    file["buffers"] = [{"byteLength": len(buffer.data)}]
    if not is_binary:
        data = base64.b64encode(buffer.data).decode()
        file["buffers"][0]["uri"] = "data:application/octet-stream;base64," + data
        return json.dumps(file, indent=1).encode()
    text = json.dumps(file).encode()
    text += b" " * (-len(text) % 4)
    data = buffer.data + b"\0" * (-len(buffer.data) % 4)
    return (struct.pack("<III", 0x46546c67, 2, 28 + len(text) + len(data))
            + struct.pack("<II", len(text), 0x4e4f534a) + text
            + struct.pack("<II", len(data), 0x004e4942) + data)


def obj(scene):
    out, vertex = ["mtllib room.mtl"], 0
    for kind, matrix, name, radiance in scene["things"]:
        positions, _, uv, triangles = MESHES[kind]
        out.append("usemtl " + ("lamp" if radiance else name))
        for p in positions:
            q = list(p) + [1]
            out.append("v " + numbers([sum(matrix[i][j] * q[j] for j in range(4))
                                       for i in range(3)]))
        out += ["vt " + numbers((a, 1 - b)) for a, b in uv]
        out += ["f " + " ".join(f"{vertex + i + 1}/{vertex + i + 1}" for i in t) for t in triangles]
        vertex += len(positions)
    return "\n".join(out) + "\n"


def mtl(scene):
    out = []
    for name, m in scene["materials"].items():
        out += [f"newmtl {name}", "Kd " + numbers(m["kd"])]
    return "\n".join(out + ["newmtl lamp", "Kd 0 0 0", "Ke 9 8 7"]) + "\n"


def make_png():
    """8 by 8, unlike itself when turned over or mirrored."""
    rows = b""
    for y in range(8):
        rows += b"\0"
        for x in range(8):
            rows += bytes((40 + 24 * x, 30 + 26 * y, 200 if (x + 2 * y) % 5 == 0 else 60))

    def chunk(kind, data):
        return (struct.pack(">I", len(data)) + kind + data
                + struct.pack(">I", zlib.crc32(kind + data)))
    return (b"\x89PNG\r\n\x1a\n" + chunk(b"IHDR", struct.pack(">IIBBBBB", 8, 8, 8, 2, 0, 0, 0))
            + chunk(b"IDAT", zlib.compress(rows, 9)) + chunk(b"IEND", b""))


def main():
    folder = pathlib.Path(sys.argv[1])
    png = make_png()
    (folder / "tiles.png").write_bytes(png)
    for name in ("gem", "stone"):
        positions, _, uv, triangles = MESHES[name]
        lines = ["v " + numbers(p) for p in positions]
        lines += ["vt " + numbers((a, 1 - b)) for a, b in uv]
        lines += ["f " + " ".join(f"{i + 1}/{i + 1}" for i in t) for t in triangles]
        (folder / f"{name}.obj").write_text("\n".join(lines) + "\n", encoding="ascii")
    for i, (name, scene) in enumerate(SCENES.items()):
        (folder / f"{name}.xml").write_text(mitsuba(scene), encoding="ascii")
        (folder / f"{name}.pbrt").write_text(pbrt(scene, i % 2 == 1), encoding="ascii")
        if name in ("metal", "smooth"):
            continue  # glTF's metals have no eta and k: beside Cycles, blender_materials.py
        is_binary = i % 2 == 0
        extension = "glb" if is_binary else "gltf"
        (folder / f"{name}.{extension}").write_bytes(gltf(scene, png, is_binary))
    (folder / "room.obj").write_text(obj(SCENES["room"]), encoding="ascii")
    (folder / "room.mtl").write_text(mtl(SCENES["room"]), encoding="ascii")


main()
