"""What the native FMU costs in a host written in C, beside an FMU that only copies and the kernel without an FMU."""

from __future__ import annotations

import subprocess
import sys
import tempfile
from collections.abc import Iterable, Iterator
from pathlib import Path

from ..fmu import IMAGE
from ..interface import Variable, variables_of, with_causality
from ..lists import read_machine
from ..model import CYCLE_TIME, Machine, fmu_sources, models
from ..native import LIBRARY_SOURCES, PLATFORMS, compile_library, compile_program, compiler_of, image_of, own_platform
from ..runtime import compile_tables
from ..saving import write_whole
from .clock import Sample, ratio
from .machines import machine_of

AXES = (3, 8, 16, 32)
POINTS = (10, 100, 1000, 10_000)
GUID = "{bench}"
KERNEL_SOURCES = ("image.c", "kernel.c", "memory.c", "records.c", "resource.c")
GOALS = {"three_axis": 1000.0, "five_axis": 3000.0}
"""Example machine → what a cycle may cost in a C host, ns."""

CALLS = 1.4
"""The FMU may cost so many times what copying and the bare kernel cost together."""

TRAVELS = {0.25: 1.3, 10.0: 1.3, 0.0: 2.0}
"""mm a cycle, 0: anywhere → what 10⁴ and 10⁵ points may cost of what 10 points do."""


class NativeHost:
    """The C host, an FMU library and one that only copies, compiled into a folder.

    Raises
    ------
    CompilerError
        If there is no C compiler, or it fails.
    """

    def __init__(self, folder: Path) -> None:
        native, host = (fmu_sources() / name for name in ("native", "native_host"))
        platform = own_platform()
        suffix = PLATFORMS[platform].suffix
        compiler = compiler_of(platform)
        includes = [f"-I{native}", f"-I{host}"]
        self._folder = folder
        self._host = folder / f"bench{'.exe' if sys.platform == 'win32' else ''}"
        self._fmu, self._copy = folder / f"axcomp{suffix}", folder / f"copy{suffix}"
        compile_library([native / name for name in LIBRARY_SOURCES], self._fmu, compiler=compiler, platform=platform)
        compile_library(
            [host / "copying_fmu.c"], self._copy, compiler=compiler, platform=platform, flags=[f"-I{native}"]
        )
        sources = [host / "bench.c", host / "fmu_library.c", *(native / name for name in KERNEL_SOURCES)]
        compile_program(sources, self._host, compiler=compiler, flags=includes)

    def cycle(self, machine: Machine, batches: int) -> tuple[float, ...]:
        """Return the ns of a cycle through the FMU: set all inputs, step, get all outputs."""
        return self._through(self._fmu, machine, batches)

    def copying(self, machine: Machine, batches: int) -> tuple[float, ...]:
        """Return the ns of a cycle through the FMU that only copies, with as many variables."""
        return self._through(self._copy, machine, batches)

    def kernel(self, machine: Machine, batches: int, travel: float | None = None) -> tuple[float, ...]:
        """Return the ns of a cycle of the kernel alone; ``travel``: mm a cycle, 0: each cycle is somewhere else."""
        self._write_image(machine)
        return self._run("kernel", str(self._folder / IMAGE), str(batches), *([] if travel is None else [repr(travel)]))

    def _through(self, library: Path, machine: Machine, batches: int) -> tuple[float, ...]:
        self._write_image(machine)
        plan = self._folder / "plan.txt"
        write_whole(plan, plan_of(machine))
        return self._run("fmu", str(library), str(self._folder), GUID, str(plan), str(batches))

    def _write_image(self, machine: Machine) -> None:
        write_whole(self._folder / IMAGE, image_of(compile_tables(machine), GUID))

    def _run(self, *arguments: str) -> tuple[float, ...]:
        result = subprocess.run([self._host, *arguments], capture_output=True, text=True, check=False)
        if result.returncode != 0:
            raise RuntimeError(f"the host program has failed: {result.stderr.strip()}")
        return tuple(map(float, result.stdout.split()))


def plan_of(machine: Machine) -> str:
    """Return the plan that ``bench.c`` reads: step size, then the variables to set and to get."""
    inputs = [v for v in with_causality(variables_of(machine), "input") if v.name != "reload"]
    outputs = with_causality(variables_of(machine), "output")
    groups = [
        *(_of_type(inputs, kind) for kind in (float, bool, int)),
        *(_of_type(outputs, k) for k in (float, int, bool)),
    ]
    texts = (" ".join(map(str, (len(group), *(v.reference for v in group)))) for group in groups)
    return "\n".join([repr(CYCLE_TIME), *texts, ""])


def _of_type(variables: Iterable[Variable], kind: type) -> list[Variable]:
    return [variable for variable in variables if type(variable.start) is kind]


def bench_native_host(repeats: int) -> Iterator[Sample]:
    """Measure the example machines in the C host, and how a cycle grows with the axes and with the points.

    Batches of 2000 cycles are measured ten times as often as ``repeats``. CompilerError if there is no C compiler, or
    it fails.
    """
    batches = 10 * repeats
    with tempfile.TemporaryDirectory() as folder:
        host = NativeHost(Path(folder))
        for name, goal in GOALS.items():
            machine = read_machine(models() / name).machine
            yield from _beside(host, machine, name, batches, goal)
        yield from _beside(host, machine_of(32, 100), "32 axes with all kinds", batches)
        for travel, most in TRAVELS.items():
            yield from _over_points(host, travel, most, batches)
        for axes in AXES:
            yield Sample(f"C host, {axes} axes, 100 points", "ns", host.cycle(machine_of(axes, 100), batches))
        for points in POINTS:
            yield Sample(f"C host, 3 axes, {points} points", "ns", host.cycle(machine_of(3, points), batches))


def _beside(host: NativeHost, machine: Machine, name: str, batches: int, goal: float | None = None) -> Iterator[Sample]:
    """Measure the FMU of a machine, the bare kernel, and an FMU that only copies."""
    kernel = Sample(f"bare kernel, {name}", "ns", host.kernel(machine, batches))
    copying = Sample(f"FMU that only copies, variables of {name}", "ns", host.copying(machine, batches))
    cycle = Sample(f"cycle of {name} in a C host", "ns", host.cycle(machine, batches), goal)
    yield from (kernel, copying, cycle)
    # With a volumetric compensation the FMU is given more that moves than the bare kernel is: a tool length, factors.
    if not machine.volumetric:
        yield ratio(f"cycle of {name} in a C host / (kernel + copying)", cycle, (kernel, copying), CALLS)


def _over_points(host: NativeHost, travel: float, most: float, batches: int) -> Iterator[Sample]:
    """Measure what many points cost of what few do."""
    how = f"{travel:g} mm a cycle" if travel else "anywhere in each cycle"
    few = Sample(f"kernel, 10 points, {how}", "ns", host.kernel(machine_of(3, 10), batches, travel))
    yield few
    for points in (10_000, 100_000):
        many = Sample("", "ns", host.kernel(machine_of(3, points), batches, travel))
        yield ratio(f"kernel, {points} points / 10, {how}", many, (few,), most)
