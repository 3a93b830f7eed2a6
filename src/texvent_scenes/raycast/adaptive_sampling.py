"""Light in every pixel of one tile (compiled by Numba).

Edges matter most: a pixel that jumps as an edge passes fires false events. So every pixel is first
probed on a fine lattice for *what* is there. Where all probes agree, one shaded sample is exact
enough, because textures are already averaged over the pixel. Where they differ, the edge is placed
by bisection, so that each surface's share of the pixel changes continuously; where something thin
is near, many samples, no two of them in the same row or column, find the shares.
"""

from __future__ import annotations

import math
from typing import Any

import numpy as np
from numpy.typing import NDArray

from texvent.runtime.jit import jit
from texvent_scenes.raycast.acceleration import TILE
from texvent_scenes.raycast.lamps.glow import add_glows
from texvent_scenes.raycast.lamps.light import ALL_LIGHTS, LIT_BITS, SUN, lit_by
from texvent_scenes.raycast.media import through_media
from texvent_scenes.raycast.records import Record
from texvent_scenes.raycast.shading.lighting import shade_hit
from texvent_scenes.raycast.trace import (
    CODES,
    Listed,
    background_hit,
    first_listed,
    hit_again,
    ray_direction,
    shapes_near,
    shows_code,
    surface_code,
)
from texvent_scenes.raycast.vectors import scaled
from texvent_scenes.rendered_scene import Colour, Float32Array, Float64Array

_THIN = -(1 << 40)
"""Probe value that agrees with nothing: something thin is near."""
UNKNOWN = -(1 << 41)
"""Probe value of lattice points that no wanted pixel needs, and of pixels with several surfaces."""
_NEEDED = -(1 << 42)
"""Value of lattice points that are yet to be probed."""
Codes = NDArray[np.int64]
Kept = tuple[NDArray[np.int64], Float64Array]
"""Found in a tile for pixels that share a border: [n, n, 7], for each lattice point its probe where
it took over another, then, of the lines to the right and down, both ends' probes and the one
beyond the first edge; and [n, n, 2], places of these edges on their lines."""
_BISECTIONS = 6
"""Steps that place an edge between two probes: to 1/128 pixel with two probes per pixel side."""
_MAX_EDGES = 4
"""Edges that are placed between two neighbouring probes."""
_BLOCK = 4
"""Side of the blocks of pixels whose shapes are listed before they are probed."""
_MOST_NEAR = 256
"""Shapes of a pixel or a block that are listed; where there are more, all of its tile are."""
_MAX_SURFACES = 64
"""Surfaces that may share a pixel."""
_SOFT_CLIP_START = 0.75
"""Light above this share of white is compressed instead of cut off."""


@jit(error_model="numpy", inner=True)
def _probe(instant: Record, x: float, y: float, listed: Listed) -> int:
    """Probe of image point (x, y): surface code and light bits of the first hit, in one int."""
    depth, number, face, _ = first_listed(instant, x, y, listed, False)
    lit = lit_by(instant, x, y, (depth, number, face), ALL_LIGHTS, False)[0]
    return (surface_code(instant, number, face) << LIT_BITS) + lit


@jit(error_model="numpy", inner=True)
def _soft_clip(light: float) -> float:
    """Linear light as a share of white: unchanged up to `_SOFT_CLIP_START`, then smoothly to 1."""
    if light <= _SOFT_CLIP_START:
        return max(light, 0.0)
    room = 1.0 - _SOFT_CLIP_START
    return _SOFT_CLIP_START + room * (1.0 - math.exp((_SOFT_CLIP_START - light) / room))


@jit(error_model="numpy", inner=True)
def _expose(instant: Record, light: Colour) -> Colour:
    red, green, blue = scaled(light, instant.exposure)
    if instant.highlights == 1:
        return max(red, 0.0), max(green, 0.0), max(blue, 0.0)
    return _soft_clip(red), _soft_clip(green), _soft_clip(blue)


