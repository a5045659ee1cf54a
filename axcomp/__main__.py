"""``python -m axcomp`` is ``axcomp``."""

import sys

from .cli import main

sys.exit(main())
