"""Place check: ground and far scenery that are said, and that the image has no room for."""

from __future__ import annotations

from collections.abc import Iterator, Sequence

import numpy as np

from texvent.camera import PosedCamera, project
from texvent.sensor import SensorSize
from texvent_scenes.checks.clip.body_boxes import is_any_inside
from texvent_scenes.checks.clip.relations import Violation
from texvent_scenes.checks.surroundings.water import wet_share
from texvent_scenes.description import SceneDescription, label_of
from texvent_scenes.models.places import PLACES, SEEN_FROM_AFAR
from texvent_scenes.models.tables import nouns_with
from texvent_scenes.raycast.ground_truth import visible_instances
from texvent_scenes.rendered_scene import Float64Array, Ground, Texture
from texvent_scenes.spec.scene import Place
from texvent_scenes.staging.actors import Actor
from texvent_scenes.staging.compose import ComposedScene

_SIZE, _FAR_M = SensorSize(40, 30), 1e4
"""Size of a coarse image; distance of a point of the horizon, m."""
_LEAST_SKY = 0.02
"""Least share of an image in which the sky is seen."""
_LEVEL_M, _WAVES_M, _ROUNDING, _LEAST_SHARE, _LEAST_SHORE = 0.05, 0.4, 1e-3, 0.005, 0.03
"""Height up to which a point is of the ground, and of ground with waves, m, and more per metre of
distance; least shares of an image that the ground takes, and the land or water of a shore."""
_REACH_M, _SIDES = 5.0, ((0, 0, 0), (1, 0, 0), (0, 1, 0), (-1, 0, 0), (0, -1, 0))
"""Reach of a crossing or a roundabout, m, of which most must be seen, and the sides of it."""
_MOST_FAR = 0.4
"""Share of the image's height up to which something may be in the distance."""


_LEAST_BACKDROP = 0.004
"""Least share of an image that a backdrop takes."""
_FINE_SIZE, _POINTS, _AROUND = SensorSize(160, 120), 15, 0.25
"""Image and points to a side at which it is looked around a body, and how far around it, in its
extents in the image."""
_LEAST_AROUND, _MOSTLY_SKY = 0.4, 0.8
"""Least share of these points in the image; share of them that are sky, and of the instants."""
_CLEAR_M, MOST_FOG = 150.0, 1.7
"""Least distance of sight in which the horizon is seen, m; distance, in those of sight, up to which
fog leaves something of a body or a ground."""
_CLEAR = 0.5
"""Distance, in those of sight, up to which haze leaves the colour of water."""
_WIDE = 2.0
"""Width of a corridor, as a multiple of the usual one, from which on it looks like a room."""


def find_unseen_place(
    scene: ComposedScene,
    said: Place,
    *,
    is_bare: bool,
    times: Sequence[float],
    names_sky: bool = False,
) -> Iterator[Violation]:
    """Scenery at the horizon while that is above the image, and a place of which nothing is seen.

    Args:
        scene: the staged scene.
        said: what is said of its place.
        is_bare: whether the place is said, and its scenery takes no room in the image.
        times: instants, s.
        names_sky: whether the sky is named.
    """
    cameras = [scene.camera(time_s) for time_s in times]
    is_veiled = all(scene.environment(time_s).fog_distance < _CLEAR_M for time_s in times)
    yield from _find_far(scene, said, cameras, is_veiled=is_veiled)
    crossings = scene.animated_environment.base.road_crossings
    areas = [np.array([x, y, 0.0]) + _REACH_M * np.array(_SIDES) for x, y, *_ in crossings]
    if said.road and not any(_is_mostly_inside(each, one) for each in areas for one in cameras):
        yield Violation("road", "", f"the {said.road}: it is out of view")
    wide_m = scene.camera_path.corridor_m
    if wide_m is not None and wide_m > _WIDE * scene.place.corridor_m:
        yield Violation("place", str(said.name), f"the {said.name}: it is as wide as a room")
    instants = [*zip(times, cameras, strict=True)]
    is_open = not (scene.place.is_room or scene.place.is_backdrop) and (said.clouds or names_sky)
    if is_open and not shows_sky(scene, times):
        if said.clouds:
            yield Violation("clouds", "", "clouds: the sky is out of view")
        yield Violation("place", "sky", "" if said.clouds else "the sky: it is out of view")
    for one in scene.actors if scene.place.ground is not Ground.NONE else ():
        tops = [one.corners(time_s)[:, 2].max() for time_s in times]
        is_below = all(top < camera.position[2] for top, camera in zip(tops, cameras, strict=True))
        if is_below and one.noun.name in nouns_with("of the sky"):
            yield Violation("noun", one.noun.name, f"the {one.name}: it is below the horizon")
    is_shore = scene.place.has_shore and bool(said.name)
    is_water = _has_water_name(scene)
    if is_shore and not any(_has_shore(scene, *one, is_water=is_water) for one in instants):
        kind = "water" if is_water else "land"
        yield Violation("place", str(said.name), f"the {said.name}: its {kind} is out of view")
        yield from [Violation("place", "sea", "")] * (kind == "water")  # whatever it is called
    has_ground = scene.place.ground not in (Ground.NONE, Ground.UNDERWATER, Ground.FLOOR)
    has_ground &= is_bare and bool(said.name) and not scene.place.is_backdrop
    if has_ground and not any(_share_of_ground(scene, *one) >= _LEAST_SHARE for one in instants):
        yield Violation("place", str(said.name), f"the {said.name}: its ground is out of view")


