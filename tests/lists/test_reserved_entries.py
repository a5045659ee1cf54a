"""``max_points``: a table may be as long as what is reserved for it (semantics §2), in all four kinds that have one."""

from collections.abc import Callable

import pytest

from axcomp.lists import Reading

ROWS = {
    "ssfk": "kw.ssfk.unit 1\nkw.ssfk.interval 10000\nkw.ssfk.kw_nr_max 3\nkw.ssfk.table[0].pos 1\n"
    "kw.ssfk.table[1].pos 2\nkw.ssfk.table[2].pos 4\n",
    "crosscomp": "kw.crosscomp.unit 1\nkw.crosscomp.master_ax_nr 2\nkw.crosscomp.last_index 2\n"
    + "".join(f"kw.crosscomp.table[{i}].setpoint {i}\nkw.crosscomp.table[{i}].correction {i}\n" for i in range(3)),
    "crosscomp2": "kw.crosscomp2.unit 1\nkw.crosscomp2.master1_ax_nr 2\nkw.crosscomp2.master2_ax_nr 3\n"
    "kw.crosscomp2.interval 10000\nkw.crosscomp2.last_index_master1 2\nkw.crosscomp2.last_index_master2 1\n"
    + "".join(f"kw.crosscomp2.table[{j}][{i}].correction {i}\n" for j in range(2) for i in range(3)),
    "frict_comp": "frict_comp.mode 3\nfrict_comp.scaling_factor 1000\nfrict_comp.table_entries 3\n"
    + "".join(f"frict_comp.table[{i}].in {1000 + i}\nfrict_comp.table[{i}].out 5\n" for i in range(3)),
}
ENTRY = {"frict_comp": "frict_comp.max_points"}
USED = {"crosscomp2": 6}


@pytest.mark.parametrize("kind", ROWS)
def test_a_table_may_be_as_long_as_what_is_reserved_and_no_longer(
    kind: str, read_lists: Callable[..., Reading]
) -> None:
    entry, used = ENTRY.get(kind, f"kw.{kind}.max_points"), USED.get(kind, 3)
    exact = read_lists({"achskw1.lis": f"kopf.achs_nr 1\n{ROWS[kind]}{entry} {used}\n"})
    assert exact.findings == ()
    assert len(exact.machine.axes[0].compensations) == 1
    short = read_lists({"achskw1.lis": f"kopf.achs_nr 1\n{ROWS[kind]}{entry} {used - 1}\n"})
    assert [finding.code for finding in short.findings] == ["110647"]
    assert short.machine.axes[0].compensations == ()
