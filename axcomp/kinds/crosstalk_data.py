"""What a crosstalk compensation is, in the new and the old variant, and the names of its entries."""

from __future__ import annotations

from dataclasses import dataclass

from ..model import Compensation
from .units import span

PREFIX = "kw.crosstalk."
_TEST = f"{PREFIX}position[i]."
TEST_FIELDS = {
    "position1": f"{_TEST}ax_1",
    "position2": f"{_TEST}ax_2",
    "accelerate_positive": f"{_TEST}correction_accelerate_dir_pos",
    "accelerate_negative": f"{_TEST}correction_accelerate_dir_neg",
    "decelerate_positive": f"{_TEST}correction_decelerate_dir_pos",
    "decelerate_negative": f"{_TEST}correction_decelerate_dir_neg",
}
CURVE = (f"{PREFIX}table[i].acceleration", f"{PREFIX}table[i].correction")
LIMITS = (f"{PREFIX}acceleration", f"{PREFIX}deceleration")
MODE, MAX_POINTS, DIRECTIONS = f"{PREFIX}mode", f"{PREFIX}max_points", f"{PREFIX}velocity_dependent"
MASTER, OLD_MASTER = f"{PREFIX}master_dyn_ax_nr", f"{PREFIX}master_ax_nr"
ADAPTATION = tuple(f"{PREFIX}master_pos{i}_ax_nr" for i in (1, 2))
LAST_INDEX, CYCLES, MANUAL = f"{PREFIX}last_index", f"{PREFIX}n_cycles", f"{PREFIX}manual_activation"
NEW_ONLY = (*TEST_FIELDS.values(), *LIMITS, MODE, MAX_POINTS, DIRECTIONS, *ADAPTATION)
TESTS_MAX = 15
BEYOND_TESTS = 1.3
"""How far beyond the acceleration of the tests a curve is shown, where it is held."""


@dataclass(frozen=True)
class CrosstalkTest:
    """One acceleration test of the crosstalk compensation (``kw.crosstalk.position[i]``), all in mm.

    Attributes
    ----------
    position1, position2 : float
        Positions of the adaptation axes (P-COMP-00085, P-COMP-00086).
    accelerate_positive, accelerate_negative : float
        Correction at the acceleration of the tests, by direction of motion (P-COMP-00087, P-COMP-00088).
    decelerate_positive, decelerate_negative : float
        Correction at the deceleration of the tests (P-COMP-00089, P-COMP-00090).
    """

    position1: float = 0.0
    position2: float = 0.0
    accelerate_positive: float = 0.0
    accelerate_negative: float = 0.0
    decelerate_positive: float = 0.0
    decelerate_negative: float = 0.0


@dataclass(frozen=True, repr=False)
class Crosstalk(Compensation, kind="crosstalk"):
    """Crosstalk compensation (``kw.crosstalk``) of manual 000: added to the slave while the master accelerates.

    Attributes
    ----------
    master : int
        Logical number of the accelerating axis (P-COMP-00063).
    acceleration, deceleration : float
        Of the tests, mm/s²: > 0 and < 0 (P-COMP-00066, P-COMP-00067).
    mode : int
        1: one test; 2: linear over ``adaptation1``; 3: over both adaptation axes (P-COMP-00082).
    tests : tuple of CrosstalkTest
        1 to 15 of them (P-COMP-00083).
    adaptation1, adaptation2 : int or None
        Logical numbers of the adaptation axes (P-COMP-00080, P-COMP-00081); None where the mode needs none.
    velocity_dependent : bool
        Corrections differ by the direction of the master (P-COMP-00084).
    n_cycles : int
        Cycles of smooth switching, 0..20 (P-COMP-00064).
    manual_activation : bool
        On only by command (P-COMP-00065).
    """

    master: int
    acceleration: float
    deceleration: float
    mode: int
    tests: tuple[CrosstalkTest, ...]
    adaptation1: int | None = None
    adaptation2: int | None = None
    velocity_dependent: bool = False
    n_cycles: int = 0
    manual_activation: bool = False

    def __repr__(self) -> str:
        return f"Crosstalk(master {self.master}, mode {self.mode}, {len(self.tests)} tests)"


@dataclass(frozen=True, repr=False)
class CrosstalkCurve(Compensation, kind="crosstalk"):
    """Crosstalk compensation (``kw.crosstalk``) of manual 001: linear over the master's acceleration.

    Attributes
    ----------
    master : int
        Logical number of the accelerating axis (P-COMP-00063).
    accelerations : tuple of float
        mm/s², strictly ascending, with sign; 1 to 5 of them (P-COMP-00066).
    corrections : tuple of float
        mm, one for each acceleration (P-COMP-00067).
    n_cycles : int
        Cycles of smooth switching, 0..20 (P-COMP-00064).
    manual_activation : bool
        On only by command (P-COMP-00073).
    """

    master: int
    accelerations: tuple[float, ...]
    corrections: tuple[float, ...]
    n_cycles: int = 0
    manual_activation: bool = False

    def __repr__(self) -> str:
        return f"CrosstalkCurve(master {self.master}, {len(self.accelerations)} points {span(self.accelerations)})"
