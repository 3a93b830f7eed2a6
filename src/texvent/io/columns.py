"""Columns of events, as codecs read and write them."""

from __future__ import annotations

from collections.abc import Callable, Iterator, Mapping
from typing import Any, TypeAlias

from numpy.typing import NDArray

Columns: TypeAlias = Mapping[str, NDArray[Any]]
"""Name → column of events: x, y, t, p, and label where it is known."""
SideData: TypeAlias = Mapping[str, Callable[[], Iterator[Columns]]]
"""triggers, imu: what a recording holds beside its events → reads its columns, of which t is µs."""
