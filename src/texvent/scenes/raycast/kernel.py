"""How the ray caster's functions are compiled."""

from __future__ import annotations

from collections.abc import Callable
from pathlib import Path
from typing import Any, TypeVar, cast

from numba import njit

Function = TypeVar("Function", bound=Callable[..., Any])


def _source_stamp() -> tuple[float, int]:
    """Changes when any file beside this one does: latest change, bytes in all."""
    states = [path.stat() for path in Path(__file__).parent.glob("*.py")]
    return max(state.st_mtime for state in states), sum(state.st_size for state in states)


_STAMP = _source_stamp()


def kernel(function: Function) -> Function:
    """Compile a function with Numba on first use; the machine code is kept on disk.

    It releases the interpreter lock, divides by zero as NumPy does, and keeps IEEE arithmetic (no
    fastmath), so that neither threads nor the order of work change a picture.
    """
    compiled = njit(cache=True, nogil=True, error_model="numpy")(function)
    # Numba discards kept code when the function's own file changes. A kernel has the functions it
    # calls built in, so here it must do so when any file of the ray caster changes.
    cache_file: Any = getattr(getattr(compiled, "_cache", None), "_cache_file", None)
    if hasattr(cache_file, "_source_stamp"):
        cache_file._source_stamp = _STAMP
    return cast("Function", compiled)
