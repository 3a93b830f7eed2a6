"""Check of a staged scene: objects out of view or tiny, and words that its picture does not show.

Rays through a grid of image points count the pixels of every object.
"""

from __future__ import annotations

import itertools
import math
from collections import Counter
from collections.abc import Collection, Container, Iterator, Mapping, Sequence
from dataclasses import replace
from types import MappingProxyType
from typing import NamedTuple

import numpy as np

from texvent.camera import PosedCamera, project
from texvent.sensor import SensorSize
from texvent_scenes.checks.bodies.limbs import find_ageless, find_tiny, list_headless
from texvent_scenes.checks.bodies.looks import find_unlike, is_ball
from texvent_scenes.checks.bodies.phases import (
    find_airborne_meals,
    find_undone,
    find_unfinished,
    find_unhurried,
    find_unlifted,
    list_departures,
    list_hidden,
    list_rounds,
)
from texvent_scenes.checks.bodies.worn import find_unworn
from texvent_scenes.checks.clip.body_boxes import BodyBoxes, body_of
from texvent_scenes.checks.clip.relations import Violation, find_violations
from texvent_scenes.checks.clip.staged_clip import is_inside
from texvent_scenes.checks.surroundings.edges import find_cut_subject, find_merged, list_covering
from texvent_scenes.checks.surroundings.placement import find_misplaced
from texvent_scenes.checks.surroundings.places import MOST_FOG, find_near, list_dry, list_own_walls
from texvent_scenes.checks.surroundings.water import find_wet_and_dry
from texvent_scenes.checks.views.pictures import find_unshown
from texvent_scenes.checks.views.shots import find_misframed
from texvent_scenes.description import SceneDescription, label_of
from texvent_scenes.meanings import list_meanings
from texvent_scenes.models.tables import nouns_with
from texvent_scenes.raycast.ground_truth import count_unoccluded, visible_instances
from texvent_scenes.raycast.render import world_and_shapes
from texvent_scenes.rendered_scene import Float64Array, RenderedScene
from texvent_scenes.spec.data import PLACING
from texvent_scenes.staging.actors import Actor
from texvent_scenes.staging.camera.subject import choose_main
from texvent_scenes.staging.compose import ComposedScene
from texvent_scenes.staging.interactions.holding import hides_riders

INSTANTS = 7
"""Instants of the clip at which it is looked for objects; what is in view at one of them is."""
MOST_POINTS = 12_000
"""Points of the grid."""
LEAST_PIXELS, _LEAST_AREA, _LEAST_BALL = 6, 0.0007, 0.0003
"""Pixels, and share of the image, below which an object is too small to be told; of a ball, which
its outline tells."""
_SMALL_AREA = 0.002
"""Share of the image below which a note tells that an object is small."""
LEAST_SEEN = 0.15
"""Share of an object's pixels that nothing stands before; of less it is hidden, and a copy of
several too of which less is inside the image."""
MOST_COVERED = 0.5
"""Share of its pixels that are seen below which a note tells how much of a body is."""
_COVERING = ("wear", "in", "ride", "under", "behind")
"""Relations that say that something hides it."""
LEAST_INSIDE = 0.33
"""Share of an object's extent that is inside the image; of less it is cut off."""
_REMNANT = 0.004
"""Share of the image below which an object is hidden too of which less than `LEAST_INSIDE` is
seen: the end of a pier behind a boat."""
_PART = 0.03
"""Share of the image from which on a way along or off what is cut off is seen: of a trunk, of a
table."""
_FILLED = (0.1, 0.4)
"""Shares of the image that tell what something is of which less than `LEAST_INSIDE` is inside, or
even than `LEAST_SEEN`: a wall of a garage is none."""
MOST_COUNTED = 6
"""Copies of an object that are counted one by one; of more, some may hide each other."""
_LEAST_CLIP_S = 1.0
"""Length of a clip, s, in which motions get so far that they are judged."""
_INSTANTS = (0.17, 0.43, 0.71, 0.93)
"""Shares of the clip at which small pictures are compared."""
_ADJECTIVES = ("count", "size", "colour", "material", "placement")
"""Fields of an object that adjectives say."""


class View(NamedTuple):
    """The most that is seen of a body."""

    pixels: int
    """Its pixels at the instant that shows most of it."""
    share: float
    """Share of those that it would have if nothing stood before it."""
    at: tuple[int, ...] = ()
    """Points of the grid that show it at each instant."""


