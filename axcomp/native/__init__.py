"""The compiled kernel, called through ctypes."""

from __future__ import annotations

from typing import TYPE_CHECKING

from ..model.face import face

if TYPE_CHECKING:
    from .compiler import FLAGS as FLAGS
    from .compiler import PLATFORMS as PLATFORMS
    from .compiler import CompilerError as CompilerError
    from .compiler import compile_library as compile_library
    from .compiler import compile_program as compile_program
    from .compiler import compiler_of as compiler_of
    from .compiler import has_cross_compiler as has_cross_compiler
    from .compiler import own_platform as own_platform
    from .image import HEADER_BEFORE_CHECK as HEADER_BEFORE_CHECK
    from .image import MAGIC as MAGIC
    from .image import image_of as image_of
    from .image import image_source as image_source
    from .layout import ctypes_of as ctypes_of
    from .layout import from_c as from_c
    from .layout import to_c as to_c
    from .library import SWITCH as SWITCH
    from .library import compiled_kernel as compiled_kernel
    from .places import layout_header as layout_header
    from .places import places_source as places_source
    from .runner import CompiledTables as CompiledTables
    from .runner import run_compiled as run_compiled
else:
    __all__, __getattr__, __dir__ = face(
        __name__,
        compiler="CompilerError FLAGS PLATFORMS compile_library compile_program compiler_of has_cross_compiler "
        "own_platform",
        image="HEADER_BEFORE_CHECK MAGIC image_of image_source",
        layout="ctypes_of from_c to_c",
        library="SWITCH compiled_kernel",
        places="layout_header places_source",
        runner="CompiledTables run_compiled",
    )
