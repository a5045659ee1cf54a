"""Settings of the linter: ``[tool.axcomp]`` of a ``pyproject.toml`` or an ``axcomp.toml``, found upwards."""

from __future__ import annotations

import os
import tomllib
from collections.abc import Iterable, Mapping
from dataclasses import dataclass, field, fields
from pathlib import Path
from typing import Any, get_args

from ..kinds import Severity
from ..lists import CODES, TypeName


class SettingsError(ValueError):
    """A setting that cannot be followed, in one sentence."""


@dataclass(frozen=True)
class Settings:
    """What is asked of the linter; names in a file have ``-`` for ``_``.

    Attributes
    ----------
    select, ignore : tuple of str
        Codes of findings, or what they begin with; ``ALL`` stands for every one.
    per_file_ignores : mapping of str to tuple of str
        The same for files that match a pattern, which is relative to ``folder``.
    exclude : tuple of str
        Patterns of files and folders that are not looked at, where folders are searched.
    fail_on : str
        Severity from which on findings make the exit status 1.
    format : str
        Of what is printed; "": text.
    baseline : str
        File of findings that are known, relative to ``folder``; "" if there is none.
    axis_type : str or None
        As ``read_machine`` takes it.
    help_address : str
        Address of the page of findings; "": of the installed one.
    folder : Path
        Where the settings stand.
    allow_outside : tuple of Path
        As ``read_machine`` takes it; in no file, which may be a stranger's as the lists are.
    """

    select: tuple[str, ...] = ("ALL",)
    ignore: tuple[str, ...] = ()
    per_file_ignores: Mapping[str, tuple[str, ...]] = field(default_factory=dict)
    exclude: tuple[str, ...] = ()
    fail_on: str = "error"
    format: str = ""
    baseline: str = ""
    axis_type: TypeName | None = None
    help_address: str = ""
    folder: Path = Path()
    allow_outside: tuple[Path, ...] = ()

    def __post_init__(self) -> None:
        check_codes((*self.select, *self.ignore, *(code for codes in self.per_file_ignores.values() for code in codes)))


def check_codes(codes: Iterable[str]) -> None:
    """Refuse what is neither a code nor the beginning of one."""
    for code in codes:
        if code != "ALL" and not (code and any(known.startswith(code) for known in CODES)):
            raise SettingsError(f"{code!r} is no code of a finding, and none begins so")


_CHOICES = {
    "fail_on": tuple(severity.value for severity in Severity),
    "format": ("text", "json", "sarif", "junit", "github", "gitlab"),
    "axis_type": get_args(TypeName),
}
_LISTS = ("select", "ignore", "exclude")
_NAMES = {
    one.name.replace("_", "-"): one.name for one in fields(Settings) if one.name not in ("folder", "allow_outside")
}


def find_settings(start: Path) -> Settings:
    """Return the settings for a path: of the nearest file above it that has some; SettingsError if they are wrong."""
    start = start.absolute()
    for above in (start, *start.parents):
        for name in ("axcomp.toml", "pyproject.toml"):
            if os.path.isfile(above / name):  # noqa: PTH113 - a path may be one that cannot be
                found = _read(above / name)
                if found is not None:
                    return found
    return Settings()


def _read(path: Path) -> Settings | None:
    try:
        table = tomllib.loads(path.read_text(encoding="utf-8"))
    except (OSError, tomllib.TOMLDecodeError, UnicodeDecodeError) as error:
        raise SettingsError(f"{path}: {error}") from None
    if path.name == "pyproject.toml":
        tool = table.get("tool", {})
        if not isinstance(tool, dict) or "axcomp" not in tool:
            return None
        table = tool["axcomp"]
    try:
        if not isinstance(table, dict):
            raise SettingsError("tool.axcomp is no table")
        return Settings(
            **{_NAMES[name]: _value(name, value) for name, value in table.items() if _known(name)}, folder=path.parent
        )
    except SettingsError as error:
        raise SettingsError(f"{path}: {error}") from None


def _known(name: str) -> bool:
    if name not in _NAMES:
        raise SettingsError(f"there is no setting {name!r}; there are {', '.join(_NAMES)}")
    return True


def _value(name: str, value: Any) -> Any:
    key = _NAMES[name]
    if key == "per_file_ignores":
        if not isinstance(value, dict):
            raise SettingsError(f"{name} must be a table of patterns and codes")
        return {pattern: _strings(f"{name}.{pattern}", codes) for pattern, codes in value.items()}
    if key in _LISTS:
        return _strings(name, value)
    if not isinstance(value, str):
        raise SettingsError(f"{name} must be a string")
    if key in _CHOICES and value not in _CHOICES[key]:
        raise SettingsError(f"{name} = {value!r} is none of {', '.join(_CHOICES[key])}")
    return value


def _strings(name: str, value: Any) -> tuple[str, ...]:
    if not isinstance(value, list) or not all(isinstance(one, str) for one in value):
        raise SettingsError(f"{name} must be a list of strings")
    return tuple(value)


def relative(path: str, folder: Path) -> str:
    """Return a path as seen from a folder, with ``/`` between its parts; as it is where that cannot be said."""
    try:
        return Path(os.path.relpath(path, folder)).as_posix()
    except ValueError:
        return path
