"""Lines of parts: the text that a noun's TOML entry holds, as placed unit shapes."""

from __future__ import annotations

import itertools
import math
import re
from collections.abc import Callable, Iterable, Iterator, Sequence
from dataclasses import dataclass, replace

import numpy as np

from texvent_scenes.models.joints import Joint, read_number, rolling
from texvent_scenes.models.shapes import (
    Affine,
    Point,
    compose,
    placed_between,
    placed_spanned,
    placed_upright,
    point,
    shift,
    turn_about,
)
from texvent_scenes.rendered_scene import Shape


@dataclass(frozen=True)
class Placed:
    """A unit shape in body coordinates, and the name of its surface."""

    shape: Shape
    surface: str
    to_body: Affine


Wheel = tuple[tuple[Placed, ...], Joint]
"""Parts of a wheel, where they are before it turns, and how it turns."""
_SOLIDS = {"box": Shape.BOX, "ball": Shape.ELLIPSOID, "post": Shape.CYLINDER, "cone": Shape.CONE}
_RODS = {"rod": Shape.CYLINDER, "limb": Shape.ELLIPSOID, "spike": Shape.CONE}
_SPANNED = {"plank": Shape.BOX, "blade": Shape.ELLIPSOID, "fin": Shape.CONE}
_AXES = {
    **dict.fromkeys(_SOLIDS, "xyz---"),
    **dict.fromkeys(_RODS, "xyzxyz--"),
    **dict.fromkeys(_SPANNED, "xyzxyzxyzxyz"),
    "bar": "xyzyz--", "disc": "xyz--", "frame": "xyz----", "ring": "xyz------", "lathe": "xyz",
    "bits": "xyz---", "chain": "-" + 40 * "xyz", "wheel": "xyz--",
}  # fmt: skip
"""Shape → the axis that each number of a line is along, "-" for lengths."""
_WORDS = frozenset({"lean", "turn", "about", "rows"})
"""Words with which the options of a line begin."""
_ROUNDED = 0.6
"""Reach of a limb beyond its joints, in its half thicknesses."""


def read_groups(text: str) -> list[tuple[str, str]]:
    """Groups of part lines: the words after "moving" in the line that begins one, and its parts.

    The first group has no such line: its parts do not move.
    """
    groups: list[tuple[str, list[str]]] = [("", [])]
    for line in _whole_lines(text):
        first, _, rest = line.partition(" ")
        if first == "moving":
            groups.append((rest.strip(), []))
        else:
            groups[-1][1].append(line)
    return [(how, "\n".join(lines)) for how, lines in groups]


def read_parts(text: str) -> tuple[tuple[Placed, ...], list[Wheel]]:
    """Parts that the lines of a text describe, and its wheels.

    Raises:
        ValueError: a line cannot be read; the message has the line.
    """
    parts: list[Placed] = []
    wheels: list[Wheel] = []
    for line in _whole_lines(text):
        drawn: list[Placed] = []
        try:
            words, turns = _take_turns(_split(line))
            for shape, surface, values, more in _written_out(words):
                if shape == "wheel":
                    wheels.append(_wheel(_count(values, 5)))
                else:
                    drawn += _read_one(shape, surface, values, more)
            _check(drawn)
        except (ValueError, IndexError, KeyError, ZeroDivisionError) as error:
            raise ValueError(f"parts, {line!r}: {error}") from None
        for turn in turns:
            parts += [replace(one, to_body=compose(turn, one.to_body)) for one in drawn]
    return tuple(parts), wheels


def _check(parts: Sequence[Placed]) -> None:
    """Refuse shapes without a volume."""
    if any(np.linalg.det(one.to_body[:, :3]) <= 0.0 for one in parts):
        raise ValueError("its sizes must be positive")


def _whole_lines(text: str) -> list[str]:
    """Lines without remarks; what is indented goes on with the line before."""
    whole: list[str] = []
    for line in text.splitlines():
        line = line.split(" # ")[0].rstrip()
        if line[:1].isspace() and whole:
            whole[-1] += line
        elif line.strip() and not line.startswith("#"):
            whole.append(line.strip())
    return whole


