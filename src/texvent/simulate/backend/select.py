"""Backend by name. Nothing is imported before a kernel is first used."""

from __future__ import annotations

import functools
import importlib
import importlib.util
from typing import Any, Generic, TypeVar

import numpy as np

from texvent._registry import suggest
from texvent._require import require
from texvent.errors import ConfigError, shown
from texvent.runtime.background_jit import is_ready

Function = TypeVar("Function")

AUTO = "auto"
_PACKAGES = {"cpu": "numba"}
BACKENDS = (AUTO, "cpu", "numpy", "reference")
"""Names of backends; "auto" is the first of the others that is ready."""
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
    for "numpy" where there is no other. `<home>_cpu.warm_up(*variant)` compiles.
    """

    def __init__(self, home: str, name: str) -> None:
        """Name a kernel; nothing is imported.

        Args:
            home: full name of the module that describes the kernel.
            name: of the function.
        """
        self._home, self._name = home, name
        self._ready: dict[Any, Function] = {}

    def load(self, backend: str = AUTO, dtype: np.dtype[Any] | None = None) -> Function:
        """The function of a backend; "auto" is "numpy" until the compiled one is ready.

        Args:
            backend: one of `BACKENDS`.
            dtype: type of the frames, where the kernel is compiled for one.

        Raises:
            ConfigError: no backend has that name.
            MissingDependencyError: what the backend needs is not installed.
        """
        if backend != AUTO:
            function: Function = _load(self._home, self._name, check_backend(backend))
            return function
        if dtype not in self._ready:
            variant = () if dtype is None else (dtype.name,)
            if not is_ready(f"{self._home}_cpu", *variant):
                return self.load("numpy")
            # Asked for at every frame, so the answer is kept.
            self._ready[dtype] = self.load("cpu")
        return self._ready[dtype]


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
