"""Try random lists, images, states and sequences of calls for a while.

examples:
  python -m tests.fuzz lists --cases 1000000
  python -m tests.fuzz images --cases 10000000 --seconds 7200
  python -m tests.fuzz all --seconds 600 --seed 5000000

Case k of a seed is case 0 of seed + k: whatever fails is tried again alone. Exit status: 0 nothing was found.
"""

from __future__ import annotations

import argparse
import os
import sys
import tempfile
import time
import traceback
from collections import Counter
from collections.abc import Iterable
from concurrent.futures import ProcessPoolExecutor
from pathlib import Path

from . import lists, native

NATIVE = ("images", "states", "calls")
AT_ONCE = 200


def main() -> int:
    """Run the command; returns the exit status."""
    parser = argparse.ArgumentParser(
        prog="python -m tests.fuzz", description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter
    )
    parser.add_argument("what", choices=("lists", *NATIVE, "all"))
    parser.add_argument("--cases", type=int, default=10**12)
    parser.add_argument("--seconds", type=float, default=60.0, help="for each of them (60)")
    parser.add_argument("--seed", type=int, default=0)
    parser.add_argument("--jobs", type=int, default=max(1, (os.cpu_count() or 2) - 1))
    options = parser.parse_args()
    asked = ("lists", *NATIVE) if options.what == "all" else (options.what,)
    if "lists" in asked and not fuzz_lists(options):
        return 1
    with tempfile.TemporaryDirectory(prefix="fuzz-") as folder:
        program = native.build(Path(folder)) if set(asked) & set(NATIVE) else None
        images = native.seed_images(Path(folder)) if program else []
        for what in (name for name in asked if name in NATIVE and program):
            begin = time.monotonic()
            try:
                said = native.run(program, what, options.cases, options.seconds, options.seed, images)
            except AssertionError as error:
                print(f"{what}, seed {options.seed}:\n{error}")
                return 1
            print(f"{said}, {time.monotonic() - begin:.0f} s", flush=True)
    return 0


def fuzz_lists(options: argparse.Namespace) -> bool:
    """Try lists in several processes; True: nothing was found."""
    begin = time.monotonic()
    told: Counter[str] = Counter()
    failed = []
    first = options.seed
    with ProcessPoolExecutor(options.jobs) as pool:
        while (left := options.seed + options.cases - first) > 0 and time.monotonic() - begin < options.seconds:
            parts = [range(first + AT_ONCE * k, first + AT_ONCE * k + min(AT_ONCE, left)) for k in range(options.jobs)]
            for count, found in pool.map(try_cases, parts):
                told += count
                failed += found
            first = parts[-1].stop
    for case, why in failed[:10]:
        print(f"case {case}: {why}")
    print(
        f"{sum(told.values())} lists, {dict(told)}, {len(failed)} failed, {time.monotonic() - begin:.0f} s", flush=True
    )
    return not failed


def try_cases(cases: Iterable[int]) -> tuple[Counter[str], list[tuple[int, str]]]:
    """Try some lists; return what came of them, and what failed."""
    told: Counter[str] = Counter()
    failed = []
    for case in cases:
        try:
            told[lists.try_case(case)] += 1
        except Exception as error:  # whatever it is: nothing may be raised
            told["failed"] += 1
            place = traceback.extract_tb(error.__traceback__)[-1]
            failed.append((case, f"{type(error).__name__}: {error} ({Path(place.filename).name}:{place.lineno})"))
    return told, failed


if __name__ == "__main__":
    sys.exit(main())
