"""What hosts, lists and users rely on, written down by hand: nothing here is computed from the product.

A change here is a change that others notice: it wants a reason, and an entry where the users read.
"""

from __future__ import annotations

from axcomp.kinds import Backlash, Cross, Crosstalk, CrosstalkTest, Friction, Leadscrew, Plane, Temperature
from axcomp.model import Axis, AxisType, ErrorTable, Machine, ModuloRange, Volumetric

# Findings

ERRORS = """
    AXC-MISSING AXC-UNREADABLE AXC-BINARY AXC-EMPTY AXC-KIND AXC-NUMBER AXC-NUMBER-TWICE AXC-AXES AXC-SIZE AXC-MASTER
    AXC-ORDER AXC-INTERVAL AXC-MODULO-SPAN AXC-AXIS-TYPE AXC-TESTS AXC-ACCELERATION AXC-RECORD AXC-MAGNITUDE
    AXC-CONSTANT AXC-ARGUMENTS AXC-POLYLINE AXC-MAX-RECORDS AXC-CHAIN AXC-ASSIGNMENT AXC-SINGULAR AXC-LIMIT
    70182 70183 70184 70245 70468 70469 70471 70506 70507
    AXC-GAP AXC-ZEROED AXC-FOLDER
    AXC-BUILD
    110229 110472 110591 110638 110639 110640 110641 110647
"""
WARNINGS = """
    AXC-PATH AXC-SYNTAX AXC-ELISION AXC-END AXC-STRING AXC-UNKNOWN AXC-TYPO AXC-TWICE AXC-INDEX AXC-VALUE AXC-RANGE
    AXC-OUTSIDE AXC-UNUSED AXC-UNIT AXC-NAME AXC-NO-AXIS-LIST AXC-NO-TABLE AXC-MASTER-SELF AXC-MODULO-AXIS
    AXC-MODULO-SEAM AXC-VARIANT AXC-TESTS-FEW AXC-TESTS-TWICE AXC-AT-REST AXC-NO-RECORD AXC-VECTOR AXC-NOT-MODELLED
    AXC-SIGN-INVERTED AXC-SIGN-SWAPPED AXC-SIGN-NO-HELP AXC-OUTLIER AXC-SEAM AXC-COVERAGE AXC-DYNAMICS-VELOCITY
    AXC-DYNAMICS-KINK AXC-DYNAMICS-JUMP AXC-LIMIT-EXCEEDED
    AXC-RESOLUTION AXC-SLAVE AXC-DIRECTION AXC-ADAPTATION AXC-GRADIENT AXC-BACKLASH AXC-SCALING AXC-LOOKAHEAD
    AXC-SECTION AXC-LARGE AXC-OPEN AXC-SPLICING AXC-V-LIMIT
    AXC-IGNORE
    70474 110052 110086 110386
"""
INFOS = "AXC-OTHERS AXC-INACTIVE AXC-SIGN AXC-DYNAMICS AXC-LIMIT-NEAR 70495"

SEVERITIES = {
    **dict.fromkeys(ERRORS.split(), "error"),
    **dict.fromkeys(WARNINGS.split(), "warning"),
    **dict.fromkeys(INFOS.split(), "info"),
}
"""Every code of a finding, and how much it matters."""

# Variables of the FMU

CURVE = (0.0, 1.0), (0.0, 0.0)


def every_variable() -> Machine:
    """Return X with all compensations, Y and Z for the volumetric one, and a rotary axis C."""
    x = Axis(
        1,
        "X",
        volumetric_limit=1.0,
        cross=Cross(2, *CURVE),
        plane=Plane(2, 3, 0.0, 0.0, 1.0, 1.0, ((0.0, 0.0), (0.0, 0.0)), manual_activation=True),
        crosstalk=Crosstalk(2, 1.0, -1.0, 1, (CrosstalkTest(),)),
        leadscrew=Leadscrew(*CURVE),
        friction=Friction(*CURVE),
        temperature=Temperature(),
        backlash=Backlash(0.01),
    )
    c = Axis(4, "C", AxisType.ROTARY, ModuloRange(0.0, 360.0), leadscrew=Leadscrew(*CURVE))
    linear = (("X", 1), ("Y", 2), ("Z", 3))
    others = (Axis(number, letter, volumetric_limit=1.0) for letter, number in linear[1:])
    return Machine((x, *others, c), (Volumetric(0, linear, errors=(ErrorTable("X0X", (0.1,)),)),))