class Unseen(NamedTuple):
    """Words of a scene that a clip does not show."""

    out_of_view: tuple[str, ...]
    """Such as "tree", "dog (2 of 3)" or "man (hidden)"."""
    too_small: tuple[str, ...]
    """Such as "bird (2 pixels)"."""
    violations: tuple[Violation, ...] = ()
    """Relations, directions, weather, effects and light."""
    notes: tuple[str, ...] = ()
    """Such as "the ball leaves the view after 1.3 s"."""
    gone: frozenset[int] = frozenset()
    """Indices of objects of which so little is seen that nothing is told of them."""
    views: Mapping[int, View] = MappingProxyType({})
    """Instance id → the most that is seen of it."""


def _list_close(scene: ComposedScene, description: SceneDescription) -> set[int]:
    """Indices of the subject of a close-up, and of those who hold it."""
    if description.camera.framing != "close" or not scene.actors:
        return set()
    close = {choose_main(description, scene.actors).object_index}
    holders = (one for one in description.relations if one.kind == "hold")
    return close | {one.subject for one in holders if not close.isdisjoint(one.targets)}


def find_unseen(
    scene: ComposedScene, description: SceneDescription, size: SensorSize, duration_s: float
) -> Unseen:
    """Words of a description that no instant shows.

    An object without a body of its own is part of another one's, as a worn coat is.
    """
    times = [float(time_s) for time_s in np.linspace(0.0, duration_s, INSTANTS)]
    cameras = [scene.camera(time_s) for time_s in times]
    views = count_pixels(scene, [one.instance for one in scene.actors], size, times)
    clip = _Clip(cameras, times, size, description.camera.is_moving)
    related = _list_related(description)
    climbed = {i for one in description.relations for i in one.targets
               if one.kind in ("up", "down", "off")}  # fmt: skip
    close = _list_close(scene, description)
    outside, small, bodies = list[str](), list[str](), list[list[BodyBoxes]]()
    covered = {one.subject for one in description.relations if one.kind in _COVERING}
    notes = list[str]()
    unseen, partly = {*scene.missing}, set[int]()
    for index in range(len(description.objects)):
        label = label_of(description, index)
        own = [one for one in scene.actors if one.object_index == index]
        seen_own = [_until_broken(one, views[one.instance], times) for one in own]
        bodies.append([body_of(one, cameras, times) for one, view in zip(own, seen_own, strict=True)
                       if view.pixels])  # fmt: skip
        if own:
            part = _PART if index in climbed else math.inf
            found = _judge(own, seen_own, clip, is_related=index in related, part=part,
                           is_close=index in close)  # fmt: skip
            if any(_is_entered(*each, clip) for each in zip(own, seen_own, strict=True)):
                found = _Judged(is_unseen=False)
            if found.words is None:
                notes += _list_slight(label, seen_own, size, is_covered=index in covered)
            lines = small if found.is_small else outside
            lines += [f"{label}{found.words}"] if found.words is not None else []
            unseen |= {index} if found.is_unseen else set()
            partly |= {index} if found.is_partly else set()
    inside_one = _list_inside(description, scene.actors)
    outside += [f"{label_of(description, index)} (hidden)" for index in sorted(inside_one)]
    unseen, partly, hidden = unseen | inside_one, partly | inside_one, unseen - partly
    unseen |= {one.targets[0] for one in description.relations if one.subject in hidden
               and one.kind == "wear" and not any(bodies[one.targets[0]])}  # fmt: skip
    riders = _list_riders(scene, description, unseen)
    outside += [label_of(description, index) for index in sorted(riders)]
    unseen |= riders
    lines, lost, cut, violations = _find_slight(scene, description, unseen, clip)
    outside, unseen, partly = outside + lines, unseen | lost | cut, partly | cut
    seen = {number: view.at for number, view in views.items()}
    violations += [*_list_words_of(description, unseen, partly)]
    violations += find_unlike(description, scene.actors, scene.missing)
    violations += _find_unrealised(scene, description, bodies, times)
    violations += _find_misstaged(scene, description, clip, seen)
    notes += _list_notes(scene, description, clip, seen, unseen)
    return Unseen(
        tuple(dict.fromkeys(outside)), tuple(dict.fromkeys(small)),
        tuple(dict.fromkeys(violations)), tuple(dict.fromkeys(notes)),
        frozenset(unseen - partly - scene.missing), views,
    )  # fmt: skip


