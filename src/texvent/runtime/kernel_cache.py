"""Compiled functions on disk: valid for the files that they consist of, made anew where damaged.

A file holds one kernel for one signature and processor, in a folder that Numba chooses:
$NUMBA_CACHE_DIR, else beside the source, else below the user's cache folder; last, a private folder
for temporary files. Where none can be written, kernels are compiled at each start. No error leaves
here: a file that cannot be read is not there, and one that cannot be written is left out.
"""

from __future__ import annotations

import contextlib
import functools
import hashlib
import importlib.util
import itertools
import os
import pickle
import re
import stat
import sys
import tempfile
from pathlib import Path
from typing import Any

import numba
from numba.core.caching import (
    CompileResultCacheImpl,
    FunctionCache,
    IndexDataCacheFile,
    InTreeCacheLocator,
    NullCache,
    UserWideCacheLocator,
)

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
