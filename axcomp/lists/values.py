"""The plausible values of one list: entries looked up in the catalogue, checked, and defaults where they fail."""

from __future__ import annotations

from collections.abc import Sequence
from decimal import Decimal

from ..kinds import METRIC, DataType, Gear, ListKind, Parameter, Severity, Value, convert, key_of
from .catalogue import SPELLINGS, ZEROED, parameter
from .column import Column, Indices, Run
from .findings import CODES, Findings
from .grammar import Entry, entries, flags, number, string
from .known import is_known, similar
from .stretches import Stretch

_SUGGESTIONS_MAX = 500


class ListValues:
    """What one list says, by parameter; where it is silent, ``fallback`` speaks, else the default.

    Attributes
    ----------
    file : str
        Name for findings.
    kind : ListKind
        What decides which parameters there are.
    foreign : dict of ListKind to int
        Unknown entries that another kind of list has, by that kind.
    others : int
        Entries that have nothing to do with compensation.
    """

    def __init__(self, file: str, kind: ListKind, fallback: ListValues | None = None) -> None:
        self.file = file
        self.kind = kind
        self._fallback = fallback
        self._columns: dict[str, Column] = {}
        self.foreign: dict[ListKind, int] = {}
        self.others = 0

    @property
    def looks_like(self) -> ListKind | None:
        """Another kind of list, where only the header would make sense as this one."""
        own = any(not key.startswith("kopf.") for key in self._columns)
        return None if own or not self.foreign else max(self.foreign, key=self.foreign.__getitem__)

    def __bool__(self) -> bool:
        """Whether the list has an entry at all."""
        return bool(self._columns)

    def column(self, parameter: Parameter) -> Column:
        """Return the values of a parameter, to be filled."""
        return self._columns.setdefault(parameter.key, Column(parameter))

    def cells(self, name: str) -> dict[Indices, tuple[Value, int]]:
        """Return indices → (value, line) of all that is given for a parameter."""
        column = self._columns.get(key_of(name))
        return {} if column is None else column.cells

    def count(self, name: str) -> int:
        """Return how many entries are given for a parameter."""
        return len(self._columns.get(key_of(name), ()))

    def filled(self, name: str, counts: Sequence[int]) -> list[int] | None:
        """Return the values of a table if they stand in regular stretches and are all there, none beyond ``counts``."""
        column = self._columns.get(key_of(name))
        return None if column is None else column.filled(counts)

    def given(self, name: str, *indices: int) -> bool:
        """Whether an entry is there."""
        return indices in self.cells(name)

    def spelt(self, name: str) -> bool:
        """Whether a parameter is given by this very name."""
        return any(key_of(name) in column.spellings for column in self._columns.values())

    def place(self, name: str, *indices: int) -> tuple[str, int]:
        """Return file and line of an entry, line 0 where it is missing."""
        cell = self.cells(name).get(indices)
        if cell is not None:
            return self.file, cell[1]
        return (self.file, 0) if self._fallback is None else self._fallback.place(name, *indices)

    def line(self, name: str, *indices: int) -> int:
        """Return the line of an entry, 0 where it is missing."""
        return self.place(name, *indices)[1]

    def value(self, name: str, *indices: int) -> Value:
        """Return a plausible value as it stands in the list."""
        cell = self.cells(name).get(indices)
        if cell is not None:
            return cell[0]
        return parameter(self.kind, name).default if self._fallback is None else self._fallback.value(name, *indices)

    def number(self, name: str, *indices: int) -> int | Decimal:
        """Return a number in the unit of the list."""
        value = self.value(name, *indices)
        return value if isinstance(value, Decimal) else int(value)

    def integer(self, name: str, *indices: int) -> int:
        """Return a count, index, axis number or number of cycles."""
        return int(self.value(name, *indices))

    def flag(self, name: str) -> bool:
        """Return a Boolean."""
        return bool(self.value(name))

    def text(self, name: str, *indices: int) -> str:
        """Return a string, "" where there is none."""
        return str(self.value(name, *indices))

    def converted(self, name: str, *indices: int, gear: Gear = METRIC) -> float:
        """Return a number in mm, °, mm/s, °/s or as a factor."""
        return convert(self.number(name, *indices), parameter(self.kind, name).quantity.divisor, gear)


