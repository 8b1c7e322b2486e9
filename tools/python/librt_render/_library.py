"""The shared library: loading, calls that fail, callbacks, and C data as Python's and NumPy's."""
from __future__ import annotations

import atexit
import hashlib
import logging
import os
import threading
import time
import warnings
from collections import deque
from pathlib import Path
from types import SimpleNamespace
from typing import Any, Callable, Iterable, Mapping, Optional, Sequence, TypeVar, Union

import numpy as np
from numpy.typing import ArrayLike, NDArray

from . import _interface
from ._api import ffi as ffi

CONSTANTS = _interface.CONSTANTS
WORDS = _interface.WORDS

_log = logging.getLogger("librt")
_major, _minor = _interface.VERSION.split(".")[:2]
_SONAME = f"librt-render.so.{_major}"


_PIP = "reinstall the package: pip install ./tools/python in the source tree of librt"


def _in_tree() -> Optional[str]:
    """The library built in the source tree that this package was installed from, if it is there."""
    tree = Path(_interface.TREE)
    path = tree / "build" / _SONAME
    if not _interface.TREE or not path.exists():
        return None
    for name, digest in _interface.HEADERS.items():
        header = tree / name
        if header.exists() and hashlib.sha256(header.read_bytes()).hexdigest() != digest:
            raise ImportError(f"{header} has changed since this package was installed; {_PIP}")
    return os.fspath(path)


def _open() -> Any:
    """Opens LIBRT_LIBRARY, the library of the tree, or the installed one: the first that is.

    It stays in memory until the process ends: objects may be destroyed after this module.
    """
    path = os.environ.get("LIBRT_LIBRARY") or _in_tree() or _SONAME
    try:
        found = ffi.dlopen(path, ffi.RTLD_NOW | ffi.RTLD_NODELETE)
    except OSError as error:
        built = f"build it with `make` in {_interface.TREE}, " if _interface.TREE else ""
        raise ImportError(
            f"{path} cannot be loaded ({error}); {built}install librt with `make install`, or set "
            f"LIBRT_LIBRARY to the path of {_SONAME}") from None
    try:
        version = ffi.string(found.rt_version()).decode()
    except (AttributeError, ffi.error):
        raise ImportError(f"{path} is not librt: it has no rt_version") from None
    if version.split(".")[:2] != [_major, _minor]:
        raise ImportError(f"{path} is version {version}, and this package is for "
                          f"{_interface.VERSION}; {_PIP}")
    return found


lib: Any = _open()

# ---- Documentation ------------------------------------------------------------------------------

Documented = TypeVar("Documented", bound=Callable[..., Any])


def documented(*names: str) -> Callable[[Documented], Documented]:
    """Adds what the C header says of these functions and types to a docstring."""

    def add(thing: Documented) -> Documented:
        parts = [thing.__doc__.strip()] if thing.__doc__ else []
        parts += [f"{name}:\n{_interface.DOCS[name]}" for name in names]
        thing.__doc__ = "\n\n".join(parts)
        return thing

    return add


# ---- Errors -------------------------------------------------------------------------------------


class Error(Exception):
    """What a call of the library could not do.

    file, line, column: where, from 1; line 0 without a place. field: the setting or parameter at
    fault, or "".
    """

    def __init__(self, message: str, file: str = "", line: int = 0, column: int = 0,
                 field: str = "") -> None:
        super().__init__(message)
        self.message, self.file, self.line, self.column = message, file, line, column
        self.field = field
        self.diagnostics: list[SimpleNamespace] = []  # all errors and warnings of a scene text

    def __str__(self) -> str:
        if self.line > 0:
            return f"{self.file}:{self.line}:{self.column}: {self.message}"
        if self.file and self.file not in self.message:
            return f"{self.file}: {self.message}"
        return self.message


class InputError(Error, ValueError):
    """A scene or a file is wrong."""


class UsageError(Error, ValueError):
    """An argument or a setting is out of its range."""


class DeviceError(Error, RuntimeError):
    """No OpenCL device, a kernel does not build, or a launch fails."""


