"""``python -m axcomp.fmu FILE.fmu`` or ``FILE.whl``: print its bill of materials."""

import sys
from pathlib import Path

from .archive import BuildError
from .bill import bill_of_archive

if len(sys.argv) != 2:
    sys.exit("usage: python -m axcomp.fmu FILE.fmu|FILE.whl > bom.cdx.json")
try:
    sys.stdout.buffer.write(bill_of_archive(Path(sys.argv[1])))
except BuildError as error:
    sys.exit(f"axcomp: {error}")
