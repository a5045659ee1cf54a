"""The FMU's variables as documentation; ``python -m axcomp.interface`` writes page and README section."""

from __future__ import annotations

from collections.abc import Iterable, Iterator

from ..kernel import LARGEST
from ..kinds import KIND_NAMES, KINDS, TableArray
from ..model import models
from .arrays import TABLE_BLOCK, every_array
from .declarations import (
    AXIS_BLOCK,
    AXIS_DECLARATIONS,
    MACHINE_BLOCK,
    OF_MACHINE,
    OF_VOLUMETRIC,
    PARTICIPANT,
    VOLUMETRIC,
    VOLUMETRIC_BLOCK,
    Declaration,
)
from .errors import ERRORS
from .variable import BLOCK, TYPE_NAMES

PAGE = models().parent / "docs" / "fmu-reference.md"
README = models().parent / "README.md"
README_BEGIN, README_END = "<!-- variables -->", "<!-- end of variables -->"

HEAD = """\
# Variables of axcomp.fmu

Written by `python -m axcomp.interface` from `axcomp/interface/declarations.py`.

`NAME` is the name of an axis (`kopf.log_achs_name`, else `axis<number>`) with `_` for what an identifier cannot hold.
Only what is configured appears. Units are those of the axis: mm or deg, mm/s or deg/s, mm/s2 or deg/s2, each defined by
its factor to SI units, so that tools convert. With `--naming flat` every `.` is a `_`; with `--types real` Booleans
and Integers are Real: a number then means the nearest integer, and false where that is 0; `update_path` is left out.

Every input starts with 0 or false, which means what the lists say: a host that does not connect one changes nothing.
A switch (`NAME.KIND.switch`, `volumetric[j].switch`) is 0 for automatic activation as the lists say, 1 for on, -1 for
off. Its changes are the commands; the same value again commands nothing, so a manual compensation which program end
has switched off needs 0 or -1 before it gets 1 again. Any other value commands nothing and sets `NAME.error`.
`NAME.KIND.offset` and `NAME.KIND.coefficient` are added to what the lists say.

A value reference is `{block} · block + identifier`, the same in every FMU: block {machine} is the machine's, block
{axis} + i that of axis i = 0 … 31 in the order of the lists, block {volumetric} + j that of volumetric compensation
j = 0 … 4.
"""

