"""Builds the package: declarations and documentation of the C interface come from its headers."""
import shutil
import sys
from pathlib import Path

from setuptools import setup
from setuptools.command.build_py import build_py
from setuptools.command.sdist import sdist

HERE = Path(__file__).resolve().parent
sys.path.insert(0, str(HERE))

import headers  # noqa: E402

HEADERS = headers.find(HERE)
INTERFACE = headers.read(HEADERS, headers.tree_of(HERE))


class BuildWithInterface(build_py):
    """Adds _api.py, which cffi reads, and _interface.py."""

    def run(self):
        super().run()
        if getattr(self, "editable_mode", False):
            folder = HERE / "librt_render"
        else:
            folder = Path(self.build_lib) / "librt_render"
        headers.write(folder, INTERFACE)


class DistributionWithHeaders(sdist):
    """Adds the headers, so that it builds elsewhere."""

    def make_release_tree(self, base_dir, files):
        generated = {"_api.py", "_interface.py"}
        super().make_release_tree(base_dir, [f for f in files if Path(f).name not in generated])
        folder = Path(base_dir) / "include"
        for path in HEADERS:
            part = "" if path.name in ("rt.h", "common.h") else "rt"
            (folder / part).mkdir(parents=True, exist_ok=True)
            # The tree's lib/rt/common.h stands for kernels/common.h, which comes before it.
            if not (folder / part / path.name).exists():
                shutil.copyfile(path, folder / part / path.name)


setup(version=INTERFACE.version,
      cmdclass={"build_py": BuildWithInterface, "sdist": DistributionWithHeaders})
