"""Errors of machines identified from deviations of the tool tip."""

from dataclasses import replace

import numpy as np
import pytest

from axcomp.engine import TcpModel
from axcomp.fit import CannotCreateError, Identifier, Sought, TcpDeviations, sought_errors
from axcomp.measurement import MeasurementError
from axcomp.model import ErrorTable, Volumetric, is_angle

AXES = (("X", 1), ("Y", 2), ("Z", 3))
TOOL = (10.0, -20.0, -150.0)
PLAIN = Volumetric(0, AXES, "YXZ", tool_position=TOOL, tool_orientation=(0.0, 0.0, -1.0))
X, Y, Z = np.linspace(-400.0, 400.0, 5), np.linspace(-300.0, 300.0, 4), np.linspace(-200.0, 0.0, 4)


def identify(*arguments, **options):
    return Identifier(*arguments, **options).fit()


def places_of(*axes, tools=(0.0, 120.0), runs=1):
    """Return a measurement without deviations at all combinations of positions, (X, Y, Z[, C])."""
    grid = np.stack(np.meshgrid(*axes, indexing="ij"), -1).reshape(-1, len(axes))
    positions = np.zeros((len(grid), 6))
    positions[:, :3] = grid[:, :3]
    positions[:, 5] = grid[:, 3] if len(axes) > 3 else 0.0
    n = len(grid)
    count = len(tools) * runs
    return TcpDeviations(
        np.tile(positions, (count, 1)),
        np.tile(np.repeat(tools, n), runs),
        np.zeros((n * count, 3)),
        np.repeat(np.arange(1, runs + 1), n * len(tools)),
    )


def over(letter, nodes, values, name):
    return ErrorTable(name, tuple(values), letter, tuple((float(node),) for node in nodes))


def simulated(measurement, machine, scatter=0.0, seed=0):
    """Let a machine with errors deviate at the places of a measurement."""
    model = TcpModel(machine)
    places = model.places(measurement.positions)
    deviations = model.deviations(places, measurement.tool_lengths, model.known_errors(places)) * 1e3
    noise = np.random.default_rng(seed).normal(0.0, 1.0, deviations.shape) * scatter
    return replace(measurement, deviations=deviations + noise)


def test_errors_by_the_first_order_formula_are_found():
    """Data by semantics §10 (chain YXZ), not by the model: EXX, EYY, EZZ, C0Y and B0Z with a tool at the flange."""
    measurement = places_of(X, Y, Z, tools=(0.0,))
    x, y, z = measurement.positions[:, :3].T
    exx, eyy, ezz = 0.02 * np.sin(x / 200.0), -0.01 * (y / 300.0) ** 2, 0.008 * z / 200.0
    c0y, b0z = 4e-5, -2e-5
    deviations = np.column_stack([exx - c0y * y + b0z * z, eyy, ezz]) * 1e3
    machine = Volumetric(0, AXES, "YXZ")
    found = identify(replace(measurement, deviations=deviations), machine, ["EXX", "EYY", "EZZ", "C0Y", "B0Z"])
    values = dict(zip([s.name for s in found.sought], found.values, strict=True))
    assert values["EXX"] == pytest.approx(0.02 * np.sin(X / 200.0), abs=2e-6)
    assert values["EYY"] == pytest.approx(-0.01 * (Y / 300.0) ** 2, abs=2e-6)
    assert values["EZZ"] == pytest.approx(0.008 * Z / 200.0, abs=2e-6)
    assert values["C0Y"] == pytest.approx([c0y], abs=1e-8)
    assert values["B0Z"] == pytest.approx([b0z], abs=1e-8)
    assert not found.redundancies


def test_what_is_not_told_apart_is_as_much_as_the_rank_lacks_and_really_makes_no_difference():
    measurement = places_of(X, Y, Z)
    identifier = Identifier(measurement, PLAIN)
    columns = identifier._columns.reshape(3 * len(measurement.runs), -1)
    scaled = columns / np.maximum(np.linalg.norm(columns, axis=0), 1e-12)
    found = identifier.fit()
    assert len(found.kept) == np.linalg.matrix_rank(scaled, tol=1e-6)
    named = {r.name: (r.part, r.others) for r in found.redundancies}
    assert named["A0X"] == named["B0Y"] == named["C0Z"] == ("all of it", ())
    assert named["X0Y"] == ("all of it", ("X0X",))
    assert named["EXX"] == ("its constant part", ("X0X",))
    assert named["EYX"] == ("its constant and linear parts", ("Y0X", "C0X"))
    assert named["EBZ"][0] == "its constant part"
    assert "C0Y" not in named


