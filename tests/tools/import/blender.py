"""Five scenes made by Blender, each exported as glTF and written for Mitsuba 3.

    blender --background --factory-startup --python tests/tools/import/blender.py -- FOLDER

Blender has z up and glTF y: (x, y, z) becomes (x, z, -y). What Mitsuba gets is written from the
objects of Blender, not from the file that its exporter makes.
"""
import math
import pathlib
import sys

import bpy
from mathutils import Euler, Matrix, Vector

WIDTH, HEIGHT = 96, 72
Y_UP = Matrix(((1, 0, 0, 0), (0, 0, 1, 0), (0, -1, 0, 0), (0, 0, 0, 1)))
LUMENS = 683  # of a watt, as the exporter has it

folder = pathlib.Path(sys.argv[sys.argv.index("--") + 1])


def numbers(values):
    return " ".join(f"{v:.7g}" for v in values)


# ---- Materials: a Principled BSDF, and the same for Mitsuba -----------------------------------

def principled(name, colour=(0, 0, 0), **values):
    material = bpy.data.materials.new(name)
    material.use_nodes = True
    shader = material.node_tree.nodes["Principled BSDF"]
    inputs = {"Base Color": (*colour, 1), "Specular": 0, "Roughness": 1, **values}
    for key, value in inputs.items():
        shader.inputs[key].default_value = value
    return material, shader


def diffuse(name, colour):
    material, _ = principled(name, colour)
    material["mitsuba"] = (f'<bsdf type="twosided"><bsdf type="diffuse">'
                           f'<rgb name="reflectance" value="{numbers(colour)}"/></bsdf></bsdf>')
    return material


def metal(name, colour, roughness):
    material, _ = principled(name, colour, Metallic=1, Roughness=roughness, Specular=0.5)
    k = [2 * math.sqrt(f / (1 - f)) for f in colour]
    material["mitsuba"] = (
        f'<bsdf type="twosided"><bsdf type="roughconductor"><string name="distribution" '
        f'value="ggx"/><float name="alpha" value="{roughness ** 2:.7g}"/>'
        f'<rgb name="eta" value="1 1 1"/><rgb name="k" value="{numbers(k)}"/></bsdf></bsdf>')
    return material


def glass(name, ior):
    material, _ = principled(name, (1, 1, 1), Transmission=1, IOR=ior, Roughness=0, Specular=0.5)
    nodes = material.node_tree.nodes
    # The exporter reads the thickness of a volume from a group of this name.
    group = bpy.data.node_groups.get("glTF Settings")
    if not group:
        group = bpy.data.node_groups.new("glTF Settings", "ShaderNodeTree")
        group.inputs.new("NodeSocketFloat", "Thickness")
    node = nodes.new("ShaderNodeGroup")
    node.node_tree = group
    node.inputs["Thickness"].default_value = 1
    material["mitsuba"] = f'<bsdf type="dielectric"><float name="int_ior" value="{ior}"/></bsdf>'
    return material


def textured(name, image):
    material, shader = principled(name, (1, 1, 1))
    node = material.node_tree.nodes.new("ShaderNodeTexImage")
    node.image = image
    material.node_tree.links.new(node.outputs["Color"], shader.inputs["Base Color"])
    material["mitsuba"] = (f'<bsdf type="twosided"><bsdf type="diffuse"><texture name="reflectance"'
                           f' type="bitmap"><string name="filename" value="{image.name}.png"/>'
                           f'</texture></bsdf></bsdf>')
    return material


def emitter(name, radiance):
    strength = max(radiance)
    colour = [v / strength for v in radiance]
    material, _ = principled(name, Emission=(*colour, 1), **{"Emission Strength": strength})
    material.use_backface_culling = True  # light on one side
    material["mitsuba"] = (
        '<bsdf type="diffuse"><rgb name="reflectance" value="0 0 0"/></bsdf><emitter type="area">'
        f'<rgb name="radiance" value="{numbers(radiance)}"/></emitter>')
    return material


