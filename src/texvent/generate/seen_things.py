"""Which things of a scene its camera ever shows, how well, and whether they move in the image."""

from __future__ import annotations

import math
from collections import Counter
from collections.abc import Mapping, Sequence
from typing import NamedTuple

import numpy as np

from texvent.generate.landmarks import (
    LEAST_MARK,
    SKY,
    Landmark,
    is_marked,
    least_share,
    list_landmarks,
)
from texvent.generate.seen_words.courses import judge_goals, list_walkers_in_air
from texvent.generate.seen_words.faces import judge_face
from texvent.generate.seen_words.motion.verbs import judge_verbs
from texvent.generate.seen_words.people import is_portrait, judge_head
from texvent.generate.seen_words.picture import Picture, View, uneven_times
from texvent.generate.seen_words.plain import ease_faults, ease_names
from texvent.generate.seen_words.things import judge_outline
from texvent.generate.seen_words.words import judge_words
from texvent.generate.sights import Glimpse, Sight
from texvent.scenes.description import SceneDescription
from texvent.scenes.evidence import Evidence
from texvent.scenes.models.lamps import LAMPS
from texvent.scenes.models.machine_acts import HANG
from texvent.scenes.projection import place_in_image, project, ray_directions
from texvent.scenes.raycast.render import world_and_shapes
from texvent.scenes.raycast.surface_motion import cast
from texvent.scenes.raycast.trace import GROUND, NOTHING
from texvent.scenes.raycast.visibility import count_unoccluded
from texvent.scenes.scene import Float64Array, Scene, Shape
from texvent.scenes.staging.acts.acts import ACTS
from texvent.scenes.staging.compose import ComposedScene
from texvent.scenes.staging.placement.at_wall import list_at_wall
from texvent.sensor import SensorSize

INSTANTS = 9
"""Instants of the clip at which it is looked for things."""
NO_ROOM = "no room for it"
"""Why an object without a body is not shown."""
MOST_POINTS = 4000
"""Image points that are looked at per instant."""
IN_FOG = 2.5
"""Distance, as a multiple of that at which colours have faded to 37 %, from which on fog hides."""
LEAST_MOTION_PX = 1.0
"""Way in the image, over the clip, below which a thing stands still."""
_EXTRAS = {"conveyor belt": "parcels ride on the conveyor belt"}
"""Noun → what its model shows besides."""


_OF_WALLS = ("door", "window")
"""Nouns of what belongs into a wall and stands alone."""
_OF_CEILINGS = frozenset({"ceiling", "pendant", "hanging", "chandelier", "chandeliers"})
"""Words in names of what hangs from a ceiling and stands on the ground."""


class Findings(NamedTuple):
    """What was found of a scene's things and places."""

    faults: dict[int, str | None]
    """Instance id → why it is not shown, such as "hidden", or None."""
    still: frozenset[int]
    """Instances that do not move in the image."""
    places: dict[str, str]
    """Words of places and of the sky that are not shown → why."""
    scenery: tuple[str, ...] = ()
    """Nouns of the scenery that is in view, the largest first."""
    views: tuple[View, ...] = ()
    """What the camera sees at each of `INSTANTS`."""
    sights: Mapping[int, Sight] = {}
    """Instance id → what is seen of it at these."""


def find_evidence(
    scene: ComposedScene, description: SceneDescription, size: SensorSize, duration_s: float
) -> Evidence:
    """What a staged scene shows of its description.

    Args:
        scene: the staged scene.
        description: what it was staged from.
        size: of the image, pixels.
        duration_s: of the clip, s.
    """
    found = look_at_scene(scene, description, size, duration_s)
    return judge_findings(scene, description, size, found)


def look_at_scene(
    scene: ComposedScene, description: SceneDescription, size: SensorSize, duration_s: float
) -> Findings:
    """What is seen of its things and places; arguments as of `find_evidence`."""
    landmarks = list_landmarks(description)
    scenery = scene.list_scenery()
    return look_for_things(scene, size, duration_s, landmarks=landmarks, scenery=scenery)