VARIABLES = {
    "reset": (0, "Boolean", "input", "discrete", None, "false"),
    "program_end": (1, "Boolean", "input", "discrete", None, "false"),
    "reload": (2, "Boolean", "input", "discrete", None, "false"),
    "update_path": (3, "String", "parameter", "tunable", None, ""),
    "cycle_time": (4, "Real", "parameter", "fixed", "s", "0.001"),
    "largest_step": (7, "Integer", "parameter", "fixed", None, "10000000"),
    "tool_length": (5, "Real", "input", "continuous", "mm", "0.0"),
    "derive_motion": (6, "Boolean", "parameter", "fixed", None, "false"),
    "X.setpoint": (64, "Real", "input", "continuous", "mm", "0.0"),
    "X.velocity": (65, "Real", "input", "continuous", "mm/s", "0.0"),
    "X.acceleration": (66, "Real", "input", "continuous", "mm/s2", "0.0"),
    "X.actual_position": (67, "Real", "input", "continuous", "mm", "0.0"),
    "X.unreferenced": (68, "Boolean", "input", "discrete", None, "false"),
    "X.fault": (69, "Boolean", "input", "discrete", None, "false"),
    "X.no_move": (70, "Boolean", "input", "discrete", None, "false"),
    "X.released": (71, "Boolean", "input", "discrete", None, "false"),
    "X.corrected_setpoint": (72, "Real", "output", "continuous", "mm", None),
    "X.display_position": (73, "Real", "output", "continuous", "mm", None),
    "X.correction": (74, "Real", "output", "continuous", "mm", None),
    "X.setpoint_shift": (75, "Real", "output", "continuous", "mm", None),
    "X.error": (76, "Integer", "output", "discrete", None, None),
    "X.current": (77, "Real", "output", "continuous", None, None),
    "X.stop_request": (78, "Boolean", "output", "discrete", None, None),
    "X.volumetric.correction": (79, "Real", "output", "continuous", "mm", None),
    "X.cross.switch": (80, "Integer", "input", "discrete", None, "0"),
    "X.cross.active": (81, "Boolean", "output", "discrete", None, None),
    "X.cross.correction": (82, "Real", "output", "continuous", "mm", None),
    "X.plane.switch": (84, "Integer", "input", "discrete", None, "0"),
    "X.plane.active": (85, "Boolean", "output", "discrete", None, None),
    "X.plane.correction": (86, "Real", "output", "continuous", "mm", None),
    "X.crosstalk.switch": (88, "Integer", "input", "discrete", None, "0"),
    "X.crosstalk.active": (89, "Boolean", "output", "discrete", None, None),
    "X.crosstalk.correction": (90, "Real", "output", "continuous", "mm", None),
    "X.leadscrew.switch": (92, "Integer", "input", "discrete", None, "0"),
    "X.leadscrew.active": (93, "Boolean", "output", "discrete", None, None),
    "X.leadscrew.correction": (94, "Real", "output", "continuous", "mm", None),
    "X.friction.switch": (96, "Integer", "input", "discrete", None, "0"),
    "X.friction.active": (97, "Boolean", "output", "discrete", None, None),
    "X.temperature.switch": (100, "Integer", "input", "discrete", None, "0"),
    "X.temperature.active": (101, "Boolean", "output", "discrete", None, None),
    "X.temperature.correction": (102, "Real", "output", "continuous", "mm", None),
    "X.temperature.offset": (103, "Real", "input", "continuous", "mm", "0.0"),
    "X.temperature.coefficient": (104, "Real", "input", "continuous", None, "0.0"),
    "X.backlash.switch": (108, "Integer", "input", "discrete", None, "0"),
    "X.backlash.active": (109, "Boolean", "output", "discrete", None, None),
    "X.backlash.correction": (110, "Real", "output", "continuous", "mm", None),
    "C.setpoint": (256, "Real", "input", "continuous", "deg", "0.0"),
    "C.velocity": (257, "Real", "input", "continuous", "deg/s", "0.0"),
    "C.acceleration": (258, "Real", "input", "continuous", "deg/s2", "0.0"),
    "C.actual_position": (259, "Real", "input", "continuous", "deg", "0.0"),
    "C.unreferenced": (260, "Boolean", "input", "discrete", None, "false"),
    "C.fault": (261, "Boolean", "input", "discrete", None, "false"),
    "C.no_move": (262, "Boolean", "input", "discrete", None, "false"),
    "C.released": (263, "Boolean", "input", "discrete", None, "false"),
    "C.corrected_setpoint": (264, "Real", "output", "continuous", "deg", None),
    "C.display_position": (265, "Real", "output", "continuous", "deg", None),
    "C.correction": (266, "Real", "output", "continuous", "deg", None),
    "C.setpoint_shift": (267, "Real", "output", "continuous", "deg", None),
    "C.error": (268, "Integer", "output", "discrete", None, None),
    "C.leadscrew.switch": (284, "Integer", "input", "discrete", None, "0"),
    "C.leadscrew.active": (285, "Boolean", "output", "discrete", None, None),
    "C.leadscrew.correction": (286, "Real", "output", "continuous", "deg", None),
    "volumetric[0].switch": (2112, "Integer", "input", "discrete", None, "0"),
    "volumetric[0].no_move": (2113, "Boolean", "input", "discrete", None, "false"),
    "volumetric[0].reduction_x": (2114, "Real", "input", "continuous", None, "0.0"),
    "volumetric[0].reduction_y": (2115, "Real", "input", "continuous", None, "0.0"),
    "volumetric[0].reduction_z": (2116, "Real", "input", "continuous", None, "0.0"),
    "volumetric[0].active": (2117, "Boolean", "output", "discrete", None, None),
}
"""Variables of ``every_variable`` but those of Y and Z: reference, type, causality, variability, unit and start."""

