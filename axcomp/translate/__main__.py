"""Write the kernel's C: ``python -m axcomp.translate``."""

import sys

from .command import main

sys.exit(main())
