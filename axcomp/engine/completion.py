"""What a trajectory does not say but its setpoints do: velocities, accelerations, and the velocities to come.

A run with setpoints only must not lose friction and crosstalk without a word (semantics §4), and whoever has the whole
trajectory knows what comes after a cycle (semantics §9).
"""

from __future__ import annotations

from collections.abc import Iterable, Mapping, Sequence
from typing import TYPE_CHECKING, Any

import numpy as np

from ..interface import Variable

if TYPE_CHECKING:
    from numpy.typing import ArrayLike, NDArray

SETPOINT, VELOCITY, ACCELERATION = "setpoint", "velocity", "acceleration"
AHEAD_KNOWN, AHEAD = "ahead_known", "velocity_ahead"


def completed(
    trajectory: Mapping[str, ArrayLike],
    variables: Iterable[Variable],
    cycle_time: float,
    before: Sequence[tuple[float, float] | None],
    modulo: Sequence[float],
) -> tuple[dict[str, ArrayLike], list[str]]:
    """Return a trajectory with what follows from it, and what there is to say about that.

    Parameters
    ----------
    trajectory : mapping of str to array_like, shape (n,)
        Inputs by name.
    variables : iterable of Variable
        Of the machine.
    cycle_time : float
        s.
    before : sequence of (float, float) or None
        Setpoint and velocity of each axis in the last cycle; None: there was none.
    modulo : sequence of float
        After how many ° the positions of each axis repeat, 0: they do not.
    """
    found: dict[str, ArrayLike] = dict(trajectory)
    inputs: dict[int, dict[str, str]] = {}
    for variable in variables:
        if variable.axis is not None and variable.causality == "input":
            inputs.setdefault(variable.axis, {})[variable.quantity] = variable.name
    derived = []
    for index, names in inputs.items():
        if names[SETPOINT] in found:
            setpoint = np.asarray(found[names[SETPOINT]], dtype=float)
            last = before[index] or (float(setpoint[0]) if len(setpoint) else 0.0, 0.0)
            derived += _derive(found, names, setpoint, last, cycle_time, modulo[index])
        if names[VELOCITY] in found:
            _look_ahead(found, names, np.asarray(found[names[VELOCITY]], dtype=float))
    said = f"{', '.join(derived)} not given: derived from the setpoints by differences over a cycle."
    return found, [said] if derived else []


def _derive(
    found: dict[str, ArrayLike],
    names: Mapping[str, str],
    setpoint: NDArray[Any],
    last: tuple[float, float],
    cycle_time: float,
    modulo: float,
) -> list[str]:
    """Add velocity and acceleration where they are missing, by backward differences; return their names."""
    missing = [names[name] for name in (VELOCITY, ACCELERATION) if names[name] not in found]
    if names[VELOCITY] in missing:
        found[names[VELOCITY]] = differences(setpoint, last[0], cycle_time, modulo)
    if names[ACCELERATION] in missing:
        velocity = np.asarray(found[names[VELOCITY]], dtype=float)
        found[names[ACCELERATION]] = differences(velocity, last[1], cycle_time)
    return missing if np.any(setpoint != last[0]) else []


def differences(values: NDArray[Any], before: float, cycle_time: float, modulo: float = 0.0) -> NDArray[Any]:
    """Return the backward differences per s, (n,), of values (n,) that repeat after ``modulo``, 0: do not."""
    way = np.diff(values, prepend=before)
    if modulo > 0.0:
        way -= modulo * np.floor(way / modulo + 0.5)
    found: NDArray[Any] = way / cycle_time
    return found


def _look_ahead(found: dict[str, ArrayLike], names: Mapping[str, str], velocity: NDArray[Any]) -> None:
    """Add the velocities to come for the compensations that need them; the last one goes on."""
    ahead = [name for name in names if name.startswith(AHEAD)]
    if not ahead or any(names[name] in found for name in (*ahead, AHEAD_KNOWN)):
        return
    found[names[AHEAD_KNOWN]] = np.full(len(velocity), True)
    for n, name in enumerate(sorted(ahead), 1):
        found[names[name]] = np.concatenate([velocity[n:], np.repeat(velocity[-1:], min(n, len(velocity)))])
