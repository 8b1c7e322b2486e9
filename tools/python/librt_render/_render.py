"""Devices and renderers."""
from __future__ import annotations

from types import SimpleNamespace
from typing import Any, Optional, Union

import numpy as np
from numpy.typing import ArrayLike, NDArray

from ._film import Film
from ._library import (Cancelled, Exclusive, Hooks, Owned, Progress, call, documented, dtype,
                       expect, ffi, floats, lib, make, owned, path_bytes, record, word_value)
from ._options import Options, Value
from ._paths import Paths
from ._photon import PhotonMap
from ._scene import Memory, Path, Scene, memory_pointer


@documented("rt_devices_list")
def devices() -> list[SimpleNamespace]:
    """All OpenCL devices of this machine."""
    out, count = ffi.new("rt_device_info **"), ffi.new("size_t *")
    call(lib.rt_devices_list, out, count)
    try:
        return [record(out[0][i]) for i in range(count[0])]
    finally:
        lib.rt_devices_free(out[0])


class Device:
    """An OpenCL device. Calls that use it from several threads wait for each other."""

    _c = Owned()

    @documented("rt_device_open", "rt_device_options")
    def __init__(self, select: Union[int, str, None] = None, *, threads: int = 0,
                 work_group: int = 0, width: int = 0, memory: Optional[Memory] = None) -> None:
        named = ffi.NULL if select is None else ffi.new("char[]", str(select).encode())
        options = ffi.new("rt_device_options *", {
            "select": named, "threads": threads, "work_group": work_group, "width": width,
            "memory": memory_pointer(memory)})
        self._c = make("rt_device", lib.rt_device_close, lib.rt_device_open, options)
        self._exclusive = Exclusive("device")

    @property
    @documented("rt_device_info")
    def info(self) -> SimpleNamespace:
        """What it is."""
        out = ffi.new("rt_device_info *")
        lib.rt_device_get_info(self._c, out)
        return record(out)


