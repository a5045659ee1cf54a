"""Volumetric compensations from deviations of the tool tip, as a laser tracker measures them."""

from __future__ import annotations

from collections.abc import Iterator, Mapping, Sequence
from dataclasses import replace
from pathlib import Path
from typing import TYPE_CHECKING, Any, ClassVar

import numpy as np
import numpy.typing as npt

from ..engine import Array
from ..model import ERRORS, LETTERS, LINEAR, NO_VECTOR, Volumetric, is_angle, shown
from ..plot import labelled
from .creation import CannotCreateError, Report
from .driver import Fit, Option
from .volumetric_identification import NODES_MAX, Identification, Identifier, TcpDeviations
from .volumetric_target import VolumetricTarget

if TYPE_CHECKING:
    from matplotlib.axes import Axes

UNIT = "µm"


def _of_new(meaning: str, **how: Any) -> Option:
    return {"metavar": "N", "help": f"of a new list: {meaning}", **how}


class VolumetricFit(Fit[TcpDeviations, Identification]):
    """The errors of a machine, identified and put into the parameter file of a volumetric list.

    The measurement is taken without any volumetric compensation. Errors in the list that are not sought are taken as
    known.
    """

    name = "volumetric"
    meaning = "errors of the machine from deviations of the tool tip"
    columns = (
        "columns x, y, z (mm), dx, dy, dz (actual − nominal on the workpiece, µm) and, where there are any, a, b, c "
        "(°), tool_length (mm), run; it is taken without any volumetric compensation"
    )
    example = (
        "axcomp create volumetric --from tracker.csv --into vol_comp0.lis\n"
        "  axcomp create volumetric --from tracker.csv --into vol_comp0.lis --chain YXZ --axes 1 2 3"
    )
    into = "vol_comp*.lis; made if it is not there; --output: where its parameters go"
    arguments: ClassVar = {
        "errors": {"nargs": "+", "metavar": "NAME", "help": "the errors to find (default: all of the chain)"},
        "nodes": {"type": int, "metavar": "N", "help": f"values of an error at most (default: {NODES_MAX})"},
        "scatter": {"type": float, "metavar": "µm", "help": "standard deviation of a reading, where it is known"},
        "chain": _of_new("axes from the workpiece to the tool, e.g. YXZ", default="", metavar="LETTERS"),
        "axes": _of_new("logical numbers in that order", type=int, nargs="+"),
        "workpiece-axes": _of_new("axes that carry it", type=int),
        "tool-position": _of_new("place of the tool tip at length 0, mm", type=float, nargs=3),
        "tool-orientation": _of_new("unit vector to the tip", type=float, nargs=3),
    }
    labels: ClassVar = {
        "largest": "largest distance",
        "rms": "root mean square distance",
        **{f"rms_{letter}": f"root mean square in {letter}" for letter in LINEAR},
    }
    one_run = Fit.few_runs
    read = TcpDeviations.read

    @classmethod
    def open(cls, path: Path, given: Mapping[str, Any]) -> VolumetricTarget:
        """Open the list; kinematics are given for one that does not exist."""
        chain, numbers = given["chain"].upper(), given["axes"] or []
        if path.exists():
            target = VolumetricTarget(path)
            target.check_kinematics(_given(given, chain, numbers))
            return target
        if not chain and not numbers:
            return VolumetricTarget(path)
        if not set("XYZ") <= set(chain) <= set(LETTERS) or len(set(chain)) < len(chain) or len(numbers) != len(chain):
            raise ValueError("--chain names X, Y, Z and some of A, B, C once each, --axes as many logical numbers")
        assigned = dict(zip(chain, numbers, strict=True))
        axes = tuple((letter, assigned[letter]) for letter in LETTERS if letter in assigned)
        position, orientation = (tuple(given[name] or NO_VECTOR) for name in ("tool_position", "tool_orientation"))
        carrying = given["workpiece_axes"] or 0
        new = Volumetric(0, axes, chain, carrying, tool_position=position, tool_orientation=orientation)
        return VolumetricTarget(path, new)

    def prepare(self) -> None:
        """Set up the equations."""
        scatter = self.options.scatter
        nodes = NODES_MAX if self.options.nodes is None else self.options.nodes
        if nodes < 2 or (scatter is not None and not scatter > 0.0):
            raise CannotCreateError("an error has two nodes at least, and the scatter is above 0")
        volumetric = self.target.volumetric
        self.capacity = self.target.reserved or volumetric.max_records
        self.identifier = Identifier(self.readings, volumetric, self.options.errors, nodes, scatter)

    def means(self, readings: TcpDeviations) -> TcpDeviations:
        """Return all readings: each counts on its own."""
        return readings

    def table(self, means: TcpDeviations) -> Identification:  # noqa: ARG002
        """Return the errors that fit all readings."""
        return self.identifier.fit()

    def removed(self, table: Identification, readings: TcpDeviations) -> Array:
        """Return the deviations that the errors explain."""
        return readings.deviations - table.residuals

    def without(self, run: npt.NDArray[np.bool_]) -> Array:
        """Return what is left of a run by errors identified without it, at the same nodes."""
        return self.identifier.left(self.identifier.fit(~run), run)

    def compensation(self, table: Identification) -> Volumetric:
        """Return the kinematics of the list with the errors."""
        found: Volumetric = self.target.volumetric
        fitted = {sought.name for sought in table.sought}
        errors = [*(error for error in found.errors if error.name not in fitted), *table.tables()]
        # Values in the files are written as they are; beyond a picometre there is nothing to be known.
        plain = [replace(error, values=tuple(round(v, 9) + 0.0 for v in error.values)) for error in errors]
        return replace(found, errors=tuple(sorted(plain, key=lambda error: ERRORS.index(error.name))))

    def files(self, compensation: Volumetric) -> dict[Path, bytes]:
        """Return the parameter file, and the list if it is new or has to change."""
        parameters, whole = self.target.with_errors(compensation)
        return {self.target.parameters: parameters, **({} if whole is None else {self.target.path: whole})}

    def points(self, table: Identification) -> int:
        """Return the number of records."""
        return self.compensation(table).records()

    def deviation(self, table: Identification) -> float:
        """Return the largest distance that is left."""
        return float(np.max(np.linalg.norm(table.residuals, axis=1)))

    def figures(self, left: Array) -> dict[str, float]:
        """Return figures of the amounts and by direction."""
        amounts = np.linalg.norm(left, axis=1)
        return {
            "largest": float(amounts.max()),
            "rms": float(np.sqrt(np.mean(amounts**2))),
            **{f"rms_{letter}": float(np.sqrt(np.mean(left[:, i] ** 2))) for i, letter in enumerate(LINEAR)},
        }

    def report(self, table: Identification) -> Report:
        """Return the errors, how well they fit, and what the measurement does not tell."""
        degrees = f"{table.degrees_of_freedom} degrees of freedom"
        fit = f"readings scatter by {table.scatter:.2f} µm around the model, {degrees}."
        untold = [f"  {redundancy}" for redundancy in table.redundancies]
        heading = ["\nWhat the measurement does not tell:"] if untold else []
        errors = _errors(table)
        details = {
            "errors": errors,
            "redundant": [{"name": r.name, "part": r.part, "others": list(r.others)} for r in table.redundancies],
            "scatter": table.scatter,
            "degrees_of_freedom": table.degrees_of_freedom,
            "determined": [[name, node] for name, node in table.kept],
            "covariance": table.covariance.tolist(),
        }
        sentences = (f"{self.points(table)} records; {fit}", *heading, *untold, "")
        return Report(sentences, tuple(self._notes(self.points(table))), tuple(_rows(errors)), details)

    def _notes(self, records: int) -> list[str]:
        volumetric, readings = self.target.volumetric, self.readings
        spans = dict(zip(LETTERS, np.ptp(readings.positions, axis=0), strict=True))
        still = [letter for letter in LETTERS if letter in volumetric.chain and not spans[letter]]
        notes = [f"{letter} did not move: its component errors are not sought." for letter in still]
        if np.ptp(readings.tool_lengths) > 0.0 and not any(volumetric.tool_orientation):
            where = "the list does not say where the tool points (N0X …)."
            notes.append(f"The tool length has no effect in the model: {where}")
        reserved = self.target.reserved
        if reserved and records > reserved:
            notes.append(
                f"The start-up list reserves {reserved} records (vol_comp[{volumetric.index}].max_records), "
                f"but there are {records}: the compensation stays off until it reserves them."
            )
        return notes

    def draw(self, ax: Axes, table: Identification) -> None:
        """Draw which share of the readings deviates by how much at most."""
        shares = (("#c4511a", "measured", self.readings.deviations), ("#0b62a4", "predicted", table.residuals))
        for colour, label, deviations in shares:
            amounts = np.sort(np.linalg.norm(deviations, axis=1))
            share = 100.0 * np.arange(1, len(amounts) + 1) / len(amounts)
            ax.plot(amounts, share, "-", color=colour, lw=1.6, label=label)
        labelled(ax, "", f"deviation of the tool tip, amount [{UNIT}]", "readings that deviate less [%]")
        ax.set_ylim(0.0, 101.0)
        ax.legend(loc="lower right", fontsize=10)


