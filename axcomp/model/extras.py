"""Packages that only some of what axcomp does needs: the extras of ``pyproject.toml``, and the word for one missing."""

from __future__ import annotations

from collections.abc import Iterable
from importlib import import_module
from importlib.util import find_spec
from typing import Any

_PLOT, _TABLES = ("matplotlib", "rich"), ("openpyxl", "pandas", "pyarrow")
EXTRAS = {
    "plot": _PLOT,
    "python": ("pythonfmu",),
    "tables": _TABLES,
    "frame": ("pandas", "xarray"),
    "completion": ("argcomplete",),
    "interactive": ("plotly",),
    "lsp": ("pygls",),
    "demo": (*_PLOT, "pythonfmu", "fmpy", "scipy"),
    "measure": (*_PLOT, *_TABLES, "scipy"),
    "sweep": (*_PLOT, *_TABLES, "dask", "distributed"),
}
"""What each extra installs, by the name it is imported with, the least one first; NumPy comes with all."""


class MissingExtraError(ModuleNotFoundError):
    """A package is not installed; the sentence says which extra brings it."""


def missing(packages: Iterable[str]) -> list[str]:
    """Return those of some packages that are not installed."""
    return [package for package in packages if find_spec(package) is None]


def extra_with(package: str) -> str:
    """Return the least extra that brings a package, "" if none does."""
    return next((extra for extra, packages in EXTRAS.items() if package.partition(".")[0] in packages), "")


def sentence(package: str, extra: str = "", what: str = "This") -> str:
    """Return what there is to say of a package that is missing."""
    extra = extra or extra_with(package)
    install = f"axcomp[{extra}]" if extra else package
    return f"{what} needs {package.partition('.')[0]}: pip install '{install}'"


def needed(module: str, extra: str = "", what: str = "This") -> Any:
    """Import a module of an extra and return it; MissingExtraError with what to install if it is not there.

    Parameters
    ----------
    module : str
        ``pandas``, ``matplotlib.figure`` …
    extra : str
        The extra to name; "": the least one that brings it.
    what : str
        What needs it, as the sentence begins.

    Examples
    --------
    >>> needed("a_package_nobody_has", "plot", "A picture")
    Traceback (most recent call last):
    axcomp.model.extras.MissingExtraError: A picture needs a_package_nobody_has: pip install 'axcomp[plot]'
    """
    try:
        return import_module(module)
    except ModuleNotFoundError as error:
        if error.name is None or error.name.partition(".")[0] != module.partition(".")[0]:
            raise
        raise MissingExtraError(sentence(module, extra, what), name=error.name) from None
