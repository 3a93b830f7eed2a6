"""Check of a staged scene: objects out of view or tiny, and words that its picture does not show.

Rays through a coarse grid of image points find all large objects. For each other one every pixel
of its box in the image is looked at, so that the pixels of small things are counted exactly.
Effects, weather, flicker and spin must change the pixels of small pictures.
"""

from __future__ import annotations

import math
from collections import Counter
from collections.abc import Iterator, Sequence
from dataclasses import replace
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from texvent.scenes.defaults import NO_PLACE
from texvent.scenes.description import SceneDescription
from texvent.scenes.held import Unheld, bodies_of, find_unheld
from texvent.scenes.models.effects import LAMPS
from texvent.scenes.models.places import PLACES, Place
from texvent.scenes.raycast.acceleration import CUBE
from texvent.scenes.raycast.records import OwnedWorld, World
from texvent.scenes.raycast.render import render, world_and_shapes
from texvent.scenes.raycast.surface_motion import cast
from texvent.scenes.read.lexicon import lexicon_of, word_set
from texvent.scenes.scene import Camera, Float64Array, Ground, Primitives, Scene, Texture, project
from texvent.scenes.spec.data import PLACING
from texvent.scenes.staging.actors import assemble
from texvent.scenes.staging.compose import ComposedScene
from texvent.sensor import SensorSize

INSTANTS = 7
"""Instants of the clip at which it is looked for objects; what is in view at one of them is."""
MOST_POINTS = 2000
"""Points of a grid over the image, or over the box of an object."""
LEAST_PIXELS = 6
"""Pixels below which an object is too small to be told."""
LEAST_INSIDE = 0.33
"""Share of an object's extent that is inside the image; of less it is cut off."""
MOST_COUNTED = 6
"""Copies of an object that are counted one by one; of more, some may hide each other."""
_SMALL = SensorSize(120, 90)
"""Size of small pictures."""
_LEAST_LEVELS, _LEAST_SHARE, _LEAST_SCENERY = 6.0, 0.002, 0.02
"""Difference of a pixel, of 255, that is seen; share of the pixels in which it is; of scenery."""
_LEAST_CLIP_S = 1.0
"""Length of a clip, s, in which motions get so far that they are judged."""
_Shots = Sequence[tuple[Primitives, Camera]]
_Box = tuple[Float64Array, Float64Array]
_WATER = (Ground.SEA, Ground.LAKE, Ground.RIVER)
_FLOORS = (Texture.CONCRETE, Texture.PAVING, Texture.ASPHALT)
"""Grounds that many places have: only their scenery shows which one it is."""
_OUTDOORS = ("sunny", "overcast", "dusk", "dawn", "moonlight")
_TURNS = ("spin", "work", "rotate")


class Unseen(NamedTuple):
    """Words of a scene that a clip does not show."""

    out_of_view: tuple[str, ...]
    """Such as "tree", or "dog (2 of 3)"."""
    too_small: tuple[str, ...]
    """Such as "bird (2 pixels)"."""
    unheld: tuple[Unheld, ...] = ()
    """Relations, directions, weather, effects and light."""


def find_unseen(
    scene: ComposedScene, description: SceneDescription, size: SensorSize, duration_s: float
) -> Unseen:
    """Words of a description that no instant shows.

    An object without a body of its own is part of another one's, as a worn coat is, unless it was
    to stand around others.
    """
    object_of = scene.object_of
    pixels = count_pixels(scene, list(object_of), size, duration_s)
    times = np.linspace(0.0, duration_s, INSTANTS)
    shots = [(scene.primitives(float(time_s)), scene.camera(float(time_s))) for time_s in times]
    around = {i for one in description.relations if one.kind == "surround" for i in one.targets}
    related = {i for one in description.relations for i in one.targets}
    outside: list[str] = []
    small: list[str] = []
    for index, thing in enumerate(description.objects):
        ids = [one for one, owner in object_of.items() if owner == index]
        copies = [pixels[one] for one in ids]
        most, lost = max(copies, default=0), copies.count(0)
        if not copies and index not in around:
            continue
        least = math.inf if index not in related else 0.1 * size.width * size.height
        if most == 0:
            outside.append(thing.noun)
        elif most < LEAST_PIXELS:
            small.append(f"{thing.noun} ({most} pixel{'s' if most > 1 else ''})")
        elif lost and len(copies) <= max(2 * lost, 0 if index in around else MOST_COUNTED):
            outside.append(f"{thing.noun} ({lost} of {len(copies)})")
        elif most < least and max(_share_inside(shots, size, one) for one in ids) < LEAST_INSIDE:
            outside.append(f"{thing.noun} (cut off)")
    bodies = bodies_of(shots, [one for one, count in pixels.items() if count])
    unheld = [one for one in find_unheld(description, bodies, object_of)
              if duration_s >= _LEAST_CLIP_S or one.value in PLACING]  # fmt: skip
    unheld += _unlit(scene, description, duration_s)
    lines = (one.partition(" (") for one in (*outside, *small) if " of " not in one)
    unheld += [Unheld("noun", noun, "") for noun, *_ in lines]
    return Unseen(
        tuple(dict.fromkeys(outside)), tuple(dict.fromkeys(small)), tuple(dict.fromkeys(unheld))
    )