def read_values(
    text: str, file: str, kind: ListKind, findings: Findings, fallback: ListValues | None = None
) -> ListValues:
    """Return the plausible values of a list; what is not plausible is noted and replaced by its default."""
    values = ListValues(file, kind, fallback)
    reader = _ValueReader(values, findings)
    columns: dict[str, Column | None] = {}

    def take(stretch: Stretch) -> bool:
        for place, key in enumerate(stretch.keys):
            if key not in columns:
                columns[key] = reader.column(Entry(key, (), "", "", stretch.line + place))
        return _take_stretch(stretch, [columns[key] for key in stretch.keys])

    for entry in entries(text, reader.report, take):
        key, indices, integer, _, line = entry
        try:
            column = columns[key]
        except KeyError:
            column = columns[key] = reader.column(entry)
        if column is None:
            reader.report_unknown(entry)
        elif integer and column.quick:
            # Nearly every line of a long table goes this way: an integer, checked and kept.
            value = int(integer)
            cells = column.cells
            if indices not in cells and column.low <= value <= column.high:
                cells[indices] = (value, line)
            else:
                reader.take(column, entry)
        else:
            reader.take(column, entry)
    reader.finish()
    return values


def _take_stretch(stretch: Stretch, columns: Sequence[Column | None]) -> bool:
    """Put a stretch into its columns; False: something about it is to be noted."""
    if len({id(column) for column in columns}) < len(columns):
        return False
    pairs = list(zip(columns, stretch.columns, strict=True))
    if not all(
        column is not None and column.has_room(stretch.fixed, stretch.first, values) for column, values in pairs
    ):
        return False
    for place, (column, values) in enumerate(pairs):
        assert column is not None
        column.add(stretch.fixed, Run(stretch.first, values, stretch.line + place, len(pairs)))
    return True


