"""Specifications: what they mean, and what is said about those that cannot be used."""

import json
from pathlib import Path

import pytest

from axcomp.model import models
from axcomp.sweep import Spec, SpecError, job_of, read_spec

GOOD = {
    "machine": str(models() / "three_axis"),
    "duration": 0.05,
    "input": {"start": {"X": 0}, "moves": [{"X": 1}, {"dwell": 0.01}], "sine": {"Y": {"amplitude": 1, "frequency": 2}}},
    "vary": {"scale X.plane": [0, 1], "achsmd1.lis: lr_param.n_backlash_cyc": {"from": 0, "to": 10, "count": 3}},
    "results": {"peak": "peak X.correction"},
}


def spec_of(folder: Path, content: dict) -> Spec:
    (folder / "sweep.json").write_text(json.dumps(content))
    return read_spec(folder / "sweep.json")


def test_every_combination_is_run_the_last_key_fastest(tmp_path: Path) -> None:
    extra = [{"input X.plane.switch": 1}, {"input X.plane.switch": -1}]
    spec = spec_of(tmp_path, {**GOOD, "runs": extra, "machine": [GOOD["machine"]] * 2})
    runs = list(spec.every_run())
    assert [run.index for run in runs] == list(range(spec.count)) == list(range(24))
    assert [run.machine for run in runs] == [0] * 12 + [1] * 12
    rows = [list(run.values.values()) for run in runs]
    assert rows[:7] == [[1, 0, 0], [1, 0, 5], [1, 0, 10], [1, 1, 0], [1, 1, 5], [1, 1, 10], [-1, 0, 0]]
    assert [s.key for s in spec.settings] == ["input X.plane.switch", *GOOD["vary"]]


def test_toml_and_json_mean_the_same(tmp_path: Path) -> None:
    (tmp_path / "sweep.toml").write_text(
        f"""machine = '{GOOD["machine"]}'
duration = 0.05
[input]
start = {{ X = 0 }}
moves = [{{ X = 1 }}, {{ dwell = 0.01 }}]
sine = {{ Y = {{ amplitude = 1, frequency = 2 }} }}
[vary]
"scale X.plane" = [0, 1]
"achsmd1.lis: lr_param.n_backlash_cyc" = {{ from = 0, to = 10, count = 3 }}
[results]
peak = "peak X.correction"
"""
    )
    one, other = read_spec(tmp_path / "sweep.toml"), spec_of(tmp_path, GOOD)
    assert list(one.every_run()) == list(other.every_run())
    assert one.trajectory == other.trajectory
    assert one.results == other.results


@pytest.mark.parametrize(
    ("change", "key", "said"),
    [
        ({"machin": 1}, "machin", "expected one of machine, cycle_time"),
        ({"machine": 3}, "machine", "expected the path"),
        ({"machine": []}, "machine", "expected the path"),
        ({"machine": "nowhere"}, "machine", "nowhere does not exist"),
        ({"cycle_time": 0}, "cycle_time", "expected a number above 0, not 0"),
        ({"duration": "long"}, "duration", "expected a number, not 'long'"),
        ({"duration": True}, "duration", "expected a number, not True"),
        ({"input": {}}, "input", "nothing moves"),
        ({"input": {"file": "no.csv"}}, "input.file", "cannot be read"),
        ({"input": {"file": 1}}, "input.file", "expected the path of a CSV file"),
        ({"input": {"file": "no.csv", "moves": []}}, "input.moves", "expected one of file"),
        ({"input": {"moves": [{"X": 1}]}}, "input.moves[0].X", "expected an axis of input.start: none"),
        ({"input": {"start": {"X": 0}, "moves": [{"dwell": 1, "X": 2}]}}, "input.moves[0]", "with nothing else"),
        ({"input": {"start": {"X": 0}, "moves": [{"X": 1, "jerk": 0}]}}, "input.moves[0].jerk", "above 0"),
        ({"input": {"sine": {"X": {"amplitude": 1}}}}, "input.sine.X", "expected amplitude and frequency"),
        ({"input": {"sine": {"X": {"amplitud": 1}}}}, "input.sine.X.amplitud", "expected one of centre, amplitude"),
        ({"vary": {"X.leadscrew": [1]}}, 'vary."X.leadscrew"', "expected “LIST: ENTRY”"),
        ({"vary": {"scale X.plane": []}}, 'vary."scale X.plane"', "expected a list of values"),
        ({"vary": {"scale X.plane": ["much"]}}, 'vary."scale X.plane"', "'much' is no factor: expected a number"),
        ({"vary": {"parameter duration": [-1]}}, 'vary."parameter duration"', "expected a number above 0"),
        ({"vary": {"scale X.plane": {"from": 0, "to": 1}}}, 'vary."scale X.plane"', "{ from, to, count }"),
        ({"runs": {}}, "runs", "expected a list of tables"),
        ({"runs": [{"scale X.plane": 1}]}, 'vary."scale X.plane"', "this stands in runs too"),
        ({"results": {}}, "results", "expected at least one"),
        ({"results": {"a": "biggest X"}}, 'results."a"', "expected “REDUCTION NAME”"),
        ({"results": {"error": "max X.correction"}}, 'results."error"', "another column of this name"),
    ],
)
def test_what_is_wrong_is_said_with_file_and_key(tmp_path: Path, change: dict, key: str, said: str) -> None:
    with pytest.raises(SpecError) as caught:
        spec_of(tmp_path, {**GOOD, **change})
    assert str(caught.value).startswith(f"{tmp_path / 'sweep.json'}: {key}: ")
    assert said in str(caught.value)


def test_a_motion_without_an_end_needs_a_duration(tmp_path: Path) -> None:
    content = {**GOOD, "input": {"sine": {"Y": {"amplitude": 1, "frequency": 2}}}}
    del content["duration"]
    with pytest.raises(SpecError, match="duration: expected a number of seconds"):
        spec_of(tmp_path, content)


@pytest.mark.parametrize("text", ["{", "[1]", '{"machine": }'])
def test_what_is_no_specification_is_refused(tmp_path: Path, text: str) -> None:
    (tmp_path / "s.json").write_text(text)
    with pytest.raises(SpecError, match=r"s\.json: (the specification is no JSON|expected an object)"):
        read_spec(tmp_path / "s.json")
    with pytest.raises(SpecError, match=r"none\.toml: the specification cannot be read"):
        read_spec(tmp_path / "none.toml")


@pytest.mark.parametrize(
    ("key", "said"),
    [
        ("achskw9.lis: kw.ssfk.bilateral", "there is no list achskw9.lis"),
        ("achskw1.lis: kw.ssfk.bilaterally", "has no entry kw.ssfk.bilaterally"),
    ],
)
def test_entries_are_tried_before_anything_runs(tmp_path: Path, key: str, said: str) -> None:
    with pytest.raises(SpecError, match=said):
        job_of(spec_of(tmp_path, {**GOOD, "vary": {key: [1]}}))
