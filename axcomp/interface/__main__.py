"""Write ``docs/fmu-reference.md`` and the variables in ``README.md``: ``python -m axcomp.interface``."""

from .reference import PAGE, README, readme_with_section, reference_page

PAGE.write_text(reference_page(), encoding="utf-8")
README.write_text(readme_with_section(README.read_text(encoding="utf-8")), encoding="utf-8")
