"""A scene of Blender's materials, exported, and its pictures by Cycles.

    blender_materials.py FOLDER SAMPLES    (a Python with Blender's module bpy, 4.2 or later)

Writes materials.glb and .obj, gltf/materials.gltf, and materials.exr, what Cycles makes of the
scene that was exported; materials_obj.exr, what it makes of the .obj, whose format has no lamps and
fewer materials. Room and camera are the same.
"""
import math
import pathlib
import sys

import bpy
from mathutils import Vector

WIDTH, HEIGHT = 192, 144

folder, samples = pathlib.Path(sys.argv[1]), int(sys.argv[2])


# ---- Images ------------------------------------------------------------------------------------

def image(name, kind, size, pixel, is_colour=True):
    """An image of a file, whose pixel (u, v) of 0 to 1 is given."""
    made = bpy.data.images.new(name, size, size, alpha=True)
    pixels = []
    for y in range(size):
        for x in range(size):
            pixels += pixel((x + 0.5) / size, (y + 0.5) / size)
    made.colorspace_settings.name = "sRGB" if is_colour else "Non-Color"
    made.pixels = pixels
    made.filepath_raw = str(folder / f"{name}.{'jpg' if kind == 'JPEG' else 'png'}")
    made.file_format = kind
    made.save()
    made.source = "FILE"
    made.reload()
    return made


def tiles(u, v):
    is_odd = (int(u * 8) + int(v * 8)) % 2
    return (0.75, 0.7, 0.6, 1) if is_odd else (0.3 + 0.4 * u, 0.35, 0.3 + 0.3 * v, 1)


def leaf(u, v):
    r = math.hypot(2 * u - 1, 2 * v - 1)
    is_there = r < 0.65 + 0.25 * math.cos(5 * math.atan2(2 * v - 1, 2 * u - 1))
    return (0.2, 0.5 + 0.2 * v, 0.1, 1 if is_there else 0)


def bumps(u, v):
    """Normals of waves."""
    x, y = 0.15 * math.cos(12 * math.pi * u), 0.15 * math.cos(12 * math.pi * v)
    z = math.sqrt(1 - x * x - y * y)
    return ((x + 1) / 2, (y + 1) / 2, (z + 1) / 2, 1)


def bands(u, _):
    """A roughness."""
    grey = 0.1 + 0.2 * (0.5 + 0.5 * math.cos(6 * math.pi * u))
    return (grey, grey, grey, 1)


# ---- Materials ---------------------------------------------------------------------------------

def principled(name, colour=(0.8, 0.8, 0.8), **values):
    material = bpy.data.materials.new(name)
    material.use_nodes = True
    shader = material.node_tree.nodes["Principled BSDF"]
    inputs = {"Base Color": (*colour, 1), "Roughness": 1, "Specular IOR Level": 0, **values}
    for key, value in inputs.items():
        shader.inputs[key].default_value = value
    return material, shader


def picture(material, made):
    node = material.node_tree.nodes.new("ShaderNodeTexImage")
    node.image = made
    return node


def link(material, output, entry):
    material.node_tree.links.new(output, entry)


def textured(name, made, **values):
    material, shader = principled(name, **values)
    node = picture(material, made)
    link(material, node.outputs["Color"], shader.inputs["Base Color"])
    return material, shader, node


def with_alpha(name, made):
    material, shader, node = textured(name, made)
    link(material, node.outputs["Alpha"], shader.inputs["Alpha"])
    return material


def with_normals(name, made):
    material, shader = principled(name, (0.6, 0.55, 0.5))
    node = material.node_tree.nodes.new("ShaderNodeNormalMap")
    link(material, picture(material, made).outputs["Color"], node.inputs["Color"])
    link(material, node.outputs["Normal"], shader.inputs["Normal"])
    return material


def with_roughness(name, made):
    material, shader = principled(name, (0.9, 0.75, 0.5), Metallic=1)
    node = picture(material, made)
    link(material, node.outputs["Color"], shader.inputs["Roughness"])
    return material


def with_colours(name):
    material, shader = principled(name)
    node = material.node_tree.nodes.new("ShaderNodeVertexColor")
    node.layer_name = "Color"
    link(material, node.outputs["Color"], shader.inputs["Base Color"])
    return material


