"""Any measurement makes a list that reads back without errors, or a sentence."""

import warnings

import pytest
from hypothesis import HealthCheck, given, settings, strategies as st

from axcomp.cli import main
from axcomp.lists import read_machine

NUMBERS = st.one_of(
    st.integers(-300, 300).map(float),
    st.floats(-1e6, 1e6),
    st.floats(allow_nan=False, allow_infinity=False),
    st.sampled_from([0.0, -0.0, 1e-12, 5e-5, 1e308]),
)
DIRECTION = st.sampled_from(["+", "-"])
RUN = st.integers(1, 3)
ROWS = {
    "leadscrew": (NUMBERS, RUN, DIRECTION, NUMBERS),
    "cross": (NUMBERS, RUN, DIRECTION, NUMBERS),
    "plane": (NUMBERS, NUMBERS, NUMBERS),
    "friction": (NUMBERS, NUMBERS),
    "crosstalk": (NUMBERS, DIRECTION, NUMBERS),
}
MORE = {
    "leadscrew": ["--axis", "1"],
    "cross": ["--axis", "1", "--master", "2"],
    "plane": ["--axis", "1", "--masters", "2", "3"],
    "friction": ["--axis", "1"],
    "crosstalk": ["--axis", "1", "--master", "2"],
}


@pytest.mark.parametrize("kind", ROWS)
@settings(deadline=None, max_examples=30, suppress_health_check=[HealthCheck.function_scoped_fixture])
@given(data=st.data())
def test_any_readings_make_a_plausible_list_or_a_sentence(kind, tmp_path_factory, capsys, data):
    folder = tmp_path_factory.mktemp(kind)
    rows = data.draw(st.lists(st.tuples(*ROWS[kind]), min_size=1, max_size=12))
    (folder / "m.csv").write_text("\n".join(",".join(map(str, row)) for row in rows))
    words = ["--from", str(folder / "m.csv"), "--into", str(folder / "a.lis"), *MORE[kind]]
    bound = data.draw(st.sampled_from([[], ["--bound", "0.5"]]))
    with warnings.catch_warnings():
        warnings.simplefilter("error")
        status = main(["create", kind, *words, *bound])
    out, err = capsys.readouterr()
    if status:
        assert not (folder / "a.lis").exists()
        assert err.count("\n") == 1
    else:
        assert not err
        assert "nan" not in out
        reading = read_machine(folder / "a.lis")
        assert not [finding for finding in reading.findings if finding.severity.value == "error"]
        assert getattr(reading.machine.axes[0], kind) is not None
