"""The corrections that a machine's model asks for with given errors."""

from __future__ import annotations

import numpy as np

from ...engine.motion import Array
from ...engine.tcp_model import TcpModel
from ...kernel.record import zeros
from ...kernel.volumetric_model import correction_with
from ...model.volumetric import LINEAR


class CorrectionModel(TcpModel):
    """A machine with a volumetric compensation whose errors can be given: what X, Y and Z must move then."""

    def corrections(self, places: Array, tool_lengths: Array, errors: Array) -> Array:
        """Return what X, Y and Z must move so that the tool tip is in its place, (n, 3), mm, with errors (n, 72).

        Whether the lists negate a correction or leave it out is not in it. nan where the position is singular.
        """
        found = np.full((len(places), len(LINEAR)), np.nan)
        rows = zip(found, places.tolist(), tool_lengths.tolist(), errors.tolist(), strict=True)
        for row, place, tool_length, wrong in rows:
            correction = zeros(len(LINEAR))
            if correction_with(self._table, place, tool_length, wrong, correction):
                row[:] = correction
        return found
