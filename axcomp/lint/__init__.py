"""Lists judged as a linter does: which machines, which findings, in which format, and what can be mended by itself."""

from __future__ import annotations

from typing import TYPE_CHECKING

from ..model.face import face

if TYPE_CHECKING:
    from .baseline import Baseline as Baseline
    from .codes import (
        PAGE as PAGE,
        Page as Page,
        explained as explained,
        help_address as help_address,
        page as page,
        pages as pages,
    )
    from .fixes import Fix as Fix, fixed as fixed, fixes_of as fixes_of
    from .formats import FORMATS as FORMATS, written as written
    from .layout import formatted as formatted
    from .machines import Checked as Checked, check_machine as check_machine, find_machines as find_machines
    from .selection import Selection as Selection
    from .settings import Settings as Settings, SettingsError as SettingsError, find_settings as find_settings
    from .text import Style as Style, as_text as as_text
else:
    __all__, __getattr__, __dir__ = face(
        __name__,
        baseline="Baseline",
        codes="PAGE Page explained help_address page pages",
        fixes="Fix fixed fixes_of",
        formats="FORMATS written",
        layout="formatted",
        machines="Checked check_machine find_machines",
        selection="Selection",
        settings="Settings SettingsError find_settings",
        text="Style as_text",
    )
