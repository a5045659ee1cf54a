"""``axcomp bench``: what a cycle costs, engine and FMUs, compiled and in Python, side by side."""

from __future__ import annotations

import argparse
import json
import platform
import shutil
import sys
import tempfile
from collections.abc import Iterator
from dataclasses import asdict
from pathlib import Path

from ..bench import (
    HistoryError,
    Sample,
    bench_calls,
    bench_engine,
    bench_fmus,
    bench_growth,
    bench_lists,
    bench_memory,
    bench_native_host,
    compared,
    save,
)
from ..fmu import BuildError
from ..lists import read_machine
from ..model import models
from ..native import CompilerError

WIDTH = 130
"""Columns that a name and its figures need in one line."""

EXAMPLE = """example:
  axcomp bench --quick
  axcomp bench --format json > costs.json
  axcomp bench --save docs/performance.md --strict
"""


def add_subparser(subparsers: argparse._SubParsersAction[argparse.ArgumentParser]) -> None:
    """Add the sub-command."""
    parser = subparsers.add_parser(
        "bench",
        description="Measure the cost of a cycle and of a whole trajectory: medians with least and greatest value.",
        epilog=EXAMPLE,
    )
    parser.add_argument("--quick", action="store_true", help="fewer repeats, 10⁴ instead of 10⁶ cycles for memory")
    parser.add_argument("--format", choices=("text", "json"), default="text", help="default: text")
    parser.add_argument("--strict", action="store_true", help="exit code 1 if a goal is missed")
    page = "a page of figures, *.md; the runs it is made of stand beside it, *.json"
    parser.add_argument("--save", type=Path, metavar="PAGE", help=f"write {page}")
    parser.add_argument("--compare", type=Path, metavar="PAGE", help="tell what has changed since the last saved run")
    parser.set_defaults(do=_do_bench)


def _do_bench(args: argparse.Namespace) -> int:
    samples = []
    if args.format == "text":
        print(f"Python {platform.python_version()}, {platform.machine()}; median (least … greatest)")
    for one in _samples(args.quick):
        samples.append(one)
        if args.format == "text":
            print(_line(one), flush=True)
    if args.format == "json":
        print(json.dumps([{**asdict(one), "median": one.median} for one in samples], indent=2, ensure_ascii=False))
    try:
        if args.compare:
            print(*compared(args.compare, samples), sep="\n", file=sys.stderr if args.format == "json" else sys.stdout)
        if args.save:
            save(args.save, samples)
    except (HistoryError, OSError) as error:
        print(f"axcomp bench: {error}", file=sys.stderr)
        return 2
    missed = [one.name for one in samples if one.missed]
    if missed:
        print(f"axcomp bench: goals missed: {len(missed)}: {'; '.join(missed)}", file=sys.stderr)
    return 1 if missed and args.strict else 0


def _samples(quick: bool) -> Iterator[Sample]:
    repeats = 3 if quick else 9
    three = read_machine(models() / "three_axis").machine
    yield from bench_engine(three, "models/three_axis", repeats, 40.0, 1.0)
    yield from bench_calls(three, "models/three_axis", repeats)
    yield from bench_engine(read_machine(models() / "five_axis").machine, "models/five_axis", repeats, 250.0)
    with tempfile.TemporaryDirectory() as folder:
        try:
            yield from bench_fmus(models() / "three_axis", Path(folder), repeats)
        except BuildError as error:
            print(f"axcomp bench: {error}", file=sys.stderr)
    try:
        yield from bench_native_host(repeats)
    except CompilerError as error:
        print(f"axcomp bench: {error}", file=sys.stderr)
    yield from bench_growth(repeats)
    yield from bench_lists(repeats)
    yield from bench_memory(three, 10_000 if quick else 1_000_000)


def _line(one: Sample) -> str:
    goal = "" if one.goal is None else f"   {one.at} {one.goal:g} {one.unit}{'   MISSED' if one.missed else ''}"
    figures = f"{one.median:9.3f} {one.unit:2} ({one.low:.3f} … {one.high:.3f}){goal}"
    wide = shutil.get_terminal_size((160, 25)).columns >= WIDTH
    return f"{one.name:66} {figures}" if wide else f"{one.name}\n    {figures}"
