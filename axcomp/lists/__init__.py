"""The controller's files, read and written: grammar, parameter catalogue, findings, one module per kind of file."""

from ..kinds.parameter import Severity
from .document import Document
from .findings import CODES, Finding, ListError
from .positions import Position
from .reader import Reading, TypeName, read_machine, reread_volumetric
from .writer import format_axis_list, format_compensation_list, format_start_up_list, machine_documents, write_machine

__all__ = [
    "CODES",
    "Document",
    "Finding",
    "ListError",
    "Position",
    "Reading",
    "Severity",
    "TypeName",
    "format_axis_list",
    "format_compensation_list",
    "format_start_up_list",
    "machine_documents",
    "read_machine",
    "reread_volumetric",
    "write_machine",
]