class Renderer:
    """A scene made ready on a device; without one, on the first device, opened for it."""

    _c = Owned()

    @documented("rt_renderer_create")
    def __init__(self, scene: Scene, device: Optional[Device] = None, *, accel: str = "bvh",
                 progress: Optional[Progress] = None) -> None:
        expect(scene, Scene, "scene", "Scene.load reads a file, Scene.parse a text")
        if device is not None:
            expect(device, Device, "device", "Device(select) opens one")
        self.device = device if device is not None else Device()
        with self.device._exclusive, Hooks(progress) as hooks:
            options = ffi.new("rt_renderer_options *", {
                "accel": word_value("rt_accel", accel, "accel"), "hooks": hooks.pointer})
            self._c = make("rt_renderer", self._destroy(), lib.rt_renderer_create, scene._c,
                           self.device._c, options)
        self._options = scene.options

    def _destroy(self) -> Any:
        soon, destroy = self.device._exclusive.soon, lib.rt_renderer_destroy
        return lambda renderer: soon(lambda: destroy(renderer))

    def _settings(self, options: Optional[Options], settings: dict[str, Value]) -> Options:
        return Options(self._options if options is None else options, **settings)

    @documented("rt_render")
    def render(self, options: Optional[Options] = None, *, progress: Optional[Progress] = None,
               photon_map: Optional[PhotonMap] = None, resume: Optional[Film] = None,
               part: Optional[tuple[int, int]] = None, light_shares: Optional[ArrayLike] = None,
               **settings: Value) -> Film:
        """Renders: render(mode="photon", k=50). Settings change the given or the scene's options.

        progress: called with stage, fraction, elapsed, remaining and error; one that returns True
        ends the render, which then raises Cancelled, with the film so far. part: (i, n), part i of
        1 to n; Film.join puts them together; (1, 1) is a whole picture that can be continued.
        """
        chosen = self._settings(options, settings)
        if photon_map is not None:
            expect(photon_map, PhotonMap, "photon_map", "PhotonMap.load reads a file")
        if resume is not None:
            expect(resume, Film, "resume", "Film.load reads a file")
        shares = None if light_shares is None else np.ascontiguousarray(light_shares, np.float32)
        out = ffi.new("rt_film **")
        film = None
        with self.device._exclusive, Hooks(progress) as hooks:
            each = chosen._c
            each.hooks = hooks.pointer
            each.photon_map = ffi.NULL if photon_map is None else photon_map._c
            each.resume = ffi.NULL if resume is None else resume._c
            each.part, each.parts = part if part is not None else (0, 0)
            chosen.warn_lacking(settings)
            if shares is not None:
                each.light_shares = ffi.cast("float *", ffi.from_buffer(shares))
                each.light_share_count = shares.size
            try:
                call(lib.rt_render, out, self._c, each)
            except Cancelled as cancelled:
                cancelled.film = self._film(out)
                raise
            film = self._film(out)
        assert film is not None
        return film

    @staticmethod
    def _film(out: Any) -> Optional[Film]:
        return Film(owned(out[0], lib.rt_film_destroy)) if out[0] != ffi.NULL else None

    @documented("rt_chunk_count")
    def chunk_count(self, options: Optional[Options] = None, **settings: Value) -> int:
        """How many chunks the picture has."""
        out = ffi.new("uint64_t *")
        call(lib.rt_chunk_count, out, self._settings(options, settings)._c)
        return int(out[0])

    @documented("rt_chunk_render")
    def render_chunks(self, first: int, count: int = 1, options: Optional[Options] = None, *,
                      progress: Optional[Progress] = None,
                      photon_map: Optional[PhotonMap] = None, **settings: Value) -> Film:
        """Renders some chunks alone, for schedulers such as Dask: Film.join adds them up."""
        chosen = self._settings(options, settings)
        with self.device._exclusive, Hooks(progress) as hooks:
            chosen._c.hooks = hooks.pointer
            chosen._c.photon_map = ffi.NULL if photon_map is None else photon_map._c
            chosen.warn_lacking(settings)
            pointer = make("rt_film", lib.rt_film_destroy, lib.rt_chunk_render, self._c, chosen._c,
                           first, count)
        return Film(pointer)

    @documented("rt_photon_map_emit")
    def emit(self, options: Optional[Options] = None, *, progress: Optional[Progress] = None,
             part: tuple[int, int] = (1, 1), resume: Optional[PhotonMap] = None,
             **settings: Value) -> PhotonMap:
        """Emits photons: emit(photons=1e6). part: (i, n), part i of 1 to n, for PhotonMap.merge."""
        chosen = self._settings(options, settings)
        index, parts = part
        if not 1 <= index <= parts:
            raise ValueError(f"part is (i, n) with 1 <= i <= n, not {part}")
        with self.device._exclusive, Hooks(progress) as hooks:
            chosen._c.hooks = hooks.pointer
            emit = ffi.new("rt_emit_options *", {
                "render": chosen._c, "part": index - 1, "parts": parts,
                "resume": ffi.NULL if resume is None else resume._c})
            pointer = make("rt_photon_map", lib.rt_photon_map_destroy, lib.rt_photon_map_emit,
                           self._c, emit)
        return PhotonMap(pointer)

    @documented("rt_paths_trace")
    def paths(self, x: int, y: int, first: int = 0, count: Optional[int] = None,
              options: Optional[Options] = None, *, progress: Optional[Progress] = None,
              **settings: Value) -> Paths:
        """Follows the camera paths of a pixel again: paths(320, 200, spp=16)."""
        chosen = self._settings(options, settings)
        with self.device._exclusive, Hooks(progress) as hooks:
            chosen._c.hooks = hooks.pointer
            pointer = make("rt_paths", lib.rt_paths_destroy, lib.rt_paths_trace, self._c,
                           chosen._c, x, y, first, count or 0)
        return Paths(pointer)

    @documented("rt_film_denoise")
    def denoise(self, film: Film, library: Optional[Path] = None) -> NDArray[np.float32]:
        """Adds the layer "denoised" to a film of this scene, and returns it."""
        expect(film, Film, "film")
        name = ffi.NULL if library is None else ffi.new("char[]", path_bytes(library))
        with self.device._exclusive, Hooks(None) as hooks:
            options = ffi.new("rt_denoise_options *", {"library": name, "hooks": hooks.pointer})
            call(lib.rt_film_denoise, film._c, self._c, options)
        return film["denoised"]

    @documented("rt_trace", "rt_hit")
    def trace(self, origins: ArrayLike, directions: ArrayLike, t_min: ArrayLike = 0.0,
              t_max: ArrayLike = np.inf, any_hit: bool = False) -> NDArray[Any]:
        """Follows rays; returns a structured array of hits."""
        starts = floats(origins, 3, "origins")
        rays = np.zeros(len(starts), dtype("rt_ray"))
        rays["origin"], rays["direction"] = starts, floats(directions, 3, "directions")
        rays["t_min"], rays["t_max"] = t_min, t_max
        hits = np.zeros(len(rays), dtype("rt_hit"))
        if len(rays):
            with self.device._exclusive:
                call(lib.rt_trace, self._c,
                     lib.RT_TRACE_ANY if any_hit else lib.RT_TRACE_CLOSEST,
                     ffi.cast("rt_ray *", ffi.from_buffer(rays)), len(rays),
                     ffi.cast("rt_hit *", ffi.from_buffer(hits)))
        return hits


def render(scene: Union[Scene, Path], device: Optional[Device] = None, *,
           progress: Optional[Progress] = None, **settings: Value) -> Film:
    """Renders a scene or a .rts file in one call: render("cornell.rts", spp=16)."""
    loaded = scene if isinstance(scene, Scene) else Scene.load(scene)
    options = Options(loaded.options, **settings)
    options.warn_lacking(settings)
    return Renderer(loaded, device).render(options, progress=progress)
