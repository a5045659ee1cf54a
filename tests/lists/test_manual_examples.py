"""The examples of the manuals, in this project's own layout: what they mean, and what is odd about them."""

from collections.abc import Callable

import pytest

from axcomp.lists import Reading

ReadList = Callable[[str], Reading]
ReadLists = Callable[..., Reading]

CROSS = """\
# Axis compensation data for the Z axis
kopf.achs_nr 3
kopf.log_achs_name Z
kw.crosscomp.last_index {last}    /* last valid index */
kw.crosscomp.master_ax_nr 1       /* log. ax. number of the master axis */
kw.crosscomp.unit 1               /* 0: increments, 1: 0.1 µm */
kw.crosscomp.n_cycles 10
#
kw.crosscomp.table[0].setpoint 10735
kw.crosscomp.table[0].correction 3
kw.crosscomp.table[1].setpoint 11523
kw.crosscomp.table[1].correction 5
{between}
kw.crosscomp.table[{last}].setpoint 10000000   /* at 1000 mm of axis 3 */
kw.crosscomp.table[{last}].correction 1000     /* corr. of 0.1 mm for axis 1 */
"""


def codes(reading: Reading) -> list[str]:
    return [finding.code for finding in reading.findings]


def test_cross_example_corrects_the_slave_whose_list_it_is(read_list: ReadList) -> None:
    reading = read_list(CROSS.format(last=2, between=""))
    assert codes(reading) == []
    z, x = reading.machine.axes
    assert (z.number, z.name, x.number, x.name) == (3, "Z", 1, "axis1")
    assert z.cross is not None
    assert (z.cross.master, z.cross.n_cycles) == (1, 10)
    assert z.cross.positions == (1.0735, 1.1523, 1000.0)
    assert z.cross.corrections == (0.0003, 0.0005, 0.1)


def test_cross_example_as_printed_is_off_because_entries_are_left_out(read_list: ReadList) -> None:
    reading = read_list(CROSS.format(last=99, between=":\n:"))
    assert codes(reading) == ["AXC-GAP", "70245", "AXC-GAP", "AXC-ELISION", "AXC-ELISION"]
    assert reading.machine.axes[0].cross is None


def leadscrew(count: int = 140) -> str:
    """The leadscrew example; with 140 entries all but the given ones are on straight lines between them."""
    given = {
        "setpoint": {0: -200000, 1: -199306, 2: -198667, 3: -198001, 138: 334488, 139: 335591},
        "pos": {0: 0, 1: 24, 2: -102, 139: -55},
        "neg": {0: 0, 1: 67, 2: 80, 139: 114},
    }
    lines = [
        "kopf.log_achs_nr 2",
        "kopf.log_achs_name Y-ACHSE",
        "kw.ssfk.interval 0",
        "kw.ssfk.kw_startpos -200000",
        f"kw.ssfk.kw_nr_max {count}",
        "kw.ssfk.unit 1",
        "kw.ssfk.bilateral 1",
    ]
    for field, values in given.items():
        known = sorted(values)
        for i in range(count):
            below = max(k for k in known if k <= i)
            above = min(k for k in known if k >= i)
            share = (i - below) / (above - below) if above > below else 0
            lines.append(f"kw.ssfk.table[{i}].{field} {round(values[below] + share * (values[above] - values[below]))}")
    return "\n".join(lines)


def test_leadscrew_example_has_minus_102_and_80_at_minus_19_8667_mm(read_list: ReadList) -> None:
    reading = read_list(leadscrew())
    assert codes(reading) == []
    y = reading.machine.axis("Y-ACHSE")
    assert y.number == 2
    table = y.leadscrew
    assert table is not None
    assert table.negative is not None
    # Programmed −19866.7 µm; measured −19876.9 µm going up and −19858.7 µm going down.
    assert (table.positions[2], table.positive[2], table.negative[2]) == (-19.8667, -0.0102, 0.0080)
    assert (len(table.positions), table.positions[0], table.positions[-1]) == (140, -20.0, 33.5591)
    assert (table.positive[-1], table.negative[-1], table.max_points) == (-0.0055, 0.0114, 1500)


