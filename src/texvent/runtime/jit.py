"""The decorator of compiled functions."""

from __future__ import annotations

import functools
from collections.abc import Callable
from typing import Any, TypeVar, overload

import numba
import numba.extending
from numba import types
from numba.core.codegen import JITCodeLibrary
from numba.core.compiler import Compiler

from texvent.runtime.kernel_cache import cache_of

Function = TypeVar("Function", bound=Callable[..., Any])


@overload
def jit(function: Function, /) -> Function: ...
@overload
def jit(*, inner: bool = False, **options: Any) -> Callable[[Function], Function]: ...
def jit(function: Any = None, /, *, inner: bool = False, **options: Any) -> Any:
    """Compile a function with Numba at its first call; later processes read it from disk.

    It is compiled again when its file changes, or a file of its package (or of texvent) that its
    module imports, directly or through others: what a kernel calls and the constants it reads are
    built into it. Arithmetic is IEEE (no fastmath), and the interpreter lock is released.

    Args:
        function: what to compile.
        inner: only other kernels call it: it has neither an entry for Python nor machine code of
            its own, and compiles sooner.
        **options: other options of `numba.njit`, such as `error_model` and `inline`.

    Returns:
        The compiled function; the function itself with NUMBA_DISABLE_JIT=1.
    """
    if inner:
        options |= {"no_cpython_wrapper": True, "no_cfunc_wrapper": True}
        options["pipeline_class"] = _InnerCompiler

    def decorate(function: Any) -> Any:
        kernel: Any = numba.njit(nogil=True, **options)(function)
        if hasattr(kernel, "py_func"):  # not with NUMBA_DISABLE_JIT=1
            if inner:
                kernel.add_overload = functools.partial(_add_overload, kernel)
                kernel._compile_for_args = functools.partial(_refuse, function.__name__)
            else:
                kernel._cache = cache_of(function)
            kernel.get_call_template = functools.partial(_template_of, kernel)
        return kernel

    return decorate if function is None else decorate(function)


def intrinsic(typed: Any, in_python: Any) -> Any:
    """A function of kernels in LLVM's language; with NUMBA_DISABLE_JIT=1 the same in Python.

    Args:
        typed: as `numba.extending.intrinsic` takes it.
        in_python: the same function, of NumPy's numbers and arrays.
    """
    config: Any = numba.config
    return in_python if config.DISABLE_JIT else numba.extending.intrinsic(typed)


_type_of: Any = types.unliteral


def _template_of(kernel: Any, arguments: Any, keywords: Any) -> Any:
    """Call from another kernel: compiled for types, not once for each constant passed."""
    arguments = tuple(_type_of(one) for one in arguments)
    keywords = {name: _type_of(one) for name, one in keywords.items()}
    return type(kernel).get_call_template(kernel, arguments, keywords)


class _InnerLibrary(JITCodeLibrary):
    """Code of an inner function, optimised for the kernels that call it, but not emitted."""

    def _optimize_final_module(self) -> None:
        # The kernels that it is linked into are optimised thoroughly.
        codegen: Any = self._codegen
        passes, builder = codegen._module_pass_manager(
            loop_vectorize=False, slp_vectorize=False, opt=codegen._opt_level, cost="cheap"
        )
        passes.run(self._final_module, builder)

    def _finalize_final_module(self) -> None:
        self._finalize_dynamic_globals()  # type: ignore[no-untyped-call]
        self._finalized = True


class _InnerCompiler(Compiler):
    def compile_extra(self, func: Any) -> Any:
        library: Any = _InnerLibrary
        self.state.library = library(self.state.targetctx.codegen(), func.__qualname__)
        self.state.targetctx.get_executable = _without_entry
        return super().compile_extra(func)  # type: ignore[no-untyped-call]


def _without_entry(library: Any, *_: Any) -> Any:
    library.finalize()
    return library  # stands for the entry


def _add_overload(kernel: Any, compiled: Any) -> None:
    """Register a compiled form for calls from kernels; those from Python do not find it."""
    kernel.overloads[tuple(compiled.signature.args)] = compiled


def _refuse(name: str, *_: Any, **__: Any) -> None:
    raise TypeError(f"{name} is an inner function, which only kernels call")
