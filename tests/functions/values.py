"""Values of a type, from small to odd, and the text of a value that is the same on every system."""

from __future__ import annotations

import ast
import copy
import enum
import importlib
import inspect
import math
import os
import pkgutil
import sys
import types
from collections.abc import Callable, Collection, Iterable, Iterator, Mapping, Sequence
from dataclasses import fields, is_dataclass
from fractions import Fraction
from functools import cache
from itertools import islice
from pathlib import Path
from typing import Annotated, Any, Literal, TypeVar, Union, get_args, get_origin, get_type_hints
from zlib import crc32

import numpy as np
from PIL import Image

from texvent.capture.array_frames import ArrayFrames
from texvent.capture.given_times import FrameTimes
from texvent.event_packets import EventPackets
from texvent.events import EventStream
from texvent.frames import FrameStream
from texvent.io.files import save
from texvent.sensor import SensorSize

SHAPES = ((5, 6), (3,), (5, 6, 3), (4, 3), (3, 3), (2, 5, 6), (8,), (0,))
"""Those of arrays; arguments of one call have the same one first."""
GIVEN = Path("../given")
"""Files that calls may read."""
OF_TYPE: dict[Any, tuple[Any, ...]] = {
    bool: (False, True),
    int: (2, 0, 1, 5, 40, -3),
    float: (0.5, 0.0, 1.0, 3.0, 30.0, -2.0),
    complex: (0.5,),
    Fraction: (Fraction(1, 4), Fraction(30), Fraction(0)),
    str: ("a red ball", "", "x", "12", "esim", "a.h5"),
    bytes: (bytes(range(1, 40)), b"", b"# a 1\n1 2 3 4\n"),
    Path: (
        GIVEN / "events.h5",
        GIVEN / "clip.npy",
        GIVEN / "events.csv",
        GIVEN / "still.png",
        Path("a.h5"),
        Path("no/b.npz"),
        GIVEN,
        GIVEN / "scene.toml",
    ),
    slice: (slice(1, 3), slice(None)),
    SensorSize: (SensorSize(6, 5), SensorSize(3, 8)),
    type(None): (None,),
    Any: (3, "a", 0.5, None),
    object: (3, "a", None),
}
OF_SEVERAL = (Sequence, Iterable, Iterator, Collection, list, set, frozenset, tuple)
MOST_OF_ARRAY, DEEPEST = 400, 5


def events(count: int) -> EventStream:
    """Some events of a sensor of 6 x 5 pixels."""
    index = np.arange(count)
    return EventStream(
        x=(index * 7 % 6).astype(np.uint16), y=(index * 5 % 5).astype(np.uint16),
        t=np.cumsum(index * 13 % 29) * 100, p=index * 3 % 4 > 1, size=SensorSize(6, 5),
    )  # fmt: skip


def frames() -> np.ndarray:
    """Four frames of that sensor, each brighter on one side."""
    return np.stack([array((5, 6), np.uint8) * (1 + n % 2) + 9 * n for n in range(4)])


def give(folder: Path) -> None:
    """Write the files that calls may read."""
    folder.mkdir()
    for name in ("events.h5", "events.csv"):
        save(folder / name, events(40))
    np.save(folder / "clip.npy", frames())
    Image.fromarray(frames()[0]).save(folder / "still.png")
    scene = 'prompt = "a red ball rolls"\n[[objects]]\nnoun = "ball"\n'
    (folder / "scene.toml").write_text(scene, encoding="utf-8")
    for one in folder.iterdir():
        os.utime(one, (1, 1))


def array(shape: tuple[int, ...], kind: Any) -> np.ndarray:
    """Numbers in no order, multiples of an eighth."""
    mixed = np.arange(math.prod(shape), dtype=np.int64) * 2654435761 % 97
    concrete = {np.unsignedinteger: np.uint16, np.signedinteger: np.int32, np.integer: np.int64}
    kind = np.dtype(
        concrete.get(
            kind,
            np.float64
            if inspect.isabstract(kind)
            or kind in (Any, np.floating, np.generic, np.number, np.inexact)
            else kind,
        )
    )
    if kind.kind == "f":
        mixed = mixed / 8 - 2
    elif kind.kind == "b":
        mixed = mixed % 3 > 0
    return mixed.astype(kind).reshape(shape)


