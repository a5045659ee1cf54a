"""Numbers of the lists in mm, °, mm/s: one rounding, and encoder increments by the gears of the axes they belong to."""

from collections.abc import Callable
from decimal import Decimal
from fractions import Fraction

import pytest
from hypothesis import given, strategies as st

from axcomp.kinds import METRIC, Gear, Quantity, convert, equidistant, in_list
from axcomp.lists import Reading

ReadLists = Callable[..., Reading]

DECIMALS = st.decimals(allow_nan=False, allow_infinity=False, min_value=-(2**63), max_value=2**63)
GEARS = st.builds(Gear, st.integers(1, 2**32 - 1), st.integers(1, 2**32 - 1))


@given(st.integers(-(2**63), 2**63) | DECIMALS, st.sampled_from((1, 1000, 10_000)), st.just(METRIC) | GEARS)
def test_conversion_rounds_once(value: int | Decimal, divisor: int, gear: Gear) -> None:
    exact = Fraction(value) * gear.numerator / gear.denominator / divisor
    assert convert(value, divisor, gear) == float(exact)


@given(st.integers(-(2**31), 2**31) | DECIMALS, st.integers(0, 2**31) | DECIMALS, GEARS)
def test_even_distances_do_not_accumulate_rounding(start: int | Decimal, step: int | Decimal, gear: Gear) -> None:
    exact = [(Fraction(start) + i * Fraction(step)) * gear.numerator / gear.denominator / 10_000 for i in range(5)]
    assert equidistant(start, step, 5, 10_000, gear) == [float(x) for x in exact]


@given(st.floats(-1e9, 1e9), st.sampled_from((Quantity.POSITION, Quantity.VELOCITY, Quantity.CURRENT)))
def test_what_is_written_converts_back_to_the_same_float(value: float, quantity: Quantity) -> None:
    assert convert(in_list(value, quantity), quantity.divisor) == value


@pytest.mark.parametrize("value", [float("nan"), float("inf"), float("-inf"), 1e308])
def test_what_is_no_number_cannot_be_written(value: float) -> None:
    with pytest.raises(ValueError, match="cannot stand in a list"):
        in_list(value, Quantity.POSITION)


def machine(compensations: str, gears: dict[int, tuple[int, int]]) -> dict[str, str]:
    """Return lists of a machine whose axes have gears (wegaufn, wegaufz) and activate everything."""
    everything = "".join(f"lr_param.{name} 1\n" for name in ("ssfk", "crosscomp", "crosscomp2"))
    axes = {
        f"achsmd{i}.lis": f"kopf.achs_nr {i}\ngetriebe[0].wegaufn {n}\ngetriebe[0].wegaufz {z}\n"
        for i, (n, z) in gears.items()
    }
    axes["achsmd1.lis"] += everything
    return {"achskw1.lis": f"kopf.achs_nr 1\n{compensations}", **axes}


CROSS = "kw.crosscomp.master_ax_nr 2\nkw.crosscomp.table[0].setpoint 1000\nkw.crosscomp.table[0].correction 600\n"
PLANE = """\
kw.crosscomp2.master1_ax_nr 2
kw.crosscomp2.master2_ax_nr 3
kw.crosscomp2.interval 3000
kw.crosscomp2.start_position_master1 1000
kw.crosscomp2.start_position_master2 2000
kw.crosscomp2.table[0][0].correction 600
"""
LEADSCREW = """\
kw.ssfk.kw_nr_max 2
kw.ssfk.interval 100
kw.ssfk.kw_startpos 3000
kw.ssfk.table[0].pos 7
kw.ssfk.table[1].pos 8
"""
GEARED = {1: (2, 3), 2: (5, 1), 3: (1, 2)}


@pytest.mark.parametrize(("unit", "absent"), [("kw.crosscomp.unit 0\n", False), ("", True)])
def test_increments_of_cross_are_the_masters_and_the_slaves(unit: str, absent: bool, read_lists: ReadLists) -> None:
    reading = read_lists(machine(unit + CROSS, GEARED))
    cross = reading.machine.axes[0].cross
    assert cross is not None
    # 1000 increments of axis 2 are 5000 · 0.1 µm, 600 of axis 1 are 400 · 0.1 µm.
    assert (cross.positions, cross.corrections) == ((0.5,), (0.04,))
    assert ("AXC-UNIT" in [f.code for f in reading.findings]) == absent


