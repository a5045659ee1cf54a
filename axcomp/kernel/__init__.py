"""The compensations of one cycle, in a subset of Python that translates line by line to C99.

Numbers are double and int32, tables lie in one pool of doubles, and nothing is allocated or raised: two runs, in any
language and on any machine, give the same bits. ``record`` is the only module that C does not see.
"""

EXPORTS = (
    "set_initial_inputs",
    "cycle",
    "has_notice",
    "update_error",
    "adopt_axis",
    "keep_declared",
    "adopt_volumetrics",
    "move_axis_table",
    "tables_fit",
)
"""The functions that C calls by name; the translation has them and what they call."""
