"""Bounds of every field of every record that checks its values, and fields that exclude each other.

    python -m tests.bounds.bounds    # writes the table anew; CHANGELOG.md says why

`bounds.txt` holds them: of a number the least and the greatest value that is taken, to the last
bit, and what is said of the next one; of two fields, which pairs of values are refused although
each alone is taken. A record is there as soon as its class checks its fields and a value for each
that must be given is known here.
"""

import importlib
import importlib.util
import inspect
import itertools
import math
import pkgutil
import struct
import warnings
from collections.abc import Callable, Iterator, Mapping, Sequence
from dataclasses import MISSING, fields, is_dataclass
from fractions import Fraction
from functools import partial
from pathlib import Path
from typing import Any, Literal, get_args, get_origin, get_type_hints
from zlib import crc32

import numpy as np

from texvent.errors import TexventError
from texvent.sensor import SensorSize

TABLE = Path(__file__).with_name("bounds.txt")
PACKAGES = ("texvent", "texvent_scenes", "texvent_lab")
LARGE = 10**30
TRIED: dict[type, tuple[Any, ...]] = {
    bool: (False, True),
    int: (1, 3, 64),
    float: (0.25, 1.0, 40.0),
    Fraction: (Fraction(1, 4), Fraction(30)),
    str: ("", "a"),
    Path: (Path("a"), Path("a.png"), Path("a.h5")),
    SensorSize: (SensorSize(64, 48),),
}
"""Values of a type, beside the default and the bounds."""
SEVERAL: dict[Any, tuple[Any, ...]] = {
    tuple: ((), ("a",)),
    Sequence: ((), ("a",)),
    Mapping: ({}, {"a": 0.5}),
}
"""Values of a type that holds others."""
SHAPES = (3, (48, 64))
REFUSALS = (
    TexventError,
    ArithmeticError,
    AttributeError,
    LookupError,
    OSError,
    TypeError,
    ValueError,
)
NUMBERS = (int, float, Fraction)


def types_in(hint: Any) -> set[type]:
    """Types of the values that an annotation allows."""
    inner = get_args(hint) if get_origin(hint) is not Literal else ()
    return {one for part in inner for one in types_in(part)} if inner else {hint}


def choices(hint: Any) -> tuple[Any, ...]:
    """Values to try of a field."""
    origin, inner = get_origin(hint), get_args(hint)
    if origin is Literal:
        return inner
    if origin is np.ndarray:
        (kind,) = get_args(inner[1])
        return tuple(np.zeros(shape, None if kind is Any else kind) for shape in SHAPES)
    if origin in SEVERAL:
        return SEVERAL[origin]
    if is_dataclass(hint) and has_checks(hint) and (base := Record(hint).base) is not None:
        return (hint(**base),)
    found = [value for part in inner for value in choices(part)] or list(TRIED.get(hint, ()))
    return (*found, None) if hint is type(None) else tuple(found)


def records() -> Iterator[type]:
    """Classes that check their fields, in order of their names."""
    found = set()
    for package in map(importlib.import_module, filter(importlib.util.find_spec, PACKAGES)):
        for module in pkgutil.walk_packages(package.__path__, f"{package.__name__}.", str):
            if module.name.endswith("__main__"):
                continue
            try:
                inside = vars(importlib.import_module(module.name)).values()
            except ImportError:  # torch, a system that is not this one
                continue
            own = [one for one in inside if inspect.isclass(one) and is_dataclass(one)]
            found |= {one for one in own if one.__module__ == module.name and has_checks(one)}
    yield from sorted(found, key=name_of)


def has_checks(kind: type) -> bool:
    """Whether a class looks at its fields when an object of it is made."""
    return "__post_init__" in vars(kind)


def name_of(record: type) -> str:
    """Module and name of a class."""
    return f"{record.__module__}.{record.__qualname__}"


class Record:
    """A class of which one object is made, and others that differ from it in a few fields."""

    def __init__(self, kind: type) -> None:
        hints, own = get_type_hints(kind), [one for one in fields(kind) if one.init]
        self.kind, self.hints = kind, {one.name: hints[one.name] for one in own}
        required = [one.name for one in own
                    if one.default is MISSING and one.default_factory is MISSING]  # fmt: skip
        tried = itertools.islice(itertools.product(*(choices(hints[one]) for one in required)), 500)
        given = (dict(zip(required, one, strict=True)) for one in tried)
        self.base = next((one for one in given if not self.refusal(**one)), None)

    def refusal(self, **values: Any) -> str:
        """What is said of an object with these values; empty: it is taken."""
        try:
            self.kind(**{**(getattr(self, "base", None) or {}), **values})
        except REFUSALS as error:
            return f"{type(error).__name__}: {error}".split("\n")[0]
        return ""

    def default(self, name: str) -> Any:
        """The value of a field that nothing was said of."""
        return getattr(self.kind(**self.base), name, None)

    def bounds(self, name: str, kind: type) -> tuple[Any, Any] | None:
        """The least and the greatest number that is taken; None: none of those tried is."""
        tried = [one for one in (self.default(name), *TRIED[kind]) if type(one) in NUMBERS]
        taken = (kind(one) for one in tried if not self.refusal(**{name: kind(one)}))
        start = next(taken, None)
        if start is None:
            return None
        is_taken = partial(self._is_taken, name)
        return last_taken(is_taken, start, kind(-LARGE)), last_taken(is_taken, start, kind(LARGE))

    def _is_taken(self, name: str, value: Any) -> bool:
        return not self.refusal(**{name: value})


