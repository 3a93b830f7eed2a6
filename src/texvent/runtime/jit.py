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
from numba._dynfunc import make_function
from numba.core.caching import FunctionCache, IndexDataCacheFile
from numba.core.codegen import JITCodeLibrary
from numba.core.compiler import Compiler

from texvent.runtime.progress import tell_of_compilation

Function = TypeVar("Function", bound=Callable[..., Any])

_IMPORT = re.compile(r"^(?:from ([\w.]+) import (\([^)]*\)|.*)|import ([\w.]+))", re.MULTILINE)


@overload
def jit(function: Function, /) -> Function: ...
@overload
def jit(*, nogil: bool = True, **options: Any) -> Callable[[Function], Function]: ...
def jit(function: Any = None, /, *, nogil: bool = True, **options: Any) -> Any:
    """Compile a function with Numba at its first call; later processes read it from disk.

    It is compiled again when its file changes, or a file of its package (or of texvent) that its
    module imports, directly or through others: what a kernel calls and the constants it reads are
    built into it. Arithmetic is IEEE (no fastmath).

    Args:
        function: what to compile.
        nogil: release the interpreter lock, so that threads work at the same time.
        **options: other options of `numba.njit`, such as `error_model`, `inline` and `parallel`
            (no kernel may call a parallel one).

    Returns:
        The compiled function; the function itself with NUMBA_DISABLE_JIT=1.
    """

    def decorate(function: Any) -> Any:
        compiler: Any = None if options.get("parallel") else _KernelCompiler
        kernel: Any = numba.njit(nogil=nogil, pipeline_class=compiler, **options)(function)
        if hasattr(kernel, "py_func"):  # not with NUMBA_DISABLE_JIT=1
            inner = functools.cache(functools.partial(_inner, function, options))
            kernel._cache = _KernelCache(function)
            kernel.get_call_template = lambda *given: _template_of(inner(), *given)
            kernel.get_overload = lambda signature: inner().get_overload(signature)
        return kernel

    return decorate if function is None else decorate(function)


def _inner(function: Any, options: dict[str, Any]) -> Any:
    """The function as other kernels call it: without an entry for Python."""
    options = {**options, "no_cpython_wrapper": True, "no_cfunc_wrapper": True}
    return numba.njit(pipeline_class=_InnerCompiler, **options)(function)


_type_of: Any = types.unliteral


def _template_of(kernel: Any, arguments: Any, keywords: Any) -> Any:
    """Call from another kernel: compiled for types, not once for each constant passed."""
    arguments = tuple(_type_of(one) for one in arguments)
    keywords = {name: _type_of(one) for name, one in keywords.items()}
    return kernel.get_call_template(arguments, keywords)


class _KernelLibrary(JITCodeLibrary):
    """Code of a kernel: all that it calls is linked first, then optimised and emitted, once."""

    def finalize(self) -> None:
        _link_callees(self, self._final_module)
        self._linking_libraries.clear()
        super().finalize()  # type: ignore[no-untyped-call]


class _InnerLibrary(JITCodeLibrary):
    """Code of a function for the kernels that call it: neither optimised nor emitted here."""

    def finalize(self) -> None:
        self._finalized = True

    def _optimize_functions(self, ll_module: Any) -> None:
        ll_module.data_layout = self._codegen._data_layout

    def _get_module_for_linking(self) -> Any:
        module = self.own_module().clone()
        _link_callees(self, module)
        return module

    def own_module(self) -> Any:
        """The function without what it calls."""
        return super()._get_module_for_linking()  # type: ignore[no-untyped-call]


def _link_callees(library: Any, module: Any) -> None:
    """Link all that a library calls, directly or through others, into a module."""
    last_first: list[Any] = []
    _list_callees(library, last_first)
    for callee in reversed(last_first):  # LLVM links what is called so far, and drops the rest
        is_inner = isinstance(callee, _InnerLibrary)
        needed = callee.own_module() if is_inner else callee._get_module_for_linking()
        module.link_in(needed, preserve=True)


def _list_callees(library: Any, listed: list[Any]) -> None:
    for callee in reversed(library._linking_libraries):
        if callee not in listed:
            if isinstance(callee, _InnerLibrary):
                _list_callees(callee, listed)
            listed.append(callee)


class _KernelCompiler(Compiler):
    library_class: Any = _KernelLibrary

    def compile_extra(self, func: Any) -> Any:
        self.state.library = self.library_class(self.state.targetctx.codegen(), func.__qualname__)
        self.state.library.enable_object_caching()
        return super().compile_extra(func)  # type: ignore[no-untyped-call]


class _InnerCompiler(_KernelCompiler):
    library_class = _InnerLibrary

    def compile_extra(self, func: Any) -> Any:
        self.state.targetctx.get_executable = _finalize_without_entry
        return super().compile_extra(func)


def _finalize_without_entry(library: Any, description: Any, environment: Any) -> Any:
    library.finalize()
    name = description.qualname
    return make_function(description.lookup_module(), name, "", 0, environment, (library,))


class _KernelCache(FunctionCache):
    """Numba's cache of a function on disk, valid for one state of all files that it depends on."""

    def __init__(self, function: Any) -> None:
        super().__init__(function)  # type: ignore[no-untyped-call]
        # Numba compares the stamp with that on disk. Its own is of one file.
        stamp = (self._cache_file._source_stamp, _stamp(function.__module__))
        name = self._impl.filename_base
        self._cache_file = IndexDataCacheFile(self._cache_path, name, stamp)  # type: ignore[no-untyped-call]

    def load_overload(self, signature: Any, target_context: Any) -> Any:
        found = None
        try:
            found = super().load_overload(signature, target_context)  # type: ignore[no-untyped-call]
        except (AttributeError, ImportError):  # types of stored signatures were renamed since
            self.flush()  # type: ignore[no-untyped-call]
        if found is None:
            tell_of_compilation()
        return found


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
