"""``axcomp format``: lists in a layout."""

from __future__ import annotations

import argparse
import sys
from pathlib import Path

from ..lint import SettingsError, find_machines, find_settings, formatted
from ..lists import Document, read_machine
from ..model import machine_path
from .check import difference

_EXAMPLE = """\
Names stand at the left, values and comments in columns; there is one blank line at most, and none at the end. Entries,
their order, their values and comments stay what they are, and so do encoding and line ends.
The exit status is 0, with --check or --diff 1 if a list is not in its layout, 2 if lists cannot be read or written.

example:
  axcomp format lists
  axcomp format lists --check
  axcomp format - < achskw1.lis
"""


def add_subparser(subparsers: argparse._SubParsersAction[argparse.ArgumentParser]) -> None:
    """Add the sub-command."""
    parser = subparsers.add_parser("format", description="Write lists in a layout.", epilog=_EXAMPLE)
    parser.add_argument(
        "paths", type=machine_path, nargs="*", metavar="PATH", help="as for axcomp check (default: the current folder)"
    )
    either = parser.add_mutually_exclusive_group()
    either.add_argument("--check", action="store_true", help="write nothing; say which lists would change")
    either.add_argument("--diff", action="store_true", help="write nothing; print what would change")
    parser.add_argument("-q", "--quiet", action="store_true", help="do not say which lists were written")
    parser.set_defaults(do=_do_format)


def _do_format(options: argparse.Namespace) -> int:
    try:
        return _format(options)
    except (SettingsError, ValueError, OSError) as error:
        place = f"{error.filename}: " if isinstance(error, OSError) and error.filename else ""
        reason = error.strerror if isinstance(error, OSError) and error.strerror else error
        print(f"axcomp format: {place}{reason}", file=sys.stderr)
        return 2


def _format(options: argparse.Namespace) -> int:
    paths = options.paths or [Path()]
    if paths == [Path("-")]:
        document = Document("-", sys.stdin.buffer.read())
        reading = read_machine("-", documents=[document], beside_disk=True)
        text = formatted(next(iter(reading.documents.values()), document))
        sys.stdout.write(document.text if text is None else text)
        return 0
    changed = 0
    for path, found in find_machines(paths, find_settings(paths[0])):
        reading = found or read_machine(path)
        missing = [one for one in reading.findings if one.code in ("AXC-MISSING", "AXC-UNREADABLE") and not one.line]
        if missing:
            raise ValueError(str(missing[0]))
        for document in reading.documents.values():
            text = formatted(document)
            if text is None or text == document.text:
                continue
            changed += 1
            document.replace_text(text)
            if options.diff:
                print("".join(difference(document)), end="")
            elif options.check or not options.quiet:
                print(f"{document.path}: {'not in its layout' if options.check else 'written'}")
            if not (options.check or options.diff):
                document.save()
    return int(changed > 0 and (options.check or options.diff))