def picture(name):
    """8 by 8, unlike itself when turned over or mirrored."""
    image = bpy.data.images.new(name, 8, 8)
    pixels = []
    for y in range(8):
        for x in range(8):
            pixels += [(40 + 24 * x) / 255, (30 + 26 * y) / 255,
                       (200 if (x + 2 * y) % 5 == 0 else 60) / 255, 1]
    image.pixels = pixels
    image.filepath_raw = str(folder / f"{name}.png")
    image.file_format = "PNG"
    image.save()
    image.source = "FILE"
    image.pack()
    return image


# ---- Objects ----------------------------------------------------------------------------------

def added(material, smooth=False, parent=None):
    thing = bpy.context.object
    thing.data.materials.append(material)
    for polygon in thing.data.polygons:
        polygon.use_smooth = smooth
    thing.parent = parent
    return thing


def square(material, at, turn=(0, 0, 0), size=(2, 2)):
    bpy.ops.mesh.primitive_plane_add(size=1, location=at, rotation=turn)
    bpy.context.object.scale = (*size, 1)
    return added(material)


def ball(material, at, radius):
    bpy.ops.mesh.primitive_uv_sphere_add(segments=96, ring_count=48, radius=radius, location=at)
    return added(material, True)


def cube(material, at, turn, size):
    bpy.ops.mesh.primitive_cube_add(size=1, location=at, rotation=turn)
    bpy.context.object.scale = size
    return added(material)


def lamp(kind, at, energy, colour, turn=(0, 0, 0)):
    data = bpy.data.lights.new(kind.lower(), kind)
    data.energy, data.color = energy, colour
    thing = bpy.data.objects.new(data.name, data)
    thing.location, thing.rotation_euler = at, turn
    bpy.context.collection.objects.link(thing)
    if kind == "SPOT":
        data.spot_size, data.spot_blend = math.radians(50), 0.02
    return thing


def look(eye, target, degrees):
    data = bpy.data.cameras.new("camera")
    data.angle = math.radians(degrees)
    thing = bpy.data.objects.new("camera", data)
    thing.location = eye
    thing.rotation_euler = (Vector(target) - Vector(eye)).to_track_quat("-Z", "Y").to_euler()
    bpy.context.collection.objects.link(thing)
    bpy.context.scene.camera = thing


# ---- The scenes -------------------------------------------------------------------------------

def room():
    white, red = diffuse("white", (0.7, 0.7, 0.7)), diffuse("red", (0.6, 0.1, 0.08))
    square(white, (0, 0, 0), size=(6, 6))
    square(white, (0, 2, 2), (math.pi / 2, 0, 0), (6, 4))
    square(red, (-2, 0, 2), (0, math.pi / 2, 0), (4, 6))
    square(emitter("light", (9, 8, 7)), (0, -0.3, 2.8), (math.pi, 0, 0), (1.2, 1.2))
    cube(red, (0.8, -0.3, 0.5), (0, 0, 0.4), (0.9, 0.9, 1))
    ball(diffuse("blue", (0.1, 0.2, 0.5)), (-0.7, -0.2, 0.6), 0.6)
    look((0, -4.5, 1.4), (0, 0, 0.9), 52)


def metals():
    square(diffuse("floor", (0.5, 0.5, 0.55)), (0, 0, 0), size=(9, 9))
    ball(metal("gold", (0.9, 0.65, 0.3), 0.45), (-0.8, 0, 0.7), 0.7)
    cube(metal("steel", (0.6, 0.6, 0.62), 0.6), (0.8, 0.2, 0.55), (0, 0, 0.5), (1.1, 1.1, 1.1))
    square(emitter("light", (6, 6, 6)), (0.5, -1.5, 3.5), (math.pi - 0.4, 0, 0), (2.5, 2))
    square(emitter("side", (1, 2, 4)), (-3.5, 0.5, 1.5), (0, math.pi / 2, 0), (2, 3))
    look((0, -4.2, 2), (0, 0, 0.6), 48)


