"""Results of a run: what a text asks for, against NumPy and by hand."""

import numpy as np
import pytest

from axcomp.sweep import Reduction

VALUES = {"a": np.array([1.0, -4.0, 2.0]), "X.b": np.array([0.5, 1.0, -1.0]), "on": np.array([False, True, True])}


@pytest.mark.parametrize(
    ("text", "expected"),
    [
        ("max a", 2.0),
        ("min a", -4.0),
        ("peak a", 4.0),
        ("mean a", -1.0 / 3.0),
        ("rms a", 7.0**0.5),
        ("last a", 2.0),
        ("at 0.002 a", -4.0),
        ("at 0.0039 a", -4.0),
        ("max a - X.b", 3.0),
        ("rms  a−X.b", (0.25 + 25.0 + 9.0) ** 0.5 / 3.0**0.5),
        ("mean on", 2.0 / 3.0),
    ],
)
def test_reductions_are_what_their_names_say(text: str, expected: float) -> None:
    assert Reduction.parse(text).of(VALUES, 0.002) == pytest.approx(expected, abs=1e-15)


def test_an_instant_of_a_cycle_is_that_cycle_whatever_rounding_does() -> None:
    count = 3000
    values = {"n": np.arange(count)}
    for cycle in range(0, count, 7):
        assert Reduction.parse(f"at {cycle * 0.001!r} n").of(values, 0.001) == cycle


@pytest.mark.parametrize(
    "text", ["", "max", "biggest a", "at a", "max 3 a", "max a - ", "at x a", "max a b", "at 1e a"]
)
def test_other_texts_are_refused_with_what_was_expected(text: str) -> None:
    with pytest.raises(ValueError, match="expected “REDUCTION NAME”"):
        Reduction.parse(text)


def test_a_time_behind_the_end_is_refused() -> None:
    with pytest.raises(ValueError, match=r"at 0.01 s: the run ends at 0.004 s"):
        Reduction.parse("at 0.01 a").of(VALUES, 0.002)
