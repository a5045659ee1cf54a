"""Write ``docs/lists.md``: ``python -m axcomp.lists``."""

from ..saving import write_whole
from .reference import PAGE, page

write_whole(PAGE, page())
