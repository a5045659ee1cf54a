"""Write ``docs/findings.md``: ``python -m axcomp.lint``."""

from .codes import PAGE, page

PAGE.write_text(page(), encoding="utf-8", newline="\n")
