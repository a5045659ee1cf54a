"""``python -m axcomp.cli`` is ``axcomp``."""

import sys

from . import main

sys.exit(main())