STEPS = """\
## Time

* The cycles of the position controller lie at start time + k · `cycle_time`. A communication step [t, t + h) runs those
  whose instants fall into it, with the inputs held; if none does, the outputs hold. How a stretch of time is divided
  into steps therefore changes nothing at the instants.
* `fmi2SetRealInputDerivatives` (native FMU): an input goes on along its first derivative during the next step, each
  cycle gets its value at its own instant, and behind the step the input stays where it has come to. A host with steps
  of 10 ms that sets them has the friction and the corrections of one with steps of a cycle, as far as its inputs are
  linear inside its steps. Derivatives of higher order are not used.
* Steps that go back in time, or beyond the stop time if there is one, are refused; a hundredth of a cycle is no matter,
  for hosts add up their steps. Going back is a matter of `fmi2SetFMUstate`.
* The outputs read after a step belong to the inputs set before it: FMI 2.0 co-simulation has no feedthrough inside a
  step, FMI 3.0 has it in event mode. At the end of initialization they belong to the start values.
* `reload`: its rising edge acts at the beginning of a step. What it reads is refused as a whole when it has an error,
  other axes or a compensation that was not there before. A relative `update_path` counts from the host's current
  folder.
* Get, set and serialize state bring everything back. A serialized state fits FMUs of the same version and machine
  only.

## Native and Python

`axcomp build` makes the native FMU: libraries for all platforms or those asked for, and C sources. With
`--runtime python` it makes one whose libraries start Python. Variables, value references and results are the same in
every bit; these differ:

| | native | `--runtime python` |
| --- | --- | --- |
| Needs in the host | nothing | Python 3.11 or later in its process, as FMPy has |
| `update_path` | an image, made by `axcomp build --image FILE`, which shows the findings; empty: its \
own one; lists with errors are refused | a start-up list, its folder or a single list; empty: those in \
`resources/`; lists with errors are refused |
| Changed lists in `resources/` | are not read: they travel along; build again | act in the next instance; a new \
compensation acts, but its variables are not there |
| Serialized state after `reload` | comes back in instances that have read the same images | \
comes back in any instance |
| Derivatives of inputs | are used | are refused by pythonfmu: inputs are held |
| Steps back in time or beyond the stop time | `fmi2Error` | `fmi2Discard`, which is all that pythonfmu offers |
| A call that cannot be carried out | returns an error, and the log says why | sets `NAME.error`; the log and standard \
error say why |
| Unpacked under any path | yes | not where it holds one of `ü + ( ) [ ] # , %`: pythonfmu's library fails there |

The native FMU's tables lie in `resources/tables.bin`; it belongs to the guid, so that of another FMU is refused.
Instances of a library share them; an instance has some 10 kB besides, and its serialized state 1 kB for each axis.
Memory is allocated when an instance or a state is made or `reload` is set, not in steps.

`fmpy compile axcomp.fmu`, or a host that takes source-code FMUs, compiles the sources with the tables in them
(`tables.c`): no file is read, nothing is allocated or logged, and `reload` is refused. With `--no-lists` no list, no
table as text and no finding is in the FMU, only the compiled tables.

## What else is in the FMU

* `documentation/index.html`: the findings, tables and variables of this machine; `documentation/licenses`.
* `model.png` (not in FMI 3.0), and `terminalsAndIcons/terminalsAndIcons.xml` (FMI 2.0.4) with a terminal for each
  axis, whose ports are its variables.
* The date of generation is SOURCE_DATE_EPOCH where that is set, else the last commit of the checkout, else, of an
  installed package, 2000-01-01: a rebuild has the same bytes. The guid does not depend on it.
* `min` and `max` are what is of use: beyond them an input is not taken. `current` has no unit: it is in the drive's
  own, which no list tells (P-COMP-00047).

## Errors

`NAME.error` is 0 or one of these, until `reset`:

| Number | Meaning |
| ---: | --- |
"""


THIRD = """\
## FMI 3.0

`axcomp build --fmi 3.0` makes the native FMU for FMI 3.0, `--fmi 2.0 3.0` one for each. Names, value references and
bits are the same, and so is the library; Real is Float64, Integer Int32. `time` is the independent variable.

* Event mode: inputs are set, and after `fmi3UpdateDiscreteStates` the outputs belong to them, without the delay of a
  cycle. The step that follows runs the very cycle. `fmi3DoStep` asks for event mode (`eventHandlingNeeded`) where a
  cycle begins at its end; an event between two cycles is heard by the next. A host that does not use event mode has
  what FMI 2.0 has.
* Tables are parameters, tunable arrays of Float64: a host reads and calibrates them, before the start or while the
  machine runs, in event mode or between two steps. A change blends in as an update does. All that one call of
  `fmi3SetFloat64` sets comes into force together. Numbers that are not finite, beyond {largest:g}, negative speeds, and
  abscissae that do not ascend are refused, all of the call: `fmi3Discard`, the old numbers stay, the log says why. A
  table that repeats with the modulo range ends with its first point, one turn on.
* The arrays are as long as the tables of the lists. After `reload` with other lengths they cannot be read or set until
  the lengths are those again. `fmi3Reset` brings the tables of the lists back; a state those that were in force, in the
  instance that has saved it.
* Clocks, configuration mode, intermediate update, early return, derivatives and other kinds of simulation: there are
  none, their functions return `fmi3Error`.

The value reference of an array is `{block} · ({tables} + i) + identifier` for axis i.

| Array | Unit | Identifier | Meaning |
| --- | --- | ---: | --- |
"""

FIRST = KIND_NAMES[0]


