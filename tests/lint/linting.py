"""What the tests of the linter have in common."""

from collections.abc import Callable, Mapping
from pathlib import Path
from typing import Any

SCREW = """\
kopf.achs_nr 1
kw.ssfk.unit 1
kw.ssfk.interval 100000
kw.ssfk.kw_nr_max 3
kw.ssfk.table[0].pos 1
kw.ssfk.table[1].pos 2
kw.ssfk.table[2].pos 3
"""

Write = Callable[[Mapping[str, str | bytes]], Path]
Check = Callable[..., Any]
