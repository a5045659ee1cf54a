"""``python -m axcomp`` is ``axcomp``."""
# PYTHON_ARGCOMPLETE_OK

import sys

from .cli import main

sys.exit(main())
