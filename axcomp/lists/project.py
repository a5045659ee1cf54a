"""TwinCAT project files (``*.tsproj``, ``*.xti``): the lists of a machine stand in elements, as CDATA.

``AchsMds`` is the axis list of a CNC axis, ``SdaMds`` the list of a channel, which is no business of compensation.
Other lists are recognized by what they say. A list belongs to the axis whose element it stands in. Written back, every
byte outside of the list stays as it is.
"""

from __future__ import annotations

import re
from pathlib import Path
from typing import NamedTuple
from xml.parsers.expat import ErrorString, ExpatError, ParserCreate

from ..kinds import ListKind, key_of
from ..saving import write_whole
from .catalogue import SPELLINGS
from .document import Document
from .findings import Findings
from .recognition import kind_of

_SUFFIXES = {".tsproj", ".xti", ".tsm", ".xml"}
_ELEMENTS = {"achsmds": ListKind.AXIS, "sdamds": None, "nullpd": None, "werkzd": None, "pzvd": None, "ved": None}
"""Elements of which it is known what they hold; None: nothing about compensations."""

_OPENING = "<![CDATA["
_ENTRY = re.compile(r"^[^\S\n]*([^\W0-9][\w.]*(?:\[[0-9 ]*\][\w.]*)*)[^\S\n]+[^\s:;=]", re.M)
_ID = ("Id", "AxisId", "ItemId")


class _Place(NamedTuple):
    """A CDATA section: its elements from the root (number, name, id), its bytes, and where its text begins."""

    path: tuple[tuple[int, str, str], ...]
    start: int
    end: int
    line: int
    column: int


class Section(Document):
    """A list that stands in a project file.

    Attributes
    ----------
    project : Project
    axis_number : int
        Of the axis it belongs to, as the project tells it; 0: it does not.
    """

    def __init__(self, project: Project, name: str, place: _Place, text: str, kind: ListKind) -> None:
        super().__init__(f"{project.path}#{name}", text.encode(), kind)
        self.project = project
        self.place = place
        self.outer = (project.path, place.line - 1, place.column)
        self.axis_number = 0

    def copy(self) -> Section:
        """Return a section to be edited on its own."""
        other = Section(self.project, self.path.name.rpartition("#")[2], self.place, self.data.decode(), self._kind())
        other.axis_number = self.axis_number
        if self._lines is not None:
            other._lines, other._newlines = list(self._lines), list(self._newlines)
        return other

    def save(self) -> None:
        """Write the project file with this list in it; ValueError if it cannot stand there."""
        data = self.to_bytes()
        if data != self.data:
            self.project.put(self, data.decode())
            self.data = data


