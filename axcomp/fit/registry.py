"""The kinds of compensation that lists are made for: those that have a module here."""

from __future__ import annotations

from importlib import import_module
from importlib.util import find_spec
from typing import Any

import numpy as np

from ..kinds import KINDS
from ..measurement import Readings
from .creation import CannotCreateError, Creation
from .driver import DROP, KEEP, Fit, Options

FITS: tuple[str, ...] = tuple(name for name in (*KINDS, "volumetric") if find_spec(f".{name}", __package__))
"""The kinds that have a module here."""

_NAMED = 5
"""Outliers in a sentence; there may be more."""


def fit_of(kind: str) -> type[Fit[Any, Any]]:
    """Return how readings become a table of one of ``FITS``; some take long to load."""
    found: type[Fit[Any, Any]] = import_module(f".{kind}", __package__).FIT
    return found


def create(kind: str, readings: Readings, target: Any, options: Options | None = None) -> Creation:
    """Make a list with a new table.

    Parameters
    ----------
    kind : str
        One of ``FITS``.
    readings : Readings
        As ``fit_of(kind).read`` returns them.
    target : TargetList or VolumetricTarget
        As ``fit_of(kind).open`` returns it.
    options : Options, optional
        How it is made.

    Raises
    ------
    CannotCreateError
        The readings do not suffice, the list does not say enough, or the table does not fit.
    MeasurementError
        The list is for another axis.
    """
    options = options or Options()
    fit = fit_of(kind)(readings, target, options)
    found = fit.outliers()
    if not found:
        return fit.create()
    named = f"{readings.source}: " + "; ".join(map(str, found[:_NAMED])) + ("; …" if len(found) > _NAMED else "")
    count = f"{len(found)} reading{'s' if len(found) > 1 else ''} of {len(readings.runs)}"
    if options.outliers == KEEP:
        return fit.create().noted(f"{count} stand apart from their like, and count: {named}.")
    places = [one.place for one in found]
    # What a fit leaves out itself (standstill) is none of the outliers: places are those of its own readings.
    rest = fit.readings.only(~np.isin(np.arange(len(fit.readings.runs)), places))
    without = fit_of(kind)(rest, target, options)
    if options.outliers == DROP:
        return without.create().noted(f"{count} stand apart from their like, and are left out: {named}.")
    raise CannotCreateError(_stopped(fit, without, count, named))


def _stopped(fit: Fit[Any, Any], without: Fit[Any, Any], count: str, named: str) -> str:
    """Say which readings stand apart and what they do to the table and the figures."""
    moved = fit.moved(without)
    with_them, without_them = (one.figures(one.measured(one.readings)) for one in (fit, without))
    figures = ", ".join(
        f"{label} {with_them[name]:.1f} / {without_them[name]:.1f}"
        for name, label in fit.labels.items()
        if np.isfinite(with_them[name]) and np.isfinite(without_them[name])
    )
    return (
        f"{named}. That is {count} that stand apart from their like; the table moves by up to {moved:.2f} {fit.small} "
        f"with them. Figures with / without them: {figures} {fit.small}. --outliers drop leaves them out, "
        f"--outliers keep lets them count"
    )
