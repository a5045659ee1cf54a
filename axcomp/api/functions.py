"""What the commands do, as functions.

Paths are those that the commands take: a start-up list, a folder with one, or a single list. What is wrong with lists
becomes findings; what cannot be done raises with the sentence that the command prints.
"""

from __future__ import annotations

import os
from collections.abc import Iterator, Sequence
from dataclasses import fields, replace
from pathlib import Path
from typing import TYPE_CHECKING, Any, Literal, overload

from ..lists import Reading, TypeName, decode, read_machine
from ..model import CYCLE_TIME, Machine, as_html, needed

if TYPE_CHECKING:
    import pandas as pd
    from matplotlib.figure import Figure

    from ..analysis.budget import Budget
    from ..fit import Creation
    from ..fmu import Built
    from ..interface import Naming
    from ..measurement import Conditions, Iso230Result
    from ..plot import Content

    AnyPath = str | os.PathLike[str]


def build_fmu(
    lists: AnyPath,
    output: AnyPath = ".",
    *,
    runtime: Literal["native", "python"] = "native",
    cycle_time: float = CYCLE_TIME,
    naming: Naming = "structured",
    platforms: Sequence[str] = (),
    axis_type: TypeName | None = None,
    name: str = "axcomp",
) -> Built:
    """Write the FMU of a machine and return what it holds; ``path`` is the file.

    Parameters
    ----------
    lists : path
        Of the machine.
    output : path
        The file, or a folder for ``NAME.fmu``.
    runtime : str
        ``native``: libraries, which need nothing; ``python``: pythonfmu in the host.
    cycle_time : float
        Of the position controller, s.
    naming : str
        ``structured``: ``X.leadscrew.correction``; ``flat``: with underscores.
    platforms : sequence of str
        Of the native FMU: ``linux64``, ``win64`` …; none: all.
    axis_type : str or None
        As in ``read_machine``.
    name : str
        Of the model.

    Raises
    ------
    BuildError
        The lists cannot be packed, or the file not be written.

    Examples
    --------
    >>> import tempfile
    >>> from axcomp import build_fmu, models
    >>> with tempfile.TemporaryDirectory() as folder:
    ...     built = build_fmu(models() / "rotary_table", folder, cycle_time=0.002)
    ...     built.path.name, len(built.variables) > 10
    ('axcomp.fmu', True)
    """
    from ..fmu import BuildError, package_axcomp, package_native

    given: dict[str, Any] = {"cycle_time": cycle_time, "naming": naming, "axis_type": axis_type, "name": name}
    if runtime == "native":
        return package_native(lists, output, platforms=platforms, **given)
    if runtime != "python" or platforms:
        raise BuildError("the run-time is native or python, and platforms are for the native FMU")
    return package_axcomp(lists, output, **given)


def check(lists: AnyPath, *, axis_type: TypeName | None = None, tool_length: float = 0.0) -> Reading:
    """Read the lists of a machine and judge their tables; ``findings`` say what there is to say.

    Parameters
    ----------
    lists : path
        Of the machine.
    axis_type : str or None
        As in ``read_machine``.
    tool_length : float
        For volumetric corrections, mm.

    Examples
    --------
    >>> from axcomp import check, models
    >>> [str(finding) for finding in check(models() / "three_axis", tool_length=50.0).findings]
    []
    """
    from ..analysis.judgement import judge

    reading = read_machine(lists, axis_type=axis_type)
    return replace(
        reading, findings=(*reading.findings, *judge(reading.machine, reading, tool_length=tool_length).findings)
    )


def measure(file: AnyPath, conditions: Conditions | None = None) -> Iso230Result:
    """Evaluate the measurement in ``file`` by ISO 230-2; MeasurementError with file and line if it is none.

    ``conditions``: of the test, for expanded uncertainties.
    """
    from ..measurement import evaluate, read_positioning

    return evaluate(read_positioning(Path(file)), conditions)