class Project(Document):
    """A project file with its lists, in their order.

    Attributes
    ----------
    sections : list of Section
    fault : str
        Why it is none; "" if it is one.
    """

    def __init__(self, path: Path, data: bytes) -> None:
        super().__init__(path, data)
        self.fault = ""
        self.fault_line = 0
        self._codec = self.encoding.name
        self.sections: list[Section] = []
        places = self._places()
        names: dict[str, int] = {}
        for place in places:
            text = self.data[place.start : place.end].decode(self._codec)
            element = place.path[-1][1] if place.path else ""
            kind = _kind(element, text)
            if kind is not None:
                names[element] = names.get(element, 0) + 1
                self.sections.append(Section(self, f"{element}{names[element]}", place, text, kind))
        self._number()

    def of_kind(self, kind: ListKind) -> list[Section]:
        """Return the lists of a kind."""
        return [section for section in self.sections if section.kind is kind]

    def put(self, section: Section, text: str) -> None:
        """Write the file with another text of a list; ValueError if it cannot stand there, OSError if that fails."""
        if "]]>" in text:
            raise ValueError(f"{section.path}: ]]> cannot stand in a list of a project file")
        try:
            new = text.encode(self._codec)
        except UnicodeEncodeError as error:
            raise ValueError(
                f"{section.path}: {error.object[error.start]!r} is not in the encoding of the file"
            ) from None
        start, end = section.place.start, section.place.end
        self.data = self.data[:start] + new + self.data[end:]
        write_whole(self.path, self.data)
        grown, lines = len(new) - (end - start), text.count("\n") - section.text.count("\n")
        for other in self.sections:
            place = other.place
            if place.start == start:
                other.place = place._replace(end=end + grown)
            elif place.start > start:
                other.place = place._replace(start=place.start + grown, end=place.end + grown, line=place.line + lines)
                other.outer = (self.path, other.place.line - 1, place.column)
        section.place = section.place._replace(end=start + len(new))

    def _places(self) -> list[_Place]:
        parser = ParserCreate()
        found: list[_Place] = []
        path: list[tuple[int, str, str]] = []
        opened: list[tuple[int, int, int]] = []
        count = 0

        def begin(name: str, attributes: dict[str, str]) -> None:
            nonlocal count
            count += 1
            path.append((count, name, next((attributes[one] for one in _ID if one in attributes), "")))

        def open_section() -> None:
            opened.append((parser.CurrentByteIndex, parser.CurrentLineNumber, parser.CurrentColumnNumber))

        def close_section() -> None:
            index, line, column = opened.pop()
            width = 2 if self._codec.startswith("utf-16") else 1
            start = index + width * len(_OPENING)
            found.append(_Place(tuple(path), start, parser.CurrentByteIndex, line, column + len(_OPENING)))

        def declared(_version: str, encoding: str | None, _alone: int) -> None:
            if encoding and not self._codec.startswith("utf-16"):
                self._codec = encoding

        parser.StartElementHandler = begin
        parser.EndElementHandler = lambda _name: path.pop()
        parser.StartCdataSectionHandler = open_section
        parser.EndCdataSectionHandler = close_section
        parser.XmlDeclHandler = declared
        try:
            parser.Parse(self.data, True)
            for place in found:
                self.data[place.start : place.end].decode(self._codec)
        except (ExpatError, LookupError, ValueError) as error:
            self.fault = ErrorString(error.code) if isinstance(error, ExpatError) else str(error)
            self.fault_line = error.lineno if isinstance(error, ExpatError) else 0
            return []
        return found

    def _number(self) -> None:
        """Give every list the number of its axis: as the axis list says, else the id of the element, else its place."""
        axes = self.of_kind(ListKind.AXIS)
        for place, axis in enumerate(axes, 1):
            ids = [id_ for _, _, id_ in axis.place.path if id_.isdigit()]
            axis.axis_number = _own_number(axis) or int(ids[-1] if ids else place)
        for section in self.of_kind(ListKind.COMPENSATION):
            own = {number for number, _, _ in section.place.path}
            for number, _, _ in reversed(section.place.path):
                inside = [axis for axis in axes if any(number == one for one, _, _ in axis.place.path)]
                if inside:
                    section.axis_number = inside[0].axis_number if len(inside) == 1 and number in own else 0
                    break


def is_project(path: Path) -> bool:
    """Tell whether a file is a project that holds lists of axes."""
    if path.suffix.lower() not in _SUFFIXES:
        return False
    try:
        data = path.read_bytes() if path.is_file() else b""
    except OSError:
        return False
    plain = data.replace(b"\0", b"").lower()
    return b"<![cdata[" in plain and (b"<achsmds" in plain or b"kopf.achs_nr" in plain)


def looks_like_project(document: Document) -> bool:
    """Tell whether a text is XML."""
    return document.text.lstrip("\ufeff \t\r\n").startswith("<") and "<![CDATA[" in document.text


def _own_number(section: Section) -> int:
    cells = section.read_as(ListKind.AXIS, Findings()).cells("kopf.achs_nr")
    return int(cells[()][0]) if () in cells else 0


def _kind(element: str, text: str) -> ListKind | None:
    """Return what list stands in an element; None for code, pictures and lists that have nothing to do with it."""
    if element.lower() in _ELEMENTS:
        return _ELEMENTS[element.lower()]
    keys = {key_of(name) for name in _ENTRY.findall(text)}
    own = {kind: {key for key in keys if key in SPELLINGS[kind] and ("." in key or "[" in key)} for kind in ListKind}
    if not any(found - {"kopf.achs_nr", "kopf.log_achs_name"} for found in own.values()):
        return None
    return kind_of("", text)
