"""Put pieces of surface where their paths lead, compiled by Numba.

For each pixel of the new image this collects which layers are there, and from where in each source
frame they came.
"""

from __future__ import annotations

import math
from typing import NamedTuple

import numpy as np

from texvent.interpolate.motion.layers_cpu import Floats, Numbers
from texvent.runtime.jit import jit

LEAST_OVERLAP = np.float32(1e-3)
"""Pieces that cover less of a pixel are left out."""
SAME_LAYER = np.float32(1.5)
"""Pieces of a layer differ in ln depth by at most this many tolerances."""
PLACE = 5
"""Numbers that a pixel collects per frame and layer: weight, and weighted sums of where from (x and
y, px from here), ln depth and its tolerance."""


class Room(NamedTuple):
    """What the pixels of the new image collect of the nearest layer."""

    nearest: Floats
    """[H, W] ln depth of the nearest piece."""
    farthest: Floats
    """[H, W] of the farthest one."""
    tolerance: Floats
    """[H, W] of the nearest piece."""
    places: Floats
    """[H · W, 2 · PLACE] of the nearest layer in both frames."""
    number: Numbers
    """[H, W] row of `Behind` for a pixel in which two layers meet; 0 where one layer is."""


class Behind(NamedTuple):
    """What pixels in which two layers meet collect of the farther one; row 0 is unused."""

    places: Floats
    """[n, 2 · PLACE]"""
    nearest: Floats
    """[n] ln depth of its nearest piece."""


class Piece(NamedTuple):
    """A piece of surface at an instant."""

    shift_x: np.float32
    """How far it is from where it was in its frame, px."""
    shift_y: np.float32
    order: np.float32
    """ln depth in its frame."""
    change: np.float32
    """Change of it since."""
    tolerance: np.float32
    """Of ln depth within its layer."""


@jit(inner=True)
def make_room(height: int, width: int) -> Room:
    """Room for an image of which nothing is known."""
    return Room(
        np.full((height, width), np.inf, np.float32),
        np.full((height, width), -np.inf, np.float32),
        np.zeros((height, width), np.float32),
        np.zeros((height * width, 2 * PLACE), np.float32),
        np.zeros((height, width), np.int32),
    )


@jit(error_model="numpy", inner=True)
def splat(pieces: Floats, s: np.float32, index: int, room: Room) -> None:
    """Collect all pieces of a frame at `s` of their paths, as if there were one layer.

    Args:
        pieces: [n, PIECE]; see `paths_cpu.list_pieces`.
        s: 0 at the frame, 1 at the other frame of the pair.
        index: first column of this frame in `Room.places`.
        room: added to.
    """
    height, width = room.nearest.shape
    nearest, farthest, tolerance = room.nearest, room.farthest, room.tolerance
    places = room.places
    for k in range(len(pieces)):
        piece = _piece_at(pieces, k, s)
        x, y = pieces[k, 0] + piece.shift_x, pieces[k, 1] + piece.shift_y
        depth = piece.order + piece.change
        left, right, top, bottom = _rectangle(pieces, k, s, x, y)
        for row in range(max(math.floor(top), 0), min(math.ceil(bottom), height)):
            down = min(bottom, np.float32(row + 1)) - max(top, np.float32(row))
            for column in range(max(math.floor(left), 0), min(math.ceil(right), width)):
                across = min(right, np.float32(column + 1)) - max(left, np.float32(column))
                if across * down <= LEAST_OVERLAP:
                    continue
                if depth < nearest[row, column]:
                    nearest[row, column] = depth
                    tolerance[row, column] = piece.tolerance
                farthest[row, column] = max(farthest[row, column], depth)
                _add(places, row * width + column, index, piece, across * down)


@jit(error_model="numpy", inner=True)
def number_meetings(room: Room) -> Numbers:
    """Number the pixels in which two layers meet, and clear what they collected.

    Returns:
        [n + 1] flat index of the pixel that has each number; the first is not used.
    """
    height, width = room.number.shape
    pixels = np.zeros(height * width + 1, np.int32)
    count = 0
    for y in range(height):
        for x in range(width):
            if room.farthest[y, x] - room.nearest[y, x] > np.float32(2.0) * room.tolerance[y, x]:
                count += 1
                room.number[y, x] = count
                pixels[count] = y * width + x
                room.places[pixels[count]] = 0
    return pixels[: count + 1].copy()


