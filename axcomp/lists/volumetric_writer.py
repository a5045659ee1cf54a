"""A ``Volumetric`` as a list and a parameter file; reading them gives the same compensation.

The file is an ISG CSV file, or an Etalon exchange file where the compensation has come from one that ends in ``.exc``.
"""

from __future__ import annotations

from collections.abc import Sequence

from ..kinds import ListKind
from ..model import ErrorTable, Interpolation, Volumetric, is_grid
from .catalogue_volumetric import AUTO, ETALON_EXCHANGE, ISG_CSV
from .etalon import write_etalon
from .format import Lines
from .isg_csv import write_isg_csv
from .volumetric_blocks import ParameterBlock

_ETALON_SUFFIX = ".exc"


def list_file(volumetric: Volumetric) -> str:
    """Return the usual name of a compensation's list."""
    return f"vol_comp{volumetric.index}.lis"


def parameter_file(volumetric: Volumetric) -> str:
    """Return the usual name of a compensation's parameter file."""
    return f"vol_comp{volumetric.index}{_ETALON_SUFFIX if _is_etalon(volumetric) else '.csv'}"


def _is_etalon(volumetric: Volumetric) -> bool:
    """Tell whether the parameters were in an Etalon exchange file and still fit into one."""
    named = [name for name in volumetric.files if name]
    return (
        bool(named)
        and all(name.lower().endswith(_ETALON_SUFFIX) for name in named)
        and all(error.arguments in ("", error.name[-1]) for error in volumetric.errors)
    )


def format_volumetric_list(volumetric: Volumetric) -> str:
    """Return the text of a volumetric list (``vol_comp*.lis``); ValueError for what a list cannot hold."""
    lines = Lines(ListKind.VOLUMETRIC)
    lines.heading("Axes")
    for letter, number in volumetric.axes:
        lines.add(letter.lower(), number)
    lines.heading("Kinematic model")
    lines.add("chain", volumetric.chain)
    lines.add("workpiece_axes", volumetric.workpiece_axes)
    lines.add_unless_default("alternative_model", volumetric.alternative_model)
    lines.heading("Parameters")
    lines.add("file[j]", parameter_file(volumetric), 0)
    lines.add("file_format[j]", ETALON_EXCHANGE if _is_etalon(volumetric) else ISG_CSV, 0)
    lines.add("interpolation", _interpolation(volumetric.errors))
    lines.heading("Correction and switching")
    lines.add_unless_default("negate", volumetric.negate)
    lines.add_unless_default("set_to_zero", volumetric.set_to_zero)
    lines.add("manual_activation", volumetric.manual_activation)
    lines.add("filter_steps", volumetric.filter_steps)
    lines.add_unless_default("associate_to_channel", volumetric.associate_to_channel)
    lines.add_unless_default("diagnosis_file", volumetric.diagnosis_file)
    return lines.text()


def format_parameters(volumetric: Volumetric) -> str:
    """Return the text of a file with all parameters."""
    blocks = blocks_of(volumetric)
    return write_etalon(blocks) if _is_etalon(volumetric) else write_isg_csv(blocks)


def blocks_of(volumetric: Volumetric) -> list[ParameterBlock]:
    """Return the parameters as blocks: the constant ones, then those over the same nodes together."""
    tables: dict[tuple[str, tuple[tuple[float, ...], ...]], list[ErrorTable]] = {("", ((),)): []}
    for error in volumetric.errors:
        tables.setdefault((error.arguments, error.nodes), []).append(error)
    blocks = []
    for (arguments, nodes), errors in tables.items():
        names = tuple(error.name for error in errors)
        rows = [[*node, *(error.values[n] for error in errors)] for n, node in enumerate(nodes)]
        blocks.append(ParameterBlock("", 0, tuple(arguments), names, rows))
    constants = blocks[0]
    for name, value in volumetric.description():
        constants.names += (name,)
        constants.rows[0].append(value)
    return [block for block in blocks if block.names]


def check_records(volumetric: Volumetric) -> None:
    """Raise ValueError if the records are more than ``max_records``: the reader would refuse them."""
    if volumetric.records() > volumetric.max_records:
        raise ValueError(
            f"volumetric compensation {volumetric.index} has {volumetric.records()} records, "
            f"more than its max_records = {volumetric.max_records}"
        )


def _interpolation(errors: Sequence[ErrorTable]) -> str:
    """Return the mode that reads back to how every table is interpolated; ValueError if there is none."""
    tables = [error for error in errors if error.arguments]
    modes = {error.interpolation for error in tables}
    if len(modes) <= 1:
        return modes.pop().value if modes else Interpolation.GRID.value
    automatic = {error.name for error in tables if (error.interpolation is Interpolation.GRID) == is_grid(error.nodes)}
    if modes == {Interpolation.GRID, Interpolation.SCATTER} and len(automatic) == len(tables):
        return AUTO
    raise ValueError("a volumetric list has one mode of interpolation, not " + ", ".join(m.value for m in modes))
