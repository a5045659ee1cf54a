"""Crosstalk tables made from acceleration tests."""

from functools import partial

import numpy as np
import pytest
from creating import copied_lists, plant

from axcomp.engine import Engine
from axcomp.fit import LEFT_OUT, PREDICTED, AccelerationTests, CannotCreateError, Options, TargetList, create
from axcomp.lists import read_machine
from axcomp.model import Axis, Machine
from axcomp.plant import acceleration_test

create_crosstalk = partial(create, "crosstalk")
A = 2000.0


def acceleration_tests(places, deflection, accelerations=(A, -A), directions=(1, -1), runs=1, scatter=0.0):
    """Make tests of a deflection(place1, place2, acceleration, direction) in µm."""
    random = np.random.default_rng(6)
    rows = [
        (*place, a, d, deflection(*place, a, d) + random.normal(0.0, scatter), run)
        for run in range(1, runs + 1)
        for place in places
        for a in accelerations
        for d in directions
    ]
    c = np.array(rows)
    return AccelerationTests(c[:, :2], c[:, 2], c[:, 3].astype(int), c[:, 4], c[:, 5].astype(int))


def grid(*axes):
    return [tuple(map(float, place)) for place in np.array(np.meshgrid(*axes)).T.reshape(-1, 2)]


@pytest.fixture
def new_list(tmp_path):
    return TargetList(tmp_path / "new.lis", 2)


OPTIONS = Options(masters=(1, 0), adaptation=(1, 3))


def read_crosstalk(creation):
    creation.write()
    return read_machine(creation.path, strict=True).machine.axes[0].crosstalk


def test_one_place_makes_mode_1_with_all_four_cases(new_list):
    tests = acceleration_tests([(0.0, 0.0)], lambda _, __, a, d: a * (0.004 + 0.001 * d))
    table = read_crosstalk(create_crosstalk(tests, new_list, OPTIONS))
    assert (table.mode, table.master, table.acceleration, table.deceleration) == (1, 1, A, -A)
    assert table.velocity_dependent
    [test] = table.tests
    assert test.accelerate_positive == pytest.approx(-0.010)
    assert test.accelerate_negative == pytest.approx(-0.006)
    assert test.decelerate_positive == pytest.approx(0.010)
    assert test.decelerate_negative == pytest.approx(0.006)


def test_one_direction_makes_a_table_that_knows_none(new_list):
    tests = acceleration_tests([(0.0, 0.0)], lambda _, __, a, ___: a * 0.004, directions=(1,))
    table = read_crosstalk(create_crosstalk(tests, new_list, OPTIONS))
    assert not table.velocity_dependent
    assert table.tests[0].accelerate_positive == pytest.approx(-0.008)


def test_smaller_accelerations_count_in_proportion(new_list):
    tests = acceleration_tests([(0.0, 0.0)], lambda _, __, a, ___: a * 0.004, accelerations=(A, 0.5 * A, -A, -0.25 * A))
    creation = create_crosstalk(tests, new_list, OPTIONS)
    assert creation.compensation.tests[0].accelerate_positive == pytest.approx(-0.008)
    assert creation.figures[PREDICTED]["largest"] < 1e-9


def test_a_line_of_places_is_thinned_to_its_corners(new_list):
    line = [(x, 0.0) for x in np.linspace(-400.0, 400.0, 33)]
    tests = acceleration_tests(line, lambda x, _, a, __: a * 0.005 * (1.0 + abs(x) / 400.0))
    creation = create_crosstalk(tests, new_list, Options(bound=0.2, masters=(1, 0), adaptation=(1, 0)))
    assert [test.position1 for test in creation.compensation.tests] == [-400.0, 0.0, 400.0]
    assert creation.compensation.mode == 2
    assert creation.deviation <= 0.2


def test_a_grid_of_places_is_thinned_to_the_tests_a_list_holds(new_list):
    places = grid(np.linspace(-400, 400, 7), np.linspace(-400, 0, 5))
    tests = acceleration_tests(places, lambda x, z, a, _: a * 0.005 * (1 + (x / 500) ** 2 + (z / 900) ** 2), runs=2)
    creation = create_crosstalk(tests, new_list, OPTIONS)
    assert creation.points <= 14
    assert creation.figures[PREDICTED]["largest"] == pytest.approx(creation.deviation, abs=0.06)
    assert creation.figures[PREDICTED]["largest"] < 1.0
    assert LEFT_OUT in creation.figures
    with pytest.raises(CannotCreateError, match="more than the 14 tests"):
        create_crosstalk(tests, new_list, Options(bound=0.1, masters=(1, 0), adaptation=(1, 3)))


