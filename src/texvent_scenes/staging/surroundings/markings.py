"""Lines on the ground of a place, laid so that what stands or goes there fits between them."""

from __future__ import annotations

import math
from collections.abc import Iterator, Sequence
from typing import NamedTuple

import numpy as np

from texvent_scenes.models.nouns import NOUNS, VARIANTS
from texvent_scenes.models.tables import nouns_with, trait_value
from texvent_scenes.rendered_scene import Float64Array
from texvent_scenes.staging.actors import Actor, size_of
from texvent_scenes.staging.placement.zones import zone_of
from texvent_scenes.staging.surroundings.pieces import SceneryItem, ViewClearance

_ON_BRIDGE_M, _GAUGE_M = 0.5, 0.3
"""Height of a train from which on no rails lie on the ground below it; distance from the middle of
a track up to which one is on it, m."""
_STILL_M_S, _PARALLEL = 0.05, 0.12
"""Speed below which a body rests; sine of the turn up to which others stand as the first does."""
_CLEAR_M, _DOOR_M = 0.06, 0.2
"""Least gap of a vehicle to the lines beside it, and usual room for its doors, m."""
_WIDTHS = (0.9, 1.4)
"""Least and greatest width of a cell that is fitted to what stands in it, in usual ones."""
_LINE_M = 0.06
"""Half the width of a line of usual bays, m."""
_AISLE_M, _OUT_M = 3.0, 0.2
"""Half the width of the way between bays; way from which on a body goes out of its bay, m."""
_STEP_M, _POINTS = 0.05, 25
"""Step of widths of bays that are tried, m; points to a side at which a body is looked at."""


class Cells(NamedTuple):
    """Cells between the lines of a noun, as a trait has them."""

    width_m: float
    length_m: float
    """0 = lanes without ends."""
    number: int


class Laid(NamedTuple):
    """Place of lines on the ground: their middle, m, their heading, and their scale."""

    spot: tuple[float, float]
    angle: float
    scale: float = 1.0

    def see(self, points: Float64Array) -> Float64Array:
        """[n, 2] ground points in the axes of the lines, m."""
        c, s = math.cos(self.angle), math.sin(self.angle)
        return np.asarray((np.asarray(points)[:, :2] - self.spot) @ [[c, -s], [s, c]])

    def point(self, along_m: float, left_m: float) -> tuple[float, float]:
        """Ground point at a place in the axes of the lines."""
        c, s = math.cos(self.angle), math.sin(self.angle)
        return (
            self.spot[0] + c * along_m - s * left_m,
            self.spot[1] + s * along_m + c * left_m,
        )


class _Stay(NamedTuple):
    """A vehicle at an instant at which it rests."""

    actor: Actor
    time_s: float
    out: Float64Array
    """[2] way on which it leaves from there, or has come there, m."""

    @property
    def yaw(self) -> float:
        return self.actor.track.at(self.time_s).yaw

    @property
    def spot(self) -> Float64Array:
        return self.actor.middle(self.time_s)[:2]


def cells_of(noun: str) -> Cells | None:
    """Cells between the lines of a noun; None: it has none."""
    row = trait_value("cells", noun)
    return None if row is None else Cells(*row)


def lay_lines(noun: str, usual: Laid, actors: Sequence[Actor], view: ViewClearance) -> list[Laid]:
    """Places of the lines of a noun.

    Rails lie under each train, a runway under what lands on it, bays around vehicles that rest,
    else beside the way of one; lanes have the first body in the middle of one; a pitch has its goal
    on its line. Other lines have their usual place.
    """
    if noun in nouns_with("rails") and any(zone_of(one.noun) == "rails" for one in actors):
        return _lay_rails([one for one in actors if zone_of(one.noun) == "rails"])
    lander = next((one for one in actors if one.noun.name in nouns_with("takes off")), None)
    if noun in nouns_with("strip") and lander is not None:
        ends = [lander.middle(time_s)[:2] for time_s in (0.0, view.clip_s)]
        x, y = np.mean(ends, axis=0)
        return [Laid((float(x), float(y)), lander.track.at(0.0).yaw)]
    for one in actors:
        row = trait_value("on lines", one.noun.name)
        if row is not None and row[0] == noun and one.track.anchor is None:
            x, y, _ = map(float, one.middle(0.0))
            own = Laid((x, y), one.track.at(0.0).yaw)
            return [Laid(own.point(float(row[1]), 0.0), own.angle)]
    cells = cells_of(noun)
    if cells is None or not actors:
        return [usual]
    if cells.length_m:
        return _lay_bays(cells, actors, view) or [usual]
    return [_centre_lane(cells, usual, actors)]


def _lay_rails(trains: Sequence[Actor]) -> list[Laid]:
    """A track under each train that is on none yet; none below a bridge."""
    laid: list[Laid] = []
    for one in trains:
        x, y, _ = map(float, one.middle(0.0))
        yaw = one.track.at(0.0).yaw
        is_on_one = any(
            abs(track.see(np.array([[x, y]]))[0, 1]) < _GAUGE_M
            and abs(math.sin(yaw - track.angle)) < _PARALLEL
            for track in laid
        )
        if one.lowest_m(0.0) <= _ON_BRIDGE_M and not is_on_one:
            laid.append(Laid((x, y), yaw))
    return laid


