"""Builds the FMUs: ``python build_fmu.py --help``. The same as ``axcomp build``, straight from a checkout."""

import sys

from axcomp.cli import main

if __name__ == "__main__":
    sys.exit(main(["build", *sys.argv[1:]]))