def test_increments_of_plane_are_those_of_each_axis(read_lists: ReadLists) -> None:
    plane = read_lists(machine(f"kw.crosscomp2.unit 0\n{PLANE}", GEARED)).machine.axes[0].plane
    assert plane is not None
    assert (plane.start1, plane.interval1) == (0.5, 1.5)
    assert (plane.start2, plane.interval2) == (0.1, 0.15)
    assert plane.corrections == ((0.04,),)


def test_increments_of_leadscrew_are_its_own_axis(read_lists: ReadLists) -> None:
    leadscrew = read_lists(machine(f"kw.ssfk.unit 0\n{LEADSCREW}", GEARED)).machine.axes[0].leadscrew
    assert leadscrew is not None
    assert leadscrew.positions == (0.2, float(Fraction(3100 * 2, 3 * 10_000)))
    assert leadscrew.positive == (float(Fraction(14, 30_000)), float(Fraction(16, 30_000)))


def test_metric_lists_have_nothing_to_do_with_the_gear(read_lists: ReadLists) -> None:
    files = machine(f"kw.ssfk.unit 1\n{LEADSCREW}kw.crosscomp.unit 1\n{CROSS}", GEARED)
    axis = read_lists(files).machine.axes[0]
    assert axis.leadscrew is not None
    assert axis.cross is not None
    assert (axis.leadscrew.positions, axis.cross.positions) == ((0.3, 0.31), (0.1,))


def test_increments_are_01_um_where_the_axis_counts_so(read_lists: ReadLists) -> None:
    reading = read_lists(machine(LEADSCREW, {1: (7, 7)}))
    leadscrew = reading.machine.axes[0].leadscrew
    assert leadscrew is not None
    assert leadscrew.positions == (0.3, 0.31)
    assert "AXC-UNIT" not in [f.code for f in reading.findings]


INCREMENTS = 2**20
"""Per revolution of the motor."""
MOTOR = {"incr_per_rev": INCREMENTS, "gear_fact_num": 2, "gear_fact_denom": 1, "feed_const_num": 200_000}
"""The vendor's example: a gear of 2, 20 mm per turn of the load."""
MOTOR_OF_SCREW = {**MOTOR, "gear_fact_num": 3, "gear_fact_denom": 7, "feed_const_denom": 13}


def scaled(gear: dict[str, int], step: int = 0) -> str:
    """Return the entries of a gear step."""
    return "".join(f"getriebe[{step}].{name} {value}\n" for name, value in gear.items())


def one_axis(gear: str, table: str) -> dict[str, str]:
    axis = f"kopf.achs_nr 1\nlr_param.ssfk 1\n{gear}"
    return {"achskw1.lis": f"kopf.achs_nr 1\n{table}", "achsmd1.lis": axis}


def table_at(position: int, unit: str = "kw.ssfk.unit 0\n") -> str:
    return f"{unit}kw.ssfk.kw_nr_max 1\nkw.ssfk.table[0].setpoint {position}\nkw.ssfk.table[0].pos {position}\n"


@pytest.mark.parametrize(
    ("gear", "path_of_an_increment"),
    [
        # R = increments · gear / feed constant, in increments per 0.1 µm; an increment is 1/R of 0.1 µm.
        (MOTOR, Fraction(200_000, INCREMENTS * 2)),
        (MOTOR_OF_SCREW, Fraction(200_000, 13) / (INCREMENTS * Fraction(3, 7))),
        ({"feed_const_num": 100_000}, Fraction(100_000, 1024)),
        ({"feed_const_denom": 4}, Fraction(1, 4 * 1024)),
        # An older build has no entries for the gear but those of the path resolution.
        (
            {"incr_per_rev": 4096, "feed_const_num": 50_000, "wegaufz": 5, "wegaufn": 3},
            Fraction(50_000) / (4096 * Fraction(5, 3)),
        ),
        # Without a feed constant the path resolution alone counts.
        ({"incr_per_rev": 4096, "gear_fact_num": 2, "wegaufz": 5, "wegaufn": 3}, Fraction(3, 5)),
        ({"incr_per_rev": 4096, "gear_fact_num": 2}, Fraction(1)),
        ({"incr_per_rev": 0, "wegaufz": 5}, Fraction(1, 5)),
    ],
)
def test_increments_are_scaled_by_motor_gear_and_feed_constant(
    gear: dict[str, int], path_of_an_increment: Fraction, read_lists: ReadLists
) -> None:
    reading = read_lists(one_axis(scaled(gear) + scaled({"feed_const_num": 9}, step=1), table_at(INCREMENTS)))
    leadscrew = reading.machine.axes[0].leadscrew
    assert leadscrew is not None
    expected = float(INCREMENTS * path_of_an_increment / 10_000)
    assert (leadscrew.positions, leadscrew.positive) == ((expected,), (expected,))
    assert [finding.code for finding in reading.findings] == []


