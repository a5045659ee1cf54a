"""``python -m axcomp.demo.examples``: write the files of the example machines again."""

from __future__ import annotations

import argparse

from ...model import models
from .files import write_expected, write_input, write_lists
from .trajectories import TRAJECTORIES


def main() -> None:
    """Write lists (where there is a plant to measure), input and expected output of the models that are named."""
    parser = argparse.ArgumentParser(prog="python -m axcomp.demo.examples", description=main.__doc__)
    parser.add_argument("names", nargs="*", metavar="MODEL", help=f"default: {' '.join(TRAJECTORIES)}")
    names = parser.parse_args().names or list(TRAJECTORIES)
    unknown = sorted(set(names) - set(TRAJECTORIES))
    if unknown:
        parser.error(f"no such model: {', '.join(unknown)}; there are {', '.join(TRAJECTORIES)}")
    for name in names:
        model = models() / name
        for path in (*write_lists(model, model), write_input(model, model), write_expected(model, model)):
            print(path.relative_to(model.parent))


if __name__ == "__main__":
    main()