def without_words(words: Sequence[str], faults: Sequence[Unheld]) -> tuple[str, ...]:
    """Words of a report, but for those that mean what a picture does not show."""
    lost = {(kind, value) for kind, value, _ in faults}
    return tuple(word for word in words if not lost.intersection(_meanings(word)))


def _meanings(word: str) -> Iterator[tuple[str, str | None]]:
    """Kinds and values, as of `Unheld`, of all senses of a word."""
    phrase = tuple(one for one in word.split() if one not in word_set("senses", "articles"))
    for sense in lexicon_of(None).get(phrase, ()):
        if sense.kind == "verb":
            one = sense.value
            yield from (("relation", one.relation), ("direction", one.direction))
            yield from (("motion", one.kind), ("effect", one.kind))
        elif sense.kind == "noun":
            yield "noun", sense.value.noun
        elif sense.kind in ("adverb", "scene", "field"):
            *_, field, value = sense.value
            yield from ((field, ""), (field if field != "kind" else "light", value))
        else:
            yield sense.kind, sense.value


def _unlit(
    scene: ComposedScene, description: SceneDescription, duration_s: float
) -> Iterator[Unheld]:
    """Weather, light, effects and spin that leave no trace in the picture."""
    said, light = description.surroundings, description.light.kind
    place = PLACES[said.name or "grass"]
    if place.is_room and light in _OUTDOORS:
        yield Unheld("light", light, f"{light} light, in a room")
    if said.wave_height > 1.0 and place.ground not in _WATER:
        yield Unheld("wave_height", "", "waves, without water")
    if said.has_snow and place.is_room:
        yield Unheld("has_snow", "", "snow, in a room")
    times = [share * duration_s for share in (0.17, 0.43, 0.71, 0.93)]
    yield from _unplaced(scene, description, times)
    if said.clouds:
        sky = scene.animated_environment
        clear = replace(sky, base=replace(sky.base, clouds=0.0))
        if not _differs(scene, replace(scene, animated_environment=clear), times):
            yield Unheld("clouds", "", "clouds: no sky is in view")
    staged = scene.particles
    for kind in dict.fromkeys((said.weather, *(one.kind for one in description.effects))):
        pairs = zip(staged.effects, staged.kinds, strict=True)
        rest = tuple(effect for effect, own in pairs if own != kind)
        without = replace(scene, particles=replace(staged, effects=rest, ends_s={}))
        if len(rest) < len(staged.effects) and not _differs(scene, without, times):
            name = "weather" if kind == said.weather else "effect"
            yield Unheld(name, kind or "", f"{kind}, which no pixel shows")
    turning = [one for one in description.objects
               if one.motion and one.motion.kind in _TURNS and not one.then]  # fmt: skip
    if turning and not description.shot.is_moving and not _differs(scene, scene, times, 0.13):
        line = f"the {turning[0].noun}'s turning: it looks the same from all sides"
        yield Unheld("motion", turning[0].motion.kind if turning[0].motion else "", line)


def _unplaced(
    scene: ComposedScene, description: SceneDescription, times: Sequence[float]
) -> Iterator[Unheld]:
    """A place whose scenery is not in view, and what no picture of it can have."""
    said = description.surroundings
    place = PLACES[said.name or "grass"]
    if description.is_timelapse and place.is_room:
        yield Unheld("is_timelapse", "", "time lapse, in a room")
    for noun in (one.noun for one in description.objects if one.is_lit and one.noun not in LAMPS):
        yield Unheld("is_lit", "", f"lights of the {noun}")
    is_said = not any(one.startswith(NO_PLACE) for one in description.notes)
    is_shared = place.is_room or place.surface in _FLOORS or _is_common(place)
    if is_said and is_shared and place.scenery and not said.is_empty:
        bare = replace(scene, still=assemble([]))
        if not _differs(scene, bare, times, least=_LEAST_SCENERY):
            line = f"{said.name}, of which only the ground is in view"
            yield Unheld("place", said.name or "", line)