def judge_findings(
    scene: ComposedScene,
    description: SceneDescription,
    size: SensorSize,
    found: Findings,
    *,
    is_eased: bool = False,
) -> Evidence:
    """What a staged scene shows of its description, from what is seen of its things.

    `is_eased`: what is plainly seen counts, though it is small or cut off (`ease_faults`).
    """
    copies: dict[int, list[int]] = {index: [] for index in range(len(description.objects))}
    for instance, index in scene.object_of.items():
        copies[index].append(instance)
    for actor in scene.actors:
        # A keyboard comes with who types on it.
        nouns = {noun for prop in actor.props for noun in prop.nouns}
        for index, own in copies.items():
            if not own and description.objects[index].noun in nouns:
                copies[index] = [actor.instance]
    for relation in description.relations:
        # A coat, or who rides a bicycle, may be a part of another's model.
        ends = (relation.subject, *relation.targets)
        if relation.kind in ACTS and any(copies[index] for index in ends):
            whole = next(copies[index] for index in ends if copies[index])
            for index in ends:
                copies[index] = copies[index] or whole
    picture = Picture(scene, size, image_points(size), found.views)
    words, qualities = judge_words(picture, description)
    if is_eased:
        qualities = ease_names(picture, qualities)
    bodies = {actor.instance: actor for actor in scene.actors}
    faults = {}
    known = ease_faults(picture, found.faults, found.sights) if is_eased else found.faults
    for one, fault in known.items():
        is_told = fault == "cut off" and is_portrait(picture, bodies.get(one))
        seen = None if is_told else fault
        body = bodies.get(one)
        seen = seen or judge_outline(picture, one) or judge_head(picture, body)
        faults[one] = seen or judge_face(picture, body)
    return Evidence(
        scene.unmet,
        {index: [faults[one] for one in own] or [NO_ROOM] for index, own in copies.items()},
        frozenset(index for index, own in copies.items() if found.still.issuperset(own)),
        {
            **judge_goals(description, {**words, **found.places}),
            **judge_verbs(picture, description),
            **words,
            **found.places,
        },
        qualities,
        found.scenery,
        tuple(
            dict.fromkeys(
                [
                    *scene.notes,
                    *_list_extras(scene, description, faults),
                    *list_walkers_in_air(picture),
                ]
            )
        ),
    )


def _list_extras(
    scene: ComposedScene, description: SceneDescription, faults: Mapping[int, str | None]
) -> list[str]:
    """What comes with a thing or an act without being said."""
    said = {one.noun for one in description.objects}
    words = set(description.prompt.casefold().split())
    laden = {description.objects[i].noun for one in description.relations if one.kind == "on"
             for i in one.targets}  # fmt: skip
    found = [note for noun, note in _EXTRAS.items() if noun in said - laden]
    bound = {one.subject for one in description.relations if one.kind in ("on", "in", "with")}
    bound |= {*list_at_wall(description, description.surroundings.place or "grass")}
    found += [
        f"the {one.noun} stands free, in no wall"
        for index, one in enumerate(description.objects)
        if one.noun in _OF_WALLS and index not in bound
    ]
    bound |= {one.subject for one in description.relations if one.kind == "above"}
    bound |= {
        index
        for index, one in enumerate(description.objects)
        if one.noun == "ceiling fan" or (one.motion is not None and one.motion.kind == HANG)
    }
    names = [one for one in description.claims if one.aspect == "name"]
    hung = {i for one in names if _OF_CEILINGS & {*one.word.split()} for i in one.things}
    found += [
        f"the {description.objects[index].noun} stands free, under no ceiling"
        for index in sorted(hung - bound)
    ]
    for actor in scene.actors:
        if actor.noun.name in LAMPS and faults.get(actor.instance) is not None:
            found.append(f"the {actor.noun.name} is not in view, but its light may be")
        for prop in actor.props:
            if prop.furniture:
                found.append(f"the {actor.noun.name} has a {prop.furniture} for what it does")
            elif prop.nouns and not said.intersection(prop.nouns) | words.intersection(prop.nouns):
                found.append(f"the {actor.noun.name} has a {prop.nouns[0]} for what it does")
    return found


