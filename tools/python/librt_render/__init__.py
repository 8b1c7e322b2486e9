"""librt, a renderer for the study of light transport.

    import librt_render as rt

    scene = rt.Scene.load("cornell.rts")
    renderer = rt.Renderer(scene)
    film = renderer.render(mode="photon", k=50)
    film.rgb                               # a NumPy array [height][width][3] of linear radiance
    film.write("cornell.exr")

    photons = renderer.emit(photons=1e5).photons()
    photons["position"], photons["flux"]   # structured, without a copy

Units are metres, degrees, watts and linear sRGB, as in rt/rt.h, whose words the docstrings carry.
"""
from ._film import Film
from ._image import Comparison, Image, compare
from ._library import (Cancelled, DeviceError, Error, InputError, OutOfMemoryError, OutputError,
                       RenderWarning, UsageError)
from ._library import ffi as _ffi
from ._library import lib as _lib
from ._options import Options
from ._paths import Paths
from ._photon import PhotonMap
from ._render import Device, Renderer, devices, render
from ._scene import Memory, Scene

__version__ = _ffi.string(_lib.rt_version()).decode()

__all__ = [
    "Cancelled", "Comparison", "Device", "DeviceError", "Error", "Film", "Image", "InputError",
    "Memory", "Options", "OutOfMemoryError", "OutputError", "Paths", "PhotonMap", "RenderWarning",
    "Renderer", "Scene", "UsageError", "compare", "devices", "render",
]