@jit(error_model="numpy", inner=True)
def _shade(instant: Record, x: float, y: float, probe: int) -> Colour:
    """Exposed light at image point (x, y), where the surface `probe` is."""
    number, lit = (probe >> LIT_BITS) // CODES, probe & ALL_LIGHTS
    depth, face = math.inf, 0
    if number >= 0:
        depth, face = hit_again(instant, x, y, number)
    if depth == math.inf:
        depth, number, face = background_hit(instant, ray_direction(instant, x, y))
    light = shade_hit(instant, x, y, (depth, number, face), lit)
    if instant.medium_count > 0:
        light = through_media(instant, x, y, depth, light)
    return _expose(instant, light)


@jit(error_model="numpy", inner=True)
def _add_share(
    shares: Float64Array, count: int, probe: int, share: float, place: tuple[float, float]
) -> int:
    """Add a piece of a pixel, at `place`, to the surface it shows; the new number of surfaces.

    `shares` is [k, 6]: probe, share, share · x and share · y summed, and x and y of one piece.
    """
    group = 0
    while group < count and shares[group, 0] != probe:
        group += 1
    if group == len(shares):
        group -= 1  # more surfaces in a pixel than there is room for: the last ones count as one
    elif group == count:
        shares[group, 0] = probe
        shares[group, 1] = shares[group, 2] = shares[group, 3] = 0.0
        shares[group, 4], shares[group, 5] = place
        count += 1
    shares[group, 1] += share
    shares[group, 2] += share * place[0]
    shares[group, 3] += share * place[1]
    return count


@jit(error_model="numpy", inner=True)
def _mean_light(instant: Record, shares: Float64Array, count: int) -> Colour:
    """Mean light of a pixel that several surfaces share.

    Each is shaded once, in the middle of its pieces: textures are averaged over the pixel anyway.
    """
    red, green, blue, total = 0.0, 0.0, 0.0, 0.0
    for group in range(count):
        share = shares[group, 1]
        probe = int(shares[group, 0])
        x, y = shares[group, 2] / share, shares[group, 3] / share
        if not shows_code(instant, x, y, probe >> LIT_BITS):
            x, y = shares[group, 4], shares[group, 5]
        light = _shade(instant, x, y, probe)
        red += share * light[0]
        green += share * light[1]
        blue += share * light[2]
        total += share
    return red / total, green / total, blue / total


@jit(error_model="numpy", inner=True)
def _sample_pixel(
    instant: Record,
    column: int,
    row: int,
    pattern: Float64Array,
    shares: Float64Array,
    listed: Listed,
) -> Colour:
    """Mean light over a pixel with something thin in it, from the samples of `pattern`."""
    count = 0
    for index in range(len(pattern)):
        x, y = column + pattern[index, 0], row + pattern[index, 1]
        count = _add_share(shares, count, _probe(instant, x, y, listed), 1.0, (x, y))
    return _mean_light(instant, shares, count)


@jit(error_model="numpy", inner=True)
def _between(
    start: tuple[float, float], stop: tuple[float, float], share: float
) -> tuple[float, float]:
    return start[0] + share * (stop[0] - start[0]), start[1] + share * (stop[1] - start[1])


@jit(error_model="numpy", inner=True)
def _find_edge(
    instant: Record,
    ends: tuple[tuple[float, float], tuple[float, float]],
    low: float,
    probes: tuple[int, int],
    listed: Listed,
) -> tuple[float, int]:
    """First edge on a line that begins on the surface `probes[0]`: its place, and the next probe.

    `low` is where on the line (0..1) that surface is known to be; `probes[1]` is at its end.
    """
    high, surface, beyond = 1.0, probes[0] >> LIT_BITS, probes[1]
    changed = (probes[0] ^ probes[1]) & ALL_LIGHTS if surface == beyond >> LIT_BITS else 0
    hit, place = (0.0, 0, 0), ends[1]
    for _ in range(_BISECTIONS):
        middle = 0.5 * (low + high)
        x, y = _between(ends[0], ends[1], middle)
        depth, number, face, _ = first_listed(instant, x, y, listed, False)
        code = surface_code(instant, number, face)
        reached = probes[0] & changed
        if code == surface and changed:  # else there is no need to know about shadow
            reached = lit_by(instant, x, y, (depth, number, face), changed, False)[0] & changed
        if code == surface and reached == probes[0] & changed:
            low = middle
        else:
            high, hit, place = middle, (depth, number, face), (x, y)
            beyond = (code << LIT_BITS) + (probes[1] & ALL_LIGHTS & ~changed) + reached
    if high < 1.0 and beyond >> LIT_BITS != surface:
        # Where the same lamps reach both ends, only the sun's shadow is looked for.
        is_other = beyond >> LIT_BITS != probes[1] >> LIT_BITS
        lamps = (probes[0] ^ probes[1]) & ALL_LIGHTS & ~SUN
        wanted = ALL_LIGHTS if is_other or lamps else SUN
        lit, _ = lit_by(instant, place[0], place[1], hit, wanted, False)
        beyond = beyond & ~wanted | lit & wanted
    return 0.5 * (low + high), beyond


