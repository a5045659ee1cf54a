"""Volumetric compensations from deviations of the tool tip, as a laser tracker measures them."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, replace
from pathlib import Path
from typing import TYPE_CHECKING, Any

import numpy as np

from ..engine.motion import Array
from ..lists.saving import write_whole
from ..model.quantity import shown
from ..model.volumetric import ERRORS, LETTERS, LINEAR, Volumetric, is_angle
from ..plot.style import labelled
from .creation import LEFT_OUT, MEASURED, PREDICTED, CannotCreateError, Creation, leave_one_run_out
from .volumetric_identification import NODES_MAX, Identification, Identifier
from .volumetric_model import TcpDeviations
from .volumetric_target import VolumetricTarget

if TYPE_CHECKING:
    from matplotlib.axes import Axes

UNIT = "µm"
SHOWN = {
    "largest": "largest distance",
    "rms": "root mean square distance",
    **{f"rms_{letter}": f"root mean square in {letter}" for letter in LINEAR},
}
"""Figures of tool tip deviations: of their amounts and by direction."""


@dataclass(frozen=True, eq=False, kw_only=True)
class VolumetricCreation(Creation):
    """A parameter file with identified errors; see ``Creation``.

    Attributes
    ----------
    identification : Identification
        The errors with uncertainties and covariance, and what the data do not tell apart.
    list_path : Path
        The list that names the parameter file, ``path``.
    list_data : bytes or None
        The list, where it is new or has to change.
    """

    identification: Identification
    list_path: Path
    list_data: bytes | None

    def write(self, path: str | Path | None = None) -> Path:
        """Write the parameter file, in its place or elsewhere, and the list if it is new; return the former's place."""
        target = super().write(path)
        if self.list_data is not None and path is None:
            write_whole(self.list_path, self.list_data)
        return target

    def errors(self) -> list[dict[str, Any]]:
        """Return the errors with nodes (mm, °), values and expanded uncertainties (k = 2) in µm or µrad."""
        found = []
        rows = zip(self.identification.sought, self.identification.values, self.identification.uncertainty, strict=True)
        for sought, values, uncertainty in rows:
            factor, unit = shown("rad" if is_angle(sought.name) else "mm")
            found.append(
                {
                    "name": sought.name,
                    "over": sought.argument,
                    "nodes": sought.nodes.tolist() if sought.argument else [],
                    "unit": unit,
                    "values": (values * factor).tolist(),
                    "uncertainty": (uncertainty * factor).tolist(),
                }
            )
        return found

    def to_dict(self) -> dict[str, Any]:
        """Return everything for JSON."""
        found = self.identification
        return {
            **super().to_dict(),
            "errors": self.errors(),
            "redundant": [{"name": r.name, "part": r.part, "others": list(r.others)} for r in found.redundancies],
            "scatter": found.scatter,
            "degrees_of_freedom": found.degrees_of_freedom,
            "determined": [[name, node] for name, node in found.kept],
            "covariance": found.covariance.tolist(),
        }