class OutputError(Error):
    """A file could not be written."""


class OutOfMemoryError(Error, MemoryError):
    """Memory of the host or the device is exhausted, or a limit on it reached."""


class Cancelled(Error):
    """A progress callback asked to stop. film: what was rendered until then, or None."""

    film: Any = None


_ERRORS = {
    "RT_ERROR_INPUT": InputError,
    "RT_ERROR_USAGE": UsageError,
    "RT_ERROR_DEVICE": DeviceError,
    "RT_ERROR_OUTPUT": OutputError,
    "RT_ERROR_MEMORY": OutOfMemoryError,
    "RT_CANCELLED": Cancelled,
}


class RenderWarning(UserWarning):
    """A probable mistake that the library tells of."""


def text(pointer: Any) -> str:
    """A C string; "" for NULL."""
    return str(ffi.string(pointer).decode(errors="replace")) if pointer else ""


def nearest(wanted: str, names: Iterable[str]) -> str:
    """The name that a mistyped one probably meant, or ""."""
    search = ffi.new("rt_nearest *")
    kept = [ffi.new("char[]", os.fsencode(each)) for each in (wanted, *names)]
    lib.rt_nearest_begin(search, kept[0], len(kept[0]) - 1)
    for each in kept[1:]:
        lib.rt_nearest_offer(search, each, len(each) - 1)
    return os.fsdecode(ffi.string(search.best, search.best_length)) if search.best else ""


def did_you_mean(name: str) -> str:
    """The end of a message that names what was probably meant; nothing for ""."""
    return f"; did you mean '{name}'?" if name else ""


def _near_file(path: str) -> str:
    """The file, or else the folder, whose name is near to that of one that is not there."""
    if not path or os.path.lexists(path):
        return ""
    folder, name = os.path.split(path)
    while folder and not os.path.isdir(folder):
        folder, name = os.path.split(folder)
    try:
        near = nearest(name, os.listdir(folder or "."))
    except OSError:
        return ""
    return near and os.path.join(folder, near)


def expect(value: Any, kind: type, what: str, hint: str = "") -> None:
    """Refuses what is not of a class, and says what to do: "scene takes an object of Scene"."""
    if not isinstance(value, kind):
        raise TypeError(f"{what} takes an object of {kind.__name__}, not {value!r:.60}" +
                        (f"; {hint}" if hint else ""))


def call(function: Any, *arguments: Any) -> None:
    """Calls what returns rt_status and takes an rt_error last; raises what it fails with."""
    error = ffi.new("rt_error *")
    status = function(*arguments, error)
    if status != lib.RT_OK:
        kind = _ERRORS[ffi.typeof("rt_status").elements[status]]
        near = _near_file(text(error.file)) if kind is InputError and error.line == 0 else ""
        raise kind((text(error.message) or "cancelled") + did_you_mean(near), text(error.file),
                   error.line, error.column, text(error.field))


_alive: set[int] = set()


def _address(pointer: Any) -> int:
    return int(ffi.cast("uintptr_t", pointer))


def owned(pointer: Any, destroy: Any) -> Any:
    """The object behind a pointer, destroyed with its last user.

    The collector frees what is in a cycle in any order, as the interpreter does at its end; the
    library's objects hold each other, so that none is missed.
    """
    address, alive = _address(pointer), _alive

    def end(it: Any) -> None:
        alive.discard(address)
        destroy(it)

    alive.add(address)
    return ffi.gc(pointer, end)


def make(type_name: str, destroy: Any, function: Any, *arguments: Any) -> Any:
    """The object that a call writes to *out, owned."""
    out = ffi.new(f"{type_name} **")
    call(function, out, *arguments)
    return owned(out[0], destroy)