def glass(name):
    material, _ = principled(name, (1, 1, 1), Roughness=0, IOR=1.5,
                             **{"Transmission Weight": 1, "Specular IOR Level": 0.5})
    # The exporter reads the thickness of a volume from a group of this name.
    group = bpy.data.node_groups.new("glTF Material Output", "ShaderNodeTree")
    group.interface.new_socket("Thickness", socket_type="NodeSocketFloat")
    node = material.node_tree.nodes.new("ShaderNodeGroup")
    node.node_tree = group
    node.inputs["Thickness"].default_value = 1
    return material


def emitter(name, radiance):
    strength = max(radiance)
    material, _ = principled(name, (0, 0, 0), **{
        "Emission Color": (*(v / strength for v in radiance), 1), "Emission Strength": strength})
    return material


# ---- Objects -----------------------------------------------------------------------------------

def added(material, smooth=False):
    thing = bpy.context.object
    thing.data.materials.append(material)
    for polygon in thing.data.polygons:
        polygon.use_smooth = smooth
    return thing


def square(material, at, turn=(0, 0, 0), size=(2, 2)):
    bpy.ops.mesh.primitive_plane_add(size=1, location=at, rotation=turn)
    bpy.context.object.scale = (*size, 1)
    return added(material)


def ball(material, at, radius):
    bpy.ops.mesh.primitive_uv_sphere_add(segments=64, ring_count=32, radius=radius, location=at)
    return added(material, True)


def lamp(kind, at, energy, colour, turn):
    data = bpy.data.lights.new(kind.lower(), kind)
    data.energy, data.color = energy, colour
    thing = bpy.data.objects.new(data.name, data)
    thing.location, thing.rotation_euler = at, turn
    bpy.context.collection.objects.link(thing)
    if kind == "SPOT":
        data.spot_size, data.spot_blend = math.radians(40), 0.3
    if kind != "SUN":
        data.shadow_soft_size = 0
    if kind == "SUN":
        data.angle = 0


def look(eye, target, degrees):
    data = bpy.data.cameras.new("camera")
    data.angle = math.radians(degrees)
    thing = bpy.data.objects.new("camera", data)
    thing.location = eye
    thing.rotation_euler = (Vector(target) - Vector(eye)).to_track_quat("-Z", "Y").to_euler()
    bpy.context.collection.objects.link(thing)
    bpy.context.scene.camera = thing


def show_colours():
    """The importer reads colours of vertices, and shows none: they were the base colour."""
    for thing in bpy.data.objects:
        if thing.type == "MESH" and thing.data.color_attributes:
            material = thing.data.materials[0]
            node = material.node_tree.nodes.new("ShaderNodeVertexColor")
            node.layer_name = thing.data.color_attributes[0].name
            entry = material.node_tree.nodes["Principled BSDF"].inputs["Base Color"]
            link(material, node.outputs["Color"], entry)


def paint(thing):
    colours = thing.data.color_attributes.new("Color", "FLOAT_COLOR", "POINT")
    for i, vertex in enumerate(thing.data.vertices):
        p = vertex.co
        colours.data[i].color = (0.5 + 0.45 * math.sin(3 * p.x), 0.5 + 0.45 * math.cos(3 * p.y),
                                 0.4 + 0.3 * p.z, 1)


def copies():
    """Two objects of one mesh below a parent that turns and stretches them."""
    material, _ = principled("copy", (0.3, 0.5, 0.45))
    parent = bpy.data.objects.new("parent", None)
    parent.location, parent.rotation_euler = (2.3, -1.6, 0.16), (0, 0, 0.5)
    parent.scale = (1.2, 0.8, 1)
    bpy.context.collection.objects.link(parent)
    bpy.ops.mesh.primitive_cube_add(size=0.3)
    first = added(material)
    second = bpy.data.objects.new("second", first.data)
    bpy.context.collection.objects.link(second)
    for i, thing in enumerate((first, second)):
        thing.parent, thing.location = parent, (0.5 * i - 0.8, 0.1 * i, 0)
        thing.rotation_euler, thing.scale = (0, 0, 0.7 * i), (1, 0.6 + 0.4 * i, 1)