@jit(error_model="numpy", inner=True)
def splat_meetings(
    pieces: Floats,
    chosen: Numbers,
    s: np.float32,
    index: int,
    room: Room,
    behind: Behind,
    is_far: bool,
) -> None:
    """As `splat`, of some pieces, only where two layers meet, and only the near or the far one.

    The first call, for the nearer layer, also finds how far away the farther one is.
    """
    height, width = room.nearest.shape
    number = room.number
    for k in chosen:
        piece = _piece_at(pieces, k, s)
        x, y = pieces[k, 0] + piece.shift_x, pieces[k, 1] + piece.shift_y
        left, right, top, bottom = _rectangle(pieces, k, s, x, y)
        for row in range(max(math.floor(top), 0), min(math.ceil(bottom), height)):
            down = min(bottom, np.float32(row + 1)) - max(top, np.float32(row))
            for column in range(max(math.floor(left), 0), min(math.ceil(right), width)):
                across = min(right, np.float32(column + 1)) - max(left, np.float32(column))
                meeting = number[row, column]
                if meeting == 0 or across * down <= LEAST_OVERLAP:
                    continue
                depth = piece.order + piece.change
                limit = SAME_LAYER * max(piece.tolerance, room.tolerance[row, column])
                if depth <= room.nearest[row, column] + limit:
                    if not is_far:
                        _add(room.places, row * width + column, index, piece, across * down)
                elif not is_far:
                    behind.nearest[meeting] = min(behind.nearest[meeting], depth)
                elif depth <= behind.nearest[meeting] + SAME_LAYER * piece.tolerance:
                    _add(behind.places, meeting, index, piece, across * down)


@jit(error_model="numpy", inner=True)
def _piece_at(pieces: Floats, k: int, s: np.float32) -> Piece:
    """Piece `k` at `s` of its path."""
    return Piece(
        s * (pieces[k, 2] + s * (pieces[k, 4] + s * pieces[k, 6])),
        s * (pieces[k, 3] + s * (pieces[k, 5] + s * pieces[k, 7])),
        pieces[k, 13],
        s * pieces[k, 8],
        pieces[k, 14],
    )


@jit(error_model="numpy", inner=True)
def _rectangle(
    pieces: Floats, k: int, s: np.float32, x: np.float32, y: np.float32
) -> tuple[np.float32, np.float32, np.float32, np.float32]:
    """Left, right, top and bottom of a rectangle around a pixel's square, as it is stretched."""
    half, one = np.float32(0.5), np.float32(1.0)
    wide = half * max(abs(one + s * pieces[k, 9]) + abs(s * pieces[k, 10]), one)
    high = half * max(abs(s * pieces[k, 11]) + abs(one + s * pieces[k, 12]), one)
    return x + half - wide, x + half + wide, y + half - high, y + half + high


@jit(error_model="numpy", inner=True)
def _add(places: Floats, row: int, index: int, piece: Piece, weight: np.float32) -> None:
    places[row, index] += weight
    places[row, index + 1] -= weight * piece.shift_x
    places[row, index + 2] -= weight * piece.shift_y
    places[row, index + 3] += weight * piece.order
    places[row, index + 4] += weight * piece.tolerance


@jit(error_model="numpy", inner=True)
def find_meeting_pieces(pieces: Floats, s: np.float32, number: Numbers) -> Numbers:
    """Indices of the pieces that may reach a pixel in which two layers meet."""
    height, width = number.shape
    near = np.zeros((height, width), np.bool_)
    for y in range(height):
        for x in range(width):
            if number[y, x]:
                near[max(y - 1, 0) : y + 2, max(x - 1, 0) : x + 2] = True
    half = np.float32(0.5)
    chosen = np.empty(len(pieces), np.int32)
    count = 0
    for k in range(len(pieces)):
        piece = _piece_at(pieces, k, s)
        x, y = pieces[k, 0] + piece.shift_x, pieces[k, 1] + piece.shift_y
        if not (-1 < x < width and -1 < y < height):
            continue
        column, row = min(int(x + half), width - 1), min(int(y + half), height - 1)
        if near[row, column]:
            chosen[count] = k
            count += 1
    return chosen[:count]
