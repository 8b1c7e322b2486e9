"""Films: pictures with their layers and statistics."""
from __future__ import annotations

import os
import tempfile
from types import SimpleNamespace
from typing import Any, Iterable, Optional

import numpy as np
from numpy.typing import NDArray

from ._library import (Hooks, Owned, call, did_you_mean, documented, dtype, expect, ffi, lib, make,
                       nearest, path_bytes, record, text, view)
from ._options import Options
from ._scene import Memory, Path, memory_pointer


def _png_of(write: Any) -> bytes:
    """The bytes of a .png that a function writes."""
    handle, path = tempfile.mkstemp(suffix=".png")
    os.close(handle)
    try:
        write(path)
        with open(path, "rb") as file:
            return file.read()
    finally:
        os.unlink(path)


def image_options(exposure: float, tonemap: str, scene: Optional[str] = None,
                  command: Optional[str] = None) -> tuple[Any, list[Any]]:
    """rt_image_options, and what they point to."""
    tonemaps = {"none": lib.RT_TONEMAP_NONE, "reinhard": lib.RT_TONEMAP_REINHARD,
                "aces": lib.RT_TONEMAP_ACES}
    if tonemap not in tonemaps:
        raise ValueError(f"tonemap is one of {', '.join(tonemaps)}, not {tonemap!r}" +
                         did_you_mean(nearest(str(tonemap), tonemaps)))
    kept = [ffi.NULL if each is None else ffi.new("char[]", each.encode())
            for each in (scene, command)]
    return ffi.new("rt_image_options *", {"exposure": exposure, "tonemap": tonemaps[tonemap],
                                          "scene": kept[0], "command": kept[1]}), kept


def ledger_array(write: Any) -> NDArray[Any]:
    """The rows of an energy ledger."""
    rows = np.zeros(write(ffi.NULL, 0), dtype("rt_light_ledger"))
    write(ffi.cast("rt_light_ledger *", ffi.from_buffer(rows)) if len(rows) else ffi.NULL,
          len(rows))
    return rows


