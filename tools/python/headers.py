"""Reads the public C headers: declarations for cffi, documentation, and the words of enums."""
from __future__ import annotations

import hashlib
import os
import re
import subprocess
from dataclasses import dataclass, field
from pathlib import Path
from typing import Optional


@dataclass
class Interface:
    """What the headers hold."""

    version: str
    declarations: str  # C that cffi parses: no comments, no preprocessor
    docs: dict[str, str] = field(default_factory=dict)  # by function or type
    parameters: dict[str, list[str]] = field(default_factory=dict)  # names, by function
    words: dict[str, dict[str, str]] = field(default_factory=dict)  # word -> constant, by enum
    constants: dict[str, int] = field(default_factory=dict)
    tree: str = ""  # the source tree that the headers lie in; "" without
    headers: dict[str, str] = field(default_factory=dict)  # SHA-256 by path in the tree


def tree_of(here: Path) -> Optional[Path]:
    """The source tree that this folder is tools/python of."""
    tree = here.parent.parent
    return tree if (tree / "lib" / "rt.h").exists() else None


def find(here: Path) -> list[Path]:
    """The headers in order: those of a source distribution, of the tree, or the installed ones."""
    tree = tree_of(here)
    if (here / "include" / "rt.h").exists():
        top, folders = here / "include" / "rt.h", [here / "include"]
    elif tree:
        top, folders = tree / "lib" / "rt.h", [tree / "lib", tree / "lib" / "rt", tree / "kernels"]
    else:
        include = _installed_headers()
        top, folders = include / "rt" / "rt.h", [include / "rt", include]
    found: list[Path] = []
    _visit(top, folders, found)
    return found


def _installed_headers() -> Path:
    """The folder that holds rt/rt.h."""
    command = ["pkg-config", "--variable=includedir", "librt-render"]
    try:
        found = subprocess.run(command, check=True, capture_output=True, text=True).stdout.strip()
    except (OSError, subprocess.CalledProcessError):
        raise SystemExit(
            "librt-render: neither the source tree of librt nor an installed librt is here: build "
            "from the tree (`pip install ./tools/python`), or install librt with its headers and "
            "set PKG_CONFIG_PATH to the folder of librt-render.pc") from None
    return Path(found)


def _visit(path: Path, folders: list[Path], found: list[Path]) -> None:
    """Appends a header after those that it includes."""
    if path in found:
        return
    for name in re.findall(r'^#include "([^"]+)"', path.read_text(), re.M):
        for folder in [path.parent, *folders]:
            if (folder / name).exists():
                _visit((folder / name).resolve(), folders, found)
                break
        else:
            raise FileNotFoundError(f"{path} includes {name}, which is not there")
    if path not in found:
        found.append(path)


def read(paths: list[Path], tree: Optional[Path] = None) -> Interface:
    """The interface that these headers declare; `tree` is the source tree that they lie in."""
    text = "\n".join(path.read_text() for path in paths)
    text = re.sub(r"#ifdef __cplusplus\n.*?#endif", "", text, flags=re.S)
    text = text.replace("\\\n", " ")
    constants = {
        name: int(value, 0)
        for name, value in re.findall(r"^#define (RT_\w+) (0x[0-9a-f]+|\d+)u?\b *(?:/\*.*)?$", text,
                                      re.M)}
    version = ".".join(str(constants[f"RT_VERSION_{part}"]) for part in ("MAJOR", "MINOR", "PATCH"))
    lists = re.findall(r"^#define (RT_\w+)\(X\)(.*)$", text, re.M)
    text = re.sub(r"^#.*$", "", text, flags=re.M).replace("RT_API ", "")
    text = re.sub(r"\[(RT_\w+)\]", lambda m: f"[{constants[m.group(1)]}]", text)
    interface = Interface(version, re.sub(r"/\*.*?\*/", "", text, flags=re.S),
                          constants=constants)
    if tree:
        interface.tree = os.fspath(tree)
        interface.headers = {os.fspath(path.relative_to(tree)):
                             hashlib.sha256(path.read_bytes()).hexdigest() for path in paths}
    _read_words(interface, lists)
    _read_docs(interface, text)
    return interface


def _read_words(interface: Interface, lists: list[tuple[str, str]]) -> None:
    enum_of = {}
    for body, name in re.findall(r"typedef enum \w+ *\{(.*?)\} *(\w+);", interface.declarations,
                                 re.S):
        for constant in re.findall(r"RT_\w+", body):
            enum_of[constant] = name
    for _, body in lists:
        rows = re.findall(r'X\((RT_\w+), "([^"]+)"', body)
        if rows and rows[0][0] in enum_of:
            interface.words[enum_of[rows[0][0]]] = {word: constant for constant, word in rows}


def _read_docs(interface: Interface, text: str) -> None:
    """A comment documents the declarations that follow it without an empty line between."""
    pattern = re.compile(r"/\*(?P<comment>.*?)\*/|(?P<struct>typedef[^;{]*\{.*?\}[^;]*;)"
                         r"|(?P<plain>[A-Za-z_][^;{}/]*;)|(?P<gap>\n[ \t]*\n)", re.S)
    hidden = str.maketrans("{};", "\x01\x02\x03")  # in comments within a struct
    shown = str.maketrans("\x01\x02\x03", "{};")
    text = re.sub(r"/\*.*?\*/", lambda m: m.group().translate(hidden), text, flags=re.S)
    comment = ""
    for match in pattern.finditer(text):
        if match["gap"]:
            comment = ""
        elif match["comment"] is not None:
            lines = match["comment"].translate(shown).split("\n")
            comment = "\n".join(re.sub(r"^ ?\* ?", "", line.strip()) for line in lines).strip()
            if comment.startswith("----"):
                comment = ""
        elif match["struct"]:
            _note(interface, re.search(r"(\w+)\s*;$", match["struct"]).group(1), comment)
        else:
            function = re.search(r"(rt_\w+)\((.*)\)\s*;$", match["plain"], re.S)
            if not function:
                _note(interface, re.search(r"(\w+)\s*;$", match["plain"]).group(1), comment)
            else:
                _note(interface, function.group(1), comment)
                plain = re.sub(r"\(\*(\w+)\)\([^)]*\)", r" \1", function.group(2))  # callbacks
                interface.parameters[function.group(1)] = [
                    re.search(r"(\w+)(?:\[\d*\])?\s*$", part).group(1)
                    for part in plain.split(",")
                    if part.strip() != "void"]


def _note(interface: Interface, name: str, comment: str) -> None:
    if comment:
        interface.docs[name] = comment


def write(folder: Path, interface: Interface) -> None:
    """Writes the two modules that the package is completed by."""
    import cffi

    ffi = cffi.FFI()
    ffi.cdef(interface.declarations)
    ffi.set_source("librt_render._api", None)
    folder.mkdir(parents=True, exist_ok=True)
    ffi.emit_python_code(os.fspath(folder / "_api.py"))
    with open(folder / "_interface.py", "w", encoding="utf-8") as out:
        out.write('"""Generated from the C headers by headers.py."""\n')
        for name in ("version", "docs", "parameters", "words", "constants", "tree", "headers"):
            out.write(f"{name.upper()} = {getattr(interface, name)!r}\n")