class _Clip(NamedTuple):
    """Cameras at the instants of a clip, and what holds for all of its objects."""

    cameras: Sequence[PosedCamera]
    times: Sequence[float]
    size: SensorSize
    is_camera_moving: bool


def _list_riders(scene: ComposedScene, description: SceneDescription, unseen: set[int]) -> set[int]:
    """Riders without a body of their own, whose mount is unseen."""
    bodied = {one.object_index for one in scene.actors}
    return {one.subject for one in description.relations if one.kind == "ride"
            and one.targets[0] in unseen and one.subject not in bodied | unseen}  # fmt: skip


def _find_misstaged(
    scene: ComposedScene, description: SceneDescription, clip: _Clip,
    seen: Mapping[int, Sequence[int]],
) -> Iterator[Violation]:  # fmt: skip
    """Motions, distances and framings that the clip does not show as they are said."""
    cameras, times, size, _ = clip
    yield from find_undone(description, scene.actors, seen, times)
    yield from find_tiny(description, scene.actors, cameras, times, size)
    yield from find_ageless(description, scene.actors, cameras, times, size)
    yield from find_near(scene, description, cameras, times)
    yield from find_misframed(scene, description, cameras, times, size)


def _list_notes(
    scene: ComposedScene, description: SceneDescription, clip: _Clip,
    seen: Mapping[int, Sequence[int]], unseen: Container[int],
) -> Iterator[str]:  # fmt: skip
    """Notes of bodies that are hidden, cut off, in the way, or leave the view."""
    cameras, times, size, _ = clip
    yield from list_hidden(scene, seen, cameras, times, size, _grid_of(size)[0] ** 2)
    yield from list_own_walls(scene, description)
    yield from list_rounds(description, scene.actors, times)
    yield from list_dry(scene, description, times)
    yield from list_headless(description, scene.actors, cameras, times, size)
    yield from list_covering(scene, description, seen, _count_points(size), times, unseen)
    if not description.camera.is_moving:
        yield from list_departures(scene, cameras, times, size)


def _list_related(description: SceneDescription) -> set[int]:
    """Objects of which a part may be seen: targets, backgrounds, and what the camera is within."""
    related = {i for one in description.relations for i in one.targets}
    partial_nouns = nouns_with("only a background")
    if any(one.kind == "travel" for one in description.camera.moves):
        partial_nouns |= nouns_with("passage")
    return related | {n for n, one in enumerate(description.objects) if one.noun in partial_nouns}


def _find_slight(
    scene: ComposedScene, description: SceneDescription, unseen: Collection[int], clip: _Clip
) -> tuple[list[str], set[int], set[int], list[Violation]]:
    """Lines on clothes, subjects at the edge and merged copies; who is lost, cut off; numbers."""
    cameras, times, size, _ = clip
    objects, shares = description.objects, [share * times[-1] for share in _INSTANTS]
    bare = {*find_unworn(scene, description, shares)} - {*unseen}
    cut = {*find_cut_subject(scene, description, cameras, times, size)} - {*unseen} - bare
    merged = [*find_merged(scene, description, cameras, times, size)]
    lines = [f"{label_of(description, index)} (hardly seen)" for index in sorted(bare)]
    lines += [f"{label_of(description, index)} (cut off most of the clip)" for index in cut]
    lines += [f"{label_of(description, index)} ({apart} of {objects[index].count})"
              for index, apart in merged if index not in {*unseen, *bare, *cut}]  # fmt: skip
    counts = [Violation("count", objects[index].count, "") for index, _ in merged]
    return lines, bare, cut, counts


class _Judged(NamedTuple):
    """Words behind the noun of an object in a report, None without a report."""

    words: str | None = None
    is_small: bool = False
    is_unseen: bool = True
    is_partly: bool = False
    """Whether enough is in the image to show its acts."""