@jit(error_model="numpy", inner=True)
def _add_line(
    instant: Record,
    shares: Float64Array,
    count: int,
    ends: tuple[tuple[float, float], tuple[float, float]],
    probes: tuple[int, int],
    share: float,
    listed: Listed,
    line: tuple[Kept, int, int, int],
) -> int:
    """Add the pieces of a line between two lattice points to the surfaces they show.

    `share` is what the whole line stands for, `line` where its first edge is kept: row and column
    of the first point, and 1 + 3 × direction. Returns the new number of surfaces.
    """
    kept, j, i, at = line
    start, stop = ends
    low, probe = 0.0, probes[0]
    for _ in range(_MAX_EDGES):
        if probe == probes[1]:
            break
        first = low
        is_kept = kept[0][j, i, at] == probe and kept[0][j, i, at + 1] == probes[1]
        if low == 0.0 and is_kept:
            low, beyond = kept[1][j, i, at // 3], kept[0][j, i, at + 2]
        else:
            low, beyond = _find_edge(instant, ends, first, (probe, probes[1]), listed)
            if first == 0.0:
                kept[0][j, i, at], kept[0][j, i, at + 1] = probe, probes[1]
                kept[1][j, i, at // 3], kept[0][j, i, at + 2] = low, beyond
        place = _between(start, stop, 0.5 * (first + low))
        count = _add_share(shares, count, probe, share * (low - first), place)
        probe = beyond
    place = _between(start, stop, 0.5 * (low + 1.0))
    return _add_share(shares, count, probes[1], share * (1.0 - low), place)


@jit(error_model="numpy", inner=True)
def _split_pixel(
    instant: Record,
    column: int,
    row: int,
    probes: NDArray[np.int64],
    shares: Float64Array,
    listed: Listed,
    kept: Kept,
    lattice: tuple[int, int],
) -> Colour:
    """Mean light over a pixel with an edge in it.

    `probes` [k, k] is what is at the lattice points in and around the pixel, `shares` [any, 6]
    scratch space, `lattice` the place of the first of these points in the tile's. The pixel is cut
    into lines between lattice points, in the direction that crosses more edges; on each line the
    edge is found by bisection. So coverage grows continuously as an edge moves, where counted
    samples would jump.
    """
    last = len(probes) - 1
    across, down = 0, 0
    for j in range(last + 1):
        for i in range(last):
            across += probes[j, i] != probes[j, i + 1]
            down += probes[i, j] != probes[i + 1, j]
    upright = across >= down
    count = 0
    for line in range(last + 1):
        share = (0.5 if line in (0, last) else 1.0) / (last * last)
        for piece in range(last):
            if upright:
                first, second = probes[line, piece], probes[line, piece + 1]
                start = (column + piece / last, row + line / last)
                stop = (column + (piece + 1) / last, start[1])
                at = (kept, lattice[0] + line, lattice[1] + piece, 1)
            else:
                first, second = probes[piece, line], probes[piece + 1, line]
                start = (column + line / last, row + piece / last)
                stop = (start[0], row + (piece + 1) / last)
                at = (kept, lattice[0] + piece, lattice[1] + line, 4)
            count = _add_line(
                instant, shares, count, (start, stop), (first, second), share, listed, at
            )
    return _mean_light(instant, shares, count)


@jit(error_model="numpy", inner=True)
def _mark_needed(
    wanted: NDArray[np.bool_], samples: int, probes: NDArray[np.int64], kept: Kept
) -> bool:
    """Write `_NEEDED` to the lattice points of wanted pixels, else `UNKNOWN`; whether there are."""
    is_any = False
    for j in range(wanted.shape[0] * samples + 1):
        for i in range(wanted.shape[1] * samples + 1):
            probes[j, i] = UNKNOWN
            kept[0][j, i, 0] = kept[0][j, i, 1] = kept[0][j, i, 4] = UNKNOWN
    for row in range(wanted.shape[0]):
        for column in range(wanted.shape[1]):
            if wanted[row, column]:
                is_any = True
                for j in range(row * samples, (row + 1) * samples + 1):
                    for i in range(column * samples, (column + 1) * samples + 1):
                        probes[j, i] = _NEEDED
    return is_any


@jit(error_model="numpy", inner=True)
def _probe_tile(
    instant: Record,
    corner: tuple[int, int],
    wanted: NDArray[np.bool_],
    samples: int,
    probes: NDArray[np.int64],
    near: NDArray[np.int32],
    kept: Kept,
) -> None:
    """Probe the wanted pixels of a tile, given its left and top edges in pixels, on a lattice.

    Shadow is looked for at every other lattice point; the points between take it over from their
    left neighbour on the same surface, which saves half of the shadow rays.
    """
    if not _mark_needed(wanted, samples, probes, kept):
        return
    rows, columns = wanted.shape[0] * samples + 1, wanted.shape[1] * samples + 1
    side = _BLOCK * samples
    for j in range(0, rows - 1, side):
        bottom = rows if j + side >= rows - 1 else j + side
        for i in range(0, columns - 1, side):
            block = (j, bottom, i, columns if i + side >= columns - 1 else i + side)
            _probe_block(instant, corner, block, samples, probes, near)


@jit(error_model="numpy", inner=True)
def _probe_block(
    instant: Record,
    corner: tuple[int, int],
    block: tuple[int, int, int, int],
    samples: int,
    probes: NDArray[np.int64],
    near: NDArray[np.int32],
) -> None:
    """As `_probe_tile`, some rows and columns of the lattice: the first and one past the last."""
    left, top = corner
    is_any = False
    for j in range(block[0], block[1]):
        for i in range(block[2], block[3]):
            is_any |= probes[j, i] == _NEEDED
    if not is_any:
        return
    box = (
        left + block[2] / samples,
        left + (block[3] - 1) / samples,
        top + block[0] / samples,
        top + (block[1] - 1) / samples,
    )
    listed = shapes_near(instant, box, near, True)
    for j in range(block[0], block[1]):
        for i in range(block[2], block[3]):
            if probes[j, i] != _NEEDED:
                continue
            x, y = left + i / samples, top + j / samples
            depth, number, face, thin = first_listed(instant, x, y, listed, True)
            surface = surface_code(instant, number, face)
            is_odd = (i + j) % 2 == 1
            if not thin and i > 0 and is_odd and probes[j, i - 1] >> LIT_BITS == surface:
                probes[j, i] = probes[j, i - 1]
                continue
            lit, thin_shadow = lit_by(instant, x, y, (depth, number, face), ALL_LIGHTS, True)
            probes[j, i] = _THIN if thin or thin_shadow else (surface << LIT_BITS) + lit


@jit(error_model="numpy", inner=True)
def _probe_shadows(
    instant: Record,
    left: int,
    top: int,
    lattice: tuple[int, int],
    probes: NDArray[np.int64],
    around: NDArray[np.int64],
    kept: Kept,
    listed: Listed,
) -> None:
    """Write the probes of a pixel to `around`, and look for shadow where they took over another.

    `probes` are those of the tile, `lattice` the place in them of the pixel's first point.
    """
    last = len(around) - 1
    for j in range(last + 1):  # to assign a slice compiles 40 functions of Numba's error message
        for i in range(last + 1):
            around[j, i] = probes[lattice[0] + j, lattice[1] + i]
    for j in range(last + 1):
        for i in range((lattice[0] + lattice[1] + j + 1) % 2, last + 1, 2):
            is_sure = True
            for row, column in ((j - 1, i), (j + 1, i), (j, i - 1), (j, i + 1)):
                if 0 <= row <= last and 0 <= column <= last:
                    differs = around[row, column] ^ around[j, i]
                    is_sure &= differs == 0 or differs >> LIT_BITS != 0
            if not is_sure:
                at = lattice[0] + j, lattice[1] + i, 0
                if kept[0][at] == UNKNOWN:
                    kept[0][at] = _probe(instant, left + i / last, top + j / last, listed)
                around[j, i] = kept[0][at]


@jit(error_model="numpy", inner=True)
def _agree(probes: NDArray[np.int64], top: int, left: int, samples: int) -> bool:
    """Whether all probes in and around one pixel saw the same surface, and nothing thin."""
    first = probes[top, left]
    if first == _THIN:
        return False
    for row in range(top, top + samples + 1):
        for column in range(left, left + samples + 1):
            if probes[row, column] != first:
                return False
    return True


@jit(error_model="numpy", inner=True)
def _any_thin(probes: NDArray[np.int64], top: int, left: int, samples: int) -> bool:
    """Whether something thin is near one pixel."""
    for row in range(top, top + samples + 1):
        for column in range(left, left + samples + 1):
            if probes[row, column] == _THIN:
                return True
    return False


@jit(error_model="numpy")
def render_rows(
    instants: NDArray[Any],
    rows: tuple[int, int],
    samples: int,
    pattern: Float64Array,
    wanted: NDArray[np.bool_],
    codes: Codes,
    image: Float32Array,
) -> None:
    """Fill the wanted pixels in some rows of an image.

    Args:
        instants: `World.instant` of the scene.
        rows: first row and one past the last one; at most `TILE` rows.
        samples: probes per pixel side.
        pattern: [k, 2] sample positions in [0, 1)² for pixels with something thin.
        wanted: [H, W] which pixels to fill.
        codes: [H, W] the one surface that fills a pixel and what it is lit by, where that is known;
            `UNKNOWN` elsewhere. What is found in wanted pixels is written.
        image: [H, W, 3] linear light, 1 is white; these rows are written.
    """
    instant = instants[0]
    width = image.shape[1]
    top, bottom = rows
    probes = np.empty((TILE * samples + 1, TILE * samples + 1), dtype=np.int64)
    shares = np.empty((_MAX_SURFACES, 6), dtype=np.float64)
    around = np.empty((samples + 1, samples + 1), dtype=np.int64)
    near = np.empty(_MOST_NEAR, dtype=np.int32)
    kept = (
        np.empty((TILE * samples + 1, TILE * samples + 1, 7), dtype=np.int64),
        np.empty((TILE * samples + 1, TILE * samples + 1, 2), dtype=np.float64),
    )
    for left in range(0, width, TILE):
        right = min(left + TILE, width)
        in_tile = wanted[top:bottom, left:right]
        if not in_tile.any():
            continue
        in_doubt = in_tile & (codes[top:bottom, left:right] == UNKNOWN)
        _probe_tile(instant, (left, top), in_doubt, samples, probes, near, kept)
        for row in range(top, bottom):
            for column in range(left, right):
                if not wanted[row, column]:
                    continue
                j, i = (row - top) * samples, (column - left) * samples
                if in_doubt[row - top, column - left] and _agree(probes, j, i, samples):
                    codes[row, column] = probes[j, i]
                if codes[row, column] != UNKNOWN:
                    light = _shade(instant, column + 0.5, row + 0.5, codes[row, column])
                else:
                    box = (column, column + 1.0, row, row + 1.0)
                    listed = shapes_near(instant, box, near, False)
                    if _any_thin(probes, j, i, samples):
                        light = _sample_pixel(instant, column, row, pattern, shares, listed)
                    else:
                        _probe_shadows(instant, column, row, (j, i), probes, around, kept, listed)
                        light = _split_pixel(
                            instant, column, row, around, shares, listed, kept, (j, i)
                        )
                if instant.glow_count > 0:
                    light = add_glows(instant, column + 0.5, row + 0.5, light)
                image[row, column, 0] = light[0]
                image[row, column, 1] = light[1]
                image[row, column, 2] = light[2]
