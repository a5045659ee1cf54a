"""The catalogue against facts of the manuals, noted down here once more."""

import pytest

from axcomp.kinds import DataType, ListKind, Manual, Quantity, Range
from axcomp.lists import CATALOGUE, SPELLINGS, parameter

BOTH = {*range(1, 34), *range(41, 48), *range(57, 68)} - {3, 8}


def ids(manual: Manual, kind: ListKind = ListKind.COMPENSATION) -> list[str]:
    return sorted(row.ids[manual] for row in CATALOGUE[kind] if row.ids.get(manual))


def test_every_compensation_parameter_of_both_manuals_is_there_once() -> None:
    isg = sorted(f"P-COMP-{i:05}" for i in BOTH | {3, 8} | set(range(80, 91)))
    twincat = sorted(f"P-COMP-{i:05}" for i in BOTH | {73})
    assert ids(Manual.ISG) == isg
    assert ids(Manual.TWINCAT) == twincat


def test_the_axis_and_start_up_parameters_are_there() -> None:
    numbers = (15, 16, 18, 21, 47, 70, 92, 103, 126, 127, 174, 175, 233, 234, 243, *range(271, 276), 362, 363)
    numbers += (511, 512, 522, 525, 526, 789)
    assert ids(Manual.AXIS, ListKind.AXIS) == [f"P-AXIS-{i:05}" for i in numbers]
    assert ids(Manual.START_UP, ListKind.START_UP) == [f"P-STUP-{i:05}" for i in (14, 15, 16, 17, 35, 36, 100, 101)]


@pytest.mark.parametrize(
    ("name", "isg", "twincat"),
    [
        ("kw.crosstalk.manual_activation", "P-COMP-00065", "P-COMP-00073"),
        ("kw.crosstalk.last_index", None, "P-COMP-00065"),
        ("kw.crosstalk.acceleration", "P-COMP-00066", None),
        ("kw.crosstalk.table[i].acceleration", None, "P-COMP-00066"),
        ("kw.crosstalk.deceleration", "P-COMP-00067", None),
        ("kw.crosstalk.table[i].correction", None, "P-COMP-00067"),
    ],
)
def test_ids_that_the_manuals_use_twice_belong_to_names(name: str, isg: str | None, twincat: str | None) -> None:
    row = parameter(ListKind.COMPENSATION, name)
    assert (row.ids.get(Manual.ISG), row.ids.get(Manual.TWINCAT)) == (isg, twincat)


@pytest.mark.parametrize(
    ("alias", "name"),
    [
        ("kw.crosscomp.slave_ax_nr", "kw.crosscomp.master_ax_nr"),
        ("kw.crosstalk.master_ax_nr", "kw.crosstalk.master_dyn_ax_nr"),
        ("kopf.log_achs_nr", "kopf.achs_nr"),
        ("kw.ssfk.table[3].sollw", "kw.ssfk.table[i].setpoint"),
        ("kw.crosscomp.table[3].sollw", "kw.crosscomp.table[i].setpoint"),
        ("kw.ssfk.intervall", "kw.ssfk.interval"),
        ("kw.frict_comp.mode", "frict_comp.mode"),
        ("kw.frict_comp.table[0].in", "frict_comp.table[i].in"),
        ("KW.SSFK.Interval", "kw.ssfk.interval"),
    ],
)
def test_other_names_mean_the_same_parameter(alias: str, name: str) -> None:
    assert parameter(ListKind.COMPENSATION, alias).name == name


DEFAULTS = {
    "kw.ssfk.max_points": 1500,
    "kw.crosscomp.max_points": 1001,
    "kw.crosscomp2.max_points": 10201,
    "frict_comp.max_points": 20,
    "frict_comp.scaling_factor": 1000,
    "kw.crosscomp2.grid": "QUADRATIC",
    "kw.crosstalk.mode": 1,
    "kopf.log_achs_name": "",
}


def test_defaults_are_zero_but_for_a_few() -> None:
    other = {row.name: row.default for row in CATALOGUE[ListKind.COMPENSATION] if row.default != 0}
    assert other == DEFAULTS


def test_defaults_are_values_the_list_would_take_or_mean_that_nothing_is_given() -> None:
    for rows in CATALOGUE.values():
        for row in rows:
            assert row.takes(row.default) or row.default in (0, ""), row.name


@pytest.mark.parametrize(
    ("name", "taken", "refused"),
    [
        ("kw.crosscomp.n_cycles", (0, 20), (-1, 21)),
        ("kw.ssfk.table[i].pos", (-(2**31), 2**31 - 2), (-(2**31) - 1, 2**31 - 1)),
        ("kw.ssfk.table[i].setpoint", (-(2**63), 2**63 - 2), (-(2**63) - 1, 2**63 - 1)),
        ("frict_comp.delay_cycles", (0, 248), (-1, 249)),
        ("frict_comp.reversal_lookahead", (0, 4), (5,)),
        ("frict_comp.mode", (0, 3), (1, 2, 4)),
        ("frict_comp.position_delay", (0, 10, 30), (-1,)),
        ("frict_comp.table[i].in", (0, 1), (2**31 - 1,)),
        ("frict_comp.scaling_factor", (-32767, 32766), (-32768, 32767)),
        ("kw.crosstalk.max_points", (0, 15), (16,)),
        ("kw.crosstalk.last_index", (0, 4), (5,)),
        ("kw.crosstalk.acceleration", (1,), (0, -1)),
        ("kw.crosstalk.deceleration", (-1,), (0, 1)),
        ("kw.crosscomp2.interval", (1,), (0, 2**32 - 1)),
        ("kopf.achs_nr", (1, 65534), (0, 65535)),
    ],
)
def test_ranges_are_those_of_the_manual(name: str, taken: tuple[int, ...], refused: tuple[int, ...]) -> None:
    row = parameter(ListKind.COMPENSATION, name)
    assert [row.takes(value) for value in (*taken, *refused)] == [True] * len(taken) + [False] * len(refused)


def test_units_are_01_um_and_a_ten_thousandth_of_a_degree() -> None:
    row = parameter(ListKind.COMPENSATION, "kw.ssfk.table[i].pos")
    assert (row.unit, row.quantity.divisor) == ("0.1 µm or 0.0001°", 10_000)
    assert Quantity.VELOCITY.divisor == 1000


def test_every_name_is_declared_once_in_its_list() -> None:
    for kind, rows in CATALOGUE.items():
        names = [row.key for row in rows]
        assert len(names) == len(set(names))
        assert set(names) <= set(SPELLINGS[kind])


def test_an_interval_must_look_like_one() -> None:
    with pytest.raises(ValueError, match="not an interval"):
        Range.parse("0..20", DataType.UNS16)
