"""What the reader has to say about a list: severity, place, parameter, code and one sentence."""

from __future__ import annotations

import re
from collections.abc import Iterable
from dataclasses import dataclass

from ..kinds import KINDS, Severity

_NAME_MAX = 80
"""Characters of a parameter that are shown at most: that of many columns at once can be long."""


@dataclass(frozen=True)
class Finding:
    """One thing the reader noticed.

    Attributes
    ----------
    severity : Severity
        ERROR where something the list asks for does not act; WARNING where it acts otherwise than written.
    file : str
        The file as it was named, "" where no file is meant.
    line : int
        Counted from 1; 0 where the whole file is meant.
    parameter : str
        The entry as it stands in the list, e.g. ``kw.ssfk.table[3].pos``; "" where none is meant.
    code : str
        The vendor's number where the vendor documents one, else ``AXC-…`` (see ``CODES``).
    message : str
        One sentence: what was wrong, and what is used instead.
    column : int
        Where the entry begins, in characters from 1; 0 where that is not known.

    Examples
    --------
    >>> from axcomp import Finding, Severity
    >>> str(Finding(Severity.ERROR, "achskw1.lis", 14, "", "110591", "The table does not ascend; it stays off."))
    'achskw1.lis:14: error 110591: The table does not ascend; it stays off.'
    """

    severity: Severity
    file: str
    line: int
    parameter: str
    code: str
    message: str
    column: int = 0

    def __str__(self) -> str:
        """``file:line: severity code: sentence``, as compilers write it; in brackets the entry the sentence omits."""
        told = not self.parameter or self.parameter in self.message or len(self.parameter) > _NAME_MAX
        entry = "" if told else f" [{self.parameter}]"
        return f"{self.file}:{self.line}: {self.severity.value} {self.code}: {self.message}{entry}"


class ListError(ValueError):
    """Lists that cannot be used: ``findings`` say why, one a line in the message."""

    def __init__(self, findings: Iterable[Finding]) -> None:
        self.findings = tuple(findings)
        super().__init__("\n".join(map(str, self.findings)) or "There is no axis in these lists.")


_ERROR, _WARNING, _INFO = Severity