_Words = tuple[str, str, list[str]]


def _split(line: str) -> _Words:
    """Shape, surface and the rest; a surface may be written in brackets."""
    shape, *rest = line.split()
    if len(rest) < 2:
        raise ValueError("a line is a shape, a surface and numbers")
    if shape not in _AXES:
        raise ValueError(f"unknown shape {shape!r}; there are {', '.join(_AXES)}")
    if shape == "wheel":
        return shape, "", rest
    taken = 1
    while " ".join(rest[:taken]).count("(") > " ".join(rest[:taken]).count(")"):
        if taken == len(rest):
            raise ValueError("a bracket is not closed")
        taken += 1
    return shape, " ".join(rest[:taken]), rest[taken:]


def _take_turns(words: _Words) -> tuple[_Words, list[Affine]]:
    """The line without "turned", and the turns of its copies: number, axis, step and pivot."""
    shape, surface, rest = words
    if "turned" not in rest:
        return words, [shift()]
    at = rest.index("turned")
    count, axis, *values = rest[at + 1 :]
    step, x, y, z = map(read_number, values)
    turns = [turn_about(axis, math.radians(n * step), (x, y, z)) for n in range(int(count))]
    return (shape, surface, rest[:at]), turns


def _written_out(words: _Words) -> Iterator[tuple[str, str, list[float], list[float | str]]]:
    """Shape, surface, numbers and options of each copy that "±", "times" and "also" ask for."""
    shape, surface, rest = words
    rest, offsets = _take_offsets(shape, rest)
    axes = _AXES[shape].ljust(len(rest), "-")
    first_word = next((n for n, one in enumerate(rest) if one in _WORDS), len(rest))
    mirrored = [axes[n] for n, one in enumerate(rest[:first_word]) if one[0] == "±"]
    signs_of = [(1.0, -1.0) if axis in mirrored else (1.0,) for axis in "xyz"]
    for offset, signs in itertools.product(offsets, itertools.product(*signs_of)):
        by_axis = dict(zip("xyz", zip(signs, offset, strict=True), strict=True))
        values: list[float] = []
        for n, one in enumerate(rest[:first_word]):
            sign, moved = by_axis.get(axes[n], (1.0, 0.0))
            is_point = not (shape in _SPANNED and n >= 6)
            value = sign * read_number(one[1:]) if one[0] == "±" else read_number(one)
            values.append(value + (moved if is_point else 0.0))
        more = [_option(one, math.prod(signs)) for one in rest[first_word:]]
        yield shape, surface, values, more


def _take_offsets(shape: str, rest: list[str]) -> tuple[list[str], list[Point]]:
    """A line without "times" or "also", and how far its copies are from the first, m."""
    if "times" in rest:
        at = rest.index("times")
        count, x, y, z = (read_number(one) for one in rest[at + 1 :])
        return rest[:at], [(n * x, n * y, n * z) for n in range(int(count))]
    if "also" not in rest:
        return rest, [(0.0, 0.0, 0.0)]
    at, first = rest.index("also"), _AXES[shape].index("x")
    x, y, z = (read_number(one.lstrip("±")) for one in rest[first : first + 3])
    values = [read_number(one) for one in rest[at + 1 :]]
    if len(values) % 3:
        raise ValueError("'also' needs places, of three numbers each")
    others = [point(values[n : n + 3]) for n in range(0, len(values), 3)]
    return rest[:at], [(a - x, b - y, c - z) for a, b, c in [(x, y, z), *others]]


def _option(word: str, sign: float) -> float | str:
    """A number after the first word of a line, or a word: an axis, rows of bits."""
    if word[0] == "±":
        return sign * read_number(word[1:])
    return word if word.isalpha() or not word.strip(".#/") else read_number(word)


def _count(values: Sequence[float], *counts: int) -> Sequence[float]:
    if len(values) not in counts:
        wanted = " or ".join(map(str, counts))
        raise ValueError(f"{wanted} numbers are needed but there are {len(values)}")
    return values