MAKERS: dict[Any, Callable[[], list[Any]]] = {
    EventStream: lambda: [events(40), events(1), events(0)],
    EventPackets: lambda: [EventPackets([events(40)[:9], events(40)[9:]], events(0).size)],
    FrameStream: lambda: [ArrayFrames(frames(), FrameTimes(fps=Fraction(10)))],
    np.random.Generator: lambda: [np.random.default_rng(7)],
    Callable[[str], None]: lambda: [print],
    type: lambda: [int, np.float64],
}


def of_origin(hint: Any, depth: int) -> list[Any] | None:
    """Values of a type that holds others; None: it is another."""
    origin, inner = get_origin(hint), get_args(hint)
    if origin is Annotated:
        return values(inner[0], depth)
    if origin is Literal:
        return [*inner]
    if origin in (Union, types.UnionType):
        return [one for part in inner for one in values(part, depth)]
    if origin is np.ndarray:
        (kind,) = get_args(inner[1]) or (Any,)
        kinds = (np.uint8, np.float64) if kind is Any else (kind,)
        return [array(shape, one) for shape in SHAPES for one in kinds if not get_origin(one)]
    if origin is tuple and Ellipsis not in inner:
        parts = [values(one, depth) for one in inner]
        count = max(map(len, parts), default=0) if all(parts) else 0
        return [tuple(one[n % len(one)] for one in parts) for n in range(count)]
    if origin in OF_SEVERAL:
        kind = {Sequence: list, Iterable: list, Iterator: list, Collection: list}.get(
            origin, origin
        )
        some = values(inner[0], depth)
        return [kind(some[n : n + 2]) for n in range(0, len(some), 2)] + [kind()] if some else []
    if origin in (Mapping, dict):
        keys, some = values(inner[0], depth), values(inner[1], depth)
        return [dict(zip(keys[:2], some[n:], strict=False)) for n in range(min(3, len(some)))]
    return None


def values(hint: Any, depth: int = 0) -> list[Any]:
    """Values of a type; empty: none is known."""
    try:
        if hint in MAKERS:
            return MAKERS[hint]()
        if hint in OF_TYPE:
            return [*OF_TYPE[hint]]
    except TypeError:
        return []
    if (found := of_origin(hint, depth)) is not None:
        return found
    if isinstance(hint, TypeVar):
        some = hint.__constraints__ or (hint.__bound__ or Any,)
        return [one for kind in some for one in values(kind, depth)]
    if inspect.isclass(hint) and issubclass(hint, np.generic) and hint is not np.generic:
        return [array((1,), hint)[0], array((3,), hint)[2]]
    if inspect.isclass(hint) and issubclass(hint, enum.Enum):
        return [*hint]
    if inspect.isclass(hint) and hint.__module__.startswith("texvent") and depth < 3:
        return made(hint, depth)
    return []


def made(kind: type, depth: int = 0) -> list[Any]:
    """Up to three objects of a class, of values of its parameters."""
    if inspect.isabstract(kind) or getattr(kind, "_is_protocol", False):
        return []
    found: list[Any] = []
    for named in islice(arguments(kind, depth + 1), 24):
        try:
            one = kind(**copy.deepcopy(named))
        except Exception:  # noqa: BLE001, whatever it is
            continue
        found.append(one)
        if len(found) == 3:
            break
    return found


@cache
def names_of(module: str) -> dict[str, Any]:
    """Names of a module, and those that only its annotations use."""
    found = dict(vars(sys.modules[module]))
    for one in ast.walk(ast.parse(inspect.getsource(sys.modules[module]))):
        if isinstance(one, ast.If) and "TYPE_CHECKING" in ast.unparse(one.test):
            for line in one.body:
                try:
                    exec(compile(ast.Module([line], []), module, "exec"), found)
                except ImportError:  # torch
                    continue
    return found


def hints_of(call: Callable[..., Any]) -> dict[str, Any]:
    """Type of each parameter."""
    inner = call.__init__ if inspect.isclass(call) else inspect.unwrap(call)
    module = call.__module__ if inspect.isclass(call) else inner.__module__
    is_record = inspect.isclass(call) and (is_dataclass(call) or issubclass(call, tuple))
    return get_type_hints(call if is_record else inner, names_of(module), include_extras=True)


