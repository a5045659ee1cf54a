"""What a cycle costs: the engine and the FMU, over machines of all sizes."""

from __future__ import annotations

from typing import TYPE_CHECKING

from ..model.face import face

if TYPE_CHECKING:
    from .clock import Sample as Sample
    from .engine import (
        bench_calls as bench_calls,
        bench_engine as bench_engine,
        bench_growth as bench_growth,
        bench_memory as bench_memory,
    )
    from .fmu import bench_fmus as bench_fmus
    from .history import HistoryError as HistoryError, compared as compared, save as save
    from .machines import machine_of as machine_of
    from .native_host import NativeHost as NativeHost, bench_native_host as bench_native_host, plan_of as plan_of
    from .reading import bench_lists as bench_lists, split_and_float as split_and_float
else:
    __all__, __getattr__, __dir__ = face(
        __name__,
        clock="Sample",
        engine="bench_calls bench_engine bench_growth bench_memory",
        fmu="bench_fmus",
        history="HistoryError compared save",
        machines="machine_of",
        native_host="NativeHost bench_native_host plan_of",
        reading="bench_lists split_and_float",
    )
