"""Backend by name. Nothing is imported before a kernel is first used."""

from __future__ import annotations

import functools
import importlib
import importlib.util

from texvent._registry import suggest
from texvent._require import require
from texvent.errors import ConfigError, MissingDependencyError
from texvent.runtime.background_jit import is_ready

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
        raise ConfigError(f"unknown backend {backend!r}; {suggest(backend, allowed)}")
    return backend


def load_kernel(kernels: str, function: str, backend: str) -> object:
    """`function` of the module `<kernels>_<backend>`.

    The module for "reference" may also be `reference` in the same folder. Where there is none for
    "numpy" the reference serves, which is NumPy too.

    Raises:
        ConfigError: no backend has that name.
        MissingDependencyError: what the backend needs is not installed.
    """
    if check_backend(backend) == AUTO:
        try:
            return load_kernel(kernels, function, "cpu")
        except MissingDependencyError:
            # Not an error: the reference gives the same events, only later.
            return load_kernel(kernels, function, "reference")
    return _load(kernels, function, backend)


@functools.cache
def _load(kernels: str, function: str, backend: str) -> object:
    if backend in _PACKAGES:
        require(_PACKAGES[backend])
    return getattr(importlib.import_module(_module_of(kernels, backend)), function)


def _module_of(kernels: str, backend: str) -> str:
    """`<kernels>_<backend>`, or `reference` in the same folder, which defines a whole model."""
    module = f"{kernels}_{backend}"
    if importlib.util.find_spec(module) is None and backend == "numpy":
        module = f"{kernels}_reference"
    if importlib.util.find_spec(module) is None:
        module = f"{kernels.rpartition('.')[0]}.reference"
    return module


def load_kernel_when_ready(kernels: str, function: str, backend: str, *variant: str) -> object:
    """As `load_kernel`, but "auto" is "numpy" until the compiled module is ready to run.

    Args:
        kernels: full name of the module that describes the kernels; beside it stand `<kernels>_cpu`
            with a function `warm_up(*variant)`, and the modules that `load_kernel` names.
        function: its name.
        backend: "auto" or a backend's name.
        variant: what has to be compiled, such as the type of the frames.

    Raises:
        ConfigError: no backend has that name.
        MissingDependencyError: what the backend needs is not installed.
    """
    if check_backend(backend) == AUTO:
        backend = "cpu" if is_ready(f"{kernels}_cpu", *variant) else "numpy"
    return _load(kernels, function, backend)
