"""From the blocks of the parameter files to the error tables of a compensation: merged, sorted, spliced and checked."""

from __future__ import annotations

from collections.abc import Iterable
from dataclasses import dataclass, field

from ..model import ERRORS, FULL_TURN, LETTERS, LINEAR, ROTARY, ErrorTable, Interpolation, is_grid
from .catalogue_volumetric import AUTO
from .findings import Findings
from .volumetric_blocks import ParameterBlock

_POLYLINE = {Interpolation.PATH.value: LINEAR, Interpolation.PATH_XY.value: LINEAR[:2]}

Nodes = tuple[tuple[float, ...], ...]


@dataclass(frozen=True)
class Constant:
    """Value of a describing parameter, and where it stands."""

    value: float
    file: str
    line: int


@dataclass
class Parameters:
    """What the parameter files of a compensation say.

    Attributes
    ----------
    errors : dict of str to ErrorTable
        By name, one for each error that is given.
    description : dict of str to Constant
        By name, one for each describing parameter that is given.
    places : dict of str to (str, int)
        File and line where each error is named.
    spliced : bool
        Whether a table was made round.
    """

    errors: dict[str, ErrorTable] = field(default_factory=dict)
    description: dict[str, Constant] = field(default_factory=dict)
    places: dict[str, tuple[str, int]] = field(default_factory=dict)
    spliced: bool = False

    def records(self) -> int:
        """Return the number of records: one for each parameter and argument tuple."""
        return sum(len(table.values) for table in self.errors.values()) + len(self.description)


@dataclass
class _Columns:
    """A block in the order of the model: nodes, and a column of values for each parameter."""

    source: ParameterBlock
    arguments: str
    nodes: Nodes
    values: dict[str, tuple[float, ...]]


def assemble(
    blocks: Iterable[ParameterBlock], interpolation: str, enable_splicing: bool, findings: Findings
) -> Parameters:
    """Return the parameters of a compensation, with findings 70471, 70474 and the project's own.

    ``interpolation`` is P-VOLC-00014, the value of an ``Interpolation`` or ``AUTO``; ``enable_splicing`` P-VOLC-00015.
    """
    result = Parameters()
    errors: dict[str, _Columns] = {}
    for block in blocks:
        columns = _normalize(block, interpolation, findings)
        for name in block.names:
            if name not in ERRORS:
                _take_constant(name, columns, result, findings)
            elif name not in errors:
                errors[name] = columns
                result.places[name] = (block.file, block.line)
            elif errors[name].arguments == columns.arguments:
                errors[name] = _merge(name, errors[name], columns, interpolation, findings)
            else:
                first = errors[name]
                message = (
                    f"{name} depends on {columns.arguments or 'nothing'} here and on {first.arguments or 'nothing'} in "
                    f"{first.source.file}:{first.source.line}; the compensation stays off."
                )
                findings.add("AXC-ARGUMENTS", block.file, block.line, name, message)

    modes: dict[int, Interpolation] = {}
    for name, columns in errors.items():
        if id(columns) not in modes:
            if enable_splicing:
                result.spliced = _splice(columns) or result.spliced
            modes[id(columns)] = _mode(columns, interpolation, findings)
        mode = modes[id(columns)]
        result.errors[name] = ErrorTable(name, columns.values[name], columns.arguments, columns.nodes, mode)
    result.errors = {name: result.errors[name] for name in ERRORS if name in result.errors}
    return result


def _take_constant(name: str, columns: _Columns, result: Parameters, findings: Findings) -> None:
    block = columns.source
    if columns.arguments:
        message = f"{name} describes the machine and cannot depend on {columns.arguments}; the compensation stays off."
        findings.add("AXC-CONSTANT", block.file, block.line, name, message)
        return
    if name in result.description:
        first = result.description[name]
        message = f"{name} was given in {first.file}:{first.line} already; the value here is used."
        findings.add("AXC-TWICE", block.file, block.line, name, message)
    result.description[name] = Constant(columns.values[name][0], block.file, block.lines[-1])


