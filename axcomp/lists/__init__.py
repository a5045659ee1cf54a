"""The controller's files, read and written: grammar, parameter catalogue, findings, one module per kind of file."""

from ..kinds.parameter import Severity
from .findings import CODES, Finding, ListError
from .reader import Reading, list_files, read_machine, reread_volumetric
from .writer import format_axis_list, format_compensation_list, format_start_up_list, write_machine

__all__ = [
    "CODES",
    "Finding",
    "ListError",
    "Reading",
    "Severity",
    "format_axis_list",
    "format_compensation_list",
    "format_start_up_list",
    "list_files",
    "read_machine",
    "reread_volumetric",
    "write_machine",
]
