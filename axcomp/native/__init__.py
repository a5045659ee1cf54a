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
        cross_compile as cross_compile,
        has_cross_compiler as has_cross_compiler,
        own_platform as own_platform,
    )
    from .image import (
        HEADER_BEFORE_CHECK as HEADER_BEFORE_CHECK,
        MAGIC as MAGIC,
        image_of as image_of,
        tables_source as tables_source,
    )
    from .layout import address_of as address_of, ctypes_of as ctypes_of, from_c as from_c, to_c as to_c
    from .library import SWITCH as SWITCH, compiled_kernel as compiled_kernel, wasm_kernel as wasm_kernel
    from .places import layout_header as layout_header, places_source as places_source
    from .prebuilt import WASM as WASM, prebuilt_path as prebuilt_path, why_not_prebuilt as why_not_prebuilt
    from .records import records_source as records_source
    from .runner import (
        NOTHING as NOTHING,
        POKES_MAX as POKES_MAX,
        Bound as Bound,
        CompiledRuntime as CompiledRuntime,
        Fields as Fields,
        Poke as Poke,
    )
    from .sources import (
        HEADERS as HEADERS,
        LIBRARY_HEADERS as LIBRARY_HEADERS,
        LIBRARY_SOURCES as LIBRARY_SOURCES,
        SOURCES as SOURCES,
        THIRD_HEADERS as THIRD_HEADERS,
        THIRD_SOURCES as THIRD_SOURCES,
        source_bytes as source_bytes,
        source_path as source_path,
    )
else:
    __all__, __getattr__, __dir__ = face(
        __name__,
        compiler="CompilerError FLAGS PLATFORMS compile_library compile_program compiler_of cross_compile "
        "has_cross_compiler own_platform",
        image="HEADER_BEFORE_CHECK MAGIC image_of tables_source",
        layout="address_of ctypes_of from_c to_c",
        library="SWITCH compiled_kernel wasm_kernel",
        places="layout_header places_source",
        prebuilt="WASM prebuilt_path why_not_prebuilt",
        records="records_source",
        runner="Bound CompiledRuntime Fields NOTHING POKES_MAX Poke",
        sources="HEADERS LIBRARY_HEADERS LIBRARY_SOURCES SOURCES THIRD_HEADERS THIRD_SOURCES source_bytes source_path",
    )
