"""The command ``axcomp``: one module for each sub-command."""

from __future__ import annotations

import argparse
import io
import os
import sys
from collections.abc import Sequence
from importlib import import_module

from .. import __version__
from ..model import EXTRAS, MissingExtraError, missing, needed, sentence
from .parser import Parser, refusal

COMMANDS = {
    "build": "build the FMU of a machine from its lists",
    "check": "check the lists of machines",
    "format": "write lists in a layout",
    "lsp": "serve editors: findings while one types, and all about an entry",
    "parameters": "list the parameters that are understood",
    "run": "run setpoints and NC commands through a machine",
    "demo": "couple compensation and plant, and show what is left of the errors",
    "bench": "measure what a cycle costs, engine and FMU",
    "measure": "evaluate positioning measurements by ISO 230-2, circular tests by ISO 230-4",
    "create": "make compensation tables from measurements and traces",
    "plan": "propose what to measure next for volumetric errors",
    "fit": "tune friction parameters until the peaks of a circular test are least",
    "convert": "convert leadscrew and cross tables to and from other controllers",
    "show": "show compensation tables as pictures and tables",
    "sweep": "run many variations of a machine",
    "budget": "what each compensation and each error contributes along a path",
    "report": "write everything about a machine on one page",
    "page": "build the page that looks at lists in a browser",
    "replay": "compare a trace of a controller with the engine",
    "diagnose": "write all records of the volumetric compensations",
}
"""What each command does, for the help; each is a module with ``add_subparser(subparsers)``.

That sets ``do``: a function of the options → exit status. Only the module of the command that runs is imported.
"""

EXTRA = {
    "bench": "demo",
    "budget": "measure",
    "create": "measure",
    "demo": "demo",
    "diagnose": "tables",
    "fit": "measure",
    "lsp": "lsp",
    "measure": "measure",
    "plan": "measure",
    "replay": "plot",
    "report": "measure",
    "show": "plot",
    "sweep": "sweep",
}
"""The extra without which a command does nothing."""


def main(arguments: Sequence[str] | None = None) -> int:
    """Run a command and return its exit status: 2 for a wrong command line, else what the command says."""
    given = sys.argv[1:] if arguments is None else arguments
    _print_anything()
    try:
        return _run(given)
    except BrokenPipeError:
        # The reader of a pipe has seen enough; Python must not try to flush the rest on its way out.
        os.dup2(os.open(os.devnull, os.O_WRONLY), 1)
        return 1
    except KeyboardInterrupt:
        print("axcomp: interrupted", file=sys.stderr)
        return 130
    except ModuleNotFoundError as error:
        print(f"axcomp: {_lacking(given[0], error)}", file=sys.stderr)
        return 1
    except OSError as error:
        place = f"{error.filename}: " if error.filename else ""
        print(f"axcomp: {place}{error.strerror or error}", file=sys.stderr)
        return 1
    except ValueError as error:
        print(f"axcomp: {error}", file=sys.stderr)
        return 1


def _run(given: Sequence[str]) -> int:
    parser = Parser(
        prog="axcomp", description="Axis compensations of CNC machines: from the controller's lists to an FMU."
    )
    parser.add_argument("--version", action="version", version=f"axcomp {__version__}")
    subparsers: argparse._SubParsersAction[argparse.ArgumentParser]
    subparsers = parser.add_subparsers(metavar="COMMAND", required=True, parser_class=Parser)
    completed = os.environ.get("COMP_LINE", "").split()[1:] if "_ARGCOMPLETE" in os.environ else []
    command = next(iter([*given, *completed]), "")
    absent = {extra for extra in EXTRA.values() if missing(EXTRAS[extra])}
    lacking = [name for name in COMMANDS if EXTRA.get(name) in absent]
    if command in COMMANDS:
        _add(command, subparsers)
    else:
        for name, what in COMMANDS.items():
            if name not in lacking:
                subparsers.add_parser(name, help=what)
    if lacking:
        parser.epilog = f"With pip install 'axcomp[workbench]' there are also: {', '.join(lacking)}."
    if "_ARGCOMPLETE" in os.environ:
        needed("argcomplete", "completion", "Completion").autocomplete(parser)
    options = parser.parse_args(given)
    if sentence_ := refusal(options):
        print(f"axcomp {command}: {sentence_}", file=sys.stderr)
        return 1
    status: int = options.do(options)
    sys.stdout.flush()
    return status


def _add(name: str, subparsers: argparse._SubParsersAction[argparse.ArgumentParser]) -> None:
    """Add a command; SystemExit with a sentence if one of its packages is missing."""
    try:
        import_module(f".{name}", __name__).add_subparser(subparsers)
    except ModuleNotFoundError as error:
        if error.name is None or error.name.split(".")[0] == __package__.split(".")[0]:
            raise
        raise SystemExit(f"axcomp: {_lacking(name, error)}") from None


def _lacking(command: str, error: ModuleNotFoundError) -> str:
    """Return what to install for a command."""
    if isinstance(error, MissingExtraError):
        return str(error)
    extra = EXTRA.get(command, "")
    package = (error.name or "").partition(".")[0]
    return sentence(package, extra if package in EXTRAS.get(extra, ()) else "", command)


def _print_anything() -> None:
    """Let file names and sentences through that the terminal's encoding does not know."""
    for stream in (sys.stdout, sys.stderr):
        if isinstance(stream, io.TextIOWrapper):
            stream.reconfigure(errors="backslashreplace")