def _judge(
    own: Sequence[Actor], views: Sequence[View], clip: _Clip, *, is_related: bool, part: float,
    is_close: bool,
) -> _Judged:  # fmt: skip
    """Visibility of an object's bodies over the clip.

    `part`: share of the image from which on what is cut off shows acts; `is_close`: whether it is
    the subject of a close shot, which cuts it off.
    """
    cameras, times, size, _ = clip
    area = size.width * size.height
    most, count = max(view.pixels for view in views), len(own)
    lost = sum(view.share < LEAST_SEEN or
               (count > 1 and _is_cut_off(one, cameras, times, size, LEAST_SEEN))
               for one, view in zip(own, views, strict=True))  # fmt: skip
    inside = _rank_inside(own, cameras, times, size)
    if most == 0:
        return _Judged("")
    share = max(view.share for view in views)
    if share < LEAST_SEEN or (share < LEAST_INSIDE and most < _REMNANT * area):
        return _Judged(" (hidden)")
    least = _LEAST_BALL if is_ball(own[0]) else _LEAST_AREA
    if most < max(LEAST_PIXELS, least * area):
        return _Judged(f" ({most} pixel{'s' if most > 1 else ''})", is_small=True)
    if _is_brief(views) and not clip.is_camera_moving:
        return _Judged(" (most of the clip)")
    if lost and count <= max(2 * lost, MOST_COUNTED):
        return _Judged(f" ({lost} of {count})", is_unseen=2 * lost > count)
    if inside < 2 and not is_close and (not is_related or most < _FILLED[inside == 0] * area):
        return _Judged(" (cut off)", is_partly=bool(inside) or most >= part * area)
    return _Judged(is_unseen=False)


def _list_slight(
    label: str, views: Sequence[View], size: SensorSize, *, is_covered: bool
) -> Iterator[str]:
    """Notes on an object that is small, and on bodies of which others hide more than half.

    `is_covered`: whether the scene says that something hides it.
    """
    most = max(view.pixels for view in views)
    if most < _SMALL_AREA * size.width * size.height:
        yield f"the {label} is small in the picture: about {most} pixels"
    shares = [view.share for view in views if view.pixels and view.share < MOST_COVERED]
    who = label if len(views) == 1 else f"{label} ({len(shares)} of {len(views)})"
    if shares and not is_covered:
        yield f"the {who} is partly hidden: at most {min(shares):.0%} of its pixels are seen"


def _until_broken(one: Actor, view: View, times: Sequence[float]) -> View:
    """View of a body until it breaks: then only its pieces are left."""
    if one.breaks_s is None:
        return view
    return view._replace(at=tuple(itertools.compress(view.at, (t < one.breaks_s for t in times))))


def _is_entered(one: Actor, view: View, clip: _Clip) -> bool:
    """Whether the camera goes through a passage, of which the image is never all but much."""
    is_large = view.pixels >= _FILLED[0] * clip.size.width * clip.size.height
    if one.noun.name not in nouns_with("passage") or not (clip.is_camera_moving and is_large):
        return False
    return any(is_inside(one, camera.position, time_s)
               for camera, time_s in zip(clip.cameras, clip.times, strict=True))  # fmt: skip


def _find_unrealised(
    scene: ComposedScene, description: SceneDescription, bodies: Sequence[list[BodyBoxes]],
    times: Sequence[float],
) -> Iterator[Violation]:  # fmt: skip
    """Words that bodies in view do not realise, and what changes no picture."""
    duration_s, bodied = times[-1], {one.object_index for one in scene.actors} | scene.missing
    apart = replace(description, relations=tuple(
        one for one in description.relations if bodied.issuperset((one.subject, *one.targets))
    ))  # fmt: skip
    for one in find_violations(apart, bodies):
        if duration_s >= _LEAST_CLIP_S or one.value in PLACING:
            yield one
    yield from find_misplaced(description, scene.place, scene.environment(0.0), scene.actors, times)
    yield from find_airborne_meals(description, scene, times)
    yield from find_unhurried(description, scene.actors, times)
    yield from find_unfinished(description, duration_s)
    yield from find_unlifted(description, scene.actors, duration_s)
    yield from find_wet_and_dry(scene, description, duration_s)
    yield from find_unshown(scene, description, [share * duration_s for share in _INSTANTS])


def _list_inside(description: SceneDescription, actors: Sequence[Actor]) -> set[int]:
    """Objects that ride in a closed vehicle, which hides them."""
    closed = {one.object_index for one in actors if hides_riders(one.noun)}
    bodied = {one.object_index for one in actors}
    return {one.subject for one in description.relations
            if one.kind in ("ride", "in") and one.targets[0] in closed} - bodied  # fmt: skip


def _is_brief(views: Sequence[View]) -> bool:
    """Whether so few instants show any copy of an object that the clip is not about it."""
    shown = [any(counts) for counts in zip(*(one.at for one in views), strict=True)]
    return sum(shown) < LEAST_SEEN * len(shown)