def tumbler():
    square(textured("floor", picture("tiles")), (0, 0, 0), size=(5, 5))
    square(diffuse("wall", (0.6, 0.6, 0.5)), (0, 2.5, 2.5), (math.pi / 2, 0, 0), (5, 5))
    ball(glass("glass", 1.5), (0, 0, 0.9), 0.8)
    square(emitter("light", (3, 3, 3)), (0, 0, 4.5), (math.pi, 0, 0), (4, 4))
    look((0, -4.5, 2.2), (0, 0, 0.8), 50)


def lamps():
    square(diffuse("floor", (0.6, 0.6, 0.6)), (0, 0, 0), size=(8, 8))
    ball(diffuse("ball", (0.7, 0.5, 0.2)), (0.2, 0, 0.7), 0.7)
    cube(diffuse("box", (0.2, 0.5, 0.6)), (-1.2, 0.6, 0.5), (0, 0, 0.3), (0.8, 0.8, 1))
    lamp("POINT", (1.8, -1.2, 2.2), 120, (1, 0.9, 0.8))
    lamp("SUN", (0, 0, 5), 1.5, (0.8, 0.9, 1), (0.5, 0.3, 0))
    lamp("SPOT", (-1.5, -1.5, 3), 150, (1, 0.4, 0.3), (0.4, -0.3, 0))
    look((0, -5, 2.4), (0, 0, 0.5), 45)


def copies():
    paint = textured("paint", picture("stripes"))
    parent = bpy.data.objects.new("group", None)
    parent.rotation_euler, parent.scale = Euler((0, 0, 0.5)), (1.2, 1.2, 0.9)
    bpy.context.collection.objects.link(parent)
    bpy.ops.mesh.primitive_monkey_add(size=1.2, location=(0, 0, 0.6), rotation=(-0.4, 0, -0.6))
    first = added(paint, False, parent)
    for i, at in enumerate(((1.3, 0.6, 0.7), (-1.3, 0.3, 0.5))):
        thing = bpy.data.objects.new(f"copy{i}", first.data)
        thing.location, thing.rotation_euler = at, (0.2, 0.3 * i, 0.7 * i - 1)
        thing.scale = (0.7, 0.9, 0.8)
        thing.parent = parent
        bpy.context.collection.objects.link(thing)
    square(diffuse("floor", (0.5, 0.45, 0.4)), (0, 0, 0), size=(9, 9))
    square(emitter("light", (7, 7, 6.5)), (-1, -2, 3.5), (math.pi - 0.5, 0, 0), (2, 2))
    look((0.3, -4.6, 2), (0, 0, 0.6), 48)


# ---- For Mitsuba ------------------------------------------------------------------------------

def write_mesh(thing, path):
    mesh, to_world = thing.data, Y_UP @ thing.matrix_world
    turn = to_world.to_3x3().inverted().transposed()
    mesh.calc_loop_triangles()
    uv = mesh.uv_layers.active
    lines, count = [], 0
    for triangle in mesh.loop_triangles:
        for vertex, loop in zip(triangle.vertices, triangle.loops):
            smooth = mesh.polygons[triangle.polygon_index].use_smooth
            normal = turn @ (mesh.vertices[vertex].normal if smooth else triangle.normal)
            at = uv.data[loop].uv if uv else (0, 0)
            lines.append(numbers([*(to_world @ mesh.vertices[vertex].co), *normal.normalized(),
                                  at[0], 1 - at[1]]))
        count += 1
    head = ["ply", "format ascii 1.0", f"element vertex {3 * count}"]
    head += [f"property float {name}" for name in ("x", "y", "z", "nx", "ny", "nz", "u", "v")]
    head += [f"element face {count}", "property list uchar int vertex_indices", "end_header"]
    flip = (lambda i: (3 * i, 3 * i + 2, 3 * i + 1)) if to_world.determinant() < 0 else (
        lambda i: (3 * i, 3 * i + 1, 3 * i + 2))
    faces = ["3 " + numbers(flip(i)) for i in range(count)]
    path.write_text("\n".join(head + lines + faces) + "\n", encoding="ascii")


