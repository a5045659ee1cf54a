"""Write ``docs/lists.md``: ``python -m axcomp.lists``."""

from .reference import PAGE, page

PAGE.write_text(page(), encoding="utf-8", newline="\n")
