"""One axis: fine interpolation, cascaded position, velocity and current control, a mass with friction.

The equations, with q the position of the mass, i the current, r the interpolated setpoint::

    e = velocity_gain · (r' + position_gain · (r − q) − q')
    i* = (r'' + e + ∫e dt / integral_time) / α + additive current, limited to ± current_limit
    i' = (i* − i) / current_time
    q'' = α · i − friction                    (see ``friction``)

α = force constant / mass, β = 1 / mass, in mm and s (° and s for a rotary axis with inertia and torque).
"""

from __future__ import annotations

import math
from collections.abc import Mapping
from typing import Any

from .friction import friction_of

STATE = ("position", "velocity", "integral", "current", "setpoint", "reference", "acceleration", "lag", "deflection")
"""What a drive remembers; all of them floats."""


class Drive:
    """A drive with its mass, in mm or °, s and mA.

    ``position`` and ``velocity`` are those of the mass, as the encoder sees it; ``acceleration`` is the mean over the
    last step; ``current`` that of the motor; ``lag``, interpolated setpoint − position, the following error;
    ``power``, W: what friction turns into heat, mean over the last step.
    """

    def __init__(self, description: Mapping[str, Any], rotary: bool, modulo: float, memoryless: bool = False) -> None:
        control, friction = description["drive"], description["friction"]
        inertia, per_unit = (control["inertia"], math.degrees(1.0)) if rotary else (control["mass"], 1000.0)
        constant = control["torque_constant"] if rotary else control["force_constant"]
        self.gain = per_unit * constant / inertia * 1e-3
        """Acceleration per mA without friction (α)."""
        self.position_gain = float(control["position_gain"])
        self.velocity_gain = float(control["velocity_gain"])
        self.integral_rate = 1.0 / control["integral_time"]
        self.current_time = float(control["current_time"])
        self.current_limit = 1e3 * control["current_limit"]
        self.friction = friction_of(friction, per_unit / inertia, memoryless)
        self.per_power = inertia / per_unit**2
        """W for each mm/s² of friction at 1 mm/s."""
        self.modulo = modulo
        """Range of a modulo axis in °, 0.0 for others."""
        self.acceleration = 0.0
        self.rest_at(0.0)

    def rest_at(self, position: float) -> None:
        """Stand still at a position that is also the setpoint."""
        self.position = self.setpoint = self.reference = position
        self.velocity = self.acceleration = self.integral = self.current = self.lag = self.power = 0.0
        self.deflection = 0.0

    @property
    def deflection(self) -> float:
        """How far friction has given way before it slides, mm or °."""
        return self.friction.deflection

    @deflection.setter
    def deflection(self, value: float) -> None:
        self.friction.deflection = value

    def advance(self, setpoint: float, additive: float, duration: float, count: int) -> None:
        """Move to the setpoint over ``duration`` s in ``count`` equal steps.

        The drive lays a parabola through the middles of the last setpoints, as fine interpolators do, so position,
        velocity and acceleration of the reference agree; it reaches the setpoint half a step after the next call.
        """
        if self._rests(setpoint, additive):
            self.acceleration = self.lag = self.power = 0.0
            return
        gain, limit = self.gain, self.current_limit
        slow_down = self.friction.after
        position_gain, velocity_gain, integral_rate = self.position_gain, self.velocity_gain, self.integral_rate
        position, velocity, integral, current = self.position, self.velocity, self.integral, self.current
        dt = duration / count
        decay = math.exp(-dt / self.current_time)

        if self.modulo:
            # A setpoint that was folded comes back by whole turns: turn the drive's own count along.
            turns = self.modulo * round((setpoint - self.setpoint) / self.modulo)
            position += turns
            self.reference += turns
            self.setpoint += turns
        start, middle, end = self.reference, self.setpoint, 0.5 * (self.setpoint + setpoint)
        velocity_start = 2.0 * (middle - start) / duration
        reference_acceleration = (2.0 * (end - middle) / duration - velocity_start) / duration
        velocity_before, position_before, pushed = velocity, position, 0.0

        for step in range(count):
            t = step * dt
            reference_velocity = velocity_start + reference_acceleration * t
            reference = start + (velocity_start + 0.5 * reference_acceleration * t) * t
            error = velocity_gain * (reference_velocity + position_gain * (reference - position) - velocity)
            demand = (reference_acceleration + error + integral) / gain + additive
            if -limit < demand < limit:
                integral += error * integral_rate * dt
            else:
                demand = max(-limit, min(limit, demand))
            current = demand + (current - demand) * decay
            after = slow_down(velocity, gain * current, dt)
            pushed += current
            position += 0.5 * (velocity + after) * dt
            velocity = after

        self.position, self.velocity, self.integral, self.current = position, velocity, integral, current
        self.acceleration = (velocity - velocity_before) / duration
        friction = gain * pushed / count - self.acceleration
        self.power = abs(self.per_power * friction * (position - position_before) / duration)
        self.setpoint, self.reference = setpoint, end
        self.lag = end - position

    def _rests(self, setpoint: float, additive: float) -> bool:
        """Tell whether nothing can change: no error, no current, no motion."""
        still = (
            self.velocity == 0.0 and self.current == 0.0 and self.integral == 0.0 and additive == 0.0 == self.deflection
        )
        return still and setpoint == self.setpoint and setpoint == self.reference and setpoint == self.position