def test_what_is_left_is_what_the_engine_leaves(new_list):
    places = grid([-400.0, 0.0, 300.0], [-200.0, 0.0])
    tests = acceleration_tests(places, lambda x, z, a, d: a * 0.004 * (1 + x / 1000 - z / 700 + 0.1 * d), scatter=1.0)
    creation = create_crosstalk(tests, new_list, OPTIONS)
    machine = Machine((Axis(1, "X"), Axis(2, "Y", crosstalk=read_crosstalk(creation)), Axis(3, "Z")))
    engine = Engine(machine)
    left = []
    for (x, z), a, d, deviation in zip(
        tests.places, tests.accelerations, tests.directions, tests.deviations, strict=True
    ):
        inputs = {"X.setpoint": x, "Z.setpoint": z, "X.velocity": 10.0 * d, "X.acceleration": a}
        left.append(deviation + engine.step(inputs)["Y.crosstalk.correction"] * 1e3)
    assert np.abs(left).max() == pytest.approx(creation.figures[PREDICTED]["largest"], abs=1e-6)


def test_the_plant_s_crosstalk_is_found_again(tmp_path):
    lists = copied_lists(tmp_path / "m")
    before = read_machine(lists).machine.axis("Y").crosstalk
    places = [(-400.0, -400.0), (0.0, -400.0), (-400.0, -200.0)]
    tests = acceleration_tests(
        places,
        lambda x, z, a, d: acceleration_test(plant(), "Y", "X", {"X": x, "Z": z}, a, d) * 1e3,
        accelerations=(2500.0, -2500.0),
    )
    creation = create_crosstalk(tests, TargetList(lists / "achskw2.lis"))
    expected = {(test.position1, test.position2): test for test in before.tests}
    for test in creation.compensation.tests:
        assert test == expected[test.position1, test.position2]
    creation.write()
    assert read_machine(lists, strict=True).machine.axis("Y").crosstalk.n_cycles == before.n_cycles


def test_entries_of_the_old_variant_give_way(tmp_path):
    file = tmp_path / "c.lis"
    file.write_text(
        "kopf.achs_nr 2\nkw.crosstalk.master_ax_nr 1\nkw.crosstalk.last_index 0\n"
        "kw.crosstalk.table[0].acceleration 0\nkw.crosstalk.table[0].correction 0\n"
    )
    tests = acceleration_tests([(0.0, 0.0)], lambda _, __, a, ___: a * 0.004)
    creation = create_crosstalk(tests, TargetList(file))
    creation.write()
    assert not read_machine(file).findings
    assert creation.compensation.master == 1


def test_what_cannot_be_is_refused(new_list):
    def flat(*_):
        return 0.0

    tests = acceleration_tests([(0.0, 0.0)], flat)
    with pytest.raises(CannotCreateError, match="which axis accelerates"):
        create_crosstalk(tests, new_list)
    with pytest.raises(CannotCreateError, match="which axis position1 is of"):
        create_crosstalk(acceleration_tests(grid([0, 1], [0]), flat), new_list, Options(masters=(1, 0)))
    with pytest.raises(CannotCreateError, match="belong in position1"):
        create_crosstalk(acceleration_tests(grid([0], [0, 1]), flat), new_list, OPTIONS)
    with pytest.raises(CannotCreateError, match="decelerations"):
        create_crosstalk(acceleration_tests([(0.0, 0.0)], flat, accelerations=(A,)), new_list, OPTIONS)
    holed = acceleration_tests(grid([0, 5], [0]), flat)
    with pytest.raises(CannotCreateError, match=r"no test \(decelerate, negative direction\) at 5, 0"):
        create_crosstalk(holed.only(np.arange(8) != 7), new_list, OPTIONS)
    scattered = [(float(i), float(i * i)) for i in range(16)]
    with pytest.raises(CannotCreateError, match="fill no grid are not thinned"):
        create_crosstalk(acceleration_tests(scattered, flat), new_list, OPTIONS)


def test_files_are_read_with_and_without_places(tmp_path):
    file = tmp_path / "t.csv"
    file.write_text("acceleration [m/s²],direction,deviation,position1\n-2,neg,3,1.5\n")
    tests = AccelerationTests.read(file)
    assert tests.accelerations.tolist() == [-2000.0]
    assert tests.places.tolist() == [[1.5, 0.0]]
    file.write_text("2000 + 3\n")
    assert AccelerationTests.read(file).deviations.tolist() == [3.0]