def test_a_straight_line_named_as_redundant_gives_the_same_deviations_as_the_other_error():
    """EYX = slope · x on one machine and C0X = slope on another: the tool tip cannot tell."""
    measurement = places_of(X, Y, Z)
    slope = 3e-5
    by_line = simulated(measurement, replace(PLAIN, errors=(over("X", X, slope * X, "EYX"),)))
    by_angle = simulated(measurement, replace(PLAIN, errors=(ErrorTable("C0X", (slope,)),)))
    assert by_line.deviations == pytest.approx(by_angle.deviations, abs=1e-3)
    found = identify(by_line, PLAIN, ["EYX", "C0X", "Y0X"])
    values = dict(zip([s.name for s in found.sought], found.values, strict=True))
    assert values["C0X"] == pytest.approx([slope], abs=1e-8)
    assert values["EYX"] == pytest.approx(np.zeros(5), abs=1e-7)


def gauge_free(random):
    """Return errors that are 0 where the identification has them 0."""
    bent = np.array([1.0, 0.5, 0.0, -0.7, 0.0])
    return (
        ErrorTable("X0X", (0.012,)),
        ErrorTable("C0Y", (4e-5,)),
        over("X", X, np.where(X == 0.0, 0.0, random.normal(0.0, 0.01, 5)), "EXX"),
        over("X", X, 0.008 * bent, "EYX"),
        over("X", X, np.where(X == 0.0, 0.0, random.normal(0.0, 3e-5, 5)), "EBX"),
        over("Z", Z, np.append(random.normal(0.0, 0.01, 3), 0.0), "EZZ"),
    )


def test_known_errors_come_back_within_the_stated_uncertainty():
    """Of 12 measurements with 1 µm scatter about 95 % of all values are within U (k = 2)."""
    truth = gauge_free(np.random.default_rng(1))
    measurement = places_of(X, Y, Z)
    exact = simulated(measurement, replace(PLAIN, errors=truth))
    wanted = {table.name: np.array(table.values) for table in truth}
    names = [*wanted, "EYY", "EAX", "A0Z", "Y0X"]
    inside, normal = [], []
    for seed in range(12):
        noise = np.random.default_rng(100 + seed).normal(0.0, 1.0, exact.deviations.shape)
        found = identify(replace(exact, deviations=exact.deviations + noise), PLAIN, names)
        assert found.scatter == pytest.approx(1.0, rel=0.15)
        for sought, values, uncertainty in zip(found.sought, found.values, found.uncertainty, strict=True):
            off = values - wanted.get(sought.name, np.zeros(len(values)))
            free = uncertainty > 0.0
            assert np.all(off[~free] == 0.0)
            inside += list(np.abs(off[free]) <= uncertainty[free])
            normal += list(2.0 * off[free] / uncertainty[free])
    assert 0.91 < np.mean(inside) < 0.985
    assert np.std(normal) == pytest.approx(1.0, abs=0.1)


def test_the_covariance_is_that_of_the_uncertainties():
    measurement = simulated(places_of(X, Y, Z), PLAIN, scatter=2.0)
    found = identify(measurement, PLAIN, ["EXX", "C0Y"], scatter=0.5)
    assert found.scatter == 0.5
    deviations = np.sqrt(np.diag(found.covariance))
    expected = [u for values in found.uncertainty for u in values if u > 0.0]
    assert 2.0 * deviations == pytest.approx(np.array(expected))
    assert len(found.kept) == len(expected)
    assert np.linalg.eigvalsh(found.covariance).min() > 0.0


def test_a_turning_axis_is_identified_all_the_way_round():
    machine = Volumetric(0, (*AXES, ("C", 6)), "CYXZ", 1, tool_position=(0.0, 0.0, -100.0))
    turn = np.arange(0.0, 360.0, 45.0)
    c_axis = np.append(0.006 * np.cos(np.radians(turn)), 0.006)
    truth = (
        ErrorTable("Y0C", (0.02,)),
        ErrorTable("A0C", (5e-5,)),
        over("C", np.append(turn, 360.0), c_axis - c_axis[0], "EZC"),
        over("C", np.append(turn, 360.0), 1e-5 * np.sin(np.radians(np.append(turn, 360.0))), "EBC"),
    )
    measurement = places_of(np.array([-100.0, 150.0]), np.array([-80.0, 120.0]), np.array([0.0]), turn, tools=(0.0,))
    names = ["Y0C", "X0C", "A0C", "EZC", "EBC", "EXC"]
    found = identify(simulated(measurement, replace(machine, errors=truth)), machine, names)
    tables = {table.name: table for table in found.tables()}
    assert np.abs(found.residuals).max() < 1e-3
    assert tables["EZC"].nodes[-1] == (360.0,)
    assert tables["EZC"].values[-1] == tables["EZC"].values[0]
    # What is told apart: the second harmonic of the machine's behaviour, i.e. the tool tip itself.
    again = simulated(measurement, replace(machine, errors=found.tables()))
    assert again.deviations == pytest.approx(
        simulated(measurement, replace(machine, errors=truth)).deviations, abs=1e-3
    )


