"""``axcomp measure`` of circular tests: ISO 230-4."""

from __future__ import annotations

import argparse
import json
import sys
from typing import Any

from ..measurement import CircularResult, CircularTest, MeasurementError, evaluate_circular, joined_tests, read_circular
from .lists import STATUS_MAX


def add_options(parser: argparse.ArgumentParser) -> None:
    """Add what only circular tests need."""
    group = parser.add_argument_group("circular tests")
    group.add_argument("--radius", type=float, metavar="mm", help="nominal radius, where the file does not say it")
    group.add_argument("--feed", type=float, metavar="mm/min", help="where the file does not say it and has times")
    group.add_argument("--set-up", action="store_true", help="F about the centre as it was set up")


def measure(args: argparse.Namespace) -> int:
    """Evaluate the files of a command; return its status."""
    tests: list[CircularTest] = []
    errors = 0
    for path in args.files:
        try:
            tests.append(read_circular(path, args.radius, args.feed))
        except MeasurementError as error:
            print(error, file=sys.stderr)
            errors += 1
    results: list[CircularResult] = []
    try:
        if args.together and tests:
            tests = [joined_tests(tests)]
        results = [evaluate_circular(test, set_up=args.set_up) for test in tests]
        if args.plot is not None and results:
            from matplotlib.figure import Figure  # takes long to load

            from ..plot import save

            drawing = Figure(figsize=(8.0 * len(results), 8.4), dpi=120, layout="constrained")
            for number, result in enumerate(results, 1):
                polar: Any = drawing.add_subplot(1, len(results), number, projection="polar")
                result.plot(polar)
            save(drawing, args.plot)
    except OSError as error:
        print(f"axcomp measure: {error.filename}: {error.strerror}", file=sys.stderr)
        errors += 1
    except MeasurementError as error:
        print(f"axcomp measure: {error}", file=sys.stderr)
        errors += 1
    if args.format == "json":
        print(json.dumps([result.to_dict() for result in results], indent=2, ensure_ascii=False))
    else:
        for result in results:
            print_circular(result)
    return min(errors, STATUS_MAX)


def print_circular(result: CircularResult) -> None:
    """Print the figures and the quadrant peaks of a test."""
    from ..plot import console, figure, table

    out = console()
    rows = [[name, figure(value), unit] for name, (value, unit) in result.figures().items()]
    out.print(table(f"{result.test.source}: ISO 230-4, R = {result.test.radius:g} mm", ["", "", ""], rows))
    ends = list(result.paths[0].peaks)
    arrows = {1: "↺", -1: "↻"}
    peaks = [[arrows[path.direction], *(figure(path.peaks[end]) for end in ends)] for path in result.paths]
    out.print(table("Quadrant peaks in µm, outward positive", ["", *ends], peaks))
    for note in result.notes:
        out.print(f"Note: {note}")
    if result.notes:
        out.print()
