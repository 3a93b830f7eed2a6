"""How Numba compiles what only other compiled functions call: sooner, and not for Python."""

from __future__ import annotations

from typing import Any

import numba

_OPTIONS: dict[str, Any] = {
    "cache": True,
    "nogil": True,
    "error_model": "numpy",
    "no_cpython_wrapper": True,
    "no_cfunc_wrapper": True,
}
compile_part: Any = numba.njit(**_OPTIONS)
"""Decorator."""