def _normalize(block: ParameterBlock, interpolation: str, findings: Findings) -> _Columns:
    """Sort the arguments as ``LETTERS`` are, and the records by their nodes unless their order is a path."""
    places = sorted(range(len(block.arguments)), key=lambda place: LETTERS.index(block.arguments[place]))
    arguments = "".join(block.arguments[place] for place in places)
    nodes = [tuple([row[place] for place in places]) for row in block.rows]
    if interpolation in _POLYLINE and arguments:
        order = [i for i, node in enumerate(nodes) if i + 1 == len(nodes) or nodes[i + 1] != node]
    else:
        last = {node: i for i, node in enumerate(nodes)}
        order = [last[node] for node in sorted(last)]
    if len(order) < len(nodes):
        replaced = min(set(range(len(nodes))).difference(order))
        where = ", ".join(f"{letter} = {x:g}" for letter, x in zip(arguments, nodes[replaced], strict=True))
        message = f"There is more than one record{' at ' if where else ''}{where}; the last one is used."
        findings.add("AXC-TWICE", block.file, block.lines[replaced], " ".join(block.names), message)
    rows = [block.rows[i] for i in order]
    first = len(places)
    values = {name: tuple([row[first + i] for row in rows]) for i, name in enumerate(block.names)}
    return _Columns(block, arguments, tuple([nodes[i] for i in order]), values)


def _merge(name: str, first: _Columns, second: _Columns, interpolation: str, findings: Findings) -> _Columns:
    """Return the records of one parameter from two blocks; where both have a node the later record is used."""
    if interpolation in _POLYLINE and first.arguments:
        values = first.values[name] + second.values[name]
        return _Columns(second.source, first.arguments, first.nodes + second.nodes, {name: values})
    records = dict(zip(first.nodes, first.values[name], strict=True))
    if not records.keys().isdisjoint(second.nodes):
        source = first.source
        message = (
            f"{name} has records in {source.file}:{source.line} for positions given here too; those here are used."
        )
        findings.add("AXC-TWICE", second.source.file, second.source.line, name, message)
    records.update(zip(second.nodes, second.values[name], strict=True))
    nodes = tuple(sorted(records))
    return _Columns(second.source, first.arguments, nodes, {name: tuple(records[node] for node in nodes)})


def _splice(columns: _Columns) -> bool:
    """Repeat the first record one turn later in a table over one rotary axis; False: it is none, or is round."""
    if columns.arguments not in tuple(ROTARY) or columns.nodes[-1][0] - columns.nodes[0][0] >= FULL_TURN:
        return False
    columns.nodes = (*columns.nodes, (columns.nodes[0][0] + FULL_TURN,))
    columns.values = {name: (*values, values[0]) for name, values in columns.values.items()}
    return True


def _mode(columns: _Columns, interpolation: str, findings: Findings) -> Interpolation:
    """Return how a table is interpolated, with a finding where its records are not made for that."""
    block = columns.source
    label = " ".join(columns.values)
    over = ", ".join(columns.arguments)
    if not columns.arguments:
        return Interpolation.GRID
    if interpolation in _POLYLINE:
        axes = _POLYLINE[interpolation]
        if not set(columns.arguments) <= set(axes):
            message = (
                f"{interpolation} takes positions of {', '.join(axes)}, not of {over}; the compensation stays off."
            )
            findings.add("AXC-POLYLINE", block.file, block.line, label, message)
        return Interpolation(interpolation)
    grid = is_grid(columns.nodes)
    if interpolation == Interpolation.GRID.value and not grid:
        message = f"The {len(columns.nodes)} records over {over} do not fill a grid; the compensation stays off."
        findings.add("70471", block.file, block.line, label, message)
    elif interpolation == Interpolation.SCATTER.value and grid:
        message = f"The records over {over} lie on a grid, but SCATTER interpolates them as scattered ones."
        findings.add("70474", block.file, block.line, label, message)
    if interpolation == AUTO:
        return Interpolation.GRID if grid else Interpolation.SCATTER
    return Interpolation(interpolation)
