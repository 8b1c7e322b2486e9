"""Starts Mitsuba 3, whose just-in-time compiler wants LLVM."""
import os
import re
import shutil
import subprocess
import sys


def find_llvm():
    """The newest LLVM library that the dynamic linker knows."""
    ldconfig = shutil.which("ldconfig", path=os.environ.get("PATH", "") + ":/sbin:/usr/sbin")
    if not ldconfig:
        return None
    listing = subprocess.run([ldconfig, "-p"], capture_output=True, text=True, check=False).stdout
    libraries = re.findall(r"libLLVM[-.]\D*(\d+)\S*.*=> (\S+)", listing)
    found = [(int(version), path) for version, path in libraries]
    return max(found)[1] if found else None


def start(variant="llvm_ad_rgb"):
    """The module mitsuba, with that variant chosen; where there is none, ends the program."""
    llvm = find_llvm()
    if llvm:
        os.environ.setdefault("DRJIT_LIBLLVM_PATH", llvm)
    try:
        import mitsuba
    except ImportError:
        sys.exit(f"mitsuba is not installed for {sys.executable}: pip install mitsuba")
    if variant.startswith("llvm") and "DRJIT_LIBLLVM_PATH" not in os.environ:
        sys.exit("mitsuba finds no LLVM: install Debian's libllvm19, "
                 "or set DRJIT_LIBLLVM_PATH to a libLLVM.so")
    mitsuba.set_variant(variant)
    return mitsuba