def test_the_vendors_revolution_of_the_motor_is_10_mm(read_lists: ReadLists) -> None:
    leadscrew = read_lists(one_axis(scaled(MOTOR), table_at(1_048_576))).machine.axes[0].leadscrew
    assert leadscrew is not None
    assert leadscrew.positions == (10.0,)


def test_the_resolution_of_the_default_axis_list_holds_for_every_axis(read_lists: ReadLists) -> None:
    files = {
        "hochlauf.lis": "default_achs_mds all.lis\nzahl_kw 1\nachs_kw[0] kw.lis\n",
        "all.lis": f"lr_param.ssfk 1\n{scaled(MOTOR)}getriebe[0].wegaufz 1\n",
        "kw.lis": f"kopf.achs_nr 1\n{table_at(1_048_576)}",
    }
    reading = read_lists(files)
    leadscrew = reading.machine.axes[0].leadscrew
    assert leadscrew is not None
    assert (leadscrew.positions, reading.findings) == ((10.0,), ())


def test_a_table_without_unit_is_warned_of_on_an_axis_with_a_feed_constant(read_lists: ReadLists) -> None:
    findings = read_lists(one_axis(scaled(MOTOR), table_at(1_048_576, unit=""))).findings
    assert [finding.code for finding in findings] == ["AXC-UNIT"]


def test_a_path_resolution_that_the_gear_makes_void_is_named(read_lists: ReadLists) -> None:
    [finding] = read_lists(one_axis(scaled({**MOTOR, "wegaufz": 3}), table_at(1_048_576))).findings
    assert (finding.code, finding.line, finding.parameter) == ("AXC-UNUSED", 7, "getriebe[0].wegaufz")


@pytest.mark.parametrize(
    ("zero", "code", "increments_per_01_um"),
    [
        ("incr_per_rev", "AXC-RESOLUTION", Fraction(1024 * 3, 200_000)),
        ("gear_fact_num", "AXC-RANGE", Fraction(4096, 200_000)),
        ("gear_fact_denom", "AXC-RANGE", Fraction(4096 * 3, 200_000)),
        ("feed_const_denom", "110472", Fraction(4096 * 3, 200_000)),
        # No feed constant is left: the path resolution counts, which is 1.
        ("feed_const_num", "AXC-RANGE", Fraction(1)),
    ],
)
def test_a_0_in_the_resolution_is_its_default_with_a_finding(
    zero: str, code: str, increments_per_01_um: Fraction, read_lists: ReadLists
) -> None:
    gear = {"incr_per_rev": 4096, "gear_fact_num": 3, "feed_const_num": 200_000}
    reading = read_lists(one_axis(scaled({**gear, zero: 0}), table_at(INCREMENTS)))
    leadscrew = reading.machine.axes[0].leadscrew
    assert leadscrew is not None
    assert leadscrew.positions == (float(INCREMENTS / increments_per_01_um / 10_000),)
    assert [(finding.code, finding.parameter) for finding in reading.findings] == [(code, f"getriebe[0].{zero}")]


def test_decimals_are_kept_exactly(read_lists: ReadLists) -> None:
    text = "kw.ssfk.unit 1\n" + LEADSCREW.replace("pos 7", "pos 0.1").replace("3000", "1234.5678901234567")
    leadscrew = read_lists({"achskw1.lis": f"kopf.achs_nr 1\n{text}"}).machine.axes[0].leadscrew
    assert leadscrew is not None
    assert leadscrew.positive[0] == 1e-5
    assert leadscrew.positions[0] == 0.12345678901234567
