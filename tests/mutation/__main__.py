"""Change sources one place at a time and see whether their tests notice.

examples:
  python -m tests.mutation --sample 100
  python -m tests.mutation --changed-since origin/main --minutes 10
  python -m tests.mutation axcomp/kernel fmu_src/native/states.c --sample 30 --seed 7
"""

from __future__ import annotations

import argparse
import random
import subprocess
import sys
import tempfile
import time
from collections import Counter
from pathlib import Path

from . import c_mutants, python_mutants
from .areas import Checkout, area_of, sources
from .python_mutants import Mutant

ROOT = Path(__file__).parents[2]


def main() -> int:
    """Run the command; returns the exit status: 1 below the rate asked for, 2 where nothing can be said."""
    options = _parser().parse_args()
    root = options.root.resolve()
    chosen = _chosen(root, options.paths, options.changed_since)
    drawn = _drawn(root, chosen, options.sample, options.seed)
    print(f"{len(drawn)} mutants of {len(chosen)} files, seed {options.seed}", flush=True)
    noticed: Counter[str] = Counter()
    tried: Counter[str] = Counter()
    red: set[str] = set()
    begin = time.monotonic()
    with tempfile.TemporaryDirectory(prefix="mutation-") as folder:
        checkout = Checkout(root, Path(folder))
        for source, mutant in drawn:
            if options.minutes is not None and time.monotonic() - begin > 60.0 * options.minutes:
                print(f"stopped after {options.minutes:g} minutes")
                break
            area = area_of(source)
            if checkout.seconds(source) is None:
                if area not in red:
                    print(f"{area}: its tests fail without any change; left out", flush=True)
                red.add(area)
                continue
            tried[area] += 1
            content = (root / source).read_bytes()
            if checkout.notices(source, mutant.of(content)):
                noticed[area] += 1
            else:
                print(f"{source}:{mutant.line}:{mutant.column(content)}: survived: {mutant}", flush=True)
    _print_table(tried, noticed)
    if red or (drawn and not tried):
        return 2
    return int(100 * noticed.total() < options.at_least * tried.total())


def _parser() -> argparse.ArgumentParser:
    parser = argparse.ArgumentParser(
        prog="python -m tests.mutation", description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter
    )
    parser.add_argument("paths", nargs="*", help="files or folders below the checkout; all sources without")
    parser.add_argument("--sample", type=int, default=100, metavar="N", help="number of mutants, 0: all [100]")
    parser.add_argument("--seed", type=int, default=0, help="of the draw [0]")
    parser.add_argument("--changed-since", metavar="REV", help="only files that differ from this revision")
    parser.add_argument("--minutes", type=float, help="begin no mutant later than this")
    parser.add_argument("--at-least", type=float, default=90.0, metavar="PERCENT", help="rate of noticed mutants [90]")
    parser.add_argument("--root", type=Path, default=ROOT, help="the checkout; it is copied, never changed")
    return parser


def _chosen(root: Path, paths: list[str], revision: str | None) -> list[str]:
    chosen = sources(root)
    if paths:
        wanted = [path.rstrip("/") for path in paths]
        chosen = [source for source in chosen if any(source == one or source.startswith(f"{one}/") for one in wanted)]
        if not chosen:
            sys.exit(f"no source to change in {', '.join(paths)}")
    if revision is not None:
        command = ["git", "diff", "--name-only", "--relative", revision, "--"]
        done = subprocess.run(command, cwd=root, capture_output=True, text=True, check=False)
        if done.returncode != 0:
            sys.exit(f"what has changed since {revision} is not known (a shallow clone?): {done.stderr.strip()}")
        chosen = sorted(set(chosen) & set(done.stdout.splitlines()))
    return chosen


def _drawn(root: Path, chosen: list[str], sample: int, seed: int) -> list[tuple[str, Mutant]]:
    """Return mutants in the order of the draw: what a limit of time leaves is a fair sample too."""
    every = []
    for source in chosen:
        kind = c_mutants if source.endswith(".c") else python_mutants
        every += [(source, mutant) for mutant in kind.mutants((root / source).read_bytes())]
    drawn = random.Random(seed).sample(every, min(sample, len(every)) if sample else len(every))
    return [
        (source, mutant)
        for source, mutant in drawn
        if source.endswith(".c") or python_mutants.compiles(mutant.of((root / source).read_bytes()))
    ]


def _print_table(tried: Counter[str], noticed: Counter[str]) -> None:
    print("\n| area | noticed | of |\n| --- | --- | --- |")
    for area in sorted(tried):
        print(f"| {area} | {noticed[area]} | {tried[area]} |")
    if tried:
        print(f"| all | {noticed.total()} | {tried.total()} |\n")
        print(f"{100 * noticed.total() / tried.total():.0f} % noticed")


if __name__ == "__main__":
    sys.exit(main())
