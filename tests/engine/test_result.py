"""The result of a run as a mapping, a data frame, a dataset and a picture; engines that are copied go on alike."""

from __future__ import annotations

import copy
import pickle
import shutil
from collections.abc import Callable, Mapping
from typing import Any

import numpy as np
import pytest

from axcomp import Engine, ListError, Machine, Result
from axcomp.model import models

THREE = models() / "three_axis"
MOVED = {"X.setpoint": np.linspace(0.0, 20.0, 50), "X.cross.switch": np.zeros(50)}
MOVED.pop("X.cross.switch")


def run() -> Result:
    return Engine(THREE).run(MOVED)


def test_a_result_is_a_mapping_of_its_variables_and_says_what_it_is() -> None:
    result = run()
    assert isinstance(result, Mapping)
    assert set(result) == set(result.keys()) == set(dict(result))
    assert len(result) == len(list(result.values())) > 20
    assert result.cycles == 50
    assert repr(result).startswith("Result(50 cycles of ")
    html = result._repr_html_()
    assert html.count("<tr>") == 21
    assert "30 more rows" in html
    assert "X.correction [mm]" in html


def test_a_frame_and_a_dataset_have_the_same_numbers_and_units() -> None:
    result = run()
    frame, dataset = result.to_frame(), result.to_xarray()
    assert frame.index.name == "time"
    assert list(frame.columns) == list(result) == list(dataset.data_vars)
    assert frame.attrs["units"]["X.correction"] == "mm"
    assert "X.leadscrew.active" not in result.units
    assert dataset["X.correction"].attrs == {"units": "mm"}
    assert dataset["time"].attrs == {"units": "s"}
    for name, values in result.items():
        assert frame[name].to_numpy().tolist() == dataset[name].to_numpy().tolist() == values.tolist()


def test_a_picture_has_a_panel_a_unit_and_names_what_it_does_not_know() -> None:
    result = run()
    figure = result.plot("X.correction", "X.leadscrew.active", "X.current")
    assert [ax.get_ylabel() for ax in figure.axes] == ["[mm]", "on", "bare number"]
    assert figure.axes[-1].get_xlabel() == "time [s]"
    assert len(result.plot().axes) >= 2
    with pytest.raises(KeyError, match=r"Q\.nothing: no output"):
        result.plot("Q.nothing")


COPIES: dict[str, Callable[[Engine], Engine]] = {
    "pickle": lambda engine: pickle.loads(pickle.dumps(engine)),
    "copy": copy.copy,
    "deepcopy": copy.deepcopy,
}


@pytest.mark.parametrize("way", COPIES)
def test_a_copied_engine_goes_on_as_the_first_one_and_apart_from_it(way: str) -> None:
    first = Engine(THREE, 0.002, "flat")
    first.run({"X_setpoint": np.linspace(0.0, 30.0, 40), "command": ["X[COMP OFF LEAD]", *[""] * 39]})
    second = COPIES[way](first)
    back = {"X_setpoint": np.linspace(30.0, -10.0, 60)}
    assert second.time == first.time
    expected = {name: values.tolist() for name, values in second.run(back).items()}
    assert {name: values.tolist() for name, values in first.run(back).items()} == expected
    assert (second.machine, second.findings) == (first.machine, first.findings)


def test_a_copy_holds_what_an_update_brought() -> None:
    engine = Engine(models() / "five_axis")
    engine.run({"X.setpoint": np.linspace(0.0, 100.0, 40)})
    engine.step(command="#VOLCOMP OFF [ID=0]")
    engine.run({"X.setpoint": np.full(60, 100.0)})
    engine.step(command="#VOLCOMP [ID=0 UPDATE]")
    twin = pickle.loads(pickle.dumps(engine))
    there: dict[str, Any] = {"X.setpoint": np.linspace(100.0, 0.0, 40)}
    assert twin.run(there)["X.correction"].tolist() == engine.run(there)["X.correction"].tolist()
    assert twin.step(command="#VOLCOMP [ID=0 UPDATE]") == engine.step(command="#VOLCOMP [ID=0 UPDATE]")


def test_a_copy_may_read_outside_where_the_first_one_may(tmp_path: Any) -> None:
    shutil.copytree(models() / "five_axis", tmp_path / "lists")
    (tmp_path / "lists" / "vol_comp0.csv").rename(tmp_path / "outside.csv")
    named = tmp_path / "lists" / "vol_comp0.lis"
    named.write_text(named.read_text(encoding="utf-8").replace("vol_comp0.csv", "../outside.csv"), encoding="utf-8")
    engine = pickle.loads(pickle.dumps(Engine(tmp_path / "lists", allow_outside=[tmp_path])))
    assert [one.index for one in engine.machine.volumetric] == [0, 1]
    engine.step(command="#VOLCOMP [ID=0 UPDATE]")


def test_an_engine_says_what_it_holds_and_what_is_not_there() -> None:
    engine = Engine(THREE)
    assert repr(engine).startswith("Engine(X: plane, leadscrew, friction; ")
    assert "<td>leadscrew" in Machine(engine.machine.axes[:1])._repr_html_() or "plane" in engine._repr_html_()
    with pytest.raises(ListError, match="nowhere:0: error AXC-MISSING") as caught:
        Engine("nowhere")
    assert [finding.code for finding in caught.value.findings] == ["AXC-MISSING"]


def test_a_folder_without_lists_is_no_engine(tmp_path: Any) -> None:
    with pytest.raises(ListError):
        Engine(tmp_path)
