"""The settings of a render, from the library's table of them."""
from __future__ import annotations

import warnings
from typing import Any, Iterable, Iterator, Optional, Union

from ._library import (RenderWarning, UsageError, call, did_you_mean, documented, expect, ffi, lib,
                       nearest, text)

Value = Union[str, int, float, bool]

_SIZE = 512  # of a value or a help text


def _table() -> dict[str, Any]:
    count = ffi.new("size_t *")
    settings = lib.rt_settings(count)
    return {text(settings[i].field.name): settings + i for i in range(count[0])}


_SETTINGS = _table()


def _text_of(value: Value) -> str:
    if isinstance(value, bool):
        return "true" if value else "false"
    if isinstance(value, float) and value.is_integer() and abs(value) < 1e15:
        return str(int(value))
    return repr(value) if isinstance(value, float) else str(value)


def _words(setting: Any) -> Iterator[str]:
    """The words that a setting takes, if any."""
    word = lib.rt_field_words(ffi.addressof(setting[0], "field"))
    while word != ffi.NULL and word.name != ffi.NULL:
        yield text(word.name)
        word += 1


@documented("rt_render_options")
class Options:
    """The settings of a render, by name: Options(mode="photon", k=50)["radius"] = 0.1.

    Values are what the scene language takes: numbers, words such as "photon", booleans. A scene
    has options of its own, Scene.options; settings given to a call change a copy of them.
    """

    def __init__(self, base: Optional["Options"] = None,
                 **settings: Optional[Value]) -> None:
        self._c = ffi.new("rt_render_options *")
        if base is not None:
            expect(base, Options, "options", "settings are given by name, as spp=16")
            self._c[0] = base._c[0]
        self.update(**settings)

    def update(self, **settings: Optional[Value]) -> None:
        """Sets several; None leaves one as it is."""
        for name, value in settings.items():
            if value is None:
                self._find(name)
            else:
                self[name] = value

    @staticmethod
    def _find(name: str) -> Any:
        setting = lib.rt_setting_find(name.encode())
        if setting == ffi.NULL:
            raise TypeError(f"there is no setting '{name}'" +
                            did_you_mean(nearest(name, _SETTINGS)))
        return setting

    def __setitem__(self, name: str, value: Value) -> None:
        setting = self._find(name)
        try:
            call(lib.rt_setting_set, self._c, setting, _text_of(value).encode())
        except UsageError as error:
            near = nearest(_text_of(value), _words(setting))
            raise UsageError(error.message + did_you_mean(near), field=error.field) from None

    def __getitem__(self, name: str) -> Value:
        setting = self._find(name)
        buffer = ffi.new("char[]", _SIZE)
        word = text(lib.rt_setting_get(buffer, _SIZE, setting, self._c))
        kind = setting.field.type
        if kind == lib.RT_FIELD_BOOLEAN:
            return word == "true"
        if kind in (lib.RT_FIELD_INTEGER, lib.RT_FIELD_COUNT) and word.isdigit():
            return int(word)
        return lib.rt_setting_value(setting, self._c) if kind == lib.RT_FIELD_NUMBER else word

    def __iter__(self) -> Iterator[str]:
        return iter(_SETTINGS)

    def keys(self) -> list[str]:
        """The names of all settings."""
        return list(_SETTINGS)

    def warn_lacking(self, names: Iterable[str], level: int = 3) -> None:
        """Warns of those settings that have no effect beside the others; level: that of the
        caller's caller, from 1."""
        for name in names:
            need = lib.rt_setting_missing(self._find(name), self._c)
            if need != ffi.NULL and self[name] is not False:
                out = ffi.new("char[]", _SIZE)
                otherwise = text(lib.rt_setting_text(out, _SIZE, need.otherwise,
                                                     lib.RT_NAME_QUOTED))
                warnings.warn(f"'{name}' has no effect {otherwise}", RenderWarning,
                              stacklevel=level)

    def __repr__(self) -> str:
        return f"Options({', '.join(f'{name}={self[name]!r}' for name in self)})"

    @staticmethod
    def help(name: str) -> str:
        """What a setting means, what it takes, and its default."""
        setting = Options._find(name)
        out, phrase = ffi.new("char[]", 4 * _SIZE), ffi.new("char[]", _SIZE)
        told = text(lib.rt_setting_text(out, 4 * _SIZE, setting.field.help, lib.RT_NAME_QUOTED))
        takes = text(lib.rt_setting_phrase(phrase, _SIZE, setting))
        unit = text(setting.field.unit)
        fallback = text(lib.rt_setting_text(out, 4 * _SIZE, setting.field.fallback,
                                            lib.RT_NAME_QUOTED))
        return (f"{told}; takes {takes}" + (f", {unit}" if unit else "") +
                f"; default: {fallback}")

    def _repr_html_(self) -> str:
        from html import escape
        rows = "".join(f"<tr><td>{escape(name)}</td><td>{escape(str(self[name]))}</td>"
                       f"<td style='text-align:left'>{escape(self.help(name))}</td></tr>"
                       for name in self)
        return f"<table><tr><th>setting</th><th>value</th><th>meaning</th></tr>{rows}</table>"
