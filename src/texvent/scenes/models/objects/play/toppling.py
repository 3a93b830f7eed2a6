"""What stands up from many pieces and comes down: a row of dominoes, towers of blocks, of cards."""

from __future__ import annotations

import math
from collections.abc import Callable, Sequence
from dataclasses import dataclass
from functools import partial

from texvent.scenes.models.articulated_model import ArticulatedModel
from texvent.scenes.models.machine_acts import COLLAPSE
from texvent.scenes.models.materials import Material
from texvent.scenes.models.objects.palette import CHINA, INK
from texvent.scenes.models.people.timing import ease
from texvent.scenes.models.protocol import ModelPart, Noun, Pose
from texvent.scenes.models.shapes import box, compose, moved, shift, turn_x
from texvent.scenes.models.variation import paint
from texvent.scenes.scene import Colour

_START_S = 0.35
_GRAVITY_M_S2 = 9.81
_ROW, _STEP_M = 9, 0.17
_TALL_M, _THIN_M, _DEEP_M = 0.32, 0.05, 0.17
"""A domino, larger than in life, m."""
_NEXT_S, _FALL_S = 0.13, 0.36
"""From the fall of one domino to that of the next, and how long one takes, s."""
_RESTING_RAD = 1.08
"""How far a domino is turned that lies on the next."""
_LEAN_S, _LEAN_RAD = 0.45, 0.20
"""How long a tower leans before its pieces fly, and how far."""
_TOYS: tuple[Colour, ...] = (
    (0.60, 0.06, 0.05), (0.05, 0.18, 0.55), (0.70, 0.50, 0.03), (0.05, 0.38, 0.12),
)  # fmt: skip


_CARDBOARD: tuple[Colour, ...] = ((0.40, 0.25, 0.12), (0.46, 0.30, 0.16))


@dataclass(frozen=True)
class _Piece:
    """A piece of a tower."""

    parts: Sequence[ModelPart]
    """About its middle, m."""
    y: float
    z: float
    """Where its middle is, m."""
    low_m: float
    """Height of its middle when it lies, m."""
    quarters: int = 1
    """Quarter turns that it makes in its fall; 0 = it stays."""


def _dominoes(paints: Sequence[Material], activity: str, time_s: float) -> list[ModelPart]:
    """A row from left to right; each falls onto the next, and the last one flat."""
    found = []
    for number in range(_ROW):
        y = (number - 0.5 * (_ROW - 1)) * _STEP_M
        share = 0.0
        if activity == COLLAPSE:
            begin = _START_S + number * _NEXT_S
            share = ease(time_s, begin - 0.5 * _FALL_S, begin + 0.5 * _FALL_S)
        least = 0.5 * math.pi if number == _ROW - 1 else _RESTING_RAD
        body = [
            box(paints[number % len(paints)], (0.0, 0.0, 0.5 * _TALL_M),
                (_DEEP_M, _THIN_M, _TALL_M)),
            box(INK, (0.0, 0.0, 0.5 * _TALL_M), (1.02 * _DEEP_M, 1.04 * _THIN_M, 0.02)),
        ]  # fmt: skip
        edge = (0.0, 0.5 * _THIN_M, 0.0)
        found += moved(moved(body, turn_x(-least * share, edge)), shift(y=y))
    return found


def _tower(pieces: Sequence[_Piece], activity: str, time_s: float) -> list[ModelPart]:
    """It leans to its right and comes apart; the pieces fall, turn over and lie."""
    lean = fall = 0.0
    if activity == COLLAPSE:
        lean = _LEAN_RAD * min(max((time_s - _START_S) / _LEAN_S, 0.0), 1.0) ** 2
        fall = max(time_s - _START_S - _LEAN_S, 0.0)
    found = []
    for number, piece in enumerate(pieces):
        if piece.quarters == 0:
            found += moved(piece.parts, shift(y=piece.y, z=piece.z))
            continue
        y = piece.y * math.cos(lean) + piece.z * math.sin(lean)
        z = piece.z * math.cos(lean) - piece.y * math.sin(lean)
        drop = max(z - piece.low_m, 0.0)
        landing = math.sqrt(2.0 * drop / _GRAVITY_M_S2)
        into = min(fall, landing)
        # What is higher goes farther; it slides on a little where it lies.
        speed = 0.35 + 1.0 * piece.z + 0.12 * (number % 3)
        slide = 0.12 * (1.0 - math.exp(-5.0 * max(fall - landing, 0.0)))
        share = into / landing if landing > 0.0 else min(4.0 * fall, 1.0)
        turn = lean + (0.5 * math.pi * piece.quarters - lean) * share if fall > 0.0 else lean
        height = max(z - 0.5 * _GRAVITY_M_S2 * into**2, piece.low_m)
        place = shift(y=y + speed * (into + slide), z=height)
        found += moved(piece.parts, compose(place, turn_x(-turn)))
    return found