class Film:
    """A picture: film.rgb, and its layers as film["albedo"], without copies.

    The arrays cannot be written to; they keep the film's memory alive. A film never changes:
    `join` and Renderer.render(resume=film) make new ones.
    """

    _c = Owned()

    def __init__(self, pointer: Any) -> None:
        self._c = pointer

    @property
    @documented("rt_film_rgb")
    def rgb(self) -> NDArray[np.float32]:
        """Linear radiance, [height][width][3], top row first."""
        return view(self._c, lib.rt_film_rgb(self._c), (*self.shape, 3), np.float32)

    @property
    def shape(self) -> tuple[int, int]:
        """(height, width) in pixels."""
        size = ffi.new("uint32_t[2]")
        lib.rt_film_get_size(self._c, size, size + 1)
        return size[1], size[0]

    @property
    def layers(self) -> list[str]:
        """The names of its layers."""
        names: list[str] = []
        while lib.rt_film_layer_name(self._c, len(names)) != ffi.NULL:
            names.append(text(lib.rt_film_layer_name(self._c, len(names))))
        return names

    @documented("rt_film_layer")
    def __getitem__(self, name: str) -> NDArray[np.float32]:
        """A layer: [height][width], or [height][width][channels] where it has several."""
        channels = ffi.new("uint32_t *")
        values = lib.rt_film_layer(self._c, name.encode(), channels)
        if values == ffi.NULL:
            raise KeyError(f"the film has no layer '{name}'" +
                           (f", but {', '.join(self.layers)}" +
                            did_you_mean(nearest(name, self.layers)) if self.layers else
                            "; render with aov=True, variance=True or photon_layers=True"))
        shape = self.shape if channels[0] == 1 else (*self.shape, channels[0])
        return view(self._c, values, shape, np.float32)

    def __array__(self, kind: Any = None, copy: Optional[bool] = None) -> NDArray[Any]:
        rgb = self.rgb
        if kind is not None and np.dtype(kind) != rgb.dtype:
            return rgb.astype(kind)
        return rgb.copy() if copy else rgb

    @property
    @documented("rt_film_stats")
    def stats(self) -> SimpleNamespace:
        """Statistics of the render; errors that were not estimated are not a number."""
        out = ffi.new("rt_film_stats *")
        lib.rt_film_get_stats(self._c, out)
        stats = record(out)
        if stats.replicates == 0:
            stats.relative_error = stats.relative_error_bound = float("nan")
        return stats

    @property
    @documented("rt_film_info")
    def info(self) -> SimpleNamespace:
        """How much of its picture the film holds."""
        out = ffi.new("rt_film_info *")
        lib.rt_film_get_info(self._c, out)
        return record(out)

    @property
    @documented("rt_film_get_options")
    def options(self) -> Options:
        """The options that it was rendered with."""
        options = Options()
        lib.rt_film_get_options(self._c, options._c)
        return options

    @property
    @documented("rt_light_ledger")
    def ledger(self) -> NDArray[Any]:
        """The energy ledger of its photon paths: a structured array, one row a light."""
        return ledger_array(lambda out, count: lib.rt_film_get_ledger(self._c, out, count))

    @documented("rt_film_write")
    def write(self, path: Path, *, exposure: float = 0.0, tonemap: str = "none",
              scene: Optional[str] = None, command: Optional[str] = None) -> None:
        """Writes an .exr with all layers, a .png, .ppm or .pfm."""
        options, kept = image_options(exposure, tonemap, scene, command)
        call(lib.rt_film_write, self._c, path_bytes(path), options)
        del kept

    def _repr_png_(self) -> bytes:
        return _png_of(self.write)

    def __repr__(self) -> str:
        height, width = self.shape
        return f"<Film {width}x{height}, {self.stats.spp} samples a pixel>"

    # ---- Parts ----------------------------------------------------------------------------------

    @documented("rt_film_save")
    def save(self, path: Path) -> None:
        """Writes its sums, so that it can be continued and joined."""
        call(lib.rt_film_save, self._c, path_bytes(path))

    @classmethod
    @documented("rt_film_load")
    def load(cls, path: Path, memory: Optional[Memory] = None) -> "Film":
        """Reads what `save` or `rtc --checkpoint` wrote."""
        return cls._resolved(make("rt_film", lib.rt_film_destroy, lib.rt_film_load,
                                  path_bytes(path), memory_pointer(memory)))

    @documented("rt_film_encode")
    def to_bytes(self) -> bytes:
        """What `save` writes."""
        size = ffi.new("size_t *")
        call(lib.rt_film_encode, self._c, ffi.NULL, 0, size)
        data = bytearray(size[0])
        call(lib.rt_film_encode, self._c, ffi.from_buffer(data), len(data), size)
        return bytes(data)

    @classmethod
    def from_bytes(cls, data: bytes) -> "Film":
        """The film of to_bytes."""
        return cls._resolved(make("rt_film", lib.rt_film_destroy, lib.rt_film_decode,
                                  ffi.from_buffer(data), len(data)))

    @classmethod
    def _resolved(cls, pointer: Any) -> "Film":
        with Hooks(None, stacklevel=4) as hooks:
            call(lib.rt_film_resolve, pointer, hooks.pointer)
        return cls(pointer)

    @classmethod
    @documented("rt_film_add")
    def join(cls, films: Iterable["Film"]) -> "Film":
        """The sum of films of one picture: the bits of a render at once."""
        all_of_them = list(films)
        if not all_of_them:
            raise ValueError("join takes one film at least")
        for each in all_of_them:
            expect(each, Film, "join")
        data = all_of_them[0].to_bytes()
        total = make("rt_film", lib.rt_film_destroy, lib.rt_film_decode, ffi.from_buffer(data),
                     len(data))
        for each in all_of_them[1:]:
            call(lib.rt_film_add, total, each._c)
        return cls._resolved(total)
