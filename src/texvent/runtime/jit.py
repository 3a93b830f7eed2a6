"""Compiled functions: their decorator, and their files on disk.

A file is valid for the sources that its function consists of, and made anew where damaged.
It holds one kernel for one signature and processor, in a folder that Numba chooses:
$NUMBA_CACHE_DIR, else beside the source, else below the user's cache folder; last, a private folder
for temporary files. Where none can be written, kernels are compiled at each start. No error leaves
here: a file that cannot be read is not there, and one that cannot be written is left out.
"""

from __future__ import annotations

import contextlib
import functools
import gc
import hashlib
import importlib.util
import itertools
import os
import pickle
import re
import stat
import sys
import tempfile
from collections.abc import Callable
from pathlib import Path
from typing import Any, TypeVar, overload

import numba
import numba.extending
from numba import types
from numba.core.caching import (
    CompileResultCacheImpl,
    FunctionCache,
    IndexDataCacheFile,
    InTreeCacheLocator,
    NullCache,
    UserWideCacheLocator,
)
from numba.core.codegen import JITCodeLibrary
from numba.core.compiler import Compiler

from texvent.errors import warn
from texvent.runtime.progress import tell_of_compilation

_IMPORT = re.compile(r"^(?:from ([\w.]+) import (\([^)]*\)|.*)|import ([\w.]+))", re.MULTILINE)
_SEAL_BYTES = hashlib.sha256().digest_size
_NOTICES = itertools.count()


def cache_of(function: Any) -> Any:
    """Cache of a function for Numba; one that keeps nothing where no folder can be written."""
    try:
        return _KernelCache(function)
    except (OSError, RuntimeError, ValueError):  # RuntimeError: Numba found no folder
        return _NoCache()


def kernel_folder() -> Path | None:
    """Folder of the compiled functions of this file's folder; None: they are kept nowhere."""
    path = cache_of(cache_of).cache_path
    return None if path is None else Path(path)


class _HomeFolder(UserWideCacheLocator):
    """The user's cache folder, where the user has a home."""

    def ensure_cache_path(self) -> None:
        if not os.path.isabs(self._cache_path):
            raise FileNotFoundError("the user has no home folder")
        super().ensure_cache_path()  # type: ignore[no-untyped-call]


class _TemporaryFolder(InTreeCacheLocator):
    """A folder among the temporary files that no other user can write: what it holds is run."""

    def __init__(self, function: Any, path: str) -> None:
        super().__init__(function, path)  # type: ignore[no-untyped-call]
        part = self.get_suitable_cache_subpath(path)  # type: ignore[no-untyped-call]
        self._cache_path = str(self.base() / part)

    @staticmethod
    def base() -> Path:
        """The folder of all kernels of this user."""
        user = os.geteuid() if hasattr(os, "geteuid") else "user"
        return Path(tempfile.gettempdir()) / f"texvent-kernels-{user}"

    def ensure_cache_path(self) -> None:
        base = self.base()
        with contextlib.suppress(FileExistsError):
            base.mkdir(mode=0o700)
        found = base.lstat()
        is_own = not hasattr(os, "geteuid") or (
            found.st_uid == os.geteuid() and not stat.S_IMODE(found.st_mode) & 0o077
        )
        if not stat.S_ISDIR(found.st_mode) or not is_own:
            raise PermissionError(f"{base} is not of this user alone")
        super().ensure_cache_path()  # type: ignore[no-untyped-call]


class _Implementation(CompileResultCacheImpl):
    """Numba's choice of a folder, with the temporary one as the last."""

    _locator_classes: Any = (
        *(
            _HomeFolder if one is UserWideCacheLocator else one
            for one in CompileResultCacheImpl._locator_classes
        ),
        _TemporaryFolder,
    )


