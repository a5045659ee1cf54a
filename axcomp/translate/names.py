"""Names: those that C has already taken, and how a name of the source is written in C."""

from __future__ import annotations

import ast
import re

from .subset import RefusedError

_LANGUAGES = """
    alignas alignof and and_eq asm auto bitand bitor bool break case catch char char8_t char16_t char32_t class compl
    concept const consteval constexpr constinit const_cast continue co_await co_return co_yield decltype default
    delete do double dynamic_cast else enum explicit export extern false float for friend goto if inline int long
    mutable namespace new noexcept not not_eq nullptr operator or or_eq private protected public register
    reinterpret_cast requires restrict return short signed sizeof static static_assert static_cast struct switch
    template this thread_local throw true try typedef typeid typename typeof union unsigned using virtual void
    volatile wchar_t while xor xor_eq
"""
_MACROS = """
    NULL NAN INFINITY HUGE_VAL EOF I complex imaginary linux unix i386 min max errno
    isnan isinf isfinite isnormal signbit fpclassify math_errhandling stdin stdout stderr assert offsetof
"""  # of the headers in use, of compilers' GNU modes, and the two that <windows.h> is known for
_HELPERS = "floor sqrt fabs whole double_min double_max int_min int_max int_abs int_floor_div int_floor_mod"
_LIBRARY = """
    abort abs acos acosh asin asinh atan atan2 atanh atexit atof atoi atol atoll bsearch calloc cbrt ceil clock
    copysign cos cosh div drem erf erfc exit exp exp2 expm1 fdim fma fmax fmin fmod free frexp gamma getenv hypot
    ilogb index j0 j1 jn labs ldexp ldiv lgamma llabs lldiv llrint llround log log10 log1p log2 logb lrint lround
    main malloc memchr memcmp memcpy memmove memset modf nan nearbyint nextafter nexttoward pow qsort rand random
    realloc remainder remove remquo rename rindex rint round scalb scalbn select signal significand sin sincos sinh
    srand strcat strchr strcmp strcpy strlen strncmp strncpy system tan tanh tgamma time trunc y0 y1 yn
"""
_TAKEN = frozenset(f"{_LANGUAGES} {_MACROS} {_HELPERS}".split())
_TAKEN_AT_FILE_SCOPE = _TAKEN | frozenset(_LIBRARY.split())


def c_name(name: str) -> str:
    """Return a module-level name as C writes it: without leading underscores, which C reserves at file scope."""
    return name.lstrip("_")


def check_name(node: ast.AST, name: str, *, file_scope: bool = False) -> None:
    """Refuse a name that C or C++ has taken.

    At file scope the standard library's names are taken too, and leading underscores do not count: there they are
    dropped (see ``c_name``), because C reserves them.
    """
    bare = c_name(name) if file_scope else name
    if bare in (_TAKEN_AT_FILE_SCOPE if file_scope else _TAKEN):
        raise RefusedError(node, f"{name} already means something in C: choose another name")
    if not re.fullmatch(r"[A-Za-z_][A-Za-z0-9_]*", bare):
        raise RefusedError(node, f"{name} is no name in C: it takes ASCII letters, digits and _ only")
    if re.match(r"_[_A-Z]", bare) or (file_scope and bare.endswith("_t")):
        raise RefusedError(node, f"{name} is reserved for the C library: choose another name")
