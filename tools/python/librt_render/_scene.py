"""Scenes, from the language or by calls."""
from __future__ import annotations

import os
import tempfile
import warnings
from types import SimpleNamespace
from typing import Any, Mapping, Optional, Union

import numpy as np
from numpy.typing import ArrayLike

from ._library import (CONSTANTS, Hooks, InputError, Numbers, Owned, Progress, RenderWarning, call,
                       callback, documented, expect, ffi, fill, floats, lib, make, nearest,
                       numbers_of, path_bytes, pointer, record, text, warn_lacking, word_value)
from ._options import Options

Path = Union[str, "os.PathLike[str]"]


@documented("rt_memory")
class Memory:
    """A limit on memory, in bytes; 0 for none, to count alone."""

    _c = Owned()

    def __init__(self, limit: int = 0) -> None:
        self._c = make("rt_memory", lib.rt_memory_destroy, lib.rt_memory_create, limit)

    @property
    def info(self) -> SimpleNamespace:
        """limit, used and most, bytes."""
        out = ffi.new("rt_memory_info *")
        lib.rt_memory_get_info(self._c, out)
        return record(out)


def memory_pointer(memory: Optional[Memory]) -> Any:
    if memory is None:
        return ffi.NULL
    expect(memory, Memory, "memory", "Scene.parse reads a text, Scene.load a file"
           if isinstance(memory, (str, os.PathLike)) else "Memory(limit) makes one")
    return memory._c


@callback("void(void *, const rt_diagnostic *)")
def _on_diagnostic(user: Any, diagnostic: Any) -> None:
    seen = record(diagnostic)
    seen.severity = ("error", "warning", "note")[diagnostic.severity]
    ffi.from_handle(user).append(seen)


@callback("void(void *, const rt_finding *)")
def _on_finding(user: Any, finding: Any) -> None:
    seen = record(finding)
    seen.severity = ("error", "warning", "note")[finding.severity]
    seen.solids = [finding.solids[i] for i in range(finding.solid_count)]
    for name in ("shape", "other", "emitter", "light", "grid"):
        if getattr(seen, name) == CONSTANTS["RT_NONE"]:
            setattr(seen, name, None)
    ffi.from_handle(user).append(seen)


