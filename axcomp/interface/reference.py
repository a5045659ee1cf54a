"""The FMU's variables as documentation; ``python -m axcomp.interface`` writes page and README section."""

from __future__ import annotations

from collections.abc import Iterable, Iterator

from ..kinds import KIND_NAMES, KINDS
from ..model import models
from .errors import ERRORS
from .variable import BLOCK, TYPE_NAMES
from .variables import (
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

PAGE = models().parent / "docs" / "fmu-reference.md"
README = models().parent / "README.md"
README_BEGIN, README_END = "<!-- variables -->", "<!-- end of variables -->"

HEAD = """\
# Variables of axcomp.fmu

Written by `python -m axcomp.interface` from `axcomp/interface/variables.py`.

`NAME` is the name of an axis (`kopf.log_achs_name`, else `axis<number>`) with `_` for what an identifier cannot hold.
Only what is configured appears. Units are those of the axis: mm or deg, mm/s or deg/s, mm/s2 or deg/s2, each defined by
its factor to SI units, so that tools convert. With `--naming flat` every `.` is a `_`.

A value reference is `{block} · block + identifier`, the same in every FMU: block {machine} is the machine's, block
{axis} + i that of axis i = 0 … 31 in the order of the lists, block {volumetric} + j that of volumetric compensation
j = 0 … 4.
"""

STEPS = """\
## Time

* The cycles of the position controller lie at start time + k · `cycle_time`. A communication step [t, t + h) runs those
  whose instants fall into it, with the inputs held; if none does, the outputs hold. How a stretch of time is divided
  into steps therefore changes nothing at the instants.
* The outputs read after a step belong to the inputs set before it: FMI 2.0 co-simulation has no feedthrough inside a
  step. At the end of initialization they belong to the start values.
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
| A call that cannot be carried out | returns an error, and the log says why | sets `NAME.error`; the log and standard \
error say why |
| Unpacked under any path | yes | not where it holds one of `ü + ( ) [ ] # , %`: pythonfmu's library fails there |

The native FMU's tables lie in `resources/tables.bin`; it belongs to the guid, so that of another FMU is refused.
Instances of a library share them; an instance has some 10 kB besides, and its serialized state 1 kB for each axis.
Memory is allocated when an instance or a state is made or `reload` is set, not in steps.

`fmpy compile axcomp.fmu`, or a host that takes source-code FMUs, compiles the sources with the tables in them
(`tables.c`): no file is read, nothing is allocated or logged, and `reload` is refused.

## Errors

`NAME.error` is 0 or one of these, until `reset`:

| Number | Meaning |
| ---: | --- |
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
    return f"{head}\n{tables}\n{STEPS}{errors}\n"


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


def _units(declaration: Declaration) -> str:
    return ", ".join(dict.fromkeys(declaration.unit.format(unit) for unit in ("mm", "deg")))


def _start(declaration: Declaration) -> str:
    if declaration.causality == "output":
        return ""
    if declaration.name.endswith(".enable"):
        return "automatic activation"
    if declaration.path.startswith("compensation."):
        return "as listed"
    return str(declaration.start).lower() if isinstance(declaration.start, bool) else repr(declaration.start)