def create(
    kind: str,
    measurements: AnyPath | Sequence[AnyPath],
    into: AnyPath,
    *,
    axis: int | None = None,
    name: str = "",
    **options: Any,
) -> Creation:
    """Make a compensation table from measurements; ``write()`` of what is returned puts it into the list.

    Parameters
    ----------
    kind : str
        ``leadscrew``, ``cross``, ``plane`` … as ``axcomp create --help`` lists them.
    measurements : path or sequence of path
        Files, as one measurement.
    into : path
        The list that gets the table; the rest of it stays.
    axis : int or None
        Logical number of the axis, where the list is new.
    name : str
        Of the axis, where the list is new.
    **options
        Fields of ``fit.Options``: ``bound``, ``max_points``, ``on_top`` …

    Raises
    ------
    MeasurementError
        A file is no measurement.
    CannotCreateError
        The readings do not suffice, or the table does not fit.

    Examples
    --------
    >>> from axcomp import create
    >>> create("leadscrew", "no.rtl", "achskw1.lis", axis=1, bound=0.5)
    Traceback (most recent call last):
    axcomp.measurement.columns.MeasurementError: no.rtl: The file cannot be read: No such file or directory.
    """
    from ..fit import FITS, Options, create as make, fit_of
    from ..measurement import joined

    if kind not in FITS:
        raise ValueError(f"there is nothing to create called {kind}; there are {', '.join(FITS)}")
    if unknown := set(options) - {field.name for field in fields(Options)}:
        raise TypeError(f"{', '.join(sorted(unknown))}: no option; there are {', '.join(Options.__annotations__)}")
    fit = fit_of(kind)
    files = [measurements] if isinstance(measurements, str | os.PathLike) else measurements
    readings = joined([fit.read(Path(file)) for file in files])
    return make(kind, readings, fit.open(Path(into), {"axis": axis, "name": name, **options}), Options(**options))


def convert(source: AnyPath, to: str, *, axis: str | None = None, kind: str | None = None, **options: Any) -> str:
    """Return compensation tables in the format of another controller, or as ``csv``.

    Parameters
    ----------
    source : path
        Lists of a machine, or a file of another controller.
    to : str
        ``enc-comp``, ``cec``, ``csv`` … as ``axcomp convert --help`` lists them.
    axis : str or None
        Only this axis; also the axis of a file that does not tell it.
    kind : str or None
        Only this kind.
    **options
        Fields of ``conversion.Options``: ``over``, ``rotary``, ``within``, ``max_points`` …

    Raises
    ------
    FormatError
        The file is none of a known format.
    CannotHoldError
        The format cannot hold the tables.

    Examples
    --------
    >>> from axcomp import convert, models
    >>> convert(models() / "rotary_table", "csv", axis="C", kind="leadscrew").splitlines()[0][:6]
    'axis,u'
    """
    from ..conversion import FORMATS, CannotHoldError, FormatError, Options, recognized, tables_of, written

    if to not in FORMATS:
        raise ValueError(f"there is no format {to}; there are {', '.join(FORMATS)}")
    path, settings = Path(source), Options(axis=axis, **options)
    if path.is_dir() or path.suffix.lower() == ".lis":
        tables = tables_of(read_machine(path).machine, axis, kind)
    else:
        text = decode(path.read_bytes())
        if text is None or (found := recognized(text)) is None:
            raise FormatError(0, f"{path}: the content does not tell the format")
        tables = [one for one in FORMATS[found].read(text, settings) if kind in {None, one.kind}]
    if not tables:
        raise CannotHoldError(f"{path}: there is no such table")
    return written(tables, to, settings)[0]


