"""The example machines in ``models/``: their lists, made from simulated measurements, their inputs and outputs.

``python -m axcomp.demo.examples`` writes them again.
"""

from __future__ import annotations

from typing import TYPE_CHECKING

from ...model.face import face

if TYPE_CHECKING:
    from .files import (
        EXPECTED as EXPECTED,
        INPUT as INPUT,
        read_csv as read_csv,
        write_expected as write_expected,
        write_input as write_input,
        write_lists as write_lists,
    )
    from .machines import MACHINES as MACHINES
    from .trajectories import TRAJECTORIES as TRAJECTORIES
else:
    __all__, __getattr__, __dir__ = face(
        __name__,
        files="EXPECTED INPUT read_csv write_expected write_input write_lists",
        machines="MACHINES",
        trajectories="TRAJECTORIES",
    )