def _read_one(
    shape: str, surface: str, values: list[float], more: list[float | str]
) -> list[Placed]:
    """The parts of one copy of a line."""
    if shape in _SOLIDS:
        x, y, z, *size = _count(values, 6)
        return [Placed(_SOLIDS[shape], surface, _solid((x, y, z), size, more))]
    if shape in _RODS:
        *ends, thick = _count(values, 7, 8)[:7]
        side = values[7] if len(values) == 8 else thick
        over = _ROUNDED * thick if shape == "limb" else 0.0
        to_body = placed_between(point(ends), point(ends[3:]), thick, side, over)
        return [Placed(_RODS[shape], surface, to_body)]
    if shape in _SPANNED:
        corners = [point(values[n : n + 3]) for n in range(0, len(_count(values, 12)), 3)]
        return [Placed(_SPANNED[shape], surface, placed_spanned(*corners))]
    return [*_COMPOSED[shape](surface, values, more)]


def _solid(centre: Point, size: Sequence[float], more: Sequence[float | str]) -> Affine:
    """An upright solid, slanted by "lean" or turned about its middle by "turn"."""
    to_body = placed_upright((0.0, 0.0, 0.0), point(size))
    word = more[0] if more else ""
    if word == "lean":
        to_body[0, 2] = float(more[1]) * to_body[2, 2]
    elif word == "turn":
        for axis, angle in zip("xyz", more[1:4], strict=True):
            to_body = compose(turn_about(axis, math.radians(float(angle))), to_body)
    elif word:
        raise ValueError(f"{word!r} is not for it; there are 'lean' and 'turn'")
    return compose(shift(*centre), to_body)


def _bar(surface: str, values: list[float], more: object) -> Iterator[Placed]:
    """A box in the y-z plane from one point to another: x y z, y z, its width and depth."""
    x, y0, z0, y1, z1, wide, deep = _count(values, 7)
    long = max(math.hypot(y1 - y0, z1 - z0), 1e-9)
    across = (0.0, wide * (z1 - z0) / long, -wide * (y1 - y0) / long)
    to_body = placed_spanned((x, y0, z0), (x, y1, z1), across, (deep, 0.0, 0.0))
    yield Placed(Shape.BOX, surface, to_body)


def _disc(surface: str, values: list[float], more: object) -> Iterator[Placed]:
    """A round plate that faces +x: its middle, radius and depth."""
    x, y, z, radius, deep = _count(values, 5)
    ends = (x - 0.5 * deep, y, z), (x + 0.5 * deep, y, z)
    yield Placed(Shape.CYLINDER, surface, placed_between(*ends, radius, radius, 0.0))


def _frame(surface: str, values: list[float], more: object) -> Iterator[Placed]:
    """Four bars around a rectangle that faces +x: its middle, outer size, their width and depth."""
    x, y, z, wide, tall, thick, deep = _count(values, 7)
    right, up = 0.5 * (wide - thick), 0.5 * (tall - thick)
    for side in (1.0, -1.0):
        ends = [y + side * right, z - up - 0.5 * thick, y + side * right, z + up + 0.5 * thick]
        yield from _bar(surface, [x, *ends, thick, deep], more)
    for side in (1.0, -1.0):
        ends = [y - right, z + side * up, y + right, z + side * up]
        yield from _bar(surface, [x, *ends, thick, deep], more)


def _chain(surface: str, values: list[float], more: object) -> Iterator[Placed]:
    """Limbs from point to point: their radius, then the points."""
    radius, *rest = values
    if len(rest) % 3 or len(rest) < 6:
        raise ValueError("a chain needs its radius and two or more points")
    points = [point(rest[n : n + 3]) for n in range(0, len(rest), 3)]
    yield from _limbs(surface, points, radius, radius)


def _limbs(surface: str, points: Iterable[Point], thick: float, side: float) -> Iterator[Placed]:
    for start, end in itertools.pairwise(points):
        to_body = placed_between(start, end, thick, side, _ROUNDED * thick)
        yield Placed(Shape.ELLIPSOID, surface, to_body)