class Scene:
    """A scene: Scene.load(path), Scene.parse(text), or an empty one to be filled by calls.

    Each call that adds something returns its index or handle. Shapes take, beside their own
    parameters, `material` (the index of one), `radiance` or `power` where they emit, `texture` and
    `transform`, an array of shape (3, 4) or (4, 4).
    """

    _c = Owned()

    @documented("rt_scene_create")
    def __init__(self, memory: Optional[Memory] = None) -> None:
        counted = memory_pointer(memory)
        self._c = make("rt_scene", lib.rt_scene_destroy, lib.rt_scene_create)
        lib.rt_scene_set_memory(self._c, counted)
        self._materials: dict[str, int] = {}

    # ---- From the language ----------------------------------------------------------------------

    @classmethod
    @documented("rt_scene_load")
    def load(cls, path: Path, *, check: bool = True, root: Optional[Path] = None,
             constants: Optional[Mapping[str, Any]] = None, camera: Optional[str] = None,
             strict: bool = False, memory: Optional[Memory] = None,
             progress: Optional[Progress] = None) -> "Scene":
        """Reads a scene from a .rts file, or from one of another program: .xml, .pbrt, .gltf, .glb,
        .obj, .ply, .stl or .off.

        check: also warn of what rt_scene_check finds. root: a folder that the text may name files
        in, and nowhere else. constants: values in place of those that the text's `let` gives, as
        {"radius": 0.3, "tint": (1, 0.5, 0)}, or of the parameters of a Mitsuba scene.
        InputError.diagnostics has all errors of the text.

        Of scenes of other programs alone: camera, the name or number of the one that is taken;
        strict makes what the language lacks an error, which is a warning otherwise.
        """
        if isinstance(path, str) and "{" in path and not os.path.exists(path):
            raise TypeError("Scene.load takes the path of a file; Scene.parse reads a text")
        return cls._read(lib.rt_scene_load, (path_bytes(path),), check, root, constants,
                         memory, progress, camera, strict)

    @classmethod
    @documented("rt_scene_import")
    def convert(cls, path: Path, to: Path, *, root: Optional[Path] = None,
                constants: Optional[Mapping[str, Any]] = None, camera: Optional[str] = None,
                strict: bool = False) -> "Scene":
        """Writes a scene of another program to the file `to`, X.rts, with its meshes and images in
        the folder X_files beside it, as `rtc import` does, and returns it.
        """
        def written(out: Any, options: Any, error: Any) -> Any:
            return lib.rt_scene_import(out, path_bytes(to), path_bytes(path), options, error)
        return cls._read(written, (), False, root, constants, None, None, camera, strict)

    @classmethod
    @documented("rt_scene_parse")
    def parse(cls, source: str, *, name: str = "text", check: bool = True,
              root: Optional[Path] = None, constants: Optional[Mapping[str, Any]] = None,
              memory: Optional[Memory] = None,
              progress: Optional[Progress] = None) -> "Scene":
        """Reads a scene from a string; `name` stands for its file in messages."""
        expect(source, str, "source")
        if source.endswith(".rts"):
            raise TypeError(f"Scene.parse takes a text; Scene.load reads the file '{source}'")
        return cls._read(lib.rt_scene_parse, (source.encode(), name.encode()), check, root,
                         constants, memory, progress)

    @classmethod
    def _read(cls, function: Any, what: tuple[Any, ...], check: bool, root: Optional[Path],
              constants: Optional[Mapping[str, Any]], memory: Optional[Memory],
              progress: Optional[Progress], camera: Optional[str] = None,
              strict: bool = False) -> "Scene":
        found: list[SimpleNamespace] = []
        handle = ffi.new_handle(found)
        folder = ffi.NULL if root is None else ffi.new("char[]", path_bytes(root))
        scratch = ffi.new("char[]", os.fsencode(tempfile.gettempdir()))
        chosen = ffi.NULL if camera is None else ffi.new("char[]", str(camera).encode())
        texts, definitions = _definitions(constants or {})
        scene = cls.__new__(cls)
        scene._materials = {}
        with Hooks(progress, stacklevel=4) as hooks:
            options = ffi.new("rt_load_options *", {
                "diagnostic": _on_diagnostic, "user": handle, "check": check, "root": folder,
                "hooks": hooks.pointer, "memory": memory_pointer(memory),
                "definitions": definitions, "definition_count": len(constants or {}),
                "camera": chosen, "is_strict": strict,
                "scratch": scratch})
            try:
                scene._c = make("rt_scene", lib.rt_scene_destroy, function, *what, options)
            except InputError as error:
                error.diagnostics = found
                raise
        del texts
        for each in found:
            if each.severity == "warning":
                place = ":".join([each.file] + [str(n) for n in (each.line, each.column) if n])
                warnings.warn(f"{place}: {each.message}", RenderWarning, stacklevel=3)
        return scene

    # ---- Options and facts ----------------------------------------------------------------------

    @property
    def options(self) -> Options:
        """A copy of the scene's own options; assign Options to change them."""
        options = Options()
        lib.rt_scene_get_options(self._c, options._c)
        return options

    @options.setter
    def options(self, options: Options) -> None:
        expect(options, Options, "options")
        call(lib.rt_scene_set_options, self._c, options._c)

    @property
    def info(self) -> SimpleNamespace:
        """How much it holds: shapes, primitives, triangles, materials, lights, has_camera."""
        out = ffi.new("rt_scene_info *")
        lib.rt_scene_get_info(self._c, out)
        return record(out)

    @documented("rt_scene_check")
    def check(self) -> list[SimpleNamespace]:
        """What is probably a mistake; an empty list is good."""
        found: list[SimpleNamespace] = []
        handle = ffi.new_handle(found)
        lib.rt_scene_check(self._c, _on_finding, handle)
        return found

    # ---- Materials and textures -----------------------------------------------------------------

    def _add(self, function: Any, *arguments: Any) -> int:
        out = ffi.new("uint32_t *")
        call(function, self._c, out, *arguments)
        return int(out[0])

    @documented("rt_scene_add_material", "rt_material")
    def material(self, name: Optional[str] = None, **members: Any) -> int:
        """Adds a material: material("red glass", kt=(1, 0.2, 0.2), fresnel="dielectric")."""
        if name is not None:
            expect(name, str, "name")
        material = ffi.new("rt_material *")
        kept = fill(material, members, "a material")
        index = self._add(lib.rt_scene_add_material,
                          ffi.NULL if name is None else name.encode(), material)
        del kept
        warn_lacking(lib.rt_material_lacks, material, members, "a material")
        if name is not None:
            self._materials[name] = index
        return index

    @documented("rt_scene_add_texture", "rt_texture")
    def texture(self, pattern: str = "image", **members: Any) -> int:
        """Adds a texture: texture(path="wood.png"), texture("checker", a=0.2, b=0.8).

        Textures inside of it are what earlier calls returned: texture("multiply",
        a_texture=wood, b=0.5).
        `kind`, the name of the member of rt_texture, stands for `pattern` too.
        """
        texture = ffi.new("rt_texture *")
        kept = fill(texture, {"kind": pattern, **members}, "a texture")
        handle = self._add(lib.rt_scene_add_texture, texture)
        warn_lacking(lib.rt_texture_lacks, texture, members, "a texture")
        del kept
        return handle

    @documented("rt_scene_add_grid", "rt_grid")
    def grid(self, values: Optional[ArrayLike] = None, path: Optional[Path] = None,
             lo: Optional[ArrayLike] = None, hi: Optional[ArrayLike] = None,
             wrap: Optional[str] = None, transform: Optional[ArrayLike] = None,
             layer: Optional[str] = None) -> int:
        """Adds a grid: grid(array, lo=..., hi=...), grid(path="puff.grid"), grid(path="smoke.vdb").

        The array has the shape (z, y, x), or (z, y, x, 3) for red, green and blue.
        """
        grid = ffi.new("rt_grid *")
        kept = fill(grid, {"path": path, "layer": layer, "lo": lo, "hi": hi,
                           "wrap": wrap}, "a grid")
        array = np.ascontiguousarray(0 if values is None else values, dtype=np.float32)
        if values is not None:
            if array.ndim != 3 and (array.ndim != 4 or array.shape[3] != 3):
                raise ValueError(f"values has shape (z, y, x) or (z, y, x, 3), not {array.shape}")
            grid.values, grid.size = pointer(array), list(array.shape[2::-1])
            grid.channels = 3 if array.ndim == 4 else 1
        _set_transform(grid, transform)
        handle = self._add(lib.rt_scene_add_grid, grid)
        del kept
        return handle

    @documented("rt_scene_set_vdb_module")
    def vdb_module(self, path: Optional[Path]) -> None:
        self._vdb_module = ffi.NULL if path is None else ffi.new("char[]", path_bytes(path))
        lib.rt_scene_set_vdb_module(self._c, self._vdb_module)

    # ---- Shapes ---------------------------------------------------------------------------------

    @documented("rt_scene_add_plane")
    def plane(self, point: ArrayLike, normal: ArrayLike, **surface: Any) -> int:
        return self._shape(lib.rt_scene_add_plane, (point, normal), surface)

    @documented("rt_scene_add_sphere")
    def sphere(self, centre: ArrayLike, radius: float, **surface: Any) -> int:
        return self._shape(lib.rt_scene_add_sphere, (centre, radius), surface)

    @documented("rt_scene_add_ellipsoid")
    def ellipsoid(self, centre: ArrayLike, radii: ArrayLike, **surface: Any) -> int:
        return self._shape(lib.rt_scene_add_ellipsoid, (centre, radii), surface)

    @documented("rt_scene_add_quad")
    def quad(self, corner: ArrayLike, edge1: ArrayLike, edge2: ArrayLike, **surface: Any) -> int:
        return self._shape(lib.rt_scene_add_quad, (corner, edge1, edge2), surface)

    @documented("rt_scene_add_disc")
    def disc(self, centre: ArrayLike, normal: ArrayLike, radius: float, inner_radius: float = 0.0,
             **surface: Any) -> int:
        return self._shape(lib.rt_scene_add_disc, (centre, normal, radius, inner_radius), surface)

    @documented("rt_scene_add_cylinder")
    def cylinder(self, a: ArrayLike, b: ArrayLike, radius: float, caps: bool = True,
                 **surface: Any) -> int:
        return self._shape(lib.rt_scene_add_cylinder, (a, b, radius, caps), surface)

    @documented("rt_scene_add_cone")
    def cone(self, base: ArrayLike, apex: ArrayLike, radius: float, apex_radius: float = 0.0,
             caps: bool = True, **surface: Any) -> int:
        return self._shape(lib.rt_scene_add_cone, (base, apex, radius, apex_radius, caps), surface)

    @documented("rt_scene_add_torus")
    def torus(self, centre: ArrayLike, axis: ArrayLike, major_radius: float, minor_radius: float,
              **surface: Any) -> int:
        return self._shape(lib.rt_scene_add_torus, (centre, axis, major_radius, minor_radius),
                           surface)

    @documented("rt_scene_add_box")
    def box(self, centre: ArrayLike, size: ArrayLike, **surface: Any) -> int:
        return self._shape(lib.rt_scene_add_box, (centre, size), surface)

    def _shape(self, function: Any, parameters: tuple[Any, ...], surface: dict[str, Any]) -> int:
        material = surface.get("material")
        if isinstance(material, str):
            near = nearest(material, self._materials)
            raise TypeError(f"material of a shape is the number that Scene.material returned, not "
                            f"the name '{material}'" +
                            (f"; that of '{near}' is {self._materials[near]}" if near else ""))
        made = _surface(surface)
        if material is None:
            raise TypeError("a shape needs a material: the number that Scene.material returned")
        return self._add(function, *(_argument(p) for p in parameters), made)

    @documented("rt_scene_add_mesh", "rt_mesh_data", "rt_mesh_attribute")
    def mesh(self, positions: ArrayLike, indices: ArrayLike, normals: Optional[ArrayLike] = None,
             uv: Optional[ArrayLike] = None, colours: Optional[ArrayLike] = None,
             attributes: Optional[dict[str, ArrayLike]] = None,
             triangle_attributes: Optional[dict[str, ArrayLike]] = None) -> int:
        """Adds a mesh from arrays; it is seen where `instance` places it.

        Attributes, by their names, have a row for each vertex or triangle, of one to three numbers.
        """
        arrays = {"positions": floats(positions, 3, "positions")}
        for name, given, columns in (("normals", normals, 3), ("uv", uv, 2),
                                     ("colours", colours, 3)):
            if given is not None:
                arrays[name] = floats(given, columns, name)
                if len(arrays[name]) != len(arrays["positions"]):
                    raise ValueError(f"{name} has {len(arrays[name])} rows for "
                                     f"{len(arrays['positions'])} vertices")
        faces = _indices(indices)
        data = ffi.new("rt_mesh_data *", {name: pointer(a) for name, a in arrays.items()})
        data.indices = pointer(faces, "uint32_t *")
        data.vertex_count, data.triangle_count = len(arrays["positions"]), len(faces)
        kept = [_mesh_attribute(name, values, count, of_triangles)
                for of_triangles, given, count in (
                    (0, attributes, data.vertex_count),
                    (1, triangle_attributes, data.triangle_count))
                for name, values in (given or {}).items()]
        listed = ffi.new("rt_mesh_attribute[]", [made for made, _ in kept])
        data.attributes, data.attribute_count = listed, len(kept)
        return self._add(lib.rt_scene_add_mesh, data)

    @documented("rt_scene_load_mesh")
    def load_mesh(self, path: Path, shading: str = "file") -> tuple[int, SimpleNamespace]:
        """Reads a mesh; returns its handle and what the file held, `warnings` as a list."""
        info = ffi.new("rt_mesh_info *")
        handle = self._add(lib.rt_scene_load_mesh, path_bytes(path),
                           word_value("rt_shading", shading, "shading"), info)
        found = record(info)
        found.warnings = found.warnings.text[:found.warnings.count]
        return handle, found

    @documented("rt_scene_add_instance")
    def instance(self, mesh: int, **surface: Any) -> int:
        if not isinstance(mesh, (int, np.integer)):
            raise TypeError("mesh of an instance is the number that Scene.mesh, or Scene.load_mesh "
                            f"first, returned, not {mesh!r:.60}")
        return self._shape(lib.rt_scene_add_instance, (mesh,), surface)

    @documented("rt_scene_add_triangles")
    def triangles(self, positions: ArrayLike, indices: ArrayLike,
                  normals: Optional[ArrayLike] = None, **surface: Any) -> int:
        return self.instance(self.mesh(positions, indices, normals), **surface)

    # ---- Lights and camera ----------------------------------------------------------------------

    def _set(self, function: Any, type_name: str, what: str, members: dict[str, Any],
             lacks: Any = None, transform: Optional[ArrayLike] = None) -> None:
        struct = ffi.new(f"{type_name} *")
        kept = fill(struct, members, what)
        _set_transform(struct, transform)
        call(function, self._c, struct)
        del kept
        if lacks is not None:
            warn_lacking(lacks, struct, members, what, level=4)

    @documented("rt_scene_add_point_light", "rt_point_light")
    def point_light(self, position: ArrayLike, *, intensity: Optional[Numbers] = None,
                    power: Optional[Numbers] = None) -> None:
        self._set(lib.rt_scene_add_point_light, "rt_point_light", "a point light",
                  {"position": position, "intensity": intensity, "power": power})

    @documented("rt_scene_add_spot_light", "rt_spot_light")
    def spot_light(self, position: ArrayLike, target: ArrayLike, intensity: Numbers,
                   outer: float = 0.0, inner: float = 0.0, falloff: str = "smooth",
                   path: Optional[Path] = None, layer: Optional[str] = None,
                   filter: str = "bilinear", repeat: bool = False,
                   up: Optional[ArrayLike] = None) -> None:
        self._set(lib.rt_scene_add_spot_light, "rt_spot_light", "a spot light",
                  {"position": position, "target": target, "intensity": intensity,
                   "inner": inner, "outer": outer, "falloff": falloff, "path": path,
                   "layer": layer, "filter": filter, "repeat": repeat, "up": up})

    @documented("rt_scene_add_projector_light", "rt_projector_light")
    def projector_light(self, position: ArrayLike, target: ArrayLike, path: Path, *,
                        irradiance: Optional[Numbers] = None,
                        intensity: Optional[Numbers] = None, fov: float = 0.0,
                        layer: Optional[str] = None, filter: str = "bilinear",
                        repeat: bool = False, up: Optional[ArrayLike] = None) -> None:
        self._set(lib.rt_scene_add_projector_light, "rt_projector_light", "a projector",
                  {"position": position, "target": target, "path": path,
                   "irradiance": irradiance, "intensity": intensity, "fov": fov,
                   "layer": layer, "filter": filter, "repeat": repeat, "up": up})

    @documented("rt_scene_add_goniometric_light", "rt_goniometric_light")
    def goniometric_light(self, position: ArrayLike, target: ArrayLike, path: Path,
                          intensity: Optional[Numbers] = None, layer: Optional[str] = None,
                          filter: str = "bilinear", up: Optional[ArrayLike] = None) -> None:
        self._set(lib.rt_scene_add_goniometric_light, "rt_goniometric_light",
                  "a goniometric light",
                  {"position": position, "target": target, "path": path,
                   "intensity": intensity, "layer": layer, "filter": filter, "up": up})

    @documented("rt_scene_add_beam_light", "rt_beam_light")
    def beam_light(self, position: ArrayLike, target: ArrayLike, width: float,
                   irradiance: Optional[Numbers] = None, power: Optional[Numbers] = None,
                   height: float = 0.0, cross_section: str = "round",
                   up: Optional[ArrayLike] = None) -> None:
        self._set(lib.rt_scene_add_beam_light, "rt_beam_light", "a beam",
                  {"position": position, "target": target, "irradiance": irradiance,
                   "power": power, "width": width, "height": height,
                   "cross_section": cross_section, "up": up})

    @documented("rt_scene_add_directional_light", "rt_directional_light")
    def directional_light(self, direction: ArrayLike, irradiance: Numbers) -> None:
        self._set(lib.rt_scene_add_directional_light, "rt_directional_light",
                  "a directional light", {"direction": direction, "irradiance": irradiance})

    @documented("rt_scene_add_portal", "rt_portal")
    def portal(self, corner: ArrayLike, edge1: ArrayLike, edge2: ArrayLike) -> None:
        self._set(lib.rt_scene_add_portal, "rt_portal", "a portal",
                  {"corner": corner, "edge1": edge1, "edge2": edge2})

    @documented("rt_scene_set_environment", "rt_environment")
    def environment(self, radiance: Optional[Numbers] = None, path: Optional[Path] = None,
                    rotation: float = 0.0, layer: Optional[str] = None,
                    transform: Optional[ArrayLike] = None) -> None:
        self._set(lib.rt_scene_set_environment, "rt_environment", "an environment",
                  {"radiance": radiance, "path": path, "rotation": rotation, "layer": layer},
                  transform=transform)

    @documented("rt_scene_set_medium", "rt_medium")
    def medium(self, scattering: Optional[Numbers] = None, absorption: Optional[Numbers] = None,
               g: Optional[float] = None, density: Optional[int] = None,
               albedo: Optional[int] = None) -> None:
        self._set(lib.rt_scene_set_medium, "rt_medium", "a medium",
                  {"absorption": absorption, "scattering": scattering, "g": g,
                   "density": density, "albedo": albedo},
                  lib.rt_medium_lacks)

    @documented("rt_scene_set_camera", "rt_camera")
    def camera(self, eye: ArrayLike, look_at: ArrayLike, projection: str = "perspective",
               **members: Any) -> None:
        """Sets the camera: camera((0, 1, -4), (0, 1, 0), fov=40).

        `kind`, the name of the member of rt_camera, stands for `projection` too.
        """
        self._set(lib.rt_scene_set_camera, "rt_camera", "a camera",
                  {"kind": projection, "eye": eye, "look_at": look_at, **members},
                  lib.rt_camera_lacks)


