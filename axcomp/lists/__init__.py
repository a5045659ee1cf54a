"""The controller's files, read and written: grammar, parameter catalogue, findings, one module per kind of file."""

from ..kinds import Severity
from .axes import Axes, AxisSettings
from .catalogue import CATALOGUE, SPELLINGS, parameter
from .catalogue_volumetric import AUTO, ETALON_EXCHANGE, ISG_CSV
from .compensation import TableReader
from .document import Document
from .etalon import read_etalon, write_etalon
from .files import Files, is_absolute, open_regular
from .findings import CODES, LIMIT, Finding, Findings, ListError
from .format import Lines
from .grammar import Entry, continued, decode, entries, number, string
from .isg_csv import read_isg_csv, write_isg_csv
from .known import all_similar
from .positions import DocumentEntry, Position
from .project import Project, Section, is_project
from .reader import read_machine, reread_volumetric
from .reading import Reading, TypeName
from .recognition import START_UP_NAME, kind_of, parameter_format
from .reference import HEADINGS, PAGE, as_dict, cells, page
from .start_up import MachineFiles, find_lists
from .values import ListValues, read_values
from .volumetric_blocks import ParameterBlock
from .volumetric_list import VolumetricReader
from .volumetric_parameters import Parameters, assemble
from .volumetric_writer import blocks_of, format_volumetric_list, parameter_file
from .writer import format_axis_list, format_compensation_list, format_start_up_list, machine_documents, write_machine

__all__ = [
    "AUTO",
    "CATALOGUE",
    "CODES",
    "ETALON_EXCHANGE",
    "HEADINGS",
    "ISG_CSV",
    "LIMIT",
    "PAGE",
    "SPELLINGS",
    "START_UP_NAME",
    "Axes",
    "AxisSettings",
    "Document",
    "DocumentEntry",
    "Entry",
    "Files",
    "Finding",
    "Findings",
    "Lines",
    "ListError",
    "ListValues",
    "MachineFiles",
    "ParameterBlock",
    "Parameters",
    "Position",
    "Project",
    "Reading",
    "Section",
    "Severity",
    "TableReader",
    "TypeName",
    "VolumetricReader",
    "all_similar",
    "as_dict",
    "assemble",
    "blocks_of",
    "cells",
    "continued",
    "decode",
    "entries",
    "find_lists",
    "format_axis_list",
    "format_compensation_list",
    "format_start_up_list",
    "format_volumetric_list",
    "is_absolute",
    "is_project",
    "kind_of",
    "machine_documents",
    "number",
    "open_regular",
    "page",
    "parameter",
    "parameter_file",
    "parameter_format",
    "read_etalon",
    "read_isg_csv",
    "read_machine",
    "read_values",
    "reread_volumetric",
    "string",
    "write_etalon",
    "write_isg_csv",
    "write_machine",
]