def _is_common(place: Place) -> bool:
    """Whether a place before it in the table has the same ground."""
    same = (one for one in PLACES.values() if one.ground is place.ground)
    return next(one for one in same if one.surface is place.surface) is not place


def _share_inside(shots: _Shots, size: SensorSize, instance: int) -> float:
    """Most that the image holds of an object at one instant: share of its box in the image."""
    most = 0.0
    for shapes, camera in shots:
        if (box := _box(camera, size, shapes, instance)) is not None:
            (low, high), inside = box, np.diff(np.clip(box, 0.0, [size.width, size.height]), axis=0)
            most = max(most, float(np.prod(inside / np.maximum(high - low, 1e-9))))
    return most


def _differs(
    scene: Scene, other: Scene, times: Sequence[float], later_s: float = 0.0,
    least: float = _LEAST_SHARE,
) -> bool:  # fmt: skip
    """Whether enough pixels of small pictures are others at one of the instants."""
    for time_s in times:
        first, second = (render(one, at_s, _SMALL, samples=1, shadows=False)
                         for one, at_s in ((scene, time_s), (other, time_s + later_s)))  # fmt: skip
        change = np.abs(first - second).max(axis=-1)
        if np.mean(change >= _LEAST_LEVELS) >= least:
            return True
    return False


def count_pixels(
    scene: Scene, instances: list[int], size: SensorSize, duration_s: float
) -> dict[int, int]:
    """Instance id → its pixels at the instant that shows most of it; of large ones about."""
    most = dict.fromkeys(instances, 0)
    whole = (np.zeros(2), np.array([size.width, size.height], dtype=np.float64))
    everywhere, share = _grid(*whole)
    for time_s in np.linspace(0.0, duration_s, INSTANTS):
        world, shapes = world_and_shapes(scene, float(time_s), size, shadows=False)
        camera = scene.camera(float(time_s))
        owner = np.append(shapes.instance.astype(np.int64), 0)
        seen = _count(world, owner, everywhere)
        for one in instances:
            most[one] = max(most[one], round(share * seen[one]))
            box = _box(camera, size, shapes, one) if most[one] < LEAST_PIXELS * share else None
            low, high = np.clip(box or (whole[0], whole[0]), *whole)
            if np.all(high > low):
                points, each = _grid(np.floor(low), np.ceil(high))
                most[one] = max(most[one], round(each * _count(world, owner, points)[one]))
    return most


def _count(
    world: World | OwnedWorld, owner: NDArray[np.int64], points: Float64Array
) -> Counter[int]:
    """Points that show each instance."""
    _, number = cast(world, points)
    return Counter(owner[np.where(number >= 0, number, -1)].tolist())


def _grid(low: Float64Array, high: Float64Array) -> tuple[Float64Array, float]:
    """Centres of pixels [k, 2] of a box, at most about `MOST_POINTS`; and pixels for each."""
    step = max(1, math.ceil(math.sqrt(float(np.prod(high - low)) / MOST_POINTS)))
    x, y = (np.arange(low[axis] + step // 2, high[axis], step) + 0.5 for axis in (0, 1))
    return np.stack(np.meshgrid(x, y), axis=-1).reshape(-1, 2), float(step * step)


def _box(camera: Camera, size: SensorSize, shapes: Primitives, instance: int) -> _Box | None:
    """Low and high corner [2] of an instance, pixels; of one around the camera the whole image.

    None where it is behind the camera.
    """
    to_world = shapes.to_world[shapes.instance == instance].astype(np.float64)
    corners = CUBE @ to_world[:, :, :3].transpose(0, 2, 1) + to_world[:, None, :, 3]
    seen = project(camera, size, corners.reshape(-1, 3))
    if not np.any(seen[:, 2] > 0.0):
        return None
    if (seen[:, 2] > 0.0).all() and np.isfinite(seen).all():
        return seen[:, :2].min(axis=0), seen[:, :2].max(axis=0)
    return np.zeros(2), np.array([size.width, size.height], dtype=np.float64)
