"""The command ``axcomp``: one module for each sub-command."""

from __future__ import annotations

import argparse
import io
import os
import sys
from collections.abc import Sequence

from . import check, measure, parameters

COMMANDS = (check, parameters, measure)
"""Each module has ``add_subparser(subparsers)``; it sets ``do``, a function of the options that returns the status."""


def main(arguments: Sequence[str] | None = None) -> int:
    """Run a command and return its exit status: 2 for a wrong command line, else what the command says."""
    _print_anything()
    parser = argparse.ArgumentParser(
        prog="axcomp", description="Axis compensations of CNC machines: from the controller's lists to an FMU."
    )
    subparsers = parser.add_subparsers(metavar="COMMAND", required=True)
    for command in COMMANDS:
        command.add_subparser(subparsers)
    options = parser.parse_args(arguments)
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
    except (OSError, ValueError) as error:
        print(f"axcomp: {error}", file=sys.stderr)
        return 1
    return status


def _print_anything() -> None:
    """Let file names and sentences through that the terminal's encoding does not know."""
    for stream in (sys.stdout, sys.stderr):
        if isinstance(stream, io.TextIOWrapper):
            stream.reconfigure(errors="backslashreplace")