class _ValueReader:
    """Looks entries up and checks their values, away from the fast path."""

    def __init__(self, values: ListValues, findings: Findings) -> None:
        self._values = values
        self._findings = findings
        self._unknown: dict[str, str] = {}

    def report(self, code: str, line: int, text: str) -> None:
        """Note a line that is no entry."""
        shown = text if len(text) <= 40 else f"{text[:40]}…"
        sentence = {
            "AXC-ELISION": f"“{shown}” stands for entries left out; nothing is taken for it.",
            "AXC-END": "Nothing after End is read.",
        }.get(code, f"“{shown}” is neither an entry nor a comment; it is not taken.")
        self._findings.add(code, self._values.file, line, "", sentence)

    def column(self, entry: Entry) -> Column | None:
        """Return where an entry's values go, None if the list has no such parameter."""
        key = entry.key.lower()
        spelling = SPELLINGS[self._values.kind].get(key)
        if spelling is None:
            self._count_foreign(key)
            if not is_known(self._values.kind, key):
                few = len(self._unknown) < _SUGGESTIONS_MAX
                self._unknown[entry.key] = similar(self._values.kind, key) if few else ""
            return None
        if spelling.typo:
            right = spelling.parameter.name
            self._note("AXC-TYPO", entry, f"{entry.key} is read as {right}, which is the usual spelling.")
        column = self._values.column(spelling.parameter)
        column.spellings.add(key)
        return column

    def _count_foreign(self, key: str) -> None:
        for kind, spellings in SPELLINGS.items():
            if key in spellings:
                self._values.foreign[kind] = self._values.foreign.get(kind, 0) + 1

    def report_unknown(self, entry: Entry) -> None:
        """Note an entry that is not in the catalogue; one that looks like a slip is not lost among strangers."""
        meant = self._unknown.get(entry.key)
        if meant is None:
            self._values.others += 1
            return
        hint = f"; {meant} may be meant" if meant else ""
        message = f"{entry.name} is not known in this list{hint}; it is not taken."
        self._note("AXC-UNKNOWN", entry, message, "similar to known ones" if meant else "")

    def finish(self) -> None:
        """Note in one sentence what has nothing to do with compensation."""
        if count := self._values.others:
            entries_are = "entry is" if count == 1 else "entries are"
            message = f"{count:,} {entries_are} known, but without effect on compensations; not used."
            self._findings.add("AXC-OTHERS", self._values.file, 0, "", message)

    def take(self, column: Column, entry: Entry) -> None:
        """Check an entry and keep its value, or the default instead."""
        for index, limit in zip(entry.indices, column.index_max, strict=False):
            if index > limit:
                code = column.parameter.index_code
                grave = self._values.kind is ListKind.VOLUMETRIC and CODES[code][0] is Severity.ERROR
                what = "the compensation stays off" if grave else "it is not taken"
                self._note(code, entry, f"{entry.name}: the index goes to {limit} only; {what}.")
                return
        if entry.indices in column.cells:
            line = column.cells[entry.indices][1]
            self._note("AXC-TWICE", entry, f"{entry.name} already stands in line {line}; the later one counts.")
        column.cells[entry.indices] = (self._plausible(column.parameter, entry), entry.line)

    def _plausible(self, parameter: Parameter, entry: Entry) -> Value:
        if not entry.word:
            return self._default(parameter, entry, "AXC-VALUE", "has no value")
        if parameter.type is DataType.STRING:
            return self._string(parameter, entry)
        value = _joined(parameter, entry.text) if parameter.flags else _number(parameter, entry.word)
        if value is None:
            kind = "is neither 0 nor 1" if parameter.type is DataType.BOOLEAN else "is no number"
            return self._default(parameter, entry, "AXC-VALUE", f"= {_short(entry.word)} {kind}")
        if parameter.values and value not in parameter.values:
            allowed = ", ".join(map(str, parameter.values))
            return self._default(parameter, entry, parameter.code, f"= {_short(entry.word)} is none of {allowed}")
        if value not in parameter.tolerable:
            bounds = parameter.tolerable if parameter.usable else parameter.plausible
            return self._default(parameter, entry, parameter.code, f"= {_short(entry.word)} is not {bounds.words}")
        if isinstance(value, Decimal) and parameter.quantity.whole:
            return self._default(parameter, entry, "AXC-VALUE", f"= {_short(entry.word)} is not a whole number")
        if value not in parameter.plausible:
            words = parameter.plausible.words
            self._note("AXC-OUTSIDE", entry, f"{entry.name} = {_short(entry.word)} is not {words}; it is used.")
        return value

    def _string(self, parameter: Parameter, entry: Entry) -> Value:
        found = string(entry.text)
        if found.fault:
            self._note("AXC-STRING", entry, f"{entry.name}: {found.fault}; “{_short(found.value)}” is used.")
        if parameter.values:
            value = found.value.upper()
            if value in parameter.values:
                return value
            allowed = " or ".join(map(str, parameter.values))
            return self._default(parameter, entry, parameter.code, f"= {_short(found.value)} is not {allowed}")
        if 0 < parameter.length < len(found.value):
            message = f"{entry.name} has more than {parameter.length} characters; it is used."
            self._note("AXC-OUTSIDE", entry, message)
        return found.value

    def _default(self, parameter: Parameter, entry: Entry, code: str, fault: str) -> Value:
        if code in ("AXC-VALUE", "AXC-RANGE") and parameter.key in ZEROED[self._values.kind]:
            code = "AXC-ZEROED"
        instead = parameter.default if parameter.default != "" else "nothing"
        self._note(code, entry, f"{entry.name} {fault}; {instead} is used.")
        return parameter.default

    def _note(self, code: str, entry: Entry, message: str, group: str | None = None) -> None:
        self._findings.add(code, self._values.file, entry.line, entry.name, message, group)


def _number(parameter: Parameter, word: str) -> int | Decimal | None:
    capitals = word.upper()
    if parameter.type is DataType.BOOLEAN:
        value = {"TRUE": 1, "FALSE": 0}.get(capitals, number(word))
        return value if value in (0, 1) else None
    return parameter.names.get(capitals, number(word))


def _joined(parameter: Parameter, text: str) -> int | None:
    """Return the bits of names and numbers as in ``A | B``; a second word that is neither begins the comment."""
    bits = None
    for word in flags(text).split("|"):
        value = _number(parameter, word.strip())
        if not isinstance(value, int):
            break
        bits = value if bits is None else bits | value
    return bits


def _short(text: str) -> str:
    return text if len(text) <= 40 else f"{text[:40]}…"
