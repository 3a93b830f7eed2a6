"""Compiled kernels once they are compiled, until then the definitions; the results are equal."""

from __future__ import annotations

import functools
import importlib
import typing
from types import ModuleType
from typing import Literal

from texvent.runtime.background_jit import is_ready

Name = Literal["candidates", "segments"]
NAMES: tuple[Name, ...] = typing.get_args(Name)
"""What there are kernels for."""


def find_compiled(name: Name) -> ModuleType | None:
    """The compiled module, or None while it is being prepared (or cannot be, without Numba)."""
    module = f"{__package__}.{name}_cpu"
    return _load(module) if is_ready(module) else None


def load_kernels(name: Name) -> ModuleType:
    """The compiled module if it is ready, else the definition."""
    return find_compiled(name) or _load(f"{__package__}.{name}_reference")


@functools.cache
def _load(module: str) -> ModuleType:
    return importlib.import_module(module)
