"""``python -m tests.proof [MACHINE …]``: what Frama-C cannot exclude for example machines, and how long it takes."""

from __future__ import annotations

import argparse
import sys
import tempfile
import time
from pathlib import Path

sys.path.insert(0, str(Path(__file__).parent))

from eva import alarms, is_installed

from axcomp.lists import read_machine
from axcomp.model import models

PROVED = ("rotary_table", "warm_axis")


def main() -> int:
    """Analyse machines; return the number of those with alarms, at most 100."""
    parser = argparse.ArgumentParser(prog="python -m tests.proof")
    parser.add_argument(
        "machines", nargs="*", default=PROVED, metavar="MACHINE", help=f"of models/ ({', '.join(PROVED)})"
    )
    parser.add_argument("--minutes", type=float, default=20.0, help="for a machine, at most (20)")
    options = parser.parse_args()
    if not is_installed():
        print("Frama-C is not here: apt-get install frama-c-base", file=sys.stderr)
        return 2
    open_ones = 0
    for name in options.machines:
        begin = time.monotonic()
        with tempfile.TemporaryDirectory() as folder:
            found = alarms(read_machine(models() / name).machine, Path(folder), minutes=options.minutes)
        print(f"{name}: {len(found)} alarms in {time.monotonic() - begin:.0f} s", *found, sep="\n  ")
        open_ones += bool(found)
    return min(open_ones, 100)


if __name__ == "__main__":
    sys.exit(main())