class Owned:
    """An attribute that holds what `owned` returns. A finalizer may meet it, in a cycle or at the
    interpreter's end, when it is destroyed already: that is an error, not a crash."""

    def __set_name__(self, _owner: type, name: str) -> None:
        self._name = name

    def __set__(self, instance: Any, pointer: Any) -> None:
        instance.__dict__[self._name] = pointer

    def __get__(self, instance: Any, owner: type) -> Any:
        pointer = instance.__dict__[self._name]
        if _address(pointer) not in _alive:
            raise ReferenceError(f"this {owner.__name__} is destroyed")
        return pointer


class Exclusive:
    """A lock on a device, which serves one thread at a time, of the process that opened it."""

    _process = 0

    def __init__(self, what: str) -> None:
        self._lock, self._what = threading.Lock(), what
        Exclusive._process = Exclusive._process or os.getpid()
        self._refuse_fork()
        self._owner: Optional[int] = None
        self._due: deque[Callable[[], object]] = deque()

    @staticmethod
    def _refuse_fork() -> None:
        if Exclusive._process != os.getpid():
            raise RuntimeError("the threads of an OpenCL driver do not survive a fork: use the "
                               "start method spawn of multiprocessing")

    def __enter__(self) -> None:
        if self._owner == threading.get_ident():
            raise RuntimeError(f"a callback of a call cannot use its {self._what}")
        self._refuse_fork()
        self._lock.acquire()
        self._owner = threading.get_ident()

    def __exit__(self, *_: Any) -> None:
        self._owner = None
        self._lock.release()
        self._run_due()

    def soon(self, act: Callable[[], object]) -> None:
        """Runs it when nobody has the lock: now, or as who has it leaves. Never waits, since the
        collector may call from any thread, and within any call."""
        self._due.append(act)
        self._run_due()

    def _run_due(self) -> None:
        while self._due and self._lock.acquire(blocking=False):
            try:
                while self._due:
                    self._due.popleft()()
            finally:
                self._lock.release()


# ---- Callbacks ----------------------------------------------------------------------------------

Progress = Callable[[SimpleNamespace], Optional[bool]]


def _keep(_kind: Any, error: BaseException, trace: Any) -> None:
    """Keeps what a callback raises, as Ctrl-C does on entering one: the call that this one belongs
    to ends, and raises it again."""
    hooks = ffi.from_handle(trace.tb_frame.f_locals["user"])
    hooks.raised = hooks.raised or error


def callback(kind: str, on_error: Optional[int] = None) -> Callable[[Documented], Documented]:
    """ffi.callback with a type, and what it returns when it raises."""
    made: Callable[[Documented], Documented] = ffi.callback(kind, error=on_error, onerror=_keep)
    return made


@callback("int(void *, const rt_progress *)", 1)
def _on_progress(user: Any, progress: Any) -> int:
    hooks = ffi.from_handle(user)
    return 1 if hooks.raised or hooks.is_over() or (
        hooks.progress and hooks.progress(hooks.describe(progress))) else 0


@callback("void(void *, const char *)")
def _on_log(user: Any, line: Any) -> None:
    _log.info("%s", text(line))


@callback("void(void *, const char *)")
def _on_warning(user: Any, line: Any) -> None:
    ffi.from_handle(user).warnings.append(text(line))