def direction_of(thing):
    return (Y_UP @ thing.matrix_world).to_3x3() @ Vector((0, 0, -1))


def light_of(thing):
    """The exporter's candela and lux, taken as W/sr and W/m^2 by 683 lumens to the watt."""
    light, at = thing.data, Y_UP @ thing.matrix_world.translation
    colour = [v * light.energy for v in light.color]
    if light.type == "SUN":
        return (f'<emitter type="directional"><vector name="direction" '
                f'value="{numbers(direction_of(thing))}"/>'
                f'<rgb name="irradiance" value="{numbers(colour)}"/></emitter>')
    intensity = numbers([v / (4 * math.pi) for v in colour])
    if light.type == "POINT":
        return (f'<emitter type="point"><point name="position" value="{numbers(at)}"/>'
                f'<rgb name="intensity" value="{intensity}"/></emitter>')
    outer = math.degrees(light.spot_size / 2)
    target = numbers(at + direction_of(thing)).replace(" ", ", ")
    return (f'<emitter type="spot"><transform name="to_world"><lookat '
            f'origin="{numbers(at).replace(" ", ", ")}" target="{target}" up="0, 0, 1"/>'
            f'</transform><rgb name="intensity" value="{intensity}"/><float name="cutoff_angle" '
            f'value="{outer:.7g}"/><float name="beam_width" '
            f'value="{outer * (1 - light.spot_blend):.7g}"/></emitter>')


def mitsuba(name):
    scene = bpy.context.scene
    eye = Y_UP @ scene.camera.matrix_world.translation
    target = eye + direction_of(scene.camera)
    look_at = " ".join(f'{key}="{numbers(value).replace(" ", ", ")}"' for key, value in
                       (("origin", eye), ("target", target), ("up", (0, 1, 0))))
    out = ['<scene version="3.0.0">',
           '<integrator type="path"><integer name="max_depth" value="16"/></integrator>',
           f'<sensor type="perspective"><float name="fov" '
           f'value="{math.degrees(scene.camera.data.angle):.7g}"/>'
           f'<string name="fov_axis" value="x"/><transform name="to_world"><lookat {look_at}/>'
           f'</transform><film type="hdrfilm"><integer name="width" value="{WIDTH}"/>'
           f'<integer name="height" value="{HEIGHT}"/><rfilter type="box"/></film></sensor>']
    for i, thing in enumerate(scene.objects):
        if thing.type == "MESH":
            mesh = f"{name}_{i}.ply"
            write_mesh(thing, folder / mesh)
            out.append(f'<shape type="ply"><string name="filename" value="{mesh}"/>'
                       f'{thing.data.materials[0]["mitsuba"]}</shape>')
        elif thing.type == "LIGHT":
            out.append(light_of(thing))
    (folder / f"{name}.xml").write_text("\n".join(out) + "\n</scene>\n", encoding="ascii")


def main():
    for i, make in enumerate((room, metals, tumbler, lamps, copies)):
        bpy.ops.wm.read_factory_settings(use_empty=True)
        scene = bpy.context.scene
        scene.render.resolution_x, scene.render.resolution_y = WIDTH, HEIGHT
        make()
        bpy.context.view_layer.update()
        name = "blender_" + make.__name__
        is_binary = i % 2 == 0
        bpy.ops.export_scene.gltf(
            filepath=str(folder / (name + (".glb" if is_binary else ".gltf"))),
            export_format="GLB" if is_binary else "GLTF_SEPARATE",
            export_cameras=True, export_lights=True)
        mitsuba(name)


main()