def reference_page() -> str:
    """Return the page as Markdown."""
    head = HEAD.format(block=BLOCK, machine=MACHINE_BLOCK, axis=AXIS_BLOCK, volumetric=VOLUMETRIC_BLOCK)
    machine = _table(OF_MACHINE, "")
    volumetric = _table([d for d in AXIS_DECLARATIONS if d.kind in (PARTICIPANT, VOLUMETRIC)], "NAME.")
    volumetrics = _table(OF_VOLUMETRIC, "volumetric[j].")
    axis = _table([d for d in AXIS_DECLARATIONS if not d.kind], "NAME.")
    kinds = "\n".join(
        f"\n### With {kind} compensation\n\n" + _table([d for d in AXIS_DECLARATIONS if d.kind == kind], "NAME.")
        for kind in KINDS
    )
    errors = "\n".join(f"| {number} | {meaning} |" for number, meaning in ERRORS.items())
    tables = f"## Of the machine\n\n{machine}\n\n## Of every axis\n\n{axis}\n{kinds}\n"
    of_others = "of the other axes that take part `stop_request` only"
    tables += f"\n### With volumetric compensation: X, Y, Z and their gantry slaves; {of_others}\n\n{volumetric}\n"
    tables += f"\n## Of every volumetric compensation\n\n{volumetrics}\n"
    arrays = "".join(
        f"| `NAME.{kind}.{array.name}` | {_units(array)} | {identifier} | {array.description} |\n"
        for kind, identifier, array in every_array()
    )
    third = THIRD.format(largest=LARGEST, block=BLOCK, tables=TABLE_BLOCK) + arrays
    return f"{head}\n{tables}\n{STEPS}{errors}\n\n{third}"


def readme_section() -> str:
    """Return the list of variables for the README: names and units, inputs before outputs."""
    every_axis = [d for d in AXIS_DECLARATIONS if not d.kind]
    of_kinds = [d for d in AXIS_DECLARATIONS if d.kind == FIRST]
    common = {d.name.removeprefix(FIRST) for d in of_kinds}
    others = [d for d in AXIS_DECLARATIONS if d.kind in KINDS and d.name.removeprefix(d.kind) not in common]
    others += [d for d in AXIS_DECLARATIONS if d.kind in (PARTICIPANT, VOLUMETRIC)]
    having = ", ".join(dict.fromkeys(f"with {d.kind}" for d in others if d.kind != PARTICIPANT))
    rows = ["| | Inputs | Outputs |", "| --- | --- | --- |"]
    for label, declarations, prefix in (
        ("of every axis", every_axis, "NAME."),
        (f"of every kind of compensation, {', '.join(KINDS)}", of_kinds, "NAME."),
        (f"{having} compensation", others, "NAME."),
        ("of every volumetric compensation", OF_VOLUMETRIC, "volumetric[j]."),
        ("of the machine", OF_MACHINE, ""),
    ):
        inputs = [d for d in declarations if d.causality != "output"]
        outputs = [d for d in declarations if d.causality == "output"]
        rows.append(f"| {label} | {_named(inputs, prefix)} | {_named(outputs, prefix)} |")
    return "\n".join(rows).replace(f"{FIRST}.", "KIND.") + "\n"


def readme_with_section(readme: str) -> str:
    """Return a README whose part between the markers is the list of variables."""
    before, _, rest = readme.partition(README_BEGIN)
    _, _, after = rest.partition(README_END)
    return f"{before}{README_BEGIN}\n{readme_section()}{README_END}{after}"


def _named(declarations: Iterable[Declaration], prefix: str) -> str:
    return ", ".join(f"`{prefix}{d.name}`" for d in declarations)


def _table(declarations: Iterable[Declaration], prefix: str) -> str:
    return "\n".join(_rows(declarations, prefix))


def _rows(declarations: Iterable[Declaration], prefix: str) -> Iterator[str]:
    yield "| Variable | | Type | Unit | Start | Identifier | Meaning |"
    yield "| --- | --- | --- | --- | --- | ---: | --- |"
    for d in declarations:
        yield (
            f"| `{prefix}{d.name}` | {d.causality} | {TYPE_NAMES[type(d.start)]} | {_units(d)} | {_start(d)} "
            f"| {d.identifier} | {d.description} |"
        )


def _units(declaration: Declaration | TableArray) -> str:
    return ", ".join(dict.fromkeys(declaration.unit.format(unit) for unit in ("mm", "deg")))


def _start(declaration: Declaration) -> str:
    if declaration.causality == "output":
        return ""
    return str(declaration.start).lower() if isinstance(declaration.start, bool) else repr(declaration.start)
