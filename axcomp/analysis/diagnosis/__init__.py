"""The diagnosis file of a volumetric compensation (manual 003, 3.5): all records that were read, as a spreadsheet.

``records`` reads the parameter files again, for a machine has forgotten which record came from where; ``workbook``
and ``files`` write what was found and need openpyxl.
"""

from __future__ import annotations

from typing import TYPE_CHECKING

from ...model.face import face

if TYPE_CHECKING:
    from .files import Written as Written, write_diagnoses as write_diagnoses
    from .records import (
        Diagnosis as Diagnosis,
        Record as Record,
        diagnose as diagnose,
        volumetric_lists as volumetric_lists,
        write_named_diagnoses as write_named_diagnoses,
    )
else:
    __all__, __getattr__, __dir__ = face(
        __name__,
        files="Written write_diagnoses",
        records="Diagnosis Record diagnose volumetric_lists write_named_diagnoses",
    )
