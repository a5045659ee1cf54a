"""Volumetric compensations from deviations of the tool tip, as a laser tracker measures them."""

from __future__ import annotations

from collections.abc import Iterator, Mapping, Sequence
from dataclasses import replace
from pathlib import Path
from typing import TYPE_CHECKING, Any, ClassVar, Self

import numpy as np
import numpy.typing as npt

from ..engine import Array, TcpModel
from ..measurement import Outlier
from ..model import ERRORS, LETTERS, LINEAR, NO_VECTOR, Volumetric, is_angle, shown
from ..plot import labelled
from .creation import CannotCreateError, Report
from .driver import Fit, Option
from .volumetric_algebra import MICRO
from .volumetric_identification import HELD, NODES_MAX, Identifier
from .volumetric_readings import TcpDeviations
from .volumetric_result import Identification
from .volumetric_target import VolumetricTarget

if TYPE_CHECKING:
    from matplotlib.axes import Axes

UNIT = "µm"
_FAR, _QUARTILE, _SHARE, _ROUNDS = 8.0, 1.0 / 1.1503, 0.1, 10
"""Standard deviations a reading is off the model to stand apart; 3/4 of normal ones are within 1.15 of them; the share
of readings that can be outliers at most; rounds in which they are looked for."""
_FINEST = 0.5
"""µm; smaller ones do not count."""
_SAMPLE = 500
"""Places at which the uncertainty of the tip is looked at."""


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
        "columns x, y, z (mm), where there are any a, b, c (°), tool_length (mm), run, and one of: dx, dy, dz (actual "
        "− nominal on the workpiece, µm); px, py, pz (point in the frame of a tracker, mm) and station; length (mm, of "
        "a ball-bar) and station; displacement (mm, of a laser tracer, but for its dead path) and station; sphere, its "
        "number, for where the axes stand with the tip at its centre, with dx, dy, dz (µm) of an R-test. Files of all "
        "these go together. It is taken without any volumetric compensation"
    )
    example = (
        "axcomp create volumetric --from tracker.csv --into vol_comp0.lis\n"
        "  axcomp create volumetric --from tracker.csv --into vol_comp0.lis --chain YXZ --axes 1 2 3"
    )
    into = "vol_comp*.lis; made if it is not there; --output: where its parameters go"
    arguments: ClassVar = {
        "errors": {
            "nargs": "+",
            "metavar": "NAME",
            "help": "errors and centres (PXC) to find (default: all of the chain)",
        },
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

    def outliers(self) -> Sequence[Outlier]:
        """Return readings that are further off the model than all others scatter."""
        found: list[Outlier] = []
        left = np.ones(len(self.readings.runs), dtype=bool)
        for _ in range(_ROUNDS):
            try:
                residuals = self.identifier.left(self.identifier.fit(left), np.ones_like(left))
            except CannotCreateError:
                return ()
            told = residuals[np.any(residuals != 0.0, axis=1)]
            scatter = _QUARTILE * float(np.quantile(np.abs(told[told != 0.0]), 0.75)) if told.any() else 0.0
            off = np.abs(residuals).max(axis=1)
            # A gross error pulls others with it: of one round only those half as far off as the worst are taken.
            new = np.flatnonzero(left & (off > max(_FAR * scatter, 0.5 * float(off[left].max()), _FINEST)))
            if not len(new) or len(found) + len(new) > _SHARE * len(left):
                break
            for i in new:
                at = ", ".join(
                    f"{letter} {self.readings.positions[i, LETTERS.index(letter)]:g}" for letter in self.readings.given
                )
                size = float(residuals[i, np.argmax(np.abs(residuals[i]))])
                found.append(Outlier(int(i), int(self.readings.runs[i]), at, size, _FAR * scatter, UNIT))
            left[new] = False
        return found

    def moved(self, other: Self) -> float:
        """Return how far the modelled tip is from that of a fit of some of the readings, at most, µm."""
        models = [TcpModel(one.compensation(one.table(one.readings))) for one in (self, other)]
        positions, lengths = self.readings.positions, self.readings.tool_lengths
        tips = [model.deviations(at := model.places(positions), lengths, model.known_errors(at)) for model in models]
        return float(np.max(np.abs(tips[0] - tips[1]))) * MICRO

    def means(self, readings: TcpDeviations) -> TcpDeviations:
        """Return all readings: each counts on its own."""
        return readings

    def table(self, means: TcpDeviations) -> Identification:  # noqa: ARG002
        """Return the errors that fit all readings."""
        return self.identifier.fit()

    def measured(self, readings: TcpDeviations) -> Array:  # noqa: ARG002
        """Return what a machine without errors does not explain."""
        return self.identifier.measured

    def removed(self, table: Identification, readings: TcpDeviations) -> Array:  # noqa: ARG002
        """Return what the errors explain of all readings."""
        return self.identifier.measured - table.residuals

    def without(self, run: npt.NDArray[np.bool_]) -> Array:
        """Return what is left of a run by errors identified without it, at the same nodes."""
        if any(run[one.rows].all() for one in self.identifier.observations.unknowns):
            raise CannotCreateError("a station was used in one run only: without it nothing is known of its place")
        return self.identifier.left(self.identifier.fit(~run), run)

    def compensation(self, table: Identification) -> Volumetric:
        """Return the kinematics of the list with the errors."""
        found: Volumetric = self.target.volumetric
        fitted = {sought.name for sought in table.sought}
        errors = [*(error for error in found.errors if error.name not in fitted), *table.tables()]
        # Values in the files are written as they are; beyond a picometre there is nothing to be known.
        found = replace(found, centers=table.centers(found.centers))
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
        sample = self.readings.positions[:: -(-len(self.readings.runs) // _SAMPLE)]
        tip = self.identifier.tip_uncertainty(table, sample, float(np.median(self.readings.tool_lengths)))
        known = f"The modelled tip is known within {np.median(tip):.2f} µm, {tip.max():.2f} µm at worst (95 %)."
        details = {
            "errors": errors,
            "redundant": [{"name": r.name, "part": r.part, "others": list(r.others)} for r in table.redundancies],
            "scatter": table.scatter,
            "degrees_of_freedom": table.degrees_of_freedom,
            "determined": [[name, node] for name, node in table.kept],
            "covariance": table.covariance.tolist(),
            "regularized": list(table.regularized),
            "stations": [{"name": name, "values": values.tolist()} for name, values in table.unknowns],
            "tip_uncertainty": {"largest": float(tip.max()), "median": float(np.median(tip))},
        }
        sentences = (f"{self.points(table)} records; {fit}", known, *heading, *untold, "")
        return Report(sentences, tuple(self._notes(table)), tuple(_rows(errors)), details)

    def _notes(self, table: Identification) -> list[str]:
        records = self.points(table)
        volumetric, readings = self.target.volumetric, self.readings
        spans = dict(zip(LETTERS, np.ptp(readings.positions, axis=0), strict=True))
        still = [letter for letter in LETTERS if letter in volumetric.chain and not spans[letter]]
        notes = [f"{letter} did not move: its component errors are not sought." for letter in still]
        if table.regularized:
            names = ", ".join(table.regularized)
            held = f"within {HELD['length'] * 1e3:g} µm, {HELD['angle'] * 1e6:g} µrad (one standard deviation)"
            notes.append(f"The readings hardly tell {names}: they are held near 0, {held}.")
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