def _blocks(count: int, edge: float) -> Callable[[Sequence[Material]], list[_Piece]]:
    """A column of cubes in several colours."""

    def make(paints: Sequence[Material]) -> list[_Piece]:
        return [
            _Piece([box(paints[n % len(paints)], (0.0, 0.0, 0.0), (edge, edge, 0.97 * edge))],
                   0.02 * (-1.0) ** n, (n + 0.5) * edge, 0.5 * edge, 0 if n == 0 else 1 + n // 3)
            for n in range(count)
        ]  # fmt: skip

    return make


def _books(paints: Sequence[Material]) -> list[_Piece]:
    """Eight books that lie on each other, their pages to one side."""
    pages, thick = Material(CHINA), 0.055
    return [
        _Piece(
            [box(paints[n % len(paints)], (0.0, 0.0, 0.0), (0.24 - 0.01 * (n % 3), 0.32, thick)),
             box(pages, (0.012, 0.0, 0.0), (0.24 - 0.01 * (n % 3), 0.30, 0.7 * thick))],
            0.02 * (-1.0) ** n, (n + 0.5) * thick, 0.5 * thick, 0 if n < 2 else 2,
        )
        for n in range(8)
    ]  # fmt: skip


def _cards(paints: Sequence[Material]) -> list[_Piece]:
    """Three storeys of cards that lean against each other, with flat ones between."""
    tall, wide, thin = 0.36, 0.24, 0.012
    pieces = []
    for level in range(3):
        bays = 3 - level
        middle = (level + 0.5) * 0.95 * tall
        for bay in range(bays):
            y = (bay - 0.5 * (bays - 1)) * 0.26
            for side in (1.0, -1.0):
                card = box(paints[0], (0.0, 0.0, 0.0), (wide, thin, tall))
                back = box(paints[1], (0.0, 0.0, 0.0), (0.8 * wide, 1.3 * thin, 0.8 * tall))
                leaning = moved([card, back], turn_x(0.30 * side))
                pieces.append(_Piece(leaning, y + 0.06 * side, middle, 0.02 + 0.006 * bay))
        if bays > 1:
            top = box(paints[0], (0.0, 0.0, 0.0), (wide, 0.26 * (bays - 1) + 0.06, thin))
            pieces.append(_Piece([top], 0.0, (level + 1) * 0.95 * tall, 0.03, 2))
    return pieces


def _build_dominoes(*, colour: Colour | None, scale: float, seed: int) -> ArticulatedModel:
    """A row of nine dominoes, 1.4 m; `colour` is theirs."""
    paints = [Material(paint(colour, seed, "paint", (CHINA,)))]
    return ArticulatedModel(
        [], scale=scale, articulate=lambda pose: _dominoes(paints, pose.activity, pose.time_s)
    )


def _build_tower(
    make: Callable[[Sequence[Material]], list[_Piece]], colours: tuple[Colour, ...], *,
    colour: Colour | None, scale: float, seed: int,
) -> ArticulatedModel:  # fmt: skip
    """Make a pile of pieces that comes down, 0.4 to 2 m; `colour` is that of all its pieces."""
    paints = [Material(colour or one) for one in colours]
    pieces = make(paints)

    def articulate(pose: Pose) -> list[ModelPart]:
        return _tower(pieces, pose.activity, pose.time_s)

    del seed
    return ArticulatedModel([], scale=scale, articulate=articulate)


def _row(name: str, build: Callable[..., ArticulatedModel], same: str) -> Noun:
    words = tuple(" ".join(word.split()) for word in same.split(","))
    # "A row of" alone would be a number of single ones.
    words += tuple(f"a {word}" for word in words if word.split()[1:2] == ["of"])
    return Noun(name, build, "fixed", 0.0, "stand", words, place="indoor",
                acts=frozenset({COLLAPSE}))  # fmt: skip


NOUNS = (
    _row("domino row", _build_dominoes, """row of dominoes, line of dominoes, chain of dominoes,
         series of dominoes, domino chain, domino run, domino line, rows of dominoes, row of domino
         tiles, line of domino tiles"""),
    _row("block tower", partial(_build_tower, _blocks(7, 0.22), _TOYS), """tower of blocks, stack
         of blocks, pile of blocks, tower of cubes, stack of cubes, tower of bricks, stack of
         bricks, tower of toy blocks, stack of toy blocks, tower of wooden blocks, stack of wooden
         blocks, wooden block tower, toy block tower, tower of building blocks, brick tower, jenga
         tower, jenga"""),
    _row("box stack", partial(_build_tower, _blocks(5, 0.40), _CARDBOARD), """tower of boxes, stack
         of boxes, pile of boxes, tower of cardboard boxes, stack of cardboard boxes"""),
    _row("book stack", partial(_build_tower, _books, _TOYS), """stack of books, pile of books,
         tower of books"""),
    _row("card house", partial(_build_tower, _cards, (CHINA, (0.50, 0.05, 0.06))), """house of
         cards, card tower, tower of cards, pyramid of cards, house of playing cards"""),
)  # fmt: skip
"""What topples."""
