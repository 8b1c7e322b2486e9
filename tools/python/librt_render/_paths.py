"""The camera paths of a pixel."""
from __future__ import annotations

from typing import Any

from numpy.typing import NDArray

from ._library import WORDS, Owned, documented, dtype, ffi, lib, view


@documented("rt_path_vertex", "rt_camera_path")
class Paths:
    """What Renderer.paths traces: structured arrays of the library's memory, without a copy."""

    _c = Owned()

    def __init__(self, pointer: Any) -> None:
        self._c = pointer

    def _array(self, function: Any, type_name: str) -> NDArray[Any]:
        count = ffi.new("size_t *")
        values = function(self._c, count)
        return view(self._c, values, (count[0],), dtype(type_name))

    @property
    @documented("rt_paths_list")
    def paths(self) -> NDArray[Any]:
        """One row a sample: radiance, weight, first_vertex, vertex_count."""
        return self._array(lib.rt_paths_list, "rt_camera_path")

    @property
    def vertices(self) -> NDArray[Any]:
        """One row a vertex: position, event, throughput, emitted, direct, ..."""
        return self._array(lib.rt_paths_vertices, "rt_path_vertex")

    def of(self, index: int) -> NDArray[Any]:
        """The vertices of one path, the camera's first."""
        path = self.paths[index]
        first = int(path["first_vertex"])
        return self.vertices[first:first + int(path["vertex_count"])]

    @staticmethod
    def event(number: int) -> str:
        """The word of an event, as "diffuse"."""
        return list(WORDS["rt_path_event"])[number]

    def __len__(self) -> int:
        return len(self.paths)

    def __repr__(self) -> str:
        return f"<Paths: {len(self)} with {len(self.vertices)} vertices>"