CODES: dict[str, tuple[Severity, str]] = {
    # Files
    "AXC-MISSING": (_ERROR, "A named file does not exist"),
    "AXC-UNREADABLE": (_ERROR, "A file cannot be read: a directory, no permission, too large"),
    "AXC-FOLDER": (
        _ERROR,
        "A list names a file outside its folder (an absolute path, .., a link), and nothing allows that",
    ),
    "AXC-BINARY": (_ERROR, "A file is no text"),
    "AXC-EMPTY": (_ERROR, "A list has no entry"),
    "AXC-KIND": (_ERROR, "A list is of another kind than it is used for"),
    "AXC-PATH": (_WARNING, "A file was found only beside the start-up list or in another case than it is named"),
    # Grammar
    "AXC-SYNTAX": (_WARNING, "A line is neither an entry nor a comment"),
    "AXC-ELISION": (_WARNING, "A line stands for entries left out (… or :)"),
    "AXC-END": (_WARNING, "Lines follow the End of the list"),
    "AXC-STRING": (_WARNING, "A string is not closed, or holds characters that only quotes allow"),
    # Entries
    "AXC-UNKNOWN": (_WARNING, "An entry is not in the catalogue"),
    "AXC-OTHERS": (_INFO, "Entries of the controller that have no effect on compensations"),
    "AXC-TYPO": (_WARNING, "An entry is spelt in a way that only some lists use"),
    "AXC-TWICE": (_WARNING, "An entry is given twice; the later one counts"),
    "AXC-INDEX": (_WARNING, "An index is larger than the parameter allows"),
    "AXC-VALUE": (_WARNING, "A value is not of the parameter's type; the default is used"),
    "AXC-ZEROED": (
        _ERROR,
        "A value or the size of a table, or the number of lists, is no number or outside its range; 0 is used",
    ),
    "AXC-RANGE": (_WARNING, "A value is outside the range; the default is used"),
    "AXC-OUTSIDE": (_WARNING, "A value is outside the documented range but usable, and used"),
    "AXC-UNUSED": (_WARNING, "Entries that nothing uses: beyond the used size, or needed in another mode only"),
    "AXC-UNIT": (_WARNING, "Increments by default, although the axis does not count 0.1 µm or 0.0001°"),
    # Axes
    "AXC-NUMBER": (_ERROR, "The logical axis number of a list is missing or 0"),
    "AXC-NUMBER-TWICE": (_ERROR, "Two lists of one kind have the same logical axis number; the first one counts"),
    "AXC-NAME": (_WARNING, "Two axes have the same name; the later one's gets its number added"),
    "AXC-AXES": (_ERROR, "More axes than the controller has"),
    "AXC-NO-AXIS-LIST": (_WARNING, "A compensation list belongs to an axis without axis list: nothing activates it"),
    "110229": (_ERROR, "Logical axis number of the start-up list and of the compensation list differ"),
    "110086": (_WARNING, "Path resolution: wegaufn is 0; 1 is used"),
    "110386": (_WARNING, "Path resolution: wegaufz is 0; 1 is used"),
    "110472": (_ERROR, "Path resolution: feed_const_denom is 0; 1 is used"),
    "AXC-RESOLUTION": (_WARNING, "Path resolution: incr_per_rev is 0, although there is a feed constant; 1024 is used"),
    "110052": (_WARNING, "Modulo range is not positive; 0 … 360 ° is used"),
    # Compensations
    "AXC-INACTIVE": (_INFO, "A table is there, but nothing activates it"),
    "AXC-NO-TABLE": (_WARNING, "The axis activates a compensation that has no table"),
    "AXC-SIZE": (_ERROR, "The used size of a table is 0"),
    "AXC-GAP": (_ERROR, "A table lacks an entry within its used size; 0 is used, as by the controller"),
    "AXC-MASTER": (_ERROR, "A master or adaptation axis is missing, unknown or of a type that cannot serve"),
    "AXC-MASTER-SELF": (_WARNING, "An axis is its own master"),
    "AXC-ORDER": (_ERROR, "Interpolation points are not strictly ascending"),
    "AXC-INTERVAL": (_ERROR, "The distance of interpolation points is 0 where it is needed"),
    "AXC-AXIS-TYPE": (_ERROR, "The compensation exists for translatory axes only"),
    **{code: meaning for kind in KINDS.values() for code, meaning in kind.codes.items()},
    "110647": (_ERROR, "A table is larger than its max_points"),
    # Volumetric compensation
    "70468": (_ERROR, "Volumetric compensation: a name is neither a parameter nor an axis"),
    "70469": (_ERROR, "Volumetric compensation: a parameter or an axis is named twice"),
    "70471": (_ERROR, "Volumetric compensation: GRID is asked for, but the records do not fill a grid"),
    "70474": (_WARNING, "Volumetric compensation: records on a grid are interpolated by SCATTER"),
    "70506": (_ERROR, "Volumetric compensation: there is none with this number"),
    "70507": (_ERROR, "Volumetric compensation: there is no parameter file with this number"),
    "AXC-RECORD": (_ERROR, "A record has too many or too few columns, or one that is no number"),
    "AXC-NO-RECORD": (_WARNING, "A parameter is named but has no record; it is not taken"),
    "AXC-MAGNITUDE": (_ERROR, "A parameter has a value that no machine has: it is in another unit"),
    "AXC-SECTION": (_WARNING, "A section of an Etalon exchange file is no parameter; it is passed over"),
    "AXC-LARGE": (_WARNING, "An error so large that it can only be in µm or degrees"),
    "AXC-OPEN": (_WARNING, "A table jumps while a rotary axis goes on turning"),
    "AXC-SPLICING": (_WARNING, "enable_splicing changes nothing"),
    "AXC-CONSTANT": (_ERROR, "A parameter that describes the machine depends on positions"),
    "AXC-ARGUMENTS": (_ERROR, "A parameter depends on different axes in different places"),
    "AXC-POLYLINE": (_ERROR, "PATH is asked for over axes that make no polyline"),
    "AXC-MAX-RECORDS": (_ERROR, "More records than max_records"),
    "AXC-CHAIN": (_ERROR, "The kinematic chain is not X, Y, Z and some of A, B, C, each once"),
    "AXC-ASSIGNMENT": (_ERROR, "An axis of the chain or of a parameter has no machine axis, or shares one"),
    "AXC-VECTOR": (_WARNING, "A direction is not scaled to length 1; it is scaled, or left out if it is 0"),
    "AXC-SINGULAR": (_ERROR, "The directions of X, Y and Z lie in one plane"),
    "AXC-LIMIT": (_ERROR, "An axis to be compensated has no s_limit (P-AXIS-00525)"),
    "AXC-V-LIMIT": (_WARNING, "An axis to be compensated has no v_limit (P-AXIS-00526)"),
    "AXC-NOT-MODELLED": (_WARNING, "The controller has this function, the model has not"),
    # Judgement of tables that can be read
    "AXC-SIGN": (_INFO, "A table makes a measured error smaller"),
    "AXC-SIGN-INVERTED": (_WARNING, "A table would make a measured error smaller with the opposite sign"),
    "AXC-SIGN-SWAPPED": (_WARNING, "A table would make a measured error smaller with its directions interchanged"),
    "AXC-SIGN-NO-HELP": (_WARNING, "A table does not make a measured error smaller, nor would its opposite"),
    "AXC-OUTLIER": (_WARNING, "A single value is far off its neighbours"),
    "AXC-SEAM": (_WARNING, "The correction steps, or changes steeply, where a round axis begins again"),
    "AXC-COVERAGE": (_WARNING, "Positions or accelerations in use lie outside a table"),
    "AXC-DYNAMICS": (_INFO, "What a table asks of a drive at a feed"),
    "AXC-DYNAMICS-VELOCITY": (_WARNING, "Feed and the velocity that a table adds are above the axis' limit"),
    "AXC-DYNAMICS-KINK": (_WARNING, "A kink of a table asks for more acceleration than the axis has"),
    "AXC-DYNAMICS-JUMP": (_WARNING, "Switching or reversing a table asks for more than the axis has"),
    "AXC-LIMIT-EXCEEDED": (_WARNING, "A volumetric correction is larger than s_limit (P-AXIS-00525)"),
    "AXC-LIMIT-NEAR": (_INFO, "A volumetric correction is close to s_limit (P-AXIS-00525)"),
    # Of the lists as a whole
    "AXC-BUILD": (_ERROR, "The lists can be read, but no FMU can be made of them"),
    "AXC-IGNORE": (_WARNING, "A comment asks to ignore findings, but names no code"),
}
"""Every code a finding can have: its severity and what it means. Numbers are the vendor's, ``AXC-…`` are our own."""

