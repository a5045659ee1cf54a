"""``axcomp page``: the page that looks at lists in a browser, as a folder of files."""

from __future__ import annotations

import argparse
import sys
from pathlib import Path

from ..browser import CYCLES, PYODIDE, SiteError, build_site
from ..native import CompilerError

_EPILOG = f"""\
The folder holds everything the page needs: a browser loads it from any file server, with no other connection. Python
for browsers is the npm package pyodide {PYODIDE}, which npm fetches while the page is built.

example:
  axcomp page --output site
  python -m http.server --directory site
"""


def add_subparser(subparsers: argparse._SubParsersAction[argparse.ArgumentParser]) -> None:
    """Add the command."""
    parser = subparsers.add_parser(
        "page",
        description="Build the page that looks at lists in a browser: findings, tables, axes moved by hand.",
        epilog=_EPILOG,
    )
    parser.add_argument("--output", type=Path, default=Path("site"), metavar="FOLDER", help="default: site")
    parser.add_argument("--pyodide", type=Path, metavar="FOLDER", help="of the npm package, instead of fetching it")
    parser.add_argument(
        "--cycles",
        type=int,
        default=CYCLES,
        metavar="N",
        help=f"of each example machine that the page compares its kernel over (default: {CYCLES})",
    )
    parser.set_defaults(do=_do_page)


def _do_page(options: argparse.Namespace) -> int:
    try:
        build_site(options.output, pyodide=options.pyodide, cycles=options.cycles)
    except (CompilerError, SiteError) as error:
        print(f"axcomp page: {error}", file=sys.stderr)
        return 1
    print(f"{options.output}: the page; serve it with: python -m http.server --directory {options.output}")
    return 0
