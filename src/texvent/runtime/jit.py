"""The decorator of compiled functions; their cache on disk follows the files that they call."""

from __future__ import annotations

import functools
import hashlib
import importlib.util
import re
import sys
from collections.abc import Callable
from pathlib import Path
from typing import Any, TypeVar, overload

import numba
from numba import types
from numba.core.caching import FunctionCache, IndexDataCacheFile
from numba.core.codegen import JITCodeLibrary
from numba.core.compiler import Compiler

from texvent.runtime.progress import tell_of_compilation

Function = TypeVar("Function", bound=Callable[..., Any])

_IMPORT = re.compile(r"^(?:from ([\w.]+) import (\([^)]*\)|.*)|import ([\w.]+))", re.MULTILINE)


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
                kernel._cache = _KernelCache(function)
            kernel.get_call_template = functools.partial(_template_of, kernel)
        return kernel

    return decorate if function is None else decorate(function)


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
    """What kernels call; calls from Python find nothing."""
    kernel.overloads[tuple(compiled.signature.args)] = compiled


def _refuse(name: str, *_: Any, **__: Any) -> None:
    raise TypeError(f"{name} is an inner function, which only kernels call")


class _KernelCache(FunctionCache):
    """Numba's cache of a function on disk, valid for one state of all files that it depends on."""

    def __init__(self, function: Any) -> None:
        super().__init__(function)  # type: ignore[no-untyped-call]
        # Numba compares the stamp with that on disk. Its own is of one file.
        stamp = (self._cache_file._source_stamp, _stamp(function.__module__))
        name = self._impl.filename_base
        self._cache_file = _KernelIndex(self._cache_path, name, stamp)  # type: ignore[no-untyped-call]

    def load_overload(self, signature: Any, target_context: Any) -> Any:
        found = super().load_overload(signature, target_context)  # type: ignore[no-untyped-call]
        if found is None:
            tell_of_compilation()
        return found


class _KernelIndex(IndexDataCacheFile):
    """The compiled signatures of a kernel; they may name types that were renamed since."""

    def _load_index(self) -> Any:
        try:
            return super()._load_index()  # type: ignore[no-untyped-call]
        except (AttributeError, ImportError):
            return {}


@functools.cache
def _stamp(module: str) -> str:
    """Digest of the files that a module consists of: its own and those that it imports."""
    packages = {_package(module), _package(__name__)}
    digests: dict[str, str] = {}
    pending = [module]
    while pending:
        name = pending.pop()
        path = getattr(sys.modules.get(name), "__file__", None)
        if path is not None and name not in digests and _package(name) in packages:
            digests[name], imported = _read(name, path)
            pending += imported
    return hashlib.sha256(repr(sorted(digests.items())).encode()).hexdigest()


@functools.cache
def _read(module: str, path: str) -> tuple[str, list[str]]:
    """Digest of a file, and the names that it imports: of modules, and of what is in them."""
    source = Path(path).read_text("utf-8")
    package = getattr(sys.modules[module], "__package__", None)
    names: list[str] = []
    for origin, parts, whole in _IMPORT.findall(source):
        name = importlib.util.resolve_name(origin or whole, package)
        names += [name, *(f"{name}.{part}" for part in re.findall(r"\w+", parts))]
    return hashlib.sha256(source.encode()).hexdigest(), names


def _package(module: str) -> str:
    return module.partition(".")[0]