class Hooks:
    """The callbacks of one call: `with Hooks(progress) as hooks: call(..., hooks.pointer, ...)`.

    There is a progress callback always, so that Ctrl-C is noticed within a second. What a callback
    raises ends the call and is raised by it; warnings are Python's. Callbacks need the interpreter:
    at its end the calls of daemon threads, and these threads, end first.
    """

    _running: set["Hooks"] = set()
    _is_ending = False

    def __init__(self, progress: Optional[Progress], stacklevel: int = 3) -> None:
        self.progress = progress
        self.raised: Optional[BaseException] = None
        self.warnings: list[str] = []
        self._level = stacklevel
        self._is_main = threading.current_thread() is threading.main_thread()
        self._handle = ffi.new_handle(self)
        self.pointer = ffi.new("rt_hooks *", {
            "progress": _on_progress, "log": _on_log, "warning": _on_warning,
            "user": self._handle})

    @staticmethod
    def describe(progress: Any) -> SimpleNamespace:
        """An rt_progress; what is unknown is None."""
        seen = record(progress)
        seen.stage = text(lib.rt_stage_name(progress.stage))
        seen.remaining = seen.remaining if seen.remaining >= 0 else None
        seen.error = seen.error if seen.error >= 0 else None
        return seen

    def is_over(self) -> bool:
        """Whether the interpreter ends, and the call is that of a thread that it does not await."""
        return Hooks._is_ending and not self._is_main

    @staticmethod
    @atexit.register
    def _end() -> None:
        Hooks._is_ending = True
        while Hooks._running:
            time.sleep(0.001)

    def __enter__(self) -> "Hooks":
        self._running.add(self)
        if self.is_over():
            self._running.remove(self)
            raise SystemExit
        return self

    def __exit__(self, kind: Any, value: Any, trace: Any) -> None:
        self._running.remove(self)
        if self.is_over():
            raise SystemExit from None
        for line in self.warnings:
            warnings.warn(line, RenderWarning, stacklevel=self._level)
        raised, self.raised = self.raised, None
        try:
            if raised is not None:
                raise raised from None
        finally:
            del raised  # else it would hold itself, and the film, until the collector comes


# ---- Data ---------------------------------------------------------------------------------------

Numbers = Union[float, Sequence[float], NDArray[Any]]

_COLOURS = frozenset("kd ks kt emission eta k absorption scattering radiance power intensity "
                     "irradiance a b".split())
# The method of Scene that makes what a handle stands for, by the end of the member's name.
_MAKERS = {"material": "material", "texture": "texture", "density": "grid", "albedo": "grid",
           "mesh": "mesh"}


def fill(struct: Any, values: Mapping[str, Any], what: str) -> list[Any]:
    """Sets members of a struct by name; returns what has to live as long as it.

    An enum takes the words of the scene language, a colour one number for grey.
    """
    members = dict(ffi.typeof(struct).item.fields)
    kept: list[Any] = []
    for name, value in values.items():
        if name not in members:
            raise TypeError(f"{what} has no '{name}', but {', '.join(members)}" +
                            did_you_mean(nearest(name, members)))
        if value is None:
            continue
        kind = members[name].type
        if kind.kind == "array":
            setattr(struct, name, numbers_of(value, kind.length, f"{name} of {what}",
                                             name in _COLOURS))
        elif _enum_of(kind) in WORDS:
            setattr(struct, name, word_value(_enum_of(kind), value, name))
        elif kind.kind == "pointer" and isinstance(value, (str, os.PathLike)):
            kept.append(ffi.new("char[]", os.fsencode(value)))
            setattr(struct, name, kept[-1])
        else:
            try:
                setattr(struct, name, value)
            except (TypeError, OverflowError):
                maker = _MAKERS.get(name.split("_")[-1])
                takes = (f"what Scene.{maker} returned" if maker
                         else "a whole number" if kind.cname not in ("float", "double")
                         else "a number")
                raise TypeError(f"{name} of {what} takes {takes}, not {value!r:.60}") from None
    return kept


def numbers_of(value: Any, length: int, what: str, is_colour: bool = False) -> list[float]:
    """The values of an array in C."""
    try:
        numbers = np.asarray(value, dtype=np.float64)
    except (TypeError, ValueError):
        raise TypeError(f"{what} takes {length} numbers, not {value!r:.60}") from None
    if numbers.ndim == 0 and is_colour:
        numbers = np.full(length, numbers)
    if numbers.shape != (length,):
        raise ValueError(f"{what} takes {length} numbers, not {value!r:.60}")
    return list(numbers.tolist())


def warn_lacking(lacks: Any, struct: Any, given: Mapping[str, Any], what: str,
                 level: int = 3) -> None:
    """Warns of given members without effect, by a function such as rt_material_lacks; level: that
    of the caller's caller, from 1."""
    for name in (name for name, value in given.items() if value is not None):
        field = "file" if name == "path" else name
        missing = lacks(struct, field.encode())
        if missing != ffi.NULL:
            warnings.warn(f"'{name}' of {what} has no effect without {text(missing)}",
                          RenderWarning, stacklevel=level)