FIT = VolumetricFit


def _given(given: Mapping[str, Any], chain: str, numbers: Sequence[int]) -> dict[str, Any]:
    """Return the kinematics that options give, by the field they are of."""
    found: dict[str, Any] = {"chain": chain} if chain else {}
    if numbers and chain and len(numbers) == len(chain):
        found["axes"] = tuple(sorted(zip(chain, numbers, strict=True), key=lambda one: LETTERS.find(one[0])))
    elif numbers:
        raise ValueError("--axes gives as many logical numbers as --chain names axes")
    for name in ("workpiece_axes", "tool_position", "tool_orientation"):
        if given[name] is not None:
            found[name] = tuple(given[name]) if name != "workpiece_axes" else given[name]
    return found


def _errors(found: Identification) -> list[dict[str, Any]]:
    """Return the errors with nodes (mm, °), values and expanded uncertainties (k = 2) in µm or µrad."""
    errors = []
    for sought, values, uncertainty in zip(found.sought, found.values, found.uncertainty, strict=True):
        factor, unit = shown("rad" if is_angle(sought.name) else "mm")
        errors.append(
            {
                "name": sought.name,
                "over": sought.argument,
                "nodes": sought.nodes.tolist() if sought.argument else [],
                "unit": unit,
                "values": (values * factor).tolist(),
                "uncertainty": (uncertainty * factor).tolist(),
            }
        )
    return errors


def _rows(errors: Sequence[Mapping[str, Any]]) -> Iterator[tuple[str, ...]]:
    """Yield the header, then the largest value of each error and its largest uncertainty."""
    yield "Errors", "over", "largest value", "largest U (k = 2)", "unit"
    for error in errors:
        over = f"{error['over']}, {len(error['nodes'])} nodes" if error["over"] else ""
        value, uncertainty = max(error["values"], key=abs) + 0.0, max(error["uncertainty"])
        yield error["name"], over, f"{value:.2f}", f"{uncertainty:.2f}" if uncertainty else "–", error["unit"]