LIMIT = 10
"""Findings of one code for one parameter of one file that are given one by one; the others are counted."""

_INDEX = re.compile(r"\[[^\]]*\]")

_Group = tuple[str, str, str]
"""Code, file, and the parameter without indices or what else is counted together."""


class Findings:
    """Collects findings; of the same fault in many rows of a table only the first ``LIMIT`` are kept one by one."""

    def __init__(self) -> None:
        self._kept: list[tuple[_Group, Finding]] = []
        self._counts: dict[_Group, int] = {}

    def add(self, code: str, file: str, line: int, parameter: str, message: str, group: str | None = None) -> None:
        """Note a finding. Those of one code, file and ``group`` (else the parameter without indices) are limited."""
        key = (code, file, _INDEX.sub("[]", parameter) if group is None else group)
        count = self._counts.get(key, 0) + 1
        self._counts[key] = count
        if count <= LIMIT:
            self._kept.append((key, Finding(CODES[code][0], file, line, parameter, code, message)))

    def take(self, others: Findings) -> None:
        """Note what others have noted."""
        room = {key: LIMIT - self._counts.get(key, 0) for key in others._counts}
        for key, finding in others._kept:
            if room[key] > 0:
                room[key] -= 1
                self._kept.append((key, finding))
        for key, count in others._counts.items():
            self._counts[key] = self._counts.get(key, 0) + count

    def errors(self) -> int:
        """Return how many findings of severity error have been noted so far."""
        return sum(count for (code, _, _), count in self._counts.items() if CODES[code][0] is Severity.ERROR)

    def all(self) -> tuple[Finding, ...]:
        """Return what was noted, file by file in the order of the lines, with a count of what was left out."""
        more = [
            Finding(CODES[code][0], file, 0, group, code, f"{CODES[code][1]}: {count - LIMIT:,} more like this.")
            for (code, file, group), count in self._counts.items()
            if count > LIMIT
        ]
        noted = [finding for _, finding in self._kept]
        order = {file: index for index, file in enumerate(dict.fromkeys(finding.file for finding in noted))}
        # What concerns a file as a whole comes before its lines, except the counts: they close its list.
        found = sorted(noted, key=lambda finding: (order[finding.file], finding.line))
        return tuple(sorted([*found, *more], key=lambda finding: order[finding.file]))