def tried_values(call: Callable[..., Any], depth: int) -> tuple[dict[str, list[Any]], set[str]]:
    """Values of each parameter, the default first, and those without one; empty: not all known."""
    try:
        hints, parameters = hints_of(call), inspect.signature(call).parameters.values()
    except (TypeError, ValueError, NameError, AttributeError, KeyError):
        return {}, {call.__name__}
    tried, needed = {}, set()
    for one in parameters:
        if one.kind in (one.VAR_POSITIONAL, one.VAR_KEYWORD) or one.name == "self":
            continue
        found = values(hints[one.name], depth) if one.name in hints else []
        if one.default is one.empty:
            needed.add(one.name)
        else:
            found.insert(0, one.default)
        if not found:
            return {}, {one.name}
        tried[one.name] = found
    return tried, needed


def arguments(call: Callable[..., Any], depth: int = 0) -> Iterator[dict[str, Any]]:
    """Arguments of calls: the n-th value of each parameter, then each at others alone."""
    tried, needed = tried_values(call, depth)
    if needed - {*tried}:
        return
    for n in range(max(map(len, tried.values()), default=1)):
        yield {name: some[n % len(some)] for name, some in tried.items() if name in needed}
    for start in range(2):
        base = {name: some[start % len(some)] for name, some in tried.items()}
        for name, some in tried.items():
            yield from ({**base, name: one} for one in some[:5] if one is not base[name])


def number(value: Any) -> str:
    """A number to four digits; what lies between two of them goes up."""
    if isinstance(value, complex | np.complexfloating):
        return f"{number(value.real)} {number(value.imag)}j"
    if isinstance(value, float | np.floating):
        return f"{float(value) * (1 + 1e-9) + 0.0:.4g}"
    return str(value)


def written(value: Any, depth: int = 0) -> str:
    """A value as text, without places on the disk and in memory."""
    if isinstance(value, np.ndarray):
        some = value.ravel()[:MOST_OF_ARRAY].tolist() if value.dtype.kind in "biufc" else []
        return f"{value.dtype}{value.shape}" + " ".join(map(number, some))
    if isinstance(value, bool | int | float | complex | np.generic | Fraction | type(None)):
        return f"{type(value).__name__} {number(value)}"
    if isinstance(value, str | bytes | Path | enum.Enum | slice | range):
        return f"{type(value).__name__} {value}"
    if depth == DEEPEST:
        return "..."
    if isinstance(value, Mapping):
        return "{" + ",".join(f"{one}:{written(value[one], depth + 1)}" for one in value) + "}"
    if isinstance(value, set | frozenset):
        return f"set {sorted(written(one, depth + 1) for one in value)}"
    if isinstance(value, list | tuple | Iterator):
        some = [*islice(value, 50)]
        return f"{type(value).__name__} {[written(one, depth + 1) for one in some]}"
    name = type(value).__name__
    if inspect.isroutine(value) or inspect.isclass(value) or inspect.ismodule(value):
        return f"{name} {getattr(value, '__name__', '')}"
    if not type(value).__module__.startswith("texvent"):
        return name
    own = (
        [one.name for one in fields(value)]
        if is_dataclass(value)
        else getattr(value, "__dict__", ())
    )
    return f"{name} {[written(getattr(value, one, None), depth + 1) for one in own]}"


def mark(text: str) -> str:
    """Four digits that stand for a text."""
    return f"{crc32(text.encode()) & 0xFFFF:04x}"


def is_own(error: BaseException) -> bool:
    """Whether an error is one of texvent, whose words are kept."""
    return type(error).__module__.startswith("texvent")


def modules(packages: Sequence[str], skipped: Sequence[str]) -> Iterator[types.ModuleType]:
    """Modules of packages that can be imported here, in order of their names."""
    for package in map(importlib.import_module, packages):
        for one in pkgutil.walk_packages(package.__path__, f"{package.__name__}.", str):
            if one.name.endswith("__main__") or one.name.startswith(tuple(skipped)):
                continue
            try:
                yield importlib.import_module(one.name)
            except ImportError:  # torch, a system that is not this one
                continue