def _shows_backdrop(scene: ComposedScene, name: str, cameras: Sequence[PosedCamera]) -> bool:
    """Whether enough of what tells a backdrop is in the image."""
    rules = PLACES[SEEN_FROM_AFAR.get(name, name)].scenery
    nouns = {one.noun for one in rules if one.where == "far"} or {one.noun for one in rules}
    own = [one for one in scene.scenery if one.rule.noun in nouns]
    return any(sum(one.share_of(camera) for one in own) >= _LEAST_BACKDROP for camera in cameras)


def is_before_sky(scene: ComposedScene, one: Actor, times: Sequence[float]) -> bool:
    """Whether most that is seen around a body is sky, at most of the instants that show it."""
    found = []
    for time_s in times:
        seen = project(scene.camera(time_s), _FINE_SIZE, one.corners(time_s))
        (left, top), (right, low) = seen[:, :2].min(axis=0), seen[:, :2].max(axis=0)
        is_aloft = one.noun.habitat == "air"
        low = low if is_aloft else 0.5 * (top + low)  # its foot is on the ground
        room = _AROUND * max(right - left, low - top)
        x, y = np.meshgrid(np.linspace(left - room, right + room, _POINTS),
                           np.linspace(top - room, low + room * is_aloft, _POINTS))  # fmt: skip
        points = np.stack([x, y], axis=-1).reshape(-1, 2)
        is_inside = ((points >= 0.0) & (points <= [_FINE_SIZE.width, _FINE_SIZE.height])).all(
            axis=1
        )
        if seen[:, 2].min() <= 0.0 or is_inside.mean() < _LEAST_AROUND:
            continue
        depth, instance = visible_instances(scene, time_s, _FINE_SIZE, points[is_inside])
        others = depth[instance != one.instance]
        found.append(bool(len(others)) and float(np.isinf(others).mean()) >= _MOSTLY_SKY)
    return bool(found) and sum(found) >= _MOSTLY_SKY * len(found)


def _find_far(
    scene: ComposedScene, said: Place, cameras: Sequence[PosedCamera], *, is_veiled: bool
) -> Iterator[Violation]:
    """Backdrops, and a place that is all far off, as mountains are, of which nothing is seen."""
    is_lost = is_veiled or not any(map(has_horizon, cameras))
    for one in said.backdrops:
        if is_lost or not _shows_backdrop(scene, one, cameras):
            yield Violation("backdrops", "", f"the {one} in the distance")
            yield Violation("place", one, "")
    far = [one.noun for one in scene.place.scenery if one.where == "far"]
    if is_veiled and said.name in far:
        yield Violation("place", str(said.name), f"the {said.name}: fog hides it")


def _is_mostly_inside(points: Float64Array, camera: PosedCamera) -> bool:
    """Whether most of some points, [n, 3] m, are in the image."""
    return sum(is_any_inside(one[None], camera, _SIZE) for one in points) > 0.5 * len(points)


def find_near(
    scene: ComposedScene, description: SceneDescription, cameras: Sequence[PosedCamera],
    times: Sequence[float],
) -> Iterator[Violation]:  # fmt: skip
    """Things that are said to be in the distance, and are large in the image all the time."""
    for index, said in enumerate(description.objects):
        own = [one for one in scene.actors if one.object_index == index]
        is_tall = said.noun in nouns_with("out of clouds")
        if own and said.placement == "far" and not is_tall and not any(
            _share_of_image(one.corners(time_s), camera) <= _MOST_FAR
            for one in own for time_s, camera in zip(times, cameras, strict=True)
        ):  # fmt: skip
            line = f"the {label_of(description, index)} in the distance: it is near"
            yield Violation("placement", "far", line)


def list_own_walls(scene: ComposedScene, description: SceneDescription) -> Iterator[str]:
    """Notes of windows and doors that stand in a room or the open, in a wall of their own."""
    where = "room" if scene.place.is_room else "open"
    bodied = {one.object_index for one in scene.actors}
    for index, said in enumerate(description.objects):
        if index in bodied and said.noun in nouns_with("in a wall of its own"):
            yield f"the {said.noun} stands in the {where}, in a piece of wall of its own"


def list_dry(
    scene: ComposedScene, description: SceneDescription, times: Sequence[float]
) -> Iterator[str]:
    """Notes of beaches of which only the sand is seen, as of a desert, or water in haze."""
    name = description.place.name
    if not (scene.place.has_shore and name) or _has_water_name(scene):
        return
    instants = ((one, scene.camera(one)) for one in times)
    if not any(_has_shore(scene, *one, is_water=True, most_fog=_CLEAR) for one in instants):
        yield f"the water of the {name} cannot be made out"


