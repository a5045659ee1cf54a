"""The kinds that lists can be made for: found by name, declared in one module each."""

import argparse
from dataclasses import fields
from pathlib import Path

import pytest

import axcomp.fit
from axcomp.cli.create import add_subparser
from axcomp.fit import FITS, Options, fit_of
from axcomp.kinds import KINDS


def test_every_module_named_like_a_kind_is_a_fit():
    modules = {path.stem for path in Path(axcomp.fit.__file__).parent.glob("*.py")}
    assert set(FITS) == modules & {*KINDS, "volumetric"}
    assert set(FITS) == {"leadscrew", "backlash", "cross", "plane", "friction", "crosstalk", "volumetric"}


@pytest.mark.parametrize("kind", FITS)
def test_the_example_of_a_kind_is_understood_and_its_options_reach_the_fit(kind):
    fit = fit_of(kind)
    assert fit.name == kind
    parser = argparse.ArgumentParser(exit_on_error=False)
    add_subparser(parser.add_subparsers())
    for line in fit.example.splitlines():
        given = vars(parser.parse_args(line.split()[1:]))
        assert given["fit"] is fit
        taken = {item.name for item in fields(Options)} | {"axis", "name", "chain", "axes", "workpiece_axes"}
        taken |= {"tool_position", "tool_orientation", "map", "cycle_time"}
        common = {"do", "fit", "files", "into", "output", "dry_run", "plot", "format", "measured"}
        assert set(given) - common <= taken
