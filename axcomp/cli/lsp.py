"""``axcomp lsp``: the language server."""

from __future__ import annotations

import argparse

_EXAMPLE = """\
An editor starts it and talks to it over standard input and output; how each editor is told to: docs/linter.md.

example:
  axcomp lsp
"""


def add_subparser(subparsers: argparse._SubParsersAction[argparse.ArgumentParser]) -> None:
    """Add the sub-command."""
    parser = subparsers.add_parser(
        "lsp", description="Serve an editor with the language server protocol.", epilog=_EXAMPLE
    )
    parser.add_argument("--stdio", action="store_true", help="over standard input and output; there is nothing else")
    parser.set_defaults(do=_do_lsp)


def _do_lsp(options: argparse.Namespace) -> int:
    del options
    from ..lsp import serve

    serve()
    return 0
