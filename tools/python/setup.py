"""Builds the package: declarations and documentation of the C interface come from its headers."""
import sys
from pathlib import Path

from setuptools import setup
from setuptools.command.build_py import build_py

HERE = Path(__file__).resolve().parent
sys.path.insert(0, str(HERE))

import headers  # noqa: E402

INTERFACE = headers.read(headers.find(HERE))


class BuildWithInterface(build_py):
    """Adds _api.py, which cffi reads, and _interface.py."""

    def run(self):
        super().run()
        if getattr(self, "editable_mode", False):
            folder = HERE / "librt_render"
        else:
            folder = Path(self.build_lib) / "librt_render"
        headers.write(folder, INTERFACE)


setup(version=INTERFACE.version, cmdclass={"build_py": BuildWithInterface})
