"""The compiled kernel, called through ctypes."""

from __future__ import annotations

from typing import TYPE_CHECKING

from ..model.face import face

if TYPE_CHECKING:
    from .compiler import (
        FLAGS as FLAGS,
        PLATFORMS as PLATFORMS,
        CompilerError as CompilerError,
        compile_library as compile_library,
        compile_program as compile_program,
        compiler_of as compiler_of,
        has_cross_compiler as has_cross_compiler,
        own_platform as own_platform,
    )
    from .image import (
        HEADER_BEFORE_CHECK as HEADER_BEFORE_CHECK,
        MAGIC as MAGIC,
        image_of as image_of,
        image_source as image_source,
    )
    from .layout import ctypes_of as ctypes_of, from_c as from_c, offset_of as offset_of, to_c as to_c
    from .library import SWITCH as SWITCH, compiled_kernel as compiled_kernel
    from .places import layout_header as layout_header, places_source as places_source
    from .runner import (
        NOTHING as NOTHING,
        POKES_MAX as POKES_MAX,
        Bound as Bound,
        CompiledRuntime as CompiledRuntime,
        Fields as Fields,
        Poke as Poke,
    )
else:
    __all__, __getattr__, __dir__ = face(
        __name__,
        compiler="CompilerError FLAGS PLATFORMS compile_library compile_program compiler_of has_cross_compiler "
        "own_platform",
        image="HEADER_BEFORE_CHECK MAGIC image_of image_source",
        layout="ctypes_of from_c offset_of to_c",
        library="SWITCH compiled_kernel",
        places="layout_header places_source",
        runner="Bound CompiledRuntime Fields NOTHING POKES_MAX Poke",
    )