def _centre_lane(cells: Cells, usual: Laid, actors: Sequence[Actor]) -> Laid:
    """The lines moved aside, so that the first body is in the middle of a lane."""
    (place,) = usual.see(actors[0].middle(0.0)[None])
    lane = float(place[1]) / cells.width_m - 0.5 * (cells.number + 1)
    return Laid(usual.point(0.0, cells.width_m * (lane - round(lane))), usual.angle)


def _list_stays(actors: Sequence[Actor], clip_s: float) -> Iterator[_Stay]:
    """Vehicles that rest at the clip's beginning, or else at its end."""
    for one in actors:
        if not _is_vehicle(one):
            continue
        way = (one.middle(clip_s) - one.middle(0.0))[:2]
        for time_s, sign in ((0.0, 1.0), (clip_s, -1.0)):
            if abs(one.track.at(time_s).speed_m_s) < _STILL_M_S:
                yield _Stay(one, time_s, sign * way)
                break


def _is_vehicle(one: Actor) -> bool:
    """Whether it is of those for which there are bays."""
    noun = NOUNS.get(VARIANTS.get(one.noun.name, one.noun.name), one.noun)
    return noun.motion == "drive" and zone_of(noun) == "road" and one.track.anchor is None


def _lay_bays(cells: Cells, actors: Sequence[Actor], view: ViewClearance) -> list[Laid]:
    """Rows of bays: around vehicles that rest, as many as they need; else beside who goes."""
    stays = [*_list_stays(actors, view.clip_s)]
    resting = {one.actor.instance for one in stays}
    going = [one for one in actors if _is_vehicle(one) and one.instance not in resting]
    rows: list[Laid] = []
    for stay in stays:
        if any(is_in_cell(cells, row, stay.actor, stay.time_s) for row in rows):
            continue
        row = _fit_row(cells, stay, stays, going)
        if not any(_overlap(cells, row, other) for other in rows):
            rows.append(row)
    movers = going or [one for one in actors if one.is_mover and one.noun.habitat == "ground"]
    if not rows and movers:
        rows.append(_beside_way(cells, movers[0], view))
    return rows


def _fit_row(cells: Cells, first: _Stay, stays: Sequence[_Stay], going: Sequence[Actor]) -> Laid:
    """The row with the first in the middle of a bay, and most of those beside it in one, too."""
    open_to = _open_end(first, stays, going)
    own = Laid((float(first.spot[0]), float(first.spot[1])), open_to)
    beside = _list_beside(cells, own, [first, *(one for one in stays if one is not first)])
    width = _choose_width(cells, beside)
    along, aside, half_length, half_width = beside.T
    numbers = np.round(aside / width)
    is_in = np.abs(aside - width * numbers) + half_width + _CLEAR_M < 0.5 * width
    is_in &= np.abs(numbers) < cells.number
    is_in[0] = True
    numbers = numbers[is_in]
    left = math.floor(0.5 * float(numbers.min() + numbers.max())) + 0.5 * (cells.number % 2 == 0)
    low = float((along - half_length)[is_in].min())
    high = float((along + half_length)[is_in].max())
    depth = width / cells.width_m * cells.length_m
    # Of long ones the ends stand out of the bays, on the side of the way.
    is_deep = high - low + 2.0 * _CLEAR_M <= depth
    ahead = 0.5 * (low + high) if is_deep else low - _DOOR_M + 0.5 * depth
    return Laid(own.point(ahead, left * width), open_to, width / cells.width_m)


def _list_beside(cells: Cells, own: Laid, stays: Sequence[_Stay]) -> Float64Array:
    """[n, 4] places along and aside, and half the lengths and widths, of who stands in a row, m.

    `own` is the place and the heading of the first of them.
    """
    rows = []
    for one in stays:
        along, aside = own.see(one.spot[None])[0]
        body = one.actor.model
        is_parallel = abs(math.sin(one.yaw - own.angle)) < _PARALLEL
        if is_parallel and abs(along) < 0.5 * cells.length_m:
            rows.append((along, aside, 0.5 * body.length, 0.5 * body.width))
    return np.array(rows, dtype=np.float64)


def _choose_width(cells: Cells, beside: Float64Array) -> float:
    """Width of bays with which most of those beside the first stand in one, m."""
    aside, half_width = beside[:, 1], beside[:, 3]
    least = max(_WIDTHS[0] * cells.width_m, 2.0 * (float(half_width[0]) + _DOOR_M))
    most = max(least, _WIDTHS[1] * cells.width_m)
    exact = (np.abs(aside[:, None]) / np.arange(1, cells.number)).ravel()
    widths = [max(cells.width_m, least), *np.arange(least, most, _STEP_M)]
    widths += [*exact[(exact > least) & (exact < most)]]

    def rank(width: float) -> tuple[int, float]:
        off = np.abs(aside - width * np.round(aside / width))
        is_clear = off + half_width + _CLEAR_M < 0.5 * width
        return -int(is_clear.sum()), float(off[is_clear].sum()) + abs(width - cells.width_m)

    return float(min(widths, key=rank))


