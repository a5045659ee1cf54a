"""A ``Machine`` as a complete set of lists; reading them gives the same machine."""

from __future__ import annotations

from os import PathLike
from pathlib import Path

from ..kinds import KINDS, ListKind, kind_of
from ..model import AXES_MAX, Axis, Compensation, Machine
from ..saving import write_all
from .document import Document
from .format import Lines
from .recognition import START_UP_NAME
from .volumetric_writer import check_records, format_parameters, format_volumetric_list, list_file, parameter_file

_MODULO_MODE = 0x4


def write_machine(machine: Machine, folder: str | PathLike[str]) -> list[Path]:
    """Write the lists of ``machine`` into ``folder``: start-up list, axes, volumetric compensations.

    Each axis has an axis list and, where it needs one, a compensation list; each volumetric compensation its list and
    a parameter file.

    Returns
    -------
    list of Path
        The files, the start-up list first.

    Raises
    ------
    ValueError
        If a list cannot hold a value, or the machine has more axes than a start-up list names; no file is written.
    OSError
        If the folder cannot be written to.
    """
    documents = machine_documents(machine, folder)
    Path(folder).mkdir(parents=True, exist_ok=True)
    write_all({document.path: document.to_bytes() for document in documents})
    return [document.path for document in documents]


def machine_documents(machine: Machine, folder: str | PathLike[str]) -> list[Document]:
    """Return the lists of a machine, to be read or written; ValueError if a list cannot hold a value."""
    texts = {START_UP_NAME: format_start_up_list(machine)}
    for axis in machine.axes:
        texts[_axis_file(axis)] = format_axis_list(axis)
        if _is_compensated(axis):
            texts[_compensation_file(axis)] = format_compensation_list(axis)
    for volumetric in machine.volumetric:
        check_records(volumetric)
        texts[list_file(volumetric)] = format_volumetric_list(volumetric)
        texts[parameter_file(volumetric)] = format_parameters(volumetric)
    return [Document(Path(folder, name), text.encode()) for name, text in texts.items()]


def format_start_up_list(machine: Machine) -> str:
    """Return the text of ``hochlauf.lis``."""
    if len(machine.axes) > AXES_MAX:
        raise ValueError(f"{len(machine.axes)} axes: a start-up list names at most {AXES_MAX}")
    lines = Lines(ListKind.START_UP)
    lines.heading("Axis lists")
    lines.add_unless_default("zahl_mds", len(machine.axes))
    for i, axis in enumerate(machine.axes):
        lines.add("achs_mds[i]", _axis_file(axis), i)
    lines.heading("Compensation value lists")
    compensated = [axis for axis in machine.axes if _is_compensated(axis)]
    lines.add("zahl_kw", len(compensated))
    for i, axis in enumerate(compensated):
        lines.add("achs_kw[i]", _compensation_file(axis), i)
        lines.add("achs_kw_log_ax_nr[i]", axis.number, i)
    if machine.volumetric:
        lines.heading("Volumetric compensations")
    for volumetric in machine.volumetric:
        lines.add("vol_comp[i].max_records", volumetric.max_records, volumetric.index)
        lines.add("vol_comp[i].file_name", list_file(volumetric), volumetric.index)
    return lines.text()


def format_axis_list(axis: Axis) -> str:
    """Return the text of an axis list (``achsmd*.lis``)."""
    lines = Lines(ListKind.AXIS)
    _format_header(axis, lines)
    lines.heading("Axis type and compensations")
    lines.add("kenngr.achs_typ", axis.type.value)
    if axis.modulo is not None:
        lines.add("kenngr.achs_mode", _MODULO_MODE)
        lines.add_converted("getriebe[i].modulou", axis.modulo.start, 0)
        lines.add_converted("getriebe[i].moduloo", axis.modulo.end, 0)
    for name, kind in KINDS.items():
        compensation = getattr(axis, name)
        if name in axis.kinds:
            lines.add(kind.activator.name, kind.activation(compensation))
            if compensation is not None and kind.list_kind is ListKind.AXIS:
                kind.write(compensation, axis, lines)
        elif kind.list_kind is ListKind.COMPENSATION:
            lines.add(kind.activator.name, 0)
    lines.add("lr_param.n_backlash_cyc", axis.backlash_cycles)
    if axis.volumetric_limit is not None:
        lines.add_converted("lr_param.vol_comp.s_limit", axis.volumetric_limit)
    if axis.volumetric_velocity is not None:
        lines.add_converted("lr_param.vol_comp.v_limit", axis.volumetric_velocity)
    if axis.gantry_master is not None:
        lines.add("kenngr.gantry_ax_nr", axis.gantry_master)
    return lines.text()


def format_compensation_list(axis: Axis) -> str:
    """Return the text of a compensation value list (``achskw*.lis``)."""
    lines = Lines(ListKind.COMPENSATION)
    _format_header(axis, lines)
    for compensation in _listed(axis):
        lines.heading(kind_of(compensation).title)
        kind_of(compensation).write(compensation, axis, lines)
    return lines.text()


def _format_header(axis: Axis, lines: Lines) -> None:
    lines.heading(f"Axis {axis.number}")
    lines.add("kopf.achs_nr", axis.number)
    lines.add("kopf.log_achs_name", axis.name)


def _is_compensated(axis: Axis) -> bool:
    return bool(_listed(axis))


def _listed(axis: Axis) -> list[Compensation]:
    """Return the compensations that stand in a compensation list."""
    return [one for one in axis.compensations if kind_of(one).list_kind is ListKind.COMPENSATION]


def _axis_file(axis: Axis) -> str:
    return f"achsmd{axis.number}.lis"


def _compensation_file(axis: Axis) -> str:
    return f"achskw{axis.number}.lis"