def create_volumetric(
    measurement: TcpDeviations,
    target: VolumetricTarget,
    names: Sequence[str] | None = None,
    nodes_max: int = NODES_MAX,
    scatter: float | None = None,
) -> VolumetricCreation:
    """Identify the errors of a machine and put them into the parameter file of a volumetric list.

    Parameters
    ----------
    measurement : TcpDeviations
        Without any volumetric compensation.
    target : VolumetricTarget
        Errors in it that are not sought are taken as known.
    names : sequence of str, optional
        The errors that are sought; without it all of the axes in the chain.
    nodes_max : int
        Values of a component error at most.
    scatter : float, optional
        Standard deviation of a reading, µm; without it, it comes from the residuals.

    Raises
    ------
    CannotCreateError
        The measurement does not suffice.
    """
    identifier = Identifier(measurement, target.volumetric, names, nodes_max, scatter)
    found = identifier.fit()
    fitted = {sought.name for sought in found.sought}
    known = [table for table in target.volumetric.errors if table.name not in fitted]
    tables = sorted([*known, *found.tables()], key=lambda table: ERRORS.index(table.name))
    # Values in the files are written as they are; beyond a picometre there is nothing to be known.
    volumetric = replace(target.volumetric, errors=tuple(replace(t, values=_plain(t.values)) for t in tables))
    figures = {MEASURED: _figures(measurement.deviations), PREDICTED: _figures(found.residuals)}
    notes = _unmoved(target.volumetric, measurement)
    if np.ptp(measurement.tool_lengths) > 0.0 and not any(target.volumetric.tool_orientation):
        notes.append("The tool length has no effect in the model: the list does not say where the tool points (N0X …).")
    held_out = _held_out(identifier, measurement)
    if held_out is None:
        notes.append("There are not two runs that suffice on their own, so there is no check by leaving runs out.")
    else:
        figures[LEFT_OUT] = _figures(held_out)
    if target.reserved and volumetric.records() > target.reserved:
        notes.append(
            f"The start-up list reserves {target.reserved} records (vol_comp[{volumetric.index}].max_records), "
            f"but there are {volumetric.records()}: the compensation stays off until it reserves them."
        )
    data, list_data = target.with_errors(volumetric)
    return VolumetricCreation(
        kind="volumetric",
        compensation=volumetric,
        path=target.parameters,
        data=data,
        points=volumetric.records(),
        capacity=target.reserved or volumetric.max_records,
        deviation=float(np.max(np.linalg.norm(found.residuals, axis=1))),
        unit=UNIT,
        figures=figures,
        labels=SHOWN,
        notes=tuple(notes),
        draw=lambda ax: _draw(ax, measurement.deviations, found.residuals),
        identification=found,
        list_path=target.path,
        list_data=list_data,
    )


def _plain(values: Sequence[float]) -> tuple[float, ...]:
    return tuple(round(value, 9) + 0.0 for value in values)


def _held_out(identifier: Identifier, measurement: TcpDeviations) -> Array | None:
    """Return what is left of every reading by errors identified without its run, (n, 3), µm."""
    left = np.empty_like(measurement.deviations)

    def amounts(some: Any, others: Any) -> Array:
        left[others] = identifier.left(identifier.fit(some), others)
        return np.zeros(int(others.sum()))

    try:
        checked = leave_one_run_out(measurement.runs, amounts)
    except CannotCreateError:
        return None
    return None if checked is None else left


def _unmoved(volumetric: Volumetric, measurement: TcpDeviations) -> list[str]:
    """Name axes of the chain that stood still: nothing is known about their component errors."""
    spans = dict(zip(LETTERS, np.ptp(measurement.positions, axis=0), strict=True))
    still = [letter for letter in LETTERS if letter in volumetric.chain and not spans[letter]]
    return [f"{letter} did not move: its component errors are not sought." for letter in still]


def _figures(deviations: Array) -> dict[str, float]:
    amounts = np.linalg.norm(deviations, axis=1)
    return {
        "largest": float(amounts.max()),
        "rms": float(np.sqrt(np.mean(amounts**2))),
        **{f"rms_{letter}": float(np.sqrt(np.mean(deviations[:, i] ** 2))) for i, letter in enumerate(LINEAR)},
    }


def _draw(ax: Axes, measured: Array, left: Array) -> None:
    """Draw which share of the readings deviates by how much at most."""
    for colour, label, deviations in (("#c4511a", "measured", measured), ("#0b62a4", "predicted", left)):
        amounts = np.sort(np.linalg.norm(deviations, axis=1))
        share = 100.0 * np.arange(1, len(amounts) + 1) / len(amounts)
        ax.plot(amounts, share, "-", color=colour, lw=1.6, label=label)
    labelled(ax, "", f"deviation of the tool tip, amount [{UNIT}]", "readings that deviate less [%]")
    ax.set_ylim(0.0, 101.0)
    ax.legend(loc="lower right", fontsize=10)