def rank(value: float) -> int:
    """Number of a float in the order of all of them."""
    (bits,) = struct.unpack("<q", struct.pack("<d", value))
    return bits if bits >= 0 else -(bits & (2**63 - 1))


def ranked(number: int) -> float:
    """The float of that rank."""
    (found,) = struct.unpack("<d", struct.pack("<q", abs(number)))
    return math.copysign(found, number)


def last_taken(is_taken: Callable[[Any], bool], start: Any, end: Any) -> Any:
    """The value nearest to the end of an interval that is taken, as the first is."""
    if is_taken(end):
        return end
    kind = type(start)
    to, back = (int, int) if kind is int else (lambda one: rank(float(one)),
                                               lambda one: kind(ranked(one)))  # fmt: skip
    taken, refused = to(start), to(end)
    while abs(taken - refused) > 1:
        middle = (taken + refused) // 2
        taken, refused = (middle, refused) if is_taken(back(middle)) else (taken, middle)
    return back(taken)


def beyond(value: Any, way: int) -> Any:
    """The next number on that side."""
    return value + way if type(value) is int else type(value)(math.nextafter(value, way * math.inf))


def written(value: Any) -> str:
    """A value, as on every system."""
    if isinstance(value, np.ndarray):
        return f"{value.dtype} {value.shape}"
    if is_dataclass(value):
        return type(value).__name__
    return repr(value.as_posix() if isinstance(value, Path) else value)


def lines_of(record: Record) -> Iterator[str]:
    """The bounds of its numbers, then the pairs of fields that exclude each other."""
    tried, alone = {}, {}
    for name, hint in record.hints.items():
        values = [record.default(name), *choices(hint)]
        for kind in sorted(types_in(hint) & {*NUMBERS}, key=str):
            if (found := record.bounds(name, kind)) is None:
                continue
            values += found
            ends = [(one, way) for one, way in zip(found, (-1, 1), strict=True) if abs(one) < LARGE]
            said = [record.refusal(**{name: beyond(*one)}) for one in ends]
            low, high = (repr(float(one)) if kind is Fraction else repr(one) for one in found)
            yield " | ".join((f"{name}: {low} .. {high}", *dict.fromkeys(said)))
        tried[name] = list({written(one): one for one in values}.values())
        alone[name] = {written(one): record.refusal(**{name: one}) for one in tried[name]}
    for one, other in itertools.combinations(tried, 2):
        yield from excluded(record, one, other, tried, alone)


def excluded(
    record: Record, one: str, other: str, tried: dict[str, list[Any]],
    alone: dict[str, dict[str, str]],
) -> Iterator[str]:  # fmt: skip
    """A line about two fields, if of two of their values more or less is said than of each."""
    found, said = [], {}
    for pair in itertools.product(tried[one], tried[other]):
        first, second = map(written, pair)
        why = record.refusal(**dict(zip((one, other), pair, strict=True)))
        if why not in ({alone[one][first], alone[other][second]} - {""} or {""}):
            found.append(f"{first} {second} {why}")
            said.setdefault(why, f"{first}, {second}: {why or 'taken'}")
    if found:
        mark = crc32("\n".join(found).encode())
        yield f"{one}, {other}: {len(found)} ({mark:08x}) | {next(iter(said.values()))}"


def table() -> dict[str, list[str]]:
    """Name of each record, and its lines."""
    found = {}
    with warnings.catch_warnings():
        warnings.simplefilter("ignore")
        for kind in records():
            record = Record(kind)
            if record.base is not None and (lines := list(lines_of(record))):
                found[name_of(kind)] = lines
    return found


def stored_table() -> dict[str, list[str]]:
    """The table as it was."""
    blocks = TABLE.read_text(encoding="utf-8").rstrip("\n").split("\n\n")
    return {block.splitlines()[0]: block.splitlines()[1:] for block in blocks}


if __name__ == "__main__":
    blocks = ("\n".join((name, *lines)) + "\n" for name, lines in table().items())
    TABLE.write_text("\n".join(blocks), encoding="utf-8")