def _argument(value: Any) -> Any:
    """A parameter of a shape: a number as it is, a vector as float[3]."""
    if isinstance(value, (bool, int, float, np.number)):
        return value
    return ffi.new("float[3]", numbers_of(value, 3, "a point or a direction"))


def _mesh_attribute(name: str, values: ArrayLike, rows: int,
                    of_triangles: int) -> tuple[dict[str, Any], tuple[Any, Any]]:
    """An rt_mesh_attribute, and what has to stay as long as it does."""
    array = np.ascontiguousarray(values, dtype=np.float32)
    if array.ndim not in (1, 2) or len(array) != rows:
        raise ValueError(f"the attribute '{name}' has the shape {array.shape} for {rows} "
                         + ("triangles" if of_triangles else "vertices"))
    text = ffi.new("char[]", name.encode())
    made = {"name": text, "values": pointer(array), "of_triangles": of_triangles,
            "width": 1 if array.ndim == 1 else array.shape[1]}
    return made, (text, array)


def _surface(members: Mapping[str, Any]) -> Any:
    """What every shape has, as an rt_surface."""
    surface = ffi.new("rt_surface *")
    fill(surface, {**members, "transform": None}, "a shape")
    _set_transform(surface, members.get("transform"))
    return surface


def _set_transform(struct: Any, transform: Optional[ArrayLike]) -> None:
    if transform is None:
        return
    rows = np.asarray(transform, dtype=np.float64)
    if rows.shape not in ((3, 4), (4, 4)):
        raise ValueError(f"transform has shape (3, 4) or (4, 4), not {rows.shape}")
    if rows.shape == (4, 4) and not np.array_equal(rows[3], (0, 0, 0, 1)):
        raise ValueError("the last row of transform is not 0 0 0 1")
    struct.transform.m = rows[:3].tolist()


def _definitions(constants: Mapping[str, Any]) -> tuple[list[Any], Any]:
    """rt_definition[] of constants, and the texts that it points to."""
    texts = []
    for name, value in constants.items():
        if not isinstance(value, str):
            numbers = np.asarray(value, dtype=np.float64)
            shown = " ".join(repr(float(number)) for number in numbers.ravel())
            value = f"[{shown}]" if numbers.ndim else shown
        texts.append([ffi.new("char[]", name.encode()), ffi.new("char[]", value.encode())])
    return texts, ffi.new("rt_definition[]", texts)


def _indices(indices: ArrayLike) -> Any:
    given = np.asarray(indices)
    if given.ndim != 2 or given.shape[1] != 3 or given.dtype.kind not in "iu":
        raise ValueError("indices is an array of integers of shape (n, 3)")
    if given.size and (given.min() < 0 or given.max() > 0xffffffff):
        raise ValueError("indices has values outside of 32 bits")
    return np.ascontiguousarray(given, dtype=np.uint32)