def look_for_things(
    scene: Scene,
    size: SensorSize,
    duration_s: float,
    *,
    landmarks: Sequence[Landmark] = (),
    scenery: Sequence[str] = (),
) -> Findings:
    """What the camera shows of a scene's things and places.

    Args:
        scene: the scene; its `class_names` are looked for.
        size: of the image, pixels.
        duration_s: of the clip, s.
        landmarks: what places and the sky are known by.
        scenery: noun of each shape of the scene that is scenery, "" for others.

    Returns:
        Why things and places are not shown, and what does not move.
    """
    sights = {one: Sight() for one in scene.class_names}
    marks: Counter[str] = Counter()
    points = image_points(size)
    views: list[View] = []
    for time_s in uneven_times(0.0, duration_s, INSTANTS):
        view = _look(scene, float(time_s), size, points, sights)
        marks |= _count_marks(scene, view, points, scenery)
        if views:
            _follow(views[-1], view, sights)
        views.append(view)
    return Findings(
        {one: sight.fault(len(points), size.width * size.height) for one, sight in sights.items()},
        frozenset(one for one, sight in sights.items() if sight.moved_px < LEAST_MOTION_PX),
        {
            landmark.word: "out of view"
            for landmark in landmarks
            if all(marks[mark] < least_share(mark) * len(points) for mark in landmark.marks)
        },
        tuple(
            noun
            for noun, count in marks.most_common()
            if noun and noun in scenery and count >= LEAST_MARK * len(points)
        ),
        tuple(views),
        sights,
    )


def _look(
    scene: Scene,
    time_s: float,
    size: SensorSize,
    points: Float64Array,
    sights: Mapping[int, Sight],
) -> View:
    """Notes what is seen of each thing at an instant."""
    world, shapes = world_and_shapes(scene, time_s, size)
    depth, number = cast(world, points)
    number[np.isfinite(depth) & (depth > IN_FOG * scene.environment(time_s).fog_distance)] = NOTHING
    view = View(time_s, scene.camera(time_s), size, shapes, depth, number)
    owner = view.owner
    count = 1 + max(int(owner.max(initial=0)), max(sights, default=0))
    seen = np.bincount(owner[view.number[view.number >= 0]], minlength=count)
    alone = np.zeros(count, dtype=np.int64)
    count_unoccluded(world, owner, points, alone)
    places = _place_in_frame(view, count)
    for one, sight in sights.items():
        extent, inside = (float(value) for value in places[one])
        sight.glimpses.append(Glimpse(int(seen[one]), int(alone[one]), extent, inside))
    return view


def _count_marks(
    scene: Scene, view: View, points: Float64Array, scenery: Sequence[str]
) -> Counter[str]:
    """Points of all marks of places."""
    marks = Counter({SKY: int(np.isinf(view.depth).sum())})
    shapes, counts = np.unique(view.number[view.number >= 0], return_counts=True)
    owner = view.owner
    for shape, count in zip(shapes, counts, strict=True):
        marks[scene.class_names.get(int(owner[shape]), "")] += int(count)
        marks[scenery[shape] if shape < len(scenery) else ""] += int(count)
    is_ground = view.number == GROUND
    rays = ray_directions(view.camera, view.size, points[is_ground]) * view.depth[is_ground, None]
    spots = (view.camera.position + rays)[:, :2]
    mark, where = is_marked(scene.environment(view.time_s), spots)
    marks[mark] += int(where.sum())
    return marks


def _follow(before: View, after: View, sights: Mapping[int, Sight]) -> None:
    """Add the way of each thing's parts that are seen, for a camera that stays where it was.

    A mesh that deforms, a lamp and a surface that change are motion too.
    """
    either = np.concatenate([before.number, after.number])
    seen = np.unique(either[either >= 0])
    first, last = before.shapes, after.shapes
    owner = after.owner
    seen = seen[owner[seen] > 0]
    reach = np.concatenate([np.zeros((3, 1)), 0.7 * np.eye(3), -0.7 * np.eye(3)], axis=1)
    spots = [
        project(
            before.camera, before.size,
            (one.to_world[seen, :, :3] @ reach + one.to_world[seen, :, 3:]).transpose(0, 2, 1),
        )
        for one in (first, last)
    ]  # fmt: skip
    way = np.linalg.norm(spots[1][..., :2] - spots[0][..., :2], axis=2)
    is_ahead = (spots[0][..., 2] > 0.0) & (spots[1][..., 2] > 0.0) & np.isfinite(way)
    way = np.where(is_ahead, way, 0.0).max(axis=1)
    changes = (first.emission[seen] != last.emission[seen]) | np.any(
        first.colour[seen] != last.colour[seen], axis=1
    )
    if first.mesh is not None and last.mesh is not None:
        changes |= first.mesh[seen] != last.mesh[seen]
    way = np.where(changes, LEAST_MOTION_PX, way)
    furthest: dict[int, float] = {}
    for one, moved in zip(owner[seen], way, strict=True):
        furthest[int(one)] = max(furthest.get(int(one), 0.0), float(moved))
    for number, moved in furthest.items():
        if number in sights:
            sights[number].moved_px += moved


