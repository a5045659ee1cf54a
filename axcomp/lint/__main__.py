"""Write ``docs/findings.md``: ``python -m axcomp.lint``."""

from ..saving import write_whole
from .codes import PAGE, page

write_whole(PAGE, page())
