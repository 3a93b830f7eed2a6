"""Search for recordings in named arrays: which arrays, fields or columns of a file are its events.

A recording is four arrays of one group (`events/x`, `xs`, `x_pos` …), one array of records with
such fields, an array [n, 4] whose order is certain, or `xy` [n, 2] beside times and polarities.
"""

from __future__ import annotations

import re
from collections.abc import Mapping, Sequence
from pathlib import Path
from typing import Any

import numpy as np
from numpy.typing import NDArray

from texvent.errors import InputError, shown
from texvent.events import COLUMN_TYPES, ID_COLUMNS
from texvent.io.polarity import CODES
from texvent.io.reading import (
    ReadOptions,
    TimeUnit,
    UnknownLayoutError,
    texts_of,
    unit_in_name,
)
from texvent.io.tables import SAMPLE_ROWS, Array, Column, EventTable, spelled
from texvent.sensor import SensorSize

ORDERS = ("txyp", "xytp", "xypt")
"""Orders in which programs write rows of four numbers."""
V2E, V2E_TYPE = "txyp", np.dtype("<u4")
"""Order and type of v2e's rows."""


def _fits(rows: NDArray[Any], order: str, size: SensorSize | None) -> bool:
    """Whether rows of four numbers, [n, 4], can be meant in an order, on a sensor in pixels."""
    t, x, y, p = (rows[:, order.index(name)] for name in "txyp")
    limits = (np.inf, np.inf) if size is None else size
    pixels = all(
        bool(((values >= 0) & (values < limit) & (values == np.rint(values))).all())
        for values, limit in zip((x, y), limits, strict=True)
    )
    polarities = set(np.unique(p).tolist())
    signs = any(polarities <= {*code} for code in CODES)
    return pixels and signs and bool((np.diff(t) >= 0).all())


def find_tables(path: Path, arrays: Mapping[str, Array], options: ReadOptions) -> list[EventTable]:
    """The recordings in named arrays, at least one.

    Args:
        path: the file, for messages.
        arrays: name → array; groups are separated by "/".
        options: names or order of columns, where the file's are others.

    Raises:
        UnknownLayoutError: there is none.
        InputError: an array or field that the options name is missing.
    """
    if options.names:
        return [_named_table(path, arrays, options)]
    groups: dict[str, dict[str, Array]] = {}
    for name, array in arrays.items():
        group, _, leaf = name.rpartition("/")
        groups.setdefault(group, {})[leaf] = array
    found = [table for group, members in groups.items() for table in _in_group(group, members)]
    if not found:
        found = _rows_of_four(path, arrays, options)
    if not found:
        holds = [f"{name} {array.dtype} {list(array.shape)}" for name, array in arrays.items()]
        raise UnknownLayoutError(path, holds)
    if options.stream is not None:
        return found
    # Links give an array several names.
    places = {
        tuple((id(arrays[one.array]), one.part) for one in table.columns.values()): table
        for table in reversed(found)
    }
    return list(reversed(places.values()))


def _in_group(group: str, members: Mapping[str, Array]) -> list[EventTable]:
    """Recordings in the arrays of one group: its columns, and arrays of records."""
    prefix = f"{group}/" if group else ""
    tables = []
    for leaf, array in members.items():
        fields = array.dtype.names or ()
        named = {spelled(one)[0]: one for one in fields}
        if all(name in named for name in "xytp"):
            columns = {name: Column(f"{prefix}{leaf}", named[name]) for name in "xytp"}
            unit = spelled(named["t"])[1]
            tables.append(EventTable(f"{prefix}{leaf}", columns, unit))
    leaves: dict[str | None, str] = {}
    for leaf, array in sorted(members.items(), key=lambda one: len(one[0])):  # t before time
        column = spelled(leaf)[0]
        if column is not None and array.shape and not array.dtype.names:
            leaves.setdefault(column, leaf)
    columns = {name: Column(f"{prefix}{leaves[name]}") for name in "xytp" if name in leaves}
    if "xy" in leaves:
        pair = f"{prefix}{leaves['xy']}"
        columns = {"x": Column(pair, 0), "y": Column(pair, 1), **columns}
    if all(name in columns for name in "xytp"):
        extra = {name: f"{prefix}{name}" for name in _optional_columns(members)}
        tables.append(EventTable(group or "events", columns, spelled(leaves["t"])[1], extra))
    return tables


