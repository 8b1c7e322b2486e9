"""Photon maps."""
from __future__ import annotations

import os
from types import SimpleNamespace
from typing import Any, Iterable, Optional

import numpy as np
from numpy.typing import ArrayLike, NDArray

from ._film import ledger_array
from ._library import (Owned, call, documented, dtype, expect, ffi, floats, lib, make, path_bytes,
                       pointer, record, view)
from ._options import Options, Value
from ._scene import Memory, Path, memory_pointer


class PhotonMap:
    """The photons of a scene, of Renderer.emit or PhotonMap.load. A map never changes."""

    _c = Owned()

    def __init__(self, pointer: Any) -> None:
        self._c = pointer

    @property
    @documented("rt_photon_map_info")
    def info(self) -> SimpleNamespace:
        """How it was made; paths and photons of the global, caustic and volume list."""
        out = ffi.new("rt_photon_map_info *")
        lib.rt_photon_map_get_info(self._c, out)
        return record(out)

    @staticmethod
    def _kind(caustic: bool, volume: bool = False) -> Any:
        if caustic and volume:
            raise ValueError("photons are either caustic or volume")
        return (lib.RT_PHOTONS_VOLUME if volume else
                lib.RT_PHOTONS_CAUSTIC if caustic else lib.RT_PHOTONS_GLOBAL)

    @documented("rt_photon")
    def photons(self, caustic: bool = False, volume: bool = False) -> NDArray[Any]:
        """The photons as a structured array, without a copy: photons()["position"].

        A flux is that of one path, undivided: over the number of paths of the list,
        photons()["flux"].sum(0) / map.info.paths[caustic], it is in W. Volume photons,
        of map.info.paths[2], have W m.
        """
        kind = self._kind(caustic, volume)
        count = lib.rt_photon_map_count(self._c, kind)
        return view(self._c, lib.rt_photon_map_photons(self._c, kind), (count,),
                    dtype("rt_photon"))

    @documented("rt_path_range")
    def ranges(self, caustic: bool = False, volume: bool = False) -> NDArray[Any]:
        """The ranges of paths that a list is made of."""
        count = ffi.new("size_t *")
        rows = lib.rt_photon_map_ranges(self._c, self._kind(caustic, volume), count)
        return view(self._c, rows, (count[0],), dtype("rt_path_range"))

    @property
    @documented("rt_light_ledger")
    def ledger(self) -> NDArray[Any]:
        """The energy ledger: a structured array, one row a light."""
        return ledger_array(lambda out, count: lib.rt_photon_map_ledger(self._c, out, count))

    @documented("rt_photon_map_irradiance")
    def irradiance(self, device: Any, positions: ArrayLike, normals: ArrayLike,
                   options: Optional[Options] = None, **settings: Value) -> NDArray[np.float32]:
        """Irradiance [n][3] in W/m^2 at points on surfaces."""
        points = floats(positions, 3, "positions")
        directions = floats(normals, 3, "normals")
        if len(points) != len(directions):
            raise ValueError(f"{len(points)} positions, but {len(directions)} normals")
        rgb = np.zeros((len(points), 3), np.float32)
        if len(points):
            with device._exclusive:
                call(lib.rt_photon_map_irradiance, pointer(rgb), self._c, device._c,
                     pointer(points), pointer(directions), len(points),
                     Options(options, **settings)._c)
        return rgb

    @documented("rt_photon_map_illuminance")
    def illuminance(self, positions: ArrayLike, normals: Optional[ArrayLike] = None,
                    options: Optional[Options] = None, threads: int = 0,
                    **settings: Value) -> NDArray[Any]:
        """Irradiance, illuminance and fluence rate at points, with standard errors, as a
        structured array: illuminance(...)["illuminance"]. Without normals, fluence alone."""
        points = floats(positions, 3, "positions")
        directions = (np.zeros_like(points) if normals is None
                      else floats(normals, 3, "normals"))
        if len(points) != len(directions):
            raise ValueError(f"{len(points)} positions, but {len(directions)} normals")
        out = np.zeros(len(points), dtype("rt_photon_reading"))
        if len(points):
            call(lib.rt_photon_map_illuminance, pointer(out, "rt_photon_reading *"), self._c,
                 pointer(points), pointer(directions), len(points),
                 threads or os.cpu_count() or 1, Options(options, **settings)._c)
        return out

    @documented("rt_photon_map_save")
    def save(self, path: Path) -> None:
        """Writes the map, to the bit."""
        call(lib.rt_photon_map_save, self._c, path_bytes(path))

    @classmethod
    def load(cls, path: Path, memory: Optional[Memory] = None) -> "PhotonMap":
        """Reads what `save` or `rtc photons` wrote."""
        return cls(make("rt_photon_map", lib.rt_photon_map_destroy, lib.rt_photon_map_load_in,
                        path_bytes(path), memory_pointer(memory)))

    @documented("rt_photon_map_export")
    def export(self, path: Path) -> None:
        """Writes the photons as the points of a .ply file."""
        call(lib.rt_photon_map_export, self._c, path_bytes(path))

    @classmethod
    @documented("rt_photon_map_merge")
    def merge(cls, maps: Iterable["PhotonMap"]) -> "PhotonMap":
        """Joins maps of other seeds or parts."""
        pointers = []
        for each in maps:
            expect(each, PhotonMap, "merge", "PhotonMap.load reads a file")
            pointers.append(each._c)
        return cls(make("rt_photon_map", lib.rt_photon_map_destroy, lib.rt_photon_map_merge,
                        ffi.new("const rt_photon_map *[]", pointers), len(pointers)))

    def __len__(self) -> int:
        return sum(self.info.photons)

    def __repr__(self) -> str:
        info = self.info
        return f"<PhotonMap of {sum(info.photons)} photons, {sum(info.paths[:2])} paths>"
