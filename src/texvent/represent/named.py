"""Any representation by its name."""

from __future__ import annotations

import inspect
from collections.abc import Callable, Mapping
from types import MappingProxyType
from typing import Any, get_type_hints

import numpy as np
from numpy.typing import NDArray

from texvent._registry import REPRESENTATIONS, suggest
from texvent._require import require
from texvent.errors import ConfigError, InputError, shown
from texvent.events import COLUMN_TYPES, EventStream
from texvent.options.values import convert
from texvent.represent.array_ops import Array, Events
from texvent.represent.tensors import put_events

WINDOW_OPTIONS: Mapping[str, int] = {"start_us": 0, "stop_us": 1, "at_us": 1}
"""Options of representations for the position in the window: 0 = its start, 1 = its end."""


def represent(name: str, events: Events, *, device: str | None = None, **options: Any) -> Array:
    """Events as a dense array.

    Args:
        name: such as "voxel-e2vid"; `REPRESENTATIONS` lists all.
        events: the slice.
        device: give a torch tensor on this device, such as "cpu" or "cuda"; default: a NumPy
            array for an EventStream, a tensor on their own device for EventTensors.
        **options: options of that representation, such as `bins=5`.

    Returns:
        See the representation's own function for shape, type and unit.

    Raises:
        ConfigError: unknown name, option or device, or a value out of range.
        InputError: `events` is neither an EventStream nor EventTensors.
        MissingDependencyError: `device` is given and torch is not installed.

    Example:
        >>> from texvent.events import EventStream
        >>> from texvent.sensor import SensorSize
        >>> represent("voxel-e2vid", EventStream.empty(SensorSize(4, 3)), bins=5).shape
        (5, 3, 4)
    """
    function = load_representation(name)
    options = checked_options(name, function, options)
    if device is not None:
        events = put_events(events, device)
    return function(events, **options)


def represent_window(
    name: str,
    events: Events,
    window_us: tuple[int, int],
    *,
    device: str | None = None,
    **options: Any,
) -> Array:
    """As `represent`; options that name the window (`start_us`, `stop_us`, `at_us`) are filled in.

    Args:
        name: such as "voxel-e2vid".
        events: those of the window.
        window_us: its start (included) and its end (excluded), µs.
        device: as `represent`.
        **options: further options; they go before the window's.
    """
    known = option_names_of(load_representation(name))
    window = {key: window_us[end] for key, end in WINDOW_OPTIONS.items() if key in known}
    return represent(name, events, device=device, **{**window, **options})


def load_representation(
    name: str, options: Mapping[str, Any] = MappingProxyType({})
) -> Callable[..., Array]:
    """The function of a representation, which takes the events and its options.

    Raises:
        ConfigError: unknown name, or one of `options` as `checked_options` says.
    """
    function: Callable[..., Array] = REPRESENTATIONS.load(name)
    checked_options(name, function, options)
    return function


def checked_options(
    name: str, function: Callable[..., Array], options: Mapping[str, Any]
) -> dict[str, Any]:
    """The options, each as the type that the representation declares for it.

    Raises:
        ConfigError: the representation has no option of that name, or it is of another type.
    """
    allowed, hints = option_names_of(function), get_type_hints(function)
    for option in options:
        if option not in allowed:
            raise ConfigError(f"{name} has no option {shown(option)}; {suggest(option, allowed)}")
    return {
        option: convert(value, hints.get(option, Any), f"{name}: {option}")
        for option, value in options.items()
    }


def option_names_of(function: Callable[..., Array]) -> tuple[str, ...]:
    """Names of a representation's options, in order."""
    return tuple(inspect.signature(function).parameters)[1:]


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