@pytest.mark.parametrize(
    "turn", [[-180.0, -170.0, -160.0, -150.0, 0.0, 90.0, 180.0], [10.0, 70.0, 130.0, 190.0, 250.0, 310.0, 370.0]]
)
def test_data_over_a_full_turn_make_a_table_that_goes_round(turn):
    machine = Volumetric(0, (*AXES, ("C", 6)), "CYXZ", 1)
    measurement = places_of(np.array([-100.0, 150.0]), np.array([-80.0, 120.0]), np.array([0.0]), turn, tools=(0.0,))
    deviations = np.zeros_like(measurement.deviations)
    # The table carries the workpiece: the tip is seen the opposite way.
    deviations[:, 2] = -6.0 * np.cos(np.radians(measurement.positions[:, 5]))
    found = identify(replace(measurement, deviations=deviations), machine, ["EZC"])
    (table,) = found.tables()
    model = TcpModel(replace(machine, errors=(table,)))
    places = np.zeros((len(turn) * 3, 6))
    places[:, 5] = np.concatenate([np.add(turn, around) for around in (-360.0, 0.0, 360.0)])
    errors = model.known_errors(places)
    assert errors.max(axis=1) + errors.min(axis=1) == pytest.approx(0.006 * np.cos(np.radians(places[:, 5])), abs=1e-9)


def test_errors_that_are_known_stay_and_are_taken_into_account():
    truth = (ErrorTable("C0Y", (5e-5,)), over("X", X, 0.01 * np.sin(X / 100.0), "EXX"))
    measurement = simulated(places_of(X, Y, Z), replace(PLAIN, errors=truth))
    found = identify(measurement, replace(PLAIN, errors=truth[:1]), ["EXX"])
    assert found.values[0] == pytest.approx(np.array(truth[1].values), abs=1e-7)


def test_nodes_are_where_it_was_measured_or_at_equal_distances():
    places = np.zeros((50, 6))
    places[:, 0] = np.arange(50.0)
    few, many = (sought_errors(["EXX"], places[:n], 11)[0] for n in (7, 50))
    assert few.nodes.tolist() == list(range(7))
    assert many.nodes == pytest.approx(np.linspace(0.0, 49.0, 11))
    assert sought_errors(["EXY"], places, 11) == []
    part_of_a_turn = places.copy()
    part_of_a_turn[:, 5] = np.linspace(-90.0, 90.0, 50)
    assert not sought_errors(["EXC"], part_of_a_turn, 5)[0].periodic


def test_weights_go_on_over_a_full_turn():
    sought = Sought("EXC", "C", np.array([0.0, 90.0, 180.0, 270.0]), periodic=True)
    places = np.zeros((3, 6))
    places[:, 5] = [315.0, -45.0, 450.0]
    assert sought.weights(places) == pytest.approx(np.array([[0.5, 0, 0, 0.5], [0.5, 0, 0, 0.5], [0, 1.0, 0, 0]]))


def test_what_cannot_be_is_refused(tmp_path):
    measurement = places_of(X, Y, Z)
    with pytest.raises(CannotCreateError, match="EXC, QQ: no error of an axis of the chain YXZ"):
        identify(measurement, PLAIN, ["EXX", "EXC", "QQ"])
    with pytest.raises(CannotCreateError, match="no column for Z"):
        identify(replace(measurement, given="XY"), PLAIN)
    with pytest.raises(CannotCreateError, match="3 readings are not enough for"):
        identify(measurement.only(np.arange(len(measurement.runs)) == 7), PLAIN, ["X0X", "Y0X", "Z0X"])
    file = tmp_path / "t.csv"
    file.write_text("x,y,z,dx,dy\n1,2,3,4,5\n")
    with pytest.raises(MeasurementError, match=r"t.csv: There is no column for dz."):
        TcpDeviations.read(file)


def test_files_are_read_with_their_units(tmp_path):
    file = tmp_path / "t.csv"
    file.write_text("c [°],x [m],y,z,dx [mm],dy,dz,tool_length,run\n90,0.5,2,3,0.001,2,3,100,4\n")
    found = TcpDeviations.read(file)
    assert found.positions.tolist() == [[500.0, 2.0, 3.0, 0.0, 0.0, 90.0]]
    assert found.deviations.tolist() == [[1.0, 2.0, 3.0]]
    assert (found.tool_lengths.tolist(), found.runs.tolist(), found.given) == ([100.0], [4], "XYZC")


def test_angles_and_lengths_are_told_by_name():
    assert [is_angle(name) for name in ("EXX", "EAX", "C0Y", "Z0C")] == [False, True, True, False]
