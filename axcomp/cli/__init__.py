"""The command ``axcomp``: one module for each sub-command."""

from __future__ import annotations

import argparse
import io
import os
import sys
from collections.abc import Sequence
from importlib import import_module
from types import ModuleType

COMMANDS = (
    "build",
    "check",
    "parameters",
    "run",
    "demo",
    "bench",
    "measure",
    "create",
    "convert",
    "show",
    "sweep",
    "budget",
    "report",
    "diagnose",
)
"""Each is a module with ``add_subparser(subparsers)``, which sets ``do``: a function of the options → exit status."""


def main(arguments: Sequence[str] | None = None) -> int:
    """Run a command and return its exit status: 2 for a wrong command line, else what the command says."""
    _print_anything()
    parser = argparse.ArgumentParser(
        prog="axcomp", description="Axis compensations of CNC machines: from the controller's lists to an FMU."
    )
    subparsers = parser.add_subparsers(metavar="COMMAND", required=True)
    given = sys.argv[1:] if arguments is None else arguments
    modules, missing = _modules(given[:1])
    for command in modules:
        command.add_subparser(subparsers)
    if missing:
        parser.epilog = f"With pip install 'axcomp[workbench]' there are also: {', '.join(missing)}."
    options = parser.parse_args(given)
    try:
        status: int = options.do(options)
        sys.stdout.flush()
    except BrokenPipeError:
        # The reader of a pipe has seen enough; Python must not try to flush the rest on its way out.
        os.dup2(os.open(os.devnull, os.O_WRONLY), 1)
        return 1
    except KeyboardInterrupt:
        return 130
    except ModuleNotFoundError as error:
        print(f"axcomp: {error.name} is missing; pip install 'axcomp[workbench]' installs it.", file=sys.stderr)
        return 1
    except OSError as error:
        place = f"{error.filename}: " if error.filename else ""
        print(f"axcomp: {place}{error.strerror or error}", file=sys.stderr)
        return 1
    except ValueError as error:
        print(f"axcomp: {error}", file=sys.stderr)
        return 1
    return status


def _modules(wanted: Sequence[str]) -> tuple[list[ModuleType], list[str]]:
    """Import the command that is wanted, else all for the help: what one needs must not slow down the others.

    The second list names the commands whose packages are not installed.
    """
    named = [name for name in COMMANDS if name in wanted]
    modules, missing = [], []
    for name in named or COMMANDS:
        try:
            modules.append(import_module(f".{name}", __name__))
        except ModuleNotFoundError as error:
            if error.name is None or error.name.split(".")[0] == __package__.split(".")[0]:
                raise
            if named:
                raise SystemExit(f"axcomp: {name} needs {error.name}: pip install 'axcomp[workbench]'") from None
            missing.append(name)
    return modules, missing


def _print_anything() -> None:
    """Let file names and sentences through that the terminal's encoding does not know."""
    for stream in (sys.stdout, sys.stderr):
        if isinstance(stream, io.TextIOWrapper):
            stream.reconfigure(errors="backslashreplace")
