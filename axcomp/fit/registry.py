"""The kinds of compensation that lists are made for: those that have a module here."""

from __future__ import annotations

from importlib import import_module
from importlib.util import find_spec
from typing import Any

from ..kinds import KINDS
from ..measurement import Readings
from .creation import Creation
from .driver import Fit, Options

FITS: tuple[str, ...] = tuple(name for name in (*KINDS, "volumetric") if find_spec(f".{name}", __package__))
"""The kinds that have a module here."""


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
    return fit_of(kind)(readings, target, options or Options()).create()