def test_leadscrew_description_names_the_distance_intervall_once(read_list: ReadList) -> None:
    text = (
        "kopf.achs_nr 1\nkw.ssfk.unit 1\nkw.ssfk.intervall 100000\nkw.ssfk.kw_startpos -100000\nkw.ssfk.kw_nr_max 3\n"
    )
    reading = read_list(text + "".join(f"kw.ssfk.table[{i}].pos {i}\n" for i in range(3)))
    assert codes(reading) == ["AXC-TYPO"]
    table = reading.machine.axes[0].leadscrew
    assert table is not None
    assert (table.positions, table.negative) == ((-10.0, 0.0, 10.0), None)


def test_plane_example_counts_its_second_master_first(read_list: ReadList) -> None:
    head = """\
kopf.achs_nr 1
kopf.log_achs_name X
kw.crosscomp2.interval 100000 /* 10 mm */
kw.crosscomp2.last_index_master1 100
kw.crosscomp2.last_index_master2 100
kw.crosscomp2.start_position_master1 -400000 /* -40 mm */
kw.crosscomp2.start_position_master2 -700000 /* -70 mm */
kw.crosscomp2.unit 1 /* 0.1 my */
kw.crosscomp2.n_cycles 10
kw.crosscomp2.master1_ax_nr 2
kw.crosscomp2.master2_ax_nr 3
"""
    first = (-3, -1, 4, 9, 13, 17, 42, 53)
    last = (82, 77, 68, 63, 61, 59, 57, 52, 56, 58, 49)
    rows = [[0] * 101 for _ in range(101)]
    rows[0][: len(first)] = first
    rows[100][101 - len(last) :] = last
    table = "\n".join(
        f"kw.crosscomp2.table[{j:3}][{i:3}].correction {value}"
        for j, row in enumerate(rows)
        for i, value in enumerate(row)
    )
    reading = read_list(f"{head}{table}\nEnd\n")
    assert codes(reading) == []
    x = reading.machine.axis("X")
    plane = x.plane
    assert plane is not None
    assert (plane.master1, plane.start1, plane.interval1) == (2, -40.0, 10.0)
    assert (plane.master2, plane.start2, plane.interval2) == (3, -70.0, 10.0)
    assert (plane.corrections[0][1], plane.corrections[1][0]) == (-0.0001, 0.0)
    assert (plane.corrections[100][90], plane.corrections[90][100]) == (0.0082, 0.0)
    assert (plane.n_cycles, plane.max_points) == (10, None)


def test_excerpt_of_the_axis_list_activates_the_leadscrew_compensation(read_lists: ReadLists) -> None:
    files = {
        "hochlauf.lis": "zahl_kw 1\nachs_kw[0] achskw2.lis\nzahl_mds 1\nachs_mds[0] achsmd2.lis\n",
        "achskw2.lis": leadscrew(),
        "achsmd2.lis": "kopf.achs_nr 2\n:\nlr_param.ssfk 1\n:\n",
    }
    reading = read_lists(files)
    assert codes(reading) == ["AXC-ELISION", "AXC-ELISION"]
    assert [one.kind for one in reading.machine.axes[0].compensations] == ["leadscrew"]


@pytest.mark.parametrize("position_delay", [30, 10])
def test_friction_examples_of_the_vendor_exceed_the_documented_ranges(read_list: ReadList, position_delay: int) -> None:
    reading = read_list(f"""\
kopf.achs_nr 1
frict_comp.mode 3
frict_comp.table_entries 2
frict_comp.position_delay {position_delay}
frict_comp.table[0].in 0
frict_comp.table[0].out 10
frict_comp.table[1].in 100000
frict_comp.table[1].out 25
""")
    friction = reading.machine.axes[0].friction
    assert friction is not None
    assert (friction.velocities, friction.currents) == ((0.0, 100.0), (10.0, 25.0))
    assert (friction.position_delay, friction.scaling) == (position_delay * 1e-4, 1.0)
    assert codes(reading) == ["AXC-OUTSIDE"] * (2 if position_delay > 10 else 1)