UNITS = {
    "s": {"s": "1"},
    "mm": {"m": "1", "factor": "0.001"},
    "mm/s": {"m": "1", "s": "-1", "factor": "0.001"},
    "mm/s2": {"m": "1", "s": "-2", "factor": "0.001"},
    "deg": {"rad": "1", "factor": "0.017453292519943295"},
    "deg/s": {"rad": "1", "s": "-1", "factor": "0.017453292519943295"},
    "deg/s2": {"rad": "1", "s": "-2", "factor": "0.017453292519943295"},
}
"""Exponents of the SI base units, and the factor to them: 1 mm = 0.001 m, 1° = π/180 rad."""

# Dependencies of the outputs


def two_axes() -> Machine:
    """Return X with leadscrew and friction, and Y that follows X by cross and crosstalk before its leadscrew."""
    tests = (CrosstalkTest(0.0), CrosstalkTest(1.0), CrosstalkTest(2.0))
    crosstalk = Crosstalk(1, 1.0, -1.0, 2, tests, adaptation1=1)
    return Machine(
        (
            Axis(1, "X", leadscrew=Leadscrew(*CURVE), friction=Friction(*CURVE)),
            Axis(2, "Y", cross=Cross(1, *CURVE), crosstalk=crosstalk, leadscrew=Leadscrew(*CURVE)),
        )
    )


_COMMANDS = "reset program_end reload"
_X_SWITCH = f"{_COMMANDS} X.setpoint X.velocity X.no_move X.released"
_Y_SWITCH = f"{_COMMANDS} Y.setpoint Y.velocity Y.no_move Y.released"
_Y_CROSS = f"{_Y_SWITCH} Y.cross.switch X.unreferenced X.setpoint"
_Y_CROSSTALK = f"{_Y_SWITCH} Y.crosstalk.switch X.unreferenced X.setpoint X.acceleration X.velocity"
_Y_ALL = f"{_Y_CROSS} {_Y_CROSSTALK} Y.unreferenced Y.leadscrew.switch"

DEPENDENCIES = {
    "X.corrected_setpoint": f"{_X_SWITCH} X.unreferenced X.leadscrew.switch",
    "X.display_position": f"{_X_SWITCH} X.unreferenced X.leadscrew.switch X.actual_position",
    "X.correction": f"{_X_SWITCH} X.unreferenced X.leadscrew.switch",
    "X.setpoint_shift": f"{_X_SWITCH} X.unreferenced X.leadscrew.switch",
    "X.error": f"{_COMMANDS} X.setpoint X.velocity X.acceleration X.actual_position "
    "X.leadscrew.switch X.friction.switch",
    "X.current": f"{_X_SWITCH} X.friction.switch X.acceleration",
    "X.leadscrew.active": f"{_X_SWITCH} X.unreferenced X.leadscrew.switch",
    "X.leadscrew.correction": f"{_X_SWITCH} X.unreferenced X.leadscrew.switch",
    "X.friction.active": f"{_X_SWITCH} X.friction.switch",
    "Y.corrected_setpoint": _Y_ALL,
    "Y.display_position": f"{_Y_ALL} Y.actual_position",
    "Y.correction": _Y_ALL,
    "Y.setpoint_shift": _Y_ALL,
    "Y.error": f"{_COMMANDS} Y.setpoint Y.velocity Y.acceleration Y.actual_position Y.cross.switch Y.crosstalk.switch "
    "Y.leadscrew.switch",
    "Y.cross.active": f"{_Y_SWITCH} Y.cross.switch X.unreferenced",
    "Y.cross.correction": _Y_CROSS,
    "Y.crosstalk.active": f"{_Y_SWITCH} Y.crosstalk.switch X.unreferenced",
    "Y.crosstalk.correction": _Y_CROSSTALK,
    "Y.leadscrew.active": f"{_Y_SWITCH} Y.unreferenced Y.leadscrew.switch",
    "Y.leadscrew.correction": _Y_ALL,
}
"""Inputs that the outputs of ``two_axes`` are computed from."""

_MEMBERS = " ".join(f"{axis}.{name}" for axis in "XYZ" for name in ("setpoint", "velocity", "unreferenced", "fault"))
_OF_VOLUMETRIC = " ".join(
    f"volumetric[0].{name}" for name in ("switch", "no_move", "reduction_x", "reduction_y", "reduction_z")
)
VOLUMETRIC_DEPENDENCIES = dict.fromkeys(
    ("volumetric[0].active", "X.stop_request", "X.volumetric.correction"),
    f"{_COMMANDS} tool_length {_MEMBERS} {_OF_VOLUMETRIC}",
)
"""The same for outputs of ``every_variable``."""

# What identifies an FMU

GUID = "{cdfb0f6a-5cb4-5d89-9561-ff28b2b4986e}"
"""Of the files ``a``, which holds "one", and ``b/c``, which is empty.

``printf 'a\\0003\\000oneb/c\\0000\\000' | sha256sum`` begins with cdfb0f6a5cb44d891561ff28b2b4986e. In a UUID of
version 5 the 13th digit is a 5, and the 17th one has the bits 10 in front: a 9.
"""
