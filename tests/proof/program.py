"""A machine's tables and any inputs as a C program: what an analysis looks at that may assume no input."""

from __future__ import annotations

import dataclasses
from typing import Any

from axcomp.model import Machine
from axcomp.native import tables_source
from axcomp.runtime import compile_tables, initial_inputs

HEAD = """\
#include "kernel.h"
#include "tables.c"

volatile double any_double; /* every double, infinities and what is no number among them */
volatile int any_int;

static AxisMotion motions[AXES_HERE];
static AxisState axis_states[AXES_HERE];
static AxisInputs axis_inputs[AXES_HERE];
static AxisOutputs axis_outputs[AXES_HERE];
static VolumetricState volumetric_states[VOLUMETRICS_HERE + 1];
static VolumetricInputs volumetric_inputs[VOLUMETRICS_HERE + 1];
static VolumetricOutputs volumetric_outputs[VOLUMETRICS_HERE + 1];
static State state;
static Inputs inputs;
static Outputs outputs;
"""


def any_input(value: Any, name: str) -> list[str]:
    """Return statements that give everything in a record any value of its type."""
    match value:
        case bool():
            return [f"{name} = any_int != 0;"]
        case int():
            return [f"{name} = any_int;"]
        case float():
            return [f"{name} = any_double;"]
        case list():
            return [line for index, one in enumerate(value) for line in any_input(one, f"{name}[{index}]")]
    fields = [field.name for field in dataclasses.fields(value)]
    return [line for field in fields for line in any_input(getattr(value, field), f"{name}.{field}")]


def files_of(machine: Machine) -> dict[str, str]:
    """Return ``main.c`` and ``tables.c``: the machine runs for ever, with any inputs in every cycle."""
    compiled = compile_tables(machine)
    tables = compiled.tables
    lines = [
        f"#define AXES_HERE {tables.axis_count}",
        f"#define VOLUMETRICS_HERE {tables.volumetrics}",
        HEAD,
        *(
            f"static double line_{i}[{axis.compensation.friction.delay + 1}];"
            for i, axis in enumerate(tables.axis[: tables.axis_count])
        ),
        "\nint main(void)\n{",
        "    state.motion.axis = motions, state.axis = axis_states, state.volumetric = volumetric_states;",
        "    inputs.axis = axis_inputs, inputs.volumetric = volumetric_inputs;",
        "    outputs.axis = axis_outputs, outputs.volumetric = volumetric_outputs;",
        *(f"    axis_states[{i}].compensation.friction.line = line_{i};" for i in range(tables.axis_count)),
        "    while (1) {",
        *(f"        {line}" for line in any_input(initial_inputs(tables), "inputs")),
        "        axcomp_cycle(&axcomp_tables.tables, pool, &state, &inputs, &outputs);",
        "    }\n}\n",
    ]
    return {"main.c": "\n".join(lines), "tables.c": tables_source(compiled, "proof")}