class _KernelCache(FunctionCache):
    """Numba's cache of a function on disk, valid for one state of all files that it depends on."""

    _impl_class = _Implementation

    def __init__(self, function: Any) -> None:
        super().__init__(function)  # type: ignore[no-untyped-call]
        stamp = f"{numba.__version__} {_stamp(function.__module__)}"
        self._cache_file = _KernelFiles(self._cache_path, self._impl.filename_base, stamp)

    def load_overload(self, signature: Any, target_context: Any) -> Any:
        try:
            found = super().load_overload(signature, target_context)  # type: ignore[no-untyped-call]
        except Exception:  # noqa: BLE001  # whatever it is, compiling does instead
            found = None
        if found is None:
            tell_of_compilation()
            if isinstance(self._impl.locator, _TemporaryFolder):
                _tell_of_folder(f"are kept in {_TemporaryFolder.base()} for now")
        return found

    def save_overload(self, signature: Any, data: Any) -> None:
        try:
            super().save_overload(signature, data)  # type: ignore[no-untyped-call]
        except OSError as error:
            _tell_of_folder(f"cannot be kept in {self.cache_path} ({error.strerror})")


class _NoCache(NullCache):
    def load_overload(self, signature: Any, target_context: Any) -> None:
        tell_of_compilation()
        _tell_of_folder("are kept nowhere: no folder for them can be written")


def _tell_of_folder(state: str) -> None:
    """Warn, once in a process."""
    if next(_NOTICES) == 0:
        warn(
            f"compiled functions {state}; so that later runs need not compile them again, name a "
            "folder that stays and can be written with the environment variable NUMBA_CACHE_DIR"
        )


class _KernelFiles(IndexDataCacheFile):
    """One file for each signature, sealed with a digest of what it holds and was made of.

    Numba's own index and files can be of two processes, and are taken as they are: a bit that
    fell over in machine code would run.
    """

    def __init__(self, folder: str, name: str, stamp: str) -> None:
        super().__init__(folder, name, stamp)  # type: ignore[no-untyped-call]
        self._place, self._stamp = Path(folder) / name, stamp.encode()

    def load(self, key: Any) -> Any:
        content = self._path(key).read_bytes()
        seal, data = content[:_SEAL_BYTES], content[_SEAL_BYTES:]
        stored, compiled = pickle.loads(data) if seal == self._seal(data) else (None, None)
        return compiled if stored == key else None

    def save(self, key: Any, data: Any) -> None:
        content = self._dump((key, data))  # type: ignore[no-untyped-call]
        with self._open_for_write(str(self._path(key))) as file:
            file.write(self._seal(content) + content)

    def _path(self, key: Any) -> Path:
        digest = hashlib.sha256(str(key).encode()).hexdigest()[:12]
        return self._place.with_name(f"{self._place.name}.{digest}.nbc")

    def _seal(self, data: bytes) -> bytes:
        return hashlib.sha256(self._stamp + data).digest()


@functools.cache
def _stamp(module: str) -> str:
    """Digest of the files that a module consists of: its own and those that it imports.

    Of other packages than its own, those of texvent count: texvent, texvent_scenes, texvent_lab.
    """
    digests: dict[str, str] = {}
    pending = [module]
    while pending:
        name = pending.pop()
        path = getattr(sys.modules.get(name), "__file__", None)
        is_own = _package(name) == _package(module) or _package(name).startswith(_package(__name__))
        if path is not None and name not in digests and is_own:
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
    options["pipeline_class"] = _InnerCompiler if inner else _KernelCompiler

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


class _KernelCompiler(Compiler):
    """Compiler that does not search for cyclic garbage, a seventh of its time."""

    def compile_extra(self, func: Any) -> Any:
        was_on = gc.isenabled()
        gc.disable()
        try:
            return super().compile_extra(func)  # type: ignore[no-untyped-call]
        finally:
            if was_on:
                gc.enable()


class _InnerCompiler(_KernelCompiler):
    def compile_extra(self, func: Any) -> Any:
        library: Any = _InnerLibrary
        self.state.library = library(self.state.targetctx.codegen(), func.__qualname__)
        self.state.targetctx.get_executable = _without_entry
        return super().compile_extra(func)


def _without_entry(library: Any, *_: Any) -> Any:
    library.finalize()
    return library  # stands for the entry


def _add_overload(kernel: Any, compiled: Any) -> None:
    """Register a compiled form for calls from kernels; those from Python do not find it."""
    kernel.overloads[tuple(compiled.signature.args)] = compiled


def _refuse(name: str, *_: Any, **__: Any) -> None:
    raise TypeError(f"{name} is an inner function, which only kernels call")