def _open_end(first: _Stay, stays: Sequence[_Stay], going: Sequence[Actor]) -> float:
    """Heading from the closed end of a bay to the way before it.

    Who leaves goes there; else who passes is there; else noses are at the closed ends.
    """
    nose = np.array([math.cos(first.yaw), math.sin(first.yaw)])
    alike = [one for one in stays if abs(math.sin(one.yaw - first.yaw)) < _PARALLEL]
    out = sum(float(one.out @ nose) for one in alike)
    if abs(out) < _OUT_M and going:
        out = sum(float((one.middle(0.0)[:2] - first.spot) @ nose) for one in going)
    return first.yaw if out > _OUT_M else first.yaw + math.pi


def _beside_way(cells: Cells, one: Actor, view: ViewClearance) -> Laid:
    """The row beside the way of a body, open to it, on the side that the camera looks at."""
    middle_s = 0.5 * view.clip_s
    x, y, _ = map(float, one.middle(middle_s))
    way = Laid((x, y), one.track.at(middle_s).yaw)
    camera = view.cameras[len(view.cameras) // 2]
    side = -1.0 if float(way.see(camera.position[None])[0, 1]) > 0.0 else 1.0
    aside = max(_AISLE_M, 0.5 * one.model.width + _DOOR_M) + 0.5 * cells.length_m
    return Laid(way.point(0.0, side * aside), way.angle - side * 0.5 * math.pi)


def _half_extents(cells: Cells, row: Laid) -> Float64Array:
    """[2] half the length and half the width of a row, m."""
    return 0.5 * row.scale * np.array([cells.length_m, cells.number * cells.width_m])


def _overlap(cells: Cells, one: Laid, other: Laid) -> bool:
    """Whether two rows of bays lie on each other."""
    half = _half_extents(cells, one)
    steps = [np.linspace(-each, each, 2 * cells.number + 1) for each in half]
    points = np.stack(np.meshgrid(*steps), axis=-1).reshape(-1, 2)
    ground = np.array([one.point(*place) for place in points])
    return bool((np.abs(other.see(ground)) < _half_extents(cells, other)).all(axis=1).any())


def list_rows(items: Sequence[SceneryItem]) -> Iterator[tuple[Cells, Laid]]:
    """Rows of bays among pieces of scenery."""
    for one in items:
        cells = cells_of(one.rule.noun)
        if cells is not None and cells.length_m:
            yield cells, Laid(one.position, one.yaw, size_of(one.model))


def list_bays(cells: Cells, row: Laid) -> Float64Array:
    """[n, 2] places of the middles of a row's bays, in its axes, m."""
    numbers = np.arange(cells.number) - 0.5 * (cells.number - 1)
    return np.stack([0.0 * numbers, row.scale * cells.width_m * numbers], axis=1)


def is_in_cell(cells: Cells, row: Laid, one: Actor, time_s: float) -> bool:
    """Whether a body stands between two lines of a row: its end may stand out on the open side."""
    along, left = row.see(one.corners(time_s)).T
    half, line_m = _half_extents(cells, row), _LINE_M * row.scale
    ends = np.array([left.min() - line_m, left.max() + line_m]) + half[1]
    low, high = np.floor(ends / (row.scale * cells.width_m))
    is_one = low == high and 0 <= low < cells.number
    is_beside = is_one and float(along.min()) > line_m - half[0]
    return bool(is_beside and row.see(one.middle(time_s)[None])[0, 0] < half[0])


def is_off(cells: Cells, row: Laid, spot: tuple[float, float], radius_m: float) -> bool:
    """Whether a circle on the ground lies beside a row of bays."""
    gap = np.maximum(np.abs(row.see(np.array([spot]))[0]) - _half_extents(cells, row), 0.0)
    return float(np.hypot(*gap)) >= radius_m


def list_astride(items: Sequence[SceneryItem], actors: Sequence[Actor], clip_s: float) -> list[str]:
    """Names of vehicles that rest across the lines of bays."""
    rows = [*list_rows(items)]
    astride = []
    for stay in _list_stays(actors, clip_s):
        points = _list_points(stay.actor, stay.time_s)
        for cells, row in rows:
            reach = _half_extents(cells, row) + _LINE_M * row.scale
            is_near = (np.abs(row.see(points)) < reach).all(axis=1).any()
            if is_near and not is_in_cell(cells, row, stay.actor, stay.time_s):
                astride.append(stay.actor.name)
                break
    return list(dict.fromkeys(astride))


def _list_points(one: Actor, time_s: float) -> Float64Array:
    """[n, 2] points of the ground that a body covers, m."""
    left, right, far = (one.corners(time_s)[number, :2] for number in (0, 2, 4))
    u, v = (each.reshape(-1, 1) for each in np.meshgrid(*[np.linspace(0.0, 1.0, _POINTS)] * 2))
    return np.asarray(left + u * (right - left) + v * (far - left))
