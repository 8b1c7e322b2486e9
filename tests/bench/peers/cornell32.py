"""The Cornell box of tests/bench/cornell32.rts for Mitsuba 3, read from that very file."""
import os
import re
import sys

import mitsuba as mi
import numpy as np

from mitsuba_scenes import rgb, scene

PATH = os.path.join(os.path.dirname(os.path.abspath(__file__)), os.pardir, "cornell32.rts")


def read_blocks():
    """The blocks of a scene file of one block a line, as (word, name, {field: [word, ...]})."""
    with open(PATH, encoding="utf-8") as file:
        for line in (line.split("#", 1)[0].strip() for line in file):
            match = re.fullmatch(r"(\w+)\s*(\w*)\s*\{(.*)\}", line)
            if match:
                yield match.group(1), match.group(2), read_fields(match.group(3).split())
            elif line:
                sys.exit(f"{PATH}: not one block on one line: {line}")


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


def make_mesh(name, triangles, bsdf, emitter):
    """One mesh of separate triangles."""
    properties = mi.Properties()
    properties["bsdf"] = mi.load_dict(bsdf)
    properties["face_normals"] = True
    if emitter:
        properties["emitter"] = mi.load_dict(emitter)
    count = 3 * len(triangles)
    mesh = mi.Mesh(name, count, len(triangles), props=properties)
    parameters = mi.traverse(mesh)
    corners = [numbers(triangle[corner]) for triangle in triangles for corner in "abc"]
    parameters["vertex_positions"] = np.array(corners, dtype=np.float32).ravel()
    parameters["faces"] = np.arange(count, dtype=np.uint32)
    parameters.update()
    return mesh


def cornell32():
    blocks = list(read_blocks())
    one = {word: fields for word, _, fields in blocks}
    parts = {}
    for name, kd in ((name, fields["kd"]) for word, name, fields in blocks if word == "material"):
        triangles = [fields for word, _, fields in blocks
                     if word == "triangle" and fields["material"] == [name]]
        emitter = None
        if "radiance" in triangles[0]:
            radiance = rgb(*numbers(triangles[0]["radiance"]))
            emitter = {"type": "area", "radiance": radiance}
        bsdf = {"type": "diffuse", "reflectance": rgb(*numbers(kd))}
        parts[name] = make_mesh(name, triangles, bsdf, emitter)
    return scene(
        int(one["render"]["max_depth"][0]), numbers(one["camera"]["eye"]),
        numbers(one["camera"]["look_at"]), float(one["camera"]["fov"][0]), **parts)
