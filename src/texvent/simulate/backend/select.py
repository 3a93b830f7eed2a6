"""Backend by name. Nothing is imported before a kernel is first used."""

from __future__ import annotations

import functools
import importlib
import importlib.util
from typing import Any, Generic, TypeVar

from texvent._registry import suggest
from texvent._require import require
from texvent.errors import ConfigError, shown

Function = TypeVar("Function")

AUTO = "auto"
_PACKAGES = {"cpu": "numba"}
BACKENDS = (AUTO, "cpu", "numpy", "reference")
"""Names of backends; "auto" is "cpu"."""
GPU = "gpu"
"""Runs whole models instead of kernels, those that have it; see `texvent.simulate.gpu`."""


def check_backend(backend: str, *, has_gpu: bool = False) -> str:
    """Return `backend` if it is one of `BACKENDS`, or "gpu" of a model that has that.

    Raises:
        ConfigError: it is not.
    """
    if backend == GPU and not has_gpu:
        raise ConfigError(
            "this simulator has no backend gpu; use simulator texvent or esim, or backend cpu"
        )
    allowed = (*BACKENDS, GPU)
    if backend not in allowed:
        raise ConfigError(f"unknown backend {shown(backend)}; {suggest(backend, allowed)}")
    return backend


class Kernel(Generic[Function]):
    """A function that several backends compute, all with the same results.

    It is `<home>_cpu.NAME`, compiled, `<home>_numpy.NAME`, or `<home>_reference.NAME`, the readable
    definition. The definition may also be in the module `reference` of the same folder, and serves
    for "numpy" where there is no other.
    """

    def __init__(self, home: str, name: str) -> None:
        """Name a kernel; nothing is imported.

        Args:
            home: full name of the module that describes the kernel.
            name: of the function.
        """
        self._home, self._name = home, name

    def load(self, backend: str = AUTO) -> Function:
        """The function of a backend; a compiled one is compiled, once on a machine, when it runs.

        Args:
            backend: one of `BACKENDS`.

        Raises:
            ConfigError: no backend has that name.
            MissingDependencyError: what the backend needs is not installed.
        """
        name = "cpu" if backend == AUTO else check_backend(backend)
        function: Function = _load(self._home, self._name, name)
        return function


@functools.cache
def _load(home: str, name: str, backend: str) -> Any:
    if backend in _PACKAGES:
        require(_PACKAGES[backend])
    return getattr(importlib.import_module(_module_of(home, backend)), name)


def _module_of(home: str, backend: str) -> str:
    names = [f"{home}_{backend}"]
    if backend == "numpy":
        names.append(f"{home}_reference")
    found = (name for name in names if importlib.util.find_spec(name) is not None)
    return next(found, f"{home.rpartition('.')[0]}.reference")
