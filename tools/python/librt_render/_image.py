"""Images, and how they differ."""
from __future__ import annotations

import os
from types import SimpleNamespace
from typing import Any, Optional, Sequence, Union

import numpy as np
from numpy.typing import ArrayLike, NDArray

from ._film import Film, _png_of, image_options
from ._library import (Owned, call, documented, dtype, ffi, lib, make, path_bytes, pointer, record,
                       view)
from ._scene import Path


class Image:
    """An image file, or an array [height][width][3] of linear values."""

    _c = Owned()

    def __init__(self, pointer: Any) -> None:
        self._c = pointer

    @classmethod
    @documented("rt_image_read")
    def read(cls, path: Path) -> "Image":
        """Reads an image of any format that textures have."""
        return cls(make("rt_image", lib.rt_image_destroy, lib.rt_image_read, path_bytes(path)))

    @classmethod
    @documented("rt_image_from_rgb")
    def from_array(cls, values: ArrayLike) -> "Image":
        """An image of an array; of shape (height, width) it is grey."""
        array = np.asarray(values, dtype=np.float32)
        if array.ndim == 2:
            array = np.repeat(array[:, :, None], 3, axis=2)
        if array.ndim != 3 or array.shape[2] != 3 or 0 in array.shape:
            raise ValueError(f"an image has shape (height, width, 3), not {array.shape}")
        array = np.ascontiguousarray(array)
        height, width = array.shape[:2]
        return cls(make("rt_image", lib.rt_image_destroy, lib.rt_image_from_rgb, pointer(array),
                        width, height))

    @property
    def shape(self) -> tuple[int, int]:
        """(height, width) in pixels."""
        size = ffi.new("uint32_t[2]")
        lib.rt_image_get_size(self._c, size, size + 1)
        return size[1], size[0]

    @property
    def rgb(self) -> NDArray[np.float32]:
        """The picture, [height][width][3], linear, as a copy; image["albedo"] is a layer."""
        return self._values(None)

    @documented("rt_image_get_rgb")
    def __getitem__(self, layer: str) -> NDArray[np.float32]:
        """A layer of an .exr, [height][width][3], as a copy."""
        return self._values(layer)

    def _values(self, layer: Optional[str]) -> NDArray[np.float32]:
        values = np.zeros((*self.shape, 3), np.float32)
        call(lib.rt_image_get_rgb, pointer(values), self._c,
             ffi.NULL if layer is None else layer.encode())
        return values

    @documented("rt_image_write")
    def write(self, path: Path, *, exposure: float = 0.0, tonemap: str = "none") -> None:
        """Writes an .exr, .png, .ppm or .pfm."""
        options, _ = image_options(exposure, tonemap)
        call(lib.rt_image_write, self._c, path_bytes(path), options)

    def _repr_png_(self) -> bytes:
        return _png_of(self.write)


Picture = Union[Image, Film, ArrayLike, str, "os.PathLike[str]"]


def _image(picture: Any) -> Image:
    if isinstance(picture, Image):
        return picture
    if isinstance(picture, (str, os.PathLike)):
        return Image.read(picture)
    return Image.from_array(picture.rgb if isinstance(picture, Film) else picture)


class Comparison:
    """How renders differ from a reference: mse, rmse, ratio, flip, ... as attributes."""

    _c = Owned()

    def __init__(self, pointer: Any) -> None:
        self._c = pointer
        self.__dict__.update(vars(self._info()))

    def _info(self) -> SimpleNamespace:
        out = ffi.new("rt_comparison_info *")
        lib.rt_comparison_get_info(self._c, out)
        return record(out)

    @property
    @documented("rt_image_block")
    def blocks_array(self) -> NDArray[Any]:
        """The blocks, row by row, as a structured array without a copy."""
        count = ffi.new("size_t *")
        rows = lib.rt_comparison_blocks(self._c, count)
        return view(self._c, rows, (count[0],), dtype("rt_image_block"))

    @documented("rt_comparison_write_difference")
    def write_difference(self, path: Path, scale: float = 0.0) -> None:
        """Writes the signed difference."""
        call(lib.rt_comparison_write_difference, self._c, path_bytes(path), scale)

    def _repr_png_(self) -> bytes:
        return _png_of(self.write_difference)

    def __repr__(self) -> str:
        return f"Comparison({', '.join(f'{n}={v!r}' for n, v in vars(self._info()).items())})"


@documented("rt_image_compare", "rt_comparison_info", "rt_image_block")
def compare(renders: Union[Picture, Sequence[Any]], reference: Picture, *,
            layer: Optional[str] = None, block: int = 0, tolerance: float = 0.0,
            exposure: float = 0.0) -> Comparison:
    """Compares one render, or a list of independent ones, with a reference.

    Pictures are Films, Images, arrays or paths.
    """
    several = renders if isinstance(renders, list) else [renders]
    images = [_image(each) for each in several]
    last = _image(reference)
    name = ffi.NULL if layer is None else ffi.new("char[]", layer.encode())
    options = ffi.new("rt_compare_options *", {"layer": name, "block": block,
                                               "tolerance": tolerance, "exposure": exposure})
    return Comparison(make("rt_comparison", lib.rt_comparison_destroy, lib.rt_image_compare,
                           ffi.new("const rt_image *[]", [each._c for each in images]),
                           len(images), last._c, options))
