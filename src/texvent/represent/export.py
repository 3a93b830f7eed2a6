"""Events in the containers of NumPy, tonic and pandas, one record per event."""

from __future__ import annotations

from typing import Any

import numpy as np
from numpy.typing import NDArray

from texvent._require import require
from texvent.errors import InputError
from texvent.events import COLUMN_TYPES, EventStream

TONIC_TYPE = np.dtype([("x", "<i2"), ("y", "<i2"), ("t", "<i8"), ("p", "i1")])
"""Signed polarity type: with uint8 or bool, tonic's ToVoxelGrid fails or counts OFF as ON."""
MAX_TONIC_SIDE = 2**15
"""tonic's coordinates are int16."""


def to_structured(events: EventStream) -> NDArray[Any]:
    """One record per event; see `EventStream.to_structured`."""
    columns = events.columns()
    return _records(events, np.dtype([(name, COLUMN_TYPES[name]) for name in columns]))


def to_tonic(events: EventStream) -> NDArray[Any]:
    """The array that tonic's transforms take; see `EventStream.to_tonic`."""
    if max(events.size) > MAX_TONIC_SIDE:
        raise InputError(
            f"tonic stores coordinates below {MAX_TONIC_SIDE:,}; the sensor is {events.size}. "
            "Use to_structured()"
        )
    return _records(events, TONIC_TYPE)


def to_dataframe(events: EventStream) -> Any:
    """A pandas DataFrame with one row per event; see `EventStream.to_dataframe`."""
    pandas = require("pandas", extra="pandas")
    return pandas.DataFrame({name: column.copy() for name, column in events.columns().items()})


def _records(events: EventStream, dtype: np.dtype[Any]) -> NDArray[Any]:
    columns = events.columns()
    records = np.empty(len(events), dtype)
    for name in dtype.names or ():
        records[name] = columns[name]
    return records