def _optional_columns(members: Mapping[str, Array]) -> tuple[str, ...]:
    """Names of the columns besides x, y, t, p that a group has.

    Arrays of other programs may have the name of our ids: they count only if they have their type.
    A label that is not one number per event is the class of the whole sample.
    """
    counts = [
        one.shape[0] for leaf, one in members.items() if spelled(leaf)[0] == "t" and one.shape
    ]
    has_ids = all(
        name in members and members[name].dtype == COLUMN_TYPES[name] for name in ID_COLUMNS
    )
    found = members.get("label")
    is_whole = found is not None and found.dtype.kind in "biu"
    label = ("label",) if is_whole and members["label"].shape == tuple(counts[:1]) else ()
    return (*label, *(ID_COLUMNS if has_ids else ()))


def _rows_of_four(
    path: Path, arrays: Mapping[str, Array], options: ReadOptions
) -> list[EventTable]:
    """Recordings in arrays [n, k]: called events, or the only one of this shape."""
    width = len(options.order or "txyp")
    flat = {
        name: array
        for name, array in arrays.items()
        if len(array.shape) == 2 and array.shape[1] == width and array.dtype.kind in "iuf"
    }
    called = {name for name in flat if "event" in name.rpartition("/")[2].lower()}
    chosen = called or (set(flat) if len({id(one) for one in flat.values()}) == 1 else set())
    if options.stream in flat:
        chosen = {str(options.stream)}
    tables = []
    for name in flat:
        if name in chosen:
            rows, default = flat[name][:SAMPLE_ROWS], V2E if flat[name].dtype == V2E_TYPE else None
            unit: TimeUnit | None = "us" if default else None
            order: Sequence[str] | None = options.order
            if order is None:
                items = arrays.get(f"{name.removesuffix('values')}items")  # pandas'
                order, stated = _stated_order(flat[name], [] if items is None else [items[:]])
                unit = stated or unit
            order = order or certain_order(path, rows, options.size, default)
            columns = {column: Column(name, order.index(column)) for column in "xytp"}
            tables.append(EventTable(name, columns, unit))
    return tables


def _stated_order(
    array: Array, lists: Sequence[Any]
) -> tuple[tuple[str, ...] | None, TimeUnit | None]:
    """Order of the columns that an attribute or another list has, and unit of the times."""
    for value in (*lists, *getattr(array, "attrs", {}).values()):
        words = texts_of(value)
        if len(words) == 1:
            words = re.split(r"[\s,;]+", words[0].strip()) if len(words[0]) != 4 else [*words[0]]
        found = [spelled(word) for word in words]
        if sorted(str(column) for column, _ in found) == sorted("txyp"):
            return tuple(str(column) for column, _ in found), dict(found).get("t")
    return None, None


def certain_order(
    path: Path, rows: Any, size: SensorSize | None, default: str | None = None
) -> Sequence[str]:
    """The order of the columns of rows of four numbers; no rows have any.

    Raises:
        InputError: several orders fit, or none, and there is no default.
    """
    orders = [order for order in ORDERS if _fits(np.asarray(rows), order, size)]
    if default is not None and (default in orders or not orders):
        return default
    if len(orders) == 1 or (orders and len(rows) == 0):
        return orders[0]
    row = ", ".join(f"{value:g}" for value in np.asarray(rows)[0]) if len(rows) else ""
    what = f"its rows fit {' and '.join(orders)}" if orders else "no usual order fits its rows"
    raise InputError(
        f"{path} does not name its columns, and {what} (the first is {row}); give columns "
        "(--columns t,x,y,p, in the order of the file)"
    )


def _named_table(path: Path, arrays: Mapping[str, Array], options: ReadOptions) -> EventTable:
    """The recording whose columns the options name: arrays, or fields of one array of records."""
    group = f"{options.stream.strip('/')}/" if options.stream else ""
    records = [name for name, array in arrays.items() if array.dtype.names]
    columns = {}
    for column, name in options.names.items():
        holders = [one for one in records if name in arrays[one].dtype.names]
        if group + name in arrays or name in arrays:
            columns[column] = Column(group + name if group + name in arrays else name)
        elif holders:
            columns[column] = Column(holders[0], name)
        else:
            listed = shown(", ".join(arrays) or "nothing")
            raise InputError(f"{path} has no {shown(name)} for column {column}; it has: {listed}")
    place = columns["t"]
    stated = unit_in_name(str(place.array if place.part is None else place.part))[1]
    return EventTable(group or "events", {name: columns[name] for name in "xytp"}, stated)
