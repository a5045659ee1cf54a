"""Write ``docs/fmu-reference.md`` and the variables in ``README.md``: ``python -m axcomp.interface``."""

from ..saving import write_whole
from .reference import PAGE, README, readme_with_section, reference_page

write_whole(PAGE, reference_page())
write_whole(README, readme_with_section(README.read_text(encoding="utf-8")))