def _share_of_image(corners: Float64Array, camera: PosedCamera) -> float:
    """Share of the image's height that a box takes, 1 where some of it is behind the camera."""
    y, depth = project(camera, _SIZE, corners)[:, 1:].T
    return float(np.ptp(y)) / _SIZE.height if depth.min() > 0.0 else 1.0


def has_horizon(camera: PosedCamera) -> bool:
    """Whether the horizon is not above the image."""
    ahead = camera.rotation[2] * [1.0, 1.0, 0.0]
    far = camera.position + _FAR_M * ahead / max(float(np.linalg.norm(ahead)), 1e-6)
    return bool(project(camera, _SIZE, far[None])[0, 1] > 0.0)


def _has_water_name(scene: ComposedScene) -> bool:
    """Whether a place with a shore is named after its water, not after its land as a beach is."""
    return scene.place.surface is not Texture.SAND


def _has_shore(
    scene: ComposedScene, time_s: float, camera: PosedCamera, *,
    is_water: bool, most_fog: float = MOST_FOG,
) -> bool:  # fmt: skip
    """Whether enough points of an image are of the water of a place, or of its land."""
    ground_m, share = _find_ground(scene, time_s, camera, most_fog=most_fog)
    wet = wet_share(scene, ground_m) if len(ground_m) else 0.0
    own = wet if is_water else 1.0 - wet
    return own * share >= _LEAST_SHORE


def shows_sky(scene: ComposedScene, times: Sequence[float]) -> bool:
    """Whether nothing stands before enough of the image at one of some instants."""
    return any(share_of_sky(scene, one, scene.camera(one)) >= _LEAST_SKY for one in times)


def shows_sun(scene: ComposedScene, times: Sequence[float], size: SensorSize) -> bool:
    """Whether nothing stands before the sun's disc in the image at one of some instants."""
    for time_s in times:
        camera = scene.camera(time_s)
        sun = camera.position + _FAR_M * np.asarray(scene.environment(time_s).sun_direction)
        (point,) = project(camera, size, sun[None])
        is_ahead = point[2] > 0.0 and (point[:2] > 0.0).all()
        if is_ahead and (point[:2] < [size.width, size.height]).all():
            depth, _ = visible_instances(scene, time_s, size, point[None, :2])
            if np.isinf(depth).all():
                return True
    return False


def share_of_sky(scene: ComposedScene, time_s: float, camera: PosedCamera) -> float:
    """Share of an image that nothing stands before."""
    x, y = np.meshgrid(np.arange(_SIZE.width) + 0.5, np.arange(_SIZE.height) + 0.5)
    depth, _ = visible_instances(scene, time_s, _SIZE, np.stack([x, y], axis=-1).reshape(-1, 2))
    return float(np.mean(~np.isfinite(depth)))


def _share_of_ground(scene: ComposedScene, time_s: float, camera: PosedCamera) -> float:
    """Share of an image that shows the ground."""
    return _find_ground(scene, time_s, camera)[1]


def share_of_walls(scene: ComposedScene, time_s: float) -> float:
    """Share of an image that shows neither a body nor the floor: of an empty room, its walls."""
    x, y = np.meshgrid(np.arange(_SIZE.width) + 0.5, np.arange(_SIZE.height) + 0.5)
    _, instance = visible_instances(scene, time_s, _SIZE, np.stack([x, y], axis=-1).reshape(-1, 2))
    camera = scene.camera(time_s)
    return float(np.mean(instance == 0)) - _share_of_ground(scene, time_s, camera)


def _find_ground(
    scene: ComposedScene, time_s: float, camera: PosedCamera, *, most_fog: float = MOST_FOG
) -> tuple[Float64Array, float]:
    """Points of the ground, [n, 2] m, that the points of a coarse image show, and their share."""
    x, y = np.meshgrid(np.arange(_SIZE.width) + 0.5, np.arange(_SIZE.height) + 0.5)
    points = np.stack([x, y], axis=-1).reshape(-1, 2)
    depth, instance = visible_instances(scene, time_s, _SIZE, points)
    middle = 0.5 * np.array([_SIZE.width, _SIZE.height])
    tangents = (points - middle) / (camera.focal * _SIZE.width)
    rays = np.column_stack([tangents, np.ones(len(points))]) @ camera.rotation
    depth = np.where(np.isfinite(depth), depth, np.nan)
    places = camera.position + depth[:, None] * rays
    room_m = (_WAVES_M if scene.place.has_shore else _LEVEL_M) + _ROUNDING * np.nan_to_num(depth)
    with np.errstate(invalid="ignore"):
        is_ground = (np.abs(places[:, 2]) <= room_m) & (instance == 0)
        is_ground &= depth <= most_fog * scene.environment(time_s).fog_distance
    return places[is_ground, :2], float(is_ground.mean())
