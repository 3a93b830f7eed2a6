"""Columns of events, as codecs read and write them."""

from __future__ import annotations

from collections.abc import Mapping
from typing import Any, TypeAlias

from numpy.typing import NDArray

Columns: TypeAlias = Mapping[str, NDArray[Any]]
"""Name → column of events: x, y, t, p, and label where it is known."""
