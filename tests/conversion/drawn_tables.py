"""Hypothesis strategies of tables as the lists hold them: whole multiples of 0.1 µm or 0.0001°."""

from __future__ import annotations

from typing import Any

from hypothesis import strategies as st

from axcomp.conversion import CompensationTable

UNITS_PER_MM = 10_000
HALF_RESOLUTION = {"mm": 0.05, "deg": 0.18}
"""Half of 0.1 µm in µm, half of 0.0001° in ″."""
NAMES = st.sampled_from(["X", "Y1", "AX3", "C"])


def changed(table: CompensationTable, **other: Any) -> CompensationTable:
    """Return a table with other positions, values, axes, period or units."""
    known: dict[str, Any] = {name: getattr(table, name) for name in ("axis", "over", "positions", "period")}
    known |= {"positive": table.positive.y, "negative": None if table.negative is None else table.negative.y}
    return CompensationTable.of(**{**known, "unit": table.unit, "over_unit": table.over_unit, **other})


def _listed(units: list[int]) -> tuple[float, ...]:
    return tuple(unit / UNITS_PER_MM for unit in units)


@st.composite
def tables(
    draw: st.DrawFn,
    *,
    even: bool = False,
    bilateral: bool | None = None,
    cross: bool | None = None,
    turning: bool | None = None,
    from_zero: bool = False,
    max_points: int = 40,
) -> CompensationTable:
    """Draw a table; None: either. A turning one repeats every 360° and may begin anywhere, or only at 0°."""
    axis = draw(NAMES)
    over = draw(NAMES.filter(lambda name: name != axis)) if (draw(st.booleans()) if cross is None else cross) else axis
    repeats = draw(st.booleans()) if turning is None else turning
    count = draw(st.integers(2 if repeats else 1, max_points))
    turn = 360 * UNITS_PER_MM
    if repeats:
        start = 0 if from_zero else draw(st.sampled_from([0, -180 * UNITS_PER_MM, 123_4567]))
        if even:
            count = draw(st.sampled_from([n for n in range(2, max_points) if turn % n == 0]))
            places = [start + index * turn // count for index in range(count)]
        else:
            gaps = draw(st.sets(st.integers(1, turn - 1), min_size=count, max_size=count))
            places = [start, *(start + gap for gap in sorted(gaps))]
    else:
        start = draw(st.integers(-(10**7), 10**7))
        if even:
            step = draw(st.integers(1, 10**6))
            places = [start + index * step for index in range(count)]
        else:
            places = sorted(draw(st.sets(st.integers(-(10**7), 10**7), min_size=count, max_size=count)))
    values = st.lists(st.integers(-5000, 5000), min_size=len(places), max_size=len(places))
    both = draw(st.booleans()) if bilateral is None else bilateral
    unit: Any = "deg" if repeats else "mm"
    return CompensationTable.of(
        axis,
        over,
        _listed(places),
        _listed(draw(values)),
        _listed(draw(values)) if both else None,
        360.0 if repeats else None,
        unit if over == axis else "mm",
        unit,
    )