def _place_in_frame(view: View, count: int) -> Float64Array:
    """[count, 2] of each instance: its extent within the image, and which share lies there.

    From the boxes around its shapes, which count by the area of their silhouettes: the extent is a
    share of the image's width or height, the greater one.
    """
    shapes, owner, camera, size = view.shapes, view.owner, view.camera, view.size
    axes = np.asarray(camera.rotation)
    linear = axes @ shapes.to_world[:, :, :3]
    middle = (shapes.to_world[:, :, 3] - camera.position) @ axes.T
    is_ball = (shapes.shape == Shape.ELLIPSOID)[:, None]
    reach = np.where(is_ball, np.linalg.norm(linear, axis=2), np.abs(linear).sum(axis=2))
    reach[:, 2] = 0.0
    found = np.zeros((count, 2))
    known = (middle[:, 2] > 0.0) & (owner > 0)
    low, high = (place_in_image(camera, size, middle[known] + sign * reach[known])[:, :2]
                 for sign in (-1.0, 1.0))  # fmt: skip
    edge = np.array([size.width, size.height], dtype=np.float64)
    inner_low, inner_high = np.clip(low, 0.0, edge), np.clip(high, 0.0, edge)
    whole, inner = np.prod(high - low, axis=1), np.prod(inner_high - inner_low, axis=1)
    share = inner / np.maximum(whole, 1e-12)
    silhouette = _project_areas(linear[known], middle[known])
    one = owner[known]
    is_in = inner > 0.0
    first, last = np.full((count, 2), np.inf), np.full((count, 2), -np.inf)
    np.minimum.at(first, one[is_in], inner_low[is_in])
    np.maximum.at(last, one[is_in], inner_high[is_in])
    found[:, 0] = np.maximum((last - first) / edge, 0.0).max(axis=1)
    areas = np.bincount(one, silhouette, count)
    found[:, 1] = np.bincount(one, share * silhouette, count) / np.where(areas > 0.0, areas, 1.0)
    return found


def _project_areas(linear: Float64Array, middle: Float64Array) -> Float64Array:
    """[k] areas that boxes have in the image, about: a long string has next to none.

    Args:
        linear: [k, 3, 3] half axes of the boxes along the camera's axes, in columns, m.
        middle: [k, 3] their middles, m.
    """
    x, y = linear[:, 0] / middle[:, 2:], linear[:, 1] / middle[:, 2:]
    pairs = [(0, 1), (0, 2), (1, 2)]
    return np.asarray(sum(np.abs(x[:, a] * y[:, b] - x[:, b] * y[:, a]) for a, b in pairs))


def image_points(size: SensorSize) -> Float64Array:
    """Centres of pixels [k, 2] (x, y), evenly spread; rows are shifted, so that poles are met too.

    Example:
        >>> image_points(SensorSize(3, 2)).tolist()[:3], len(image_points(SensorSize(346, 260)))
        ([[0.5, 0.5], [1.5, 0.5], [2.5, 0.5]], 3599)
    """
    step = max(1, math.ceil(math.sqrt(size.width * size.height / MOST_POINTS)))
    rows = np.arange(step // 2, size.height, step)
    found = []
    for number, row in enumerate(rows):
        columns = np.arange((2 * number) % step, size.width, step)
        found.append(np.stack([columns, np.full(len(columns), row)], axis=1))
    return np.asarray(np.concatenate(found) + 0.5, dtype=np.float64)