class Tables(Sequence["Content"]):
    """Compensation tables to look at: each draws itself (``figure()``) and has its numbers (``records()``).

    ``contents``: the tables; ``title``: of what.
    """

    def __init__(self, contents: Sequence[Content], title: str = "") -> None:
        self.contents, self.title = tuple(contents), title

    @overload
    def __getitem__(self, place: int) -> Content: ...
    @overload
    def __getitem__(self, place: slice) -> Tables: ...
    def __getitem__(self, place: int | slice) -> Content | Tables:
        """Return one, or some of them."""
        return Tables(self.contents[place], self.title) if isinstance(place, slice) else self.contents[place]

    def __len__(self) -> int:
        return len(self.contents)

    def __iter__(self) -> Iterator[Content]:
        return iter(self.contents)

    def __repr__(self) -> str:
        return f"Tables({self.title}: {', '.join(one.subject.name for one in self)})"

    def _repr_html_(self) -> str:
        """Return size and range of each, for notebooks."""
        rows = [(one.subject.title, *one.summary()) for one in self]
        return as_html(["compensation", "points", "range", "values"], rows, caption=self.title)

    def plot(self) -> list[Figure]:
        """Draw them; return a figure each."""
        return [one.figure() for one in self]

    def to_frame(self) -> pd.DataFrame:
        """Return all numbers as a data frame: name of the table, columns with their units in brackets."""
        pandas = needed("pandas", "frame")
        every = [(one.subject.name, one.records()) for one in self]
        frames = [pandas.DataFrame(numbers.rows, columns=list(numbers.columns)) for _, numbers in every]
        joined: pd.DataFrame = pandas.concat(frames, keys=[name for name, _ in every], names=["table", "row"])
        return joined


def show(
    lists: AnyPath | Machine,
    *,
    axis: str | None = None,
    kind: str | None = None,
    against: AnyPath | Machine | None = None,
    tool_length: float = 0.0,
) -> Tables:
    """Return the compensation tables of a machine, or what another one has more than it.

    Parameters
    ----------
    lists : path or Machine
        The machine.
    axis : str or None
        Only the tables of this axis.
    kind : str or None
        Only this kind: ``leadscrew`` … or ``volumetric``.
    against : path or Machine or None
        Another machine; the tables are then its values minus those of ``lists``, where both have one.
    tool_length : float
        For the error of the tool tip, mm.

    Examples
    --------
    >>> from axcomp import models, show
    >>> show(models() / "rotary_table", kind="leadscrew")
    Tables(rotary_table: C-leadscrew)
    """
    from ..plot import contents_of

    first = _machine(lists)
    contents = contents_of(first, axis, kind, tool_length)
    title = "Machine" if isinstance(lists, Machine) else Path(lists).name
    if against is not None:
        others = {one.subject: one for one in contents_of(_machine(against), axis, kind, tool_length)}
        contents = [one.against(others[one.subject]) for one in contents if one.subject in others]
    return Tables(contents, title)


def budget(
    lists: AnyPath | Machine, path: AnyPath, *, tool_length: float | None = None, cycle_time: float = CYCLE_TIME
) -> Budget:
    """Return what each compensation and each volumetric error contributes along a path.

    Parameters
    ----------
    lists : path or Machine
        The machine.
    path : path
        A table with a column for each setpoint, ``X.setpoint`` …
    tool_length : float or None
        mm; None: the column ``tool_length``, else 0.
    cycle_time : float
        Of the position controller, s.

    Examples
    --------
    >>> from axcomp import budget, models
    >>> machine = models() / "rotary_table"
    >>> list(budget(machine, machine / "input.csv", cycle_time=0.001).totals)
    ['C']
    """
    from ..analysis.budget import budget_of
    from ..engine import read_input

    return budget_of(_machine(lists), read_input(Path(path)), tool_length=tool_length, cycle_time=cycle_time)


def _machine(lists: AnyPath | Machine) -> Machine:
    from ..lists import ListError

    if isinstance(lists, Machine):
        return lists
    reading = read_machine(lists)
    if not reading.machine.axes:
        raise ListError(reading.findings)
    return reading.machine