def _ring(surface: str, values: list[float], more: Sequence[float | str]) -> Iterator[Placed]:
    """Limbs around an ellipse.

    Its middle, half extents to the right and up, half thickness; then the axis that it goes round,
    the first and last angle in degrees, from the right, and the number of limbs.
    """
    if not (more and more[0] in ("about",)) or len(more) != 5:
        raise ValueError("a ring ends with 'about', an axis, two angles and a number of pieces")
    x, y, z, right, up, thick = _count(values, 6)
    axis, first, last, pieces = str(more[1]), float(more[2]), float(more[3]), int(more[4])
    points: list[Point] = []
    for step in range(pieces + 1):
        angle = math.radians(first + (last - first) * step / pieces)
        a, b = right * math.cos(angle), up * math.sin(angle)
        points.append(
            {"x": (x, y + a, z + b), "y": (x + a, y, z + b), "z": (x - b, y + a, z)}[axis]
        )
    yield from _limbs(surface, points, thick, thick)


def _lathe(surface: str, values: list[float], more: object) -> Iterator[Placed]:
    """Posts on each other: the foot, their number, then heights and radii of the outline."""
    x, y, z, steps, *outline = values
    if len(outline) % 2 or len(outline) < 4:
        raise ValueError("a lathe needs its foot, a number of steps, and heights with radii")
    heights, radii = outline[0::2], outline[1::2]
    edges = np.linspace(heights[0], heights[-1], int(steps) + 1)
    for low, high in itertools.pairwise(map(float, edges)):
        wide = 2.0 * float(np.interp(0.5 * (low + high), heights, radii))
        centre = (x, y, z + 0.5 * (low + high))
        yield Placed(Shape.CYLINDER, surface, placed_upright(centre, (wide, wide, high - low)))


def _bits(surface: str, values: list[float], more: Sequence[float | str]) -> Iterator[Placed]:
    """Dark cells of a grid that faces +x, as boxes: its middle, width, height and depth.

    Then "rows" and the rows from the top, "#" for a dark cell and "." for a bright one, with "/"
    between them.
    """
    if len(more) < 2 or more[0] != "rows":
        raise ValueError("bits end with 'rows' and rows of '#' and '.' with '/' between them")
    x, y, z, wide, tall, deep = _count(values, 6)
    rows = "".join(map(str, more[1:])).split("/")
    cell, high = wide / max(map(len, rows)), tall / len(rows)
    for number, row in enumerate(rows):
        for run in re.finditer("#+", row):
            middle = y - 0.5 * wide + 0.5 * cell * (run.start() + run.end())
            centre = (x, middle, z + 0.5 * tall - high * (number + 0.5))
            size = (deep, cell * (run.end() - run.start()), high)
            yield Placed(Shape.BOX, surface, placed_upright(centre, size))


_COMPOSED: dict[str, Callable[[str, list[float], list[float | str]], Iterator[Placed]]] = {
    "bar": _bar, "bits": _bits, "disc": _disc, "frame": _frame, "chain": _chain, "ring": _ring,
    "lathe": _lathe,
}  # fmt: skip


def _wheel(values: Sequence[float]) -> Wheel:
    """A tyre with a bright rim that a dark cross divides: its middle, radius and width."""
    x, y, z, radius, width = values
    spoke, deep = 1.26 * radius, width + 0.04
    sizes = (spoke, deep, 0.16 * radius), (0.16 * radius, deep, spoke)
    rims = ("rubber", 0.5 * width, radius), ("chrome", 0.5 * width + 0.01, 0.64 * radius)
    discs = [
        (surface, placed_between((x, y - half, z), (x, y + half, z), reach, reach, 0.0))
        for surface, half, reach in rims
    ]
    parts = [Placed(Shape.CYLINDER, surface, to_body) for surface, to_body in discs]
    parts += [Placed(Shape.BOX, "dark", placed_upright((x, y, z), size)) for size in sizes]
    return tuple(parts), rolling("y", (x, y, z), radius)