def room():
    floor, _, _ = textured("tiles", image("tiles", "JPEG", 512, tiles))
    square(floor, (0, 0, 0), size=(8, 6))
    wall, _ = principled("wall", (0.6, 0.62, 0.65))
    square(wall, (0, 2, 2), (math.pi / 2, 0, 0), (8, 4))
    square(emitter("light", (7, 6.5, 6)), (0, -1, 3.9), (math.pi, 0, 0), (3, 2))
    gold, _ = principled("gold", (0.95, 0.7, 0.35), Roughness=0.2, Metallic=1,
                         **{"Specular IOR Level": 0.5})
    plastic, _ = principled("plastic", (0.6, 0.08, 0.06), Roughness=0.3, IOR=1.5,
                            **{"Specular IOR Level": 0.5})
    cloth, _ = principled("cloth", (0.1, 0.12, 0.35), Roughness=0.8, **{
        "Sheen Weight": 1, "Sheen Roughness": 0.5, "Sheen Tint": (0.12, 0.12, 0.15, 1)})
    for i, material in enumerate((gold, plastic, glass("glass"), cloth)):
        ball(material, (-2.1 + 1.4 * i, 0.6, 0.6), 0.6)
    front = (with_normals("waves", image("waves", "PNG", 128, bumps, False)),
             with_roughness("brushed", image("bands", "PNG", 64, bands, False)),
             with_colours("painted"))
    for i, material in enumerate(front):
        thing = ball(material, (-1.9 + 1.3 * i, -0.8, 0.45), 0.45)
        if i == 2:
            paint(thing)
    square(with_alpha("leaf", image("leaf", "PNG", 128, leaf)), (1.9, -0.7, 0.75),
           (1.3, 0, -0.3), (1.3, 1.3))
    copies()
    look((0, -6.5, 2.6), (0, 0, 0.7), 42)


# ---- Pictures ----------------------------------------------------------------------------------

def setup(scene):
    scene.render.engine = "CYCLES"
    scene.render.resolution_x, scene.render.resolution_y = WIDTH, HEIGHT
    scene.render.resolution_percentage = 100
    cycles = scene.cycles
    cycles.device, cycles.samples = "CPU", samples
    cycles.use_adaptive_sampling = cycles.use_denoising = False
    cycles.pixel_filter_type = "BOX"
    cycles.blur_glossy = 0
    cycles.sample_clamp_indirect = cycles.sample_clamp_direct = 0
    cycles.max_bounces = cycles.diffuse_bounces = cycles.glossy_bounces = 16
    cycles.transmission_bounces = cycles.transparent_max_bounces = 16
    if scene.world is None:
        scene.world = bpy.data.worlds.new("black")
    scene.world.use_nodes = True
    scene.world.node_tree.nodes["Background"].inputs["Color"].default_value = (0, 0, 0, 1)
    scene.render.image_settings.file_format = "OPEN_EXR"
    scene.render.image_settings.color_depth = "32"


def render(path):
    bpy.context.scene.render.filepath = str(path)
    bpy.ops.render.render(write_still=True)


def main():
    folder.mkdir(parents=True, exist_ok=True)
    bpy.ops.wm.read_factory_settings(use_empty=True)
    setup(bpy.context.scene)
    room()
    bpy.context.view_layer.update()
    cloth = bpy.data.materials["cloth"].node_tree.nodes["Principled BSDF"].inputs
    weight, tint = cloth["Sheen Weight"], cloth["Sheen Tint"]
    colour = tuple(tint.default_value)
    # MTL has the weight of sheen alone, glTF its colour alone.
    weight.default_value, tint.default_value = 0.12, (1, 1, 1, 1)
    bpy.ops.wm.obj_export(filepath=str(folder / "materials.obj"), export_materials=True,
                          export_colors=True, export_pbr_extensions=True, path_mode="RELATIVE")
    weight.default_value, tint.default_value = 1, colour
    lamp("SUN", (0, 0, 5), 1.0, (0.8, 0.9, 1), (0.7, 0.4, 0))
    lamp("SPOT", (2.5, -2.5, 3), 600, (1, 0.6, 0.4), (0.8, 0, 0.6))
    lamp("POINT", (-2.5, -2, 2.2), 60, (0.7, 0.8, 1), (0, 0, 0))
    bpy.context.view_layer.update()
    # Images of a .gltf take the names of those that they are made of: in a folder of their own.
    (folder / "gltf").mkdir(exist_ok=True)
    for kind, path in (("GLB", "materials.glb"), ("GLTF_SEPARATE", "gltf/materials.gltf")):
        bpy.ops.export_scene.gltf(
            filepath=str(folder / path), export_format=kind,
            export_cameras=True, export_lights=True, export_tangents=True)
    render(folder / "materials.exr")
    for thing in list(bpy.data.objects):
        if thing.type not in ("CAMERA",):
            bpy.data.objects.remove(thing)
    bpy.ops.wm.obj_import(filepath=str(folder / "materials.obj"))
    show_colours()
    render(folder / "materials_obj.exr")


main()