def _enum_of(kind: Any) -> str:
    return str(kind.cname).replace("enum ", "")


def word_value(enum: str, word: str, name: str) -> int:
    """The value of an enum's word."""
    words = WORDS[enum]
    if word not in words:
        raise ValueError(f"{name} is one of {', '.join(words)}, not {word!r}" +
                         did_you_mean(nearest(str(word), words)))
    return int(getattr(lib, words[word]))


def _python(value: Any, kind: Any) -> Any:
    if kind.kind == "enum":
        for word, constant in WORDS.get(_enum_of(kind), {}).items():
            if kind.relements.get(constant) == value:
                return word
        return value
    if kind.kind == "struct":
        return record(value)
    if kind.kind == "pointer":
        return text(value) if kind.item.cname == "char" else None
    if kind.kind == "array" and kind.item.kind == "array":
        return [_python(row, kind.item) for row in value]
    if kind.kind == "array":
        return text(value) if kind.item.cname == "char" else np.array(list(value))
    return value


def record(struct: Any) -> SimpleNamespace:
    """A struct by value: its members with their names in C; enums by their words."""
    kind = ffi.typeof(struct)
    kind = kind.item if kind.kind == "pointer" else kind
    return SimpleNamespace(
        **{name: _python(getattr(struct, name), member.type) for name, member in kind.fields})


def dtype(type_name: str) -> np.dtype[Any]:
    """The NumPy type with the layout of a struct."""
    return _dtype_of(ffi.typeof(type_name))


def _dtype_of(kind: Any) -> np.dtype[Any]:
    if kind.kind == "struct":
        members = kind.fields
        return np.dtype({
            "names": [name for name, _ in members],
            "formats": [_dtype_of(member.type) for _, member in members],
            "offsets": [member.offset for _, member in members],
            "itemsize": ffi.sizeof(kind)})
    if kind.kind == "array":
        return np.dtype((_dtype_of(kind.item), (kind.length,)))
    letter = "f" if kind.cname in ("float", "double") else "i" if (
        kind.kind == "enum" or kind.cname.startswith("int")) else "u"
    return np.dtype(f"{letter}{ffi.sizeof(kind)}")


class _Memory:
    """Memory of an owner, for NumPy: an array over it keeps the owner alive."""

    def __init__(self, owner: Any, pointer: Any, shape: tuple[int, ...], kind: np.dtype[Any]):
        self.owner = owner
        self.__array_interface__ = {
            "version": 3, "shape": shape, "typestr": kind.str, "descr": kind.descr,
            "data": (int(ffi.cast("uintptr_t", pointer)), True)}


def view(owner: Any, pointer: Any, shape: tuple[int, ...], kind: Any) -> NDArray[Any]:
    """Memory of the library as an array that cannot be written to, without a copy."""
    kind = np.dtype(kind)
    if 0 in shape:
        return np.zeros(shape, kind)
    plain = kind if kind.names is None else np.dtype(f"V{kind.itemsize}")
    return np.asarray(_Memory(owner, pointer, shape, plain)).view(kind)


def floats(values: ArrayLike, columns: int, name: str) -> NDArray[np.float32]:
    """An array [n][columns] of floats, copied only where it is none."""
    array = np.ascontiguousarray(values, dtype=np.float32)
    if array.ndim != 2 or array.shape[1] != columns:
        raise ValueError(f"{name} is an array of shape (n, {columns}), not {array.shape}")
    return array


def pointer(array: Optional[NDArray[Any]], kind: str = "float *") -> Any:
    """A pointer to an array's memory; NULL for None."""
    return ffi.NULL if array is None else ffi.cast(kind, ffi.from_buffer(array))


def path_bytes(path: Union[str, os.PathLike[str]]) -> bytes:
    """A path as C takes it."""
    name = os.fsencode(path)
    if b"\0" in name:
        raise ValueError(f"{path!r:.60}: a path has no zero byte")
    return name