def _list_words_of(
    description: SceneDescription, gone: Collection[int], partly: Collection[int]
) -> Iterator[Violation]:
    """Nouns of unseen objects, and what is said of no others; of those partly seen the noun."""
    told = [
        [*((name, getattr(one, name)) for name in _ADJECTIVES),
         *(("motion", motion.kind) for motion in one.motions)]
        for one in description.objects
    ]  # fmt: skip
    seen = {pair for index, pairs in enumerate(told) if index not in gone for pair in pairs}
    for index in sorted(gone):
        yield Violation("noun", description.objects[index].noun, "")
        said = told[index] if index not in partly else []
        yield from (Violation(*pair, "") for pair in said if pair not in seen)


def without_words(words: Sequence[str], faults: Sequence[Violation]) -> tuple[str, ...]:
    """Words of a report, but for those that mean what a picture does not show."""
    lost = {(kind, value) for kind, value, _ in faults}
    return tuple(
        word for word in words
        if not any((kind, value) in lost or (kind, "") in lost
                   for kind, value in list_meanings(word))
    )  # fmt: skip


def _rank_inside(
    own: Sequence[Actor], cameras: Sequence[PosedCamera], times: Sequence[float], size: SensorSize
) -> int:
    """Rank of how much of any copy is inside: 0, less than `LEAST_SEEN`; 1, `LEAST_INSIDE`; 2."""
    shares = (LEAST_SEEN, LEAST_INSIDE)
    return sum(not all(_is_cut_off(one, cameras, times, size, share) for one in own)
               for share in shares)  # fmt: skip


def _is_cut_off(
    actor: Actor, cameras: Sequence[PosedCamera], times: Sequence[float], size: SensorSize,
    least: float = LEAST_INSIDE,
) -> bool:  # fmt: skip
    """Whether no instant has more than a share of its box in the image."""
    for time_s, camera in zip(times, cameras, strict=True):
        seen = project(camera, size, actor.corners(time_s))
        if (seen[:, 2] > 0.0).all():
            box = np.array([seen[:, :2].min(axis=0) - 1.0, seen[:, :2].max(axis=0) + 1.0])
            inside = np.diff(np.clip(box, 0.0, [size.width, size.height]), axis=0)
            if float(np.prod(inside / np.diff(box, axis=0))) >= least:
                return False
    return True


def count_pixels(
    scene: RenderedScene, instances: list[int], size: SensorSize, times: Sequence[float]
) -> dict[int, View]:
    """Instance id → what is seen of it, from a grid of points."""
    step, (x, y) = _grid_of(size)
    points = np.stack(np.meshgrid(x, y), axis=-1).reshape(-1, 2)
    seen = [Counter(_list_seen(scene, time_s, size, points)) for time_s in times]
    views = {}
    for number, ids in _group_by_best(instances, seen).items():
        world, shapes = world_and_shapes(scene, times[number], size, shadows=False)
        owner = shapes.instance.astype(np.int32)
        alone = np.zeros(1 + max(max(ids), int(owner.max(initial=0))), dtype=np.int64)
        count_unoccluded(world.instant, owner, points, alone)
        for one in ids:
            count = seen[number][one]
            views[one] = View(count * step * step, count / max(int(alone[one]), 1),
                              tuple(each[one] for each in seen))  # fmt: skip
    return {one: views[one] for one in instances}


def _grid_of(size: SensorSize) -> tuple[int, tuple[Float64Array, Float64Array]]:
    """Step of the grid of points, pixels, and its x and y."""
    step = max(1, math.ceil(math.sqrt(size.width * size.height / MOST_POINTS)))
    x, y = (np.arange(step // 2, side, step, dtype=np.float64) + 0.5
            for side in (size.width, size.height))  # fmt: skip
    return step, (x, y)


def _count_points(size: SensorSize) -> int:
    """Points of the grid."""
    x, y = _grid_of(size)[1]
    return len(x) * len(y)


def _list_seen(
    scene: RenderedScene, time_s: float, size: SensorSize, points: Float64Array
) -> list[int]:
    """Instances through image points, 0 where fog leaves next to nothing of one."""
    depth, seen = visible_instances(scene, time_s, size, points)
    is_clear = depth <= MOST_FOG * float(scene.environment(time_s).fog_distance)
    return [int(one) for one in np.where(is_clear, seen, 0)]


def _group_by_best(instances: list[int], seen: Sequence[Counter[int]]) -> dict[int, list[int]]:
    """Number of an instant → the instances of which it shows most."""
    best: dict[int, list[int]] = {}
    for one in instances:
        counts = [at[one] for at in seen]
        best.setdefault(counts.index(max(counts)), []).append(one)
    return best
