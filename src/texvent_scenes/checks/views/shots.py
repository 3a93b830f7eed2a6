"""Shot check: framing, viewpoint and moves that are said of the camera, over the clip."""

from __future__ import annotations

from collections.abc import Callable, Iterator, Mapping, Sequence
from functools import partial
from typing import NamedTuple

import numpy as np

from texvent.camera import PosedCamera, project
from texvent.sensor import SensorSize
from texvent_scenes.checks.clip.relations import Violation
from texvent_scenes.description import SceneDescription
from texvent_scenes.models.activities import PERSON_NOUNS
from texvent_scenes.models.shapes import bounds, moved
from texvent_scenes.rendered_scene import Float64Array
from texvent_scenes.staging.actors import Actor
from texvent_scenes.staging.camera.subject import choose_main, near_part
from texvent_scenes.staging.compose import ComposedScene

_CLOSE, _HALF, _MOST = 0.4, 0.5, 0.7
"""Share of the image's width or height that the part in a close shot extends over; shares of the
instants at which a shot is as it is said, and what is followed is in sight."""
_DOWN, _STEEP, _LEVEL = -0.25, -0.9, 0.05
"""Height of the direction of sight, a unit vector, of a view from the air, and from the top; most
of one downwards from a low angle."""
_STEPS, _CORE = 49, 0.4
"""Instants at which it is looked for what the camera goes through; half of the share of a part's
box, along each axis, that is surely inside that part."""
_TURNING = frozenset({"pan", "tilt", "roll", "zoom", "handheld", "shake"})
"""Moves of a camera that stays where it is."""
_TREMBLING = ("handheld", "shake")
_STILL, _SLIGHT = 1e-6, 0.02
"""Change of position, m, of direction, or of focal length, of a camera that stays; of moves other
than trembling, per metre to what it looks at, or of directions."""
_SAID = {"low": "low angle", "top": "view from the top", "aerial": "view from the air",
         "close": "close-up", "side": "view of its side", "front": "view of its front",
         "back": "view from behind"}  # fmt: skip


def find_misframed(
    scene: ComposedScene,
    description: SceneDescription,
    cameras: Sequence[PosedCamera],
    times: Sequence[float],
    size: SensorSize,
) -> Iterator[Violation]:
    """Words of the camera that its image does not show.

    Args:
        scene: the staged scene.
        description: the scene before it was staged.
        cameras: of the instants.
        times: instants, s.
        size: of the image, pixels.
    """
    shot = description.camera
    main = choose_main(description, scene.actors) if scene.actors else None
    if main is not None:
        yield from _find_wrong_size(main, shot.framing or "", cameras, times, size)
    rule = _VIEWS.get(shot.view or "")
    has_view = [rule is None or rule(*each, main) for each in zip(cameras, times, strict=True)]
    if np.mean(has_view) < _HALF:
        yield Violation("view", str(shot.view), _SAID[str(shot.view)])
    moves = [one for one in shot.moves if one.kind != "static"]
    if shot.view == "first person" and not any(one.kind == "travel" for one in moves):
        yield Violation("view", "first person", "first-person view: the camera goes nowhere")
    kinds = sorted({one.kind for one in moves})
    if "follow" in kinds and scene.actors:
        followed = _find_followed(scene, description)
        if not _keeps_inside(followed, cameras, times, size):
            line = f"follow of the camera: the {followed.name} leaves the image"
            yield Violation("move", "follow", line)
    reach_m = scene.camera_path.framing.distance_m
    met = _find_met(scene, times) if set(kinds) - _TURNING else ""
    for kind in kinds:
        if met and kind not in _TURNING:
            yield Violation("move", kind, f"{kind} of the camera: it goes through the {met}")
        elif all(_is_still(cameras[0], one, 0.0 if kind in _TREMBLING else reach_m)
                 for one in cameras):  # fmt: skip
            yield Violation("move", kind, f"{kind} of the camera: it stays where it is")


def _find_followed(scene: ComposedScene, description: SceneDescription) -> Actor:
    """The body that a camera follows: the one it looks at, else the main one."""
    target = description.index(description.camera.target)
    own = [one for one in scene.actors if one.object_index == target]
    return own[0] if own else choose_main(description, scene.actors)


def _keeps_inside(
    body: Actor, cameras: Sequence[PosedCamera], times: Sequence[float], size: SensorSize
) -> bool:
    """Whether the middle of a body is inside the image, at most instants."""
    points = np.array([project(camera, size, body.middle(time_s)[None])[0]
                       for camera, time_s in zip(cameras, times, strict=True)])  # fmt: skip
    x, y, depth = points.T
    inside = (depth > 0.0) & (x >= 0.0) & (x < size.width) & (y >= 0.0) & (y < size.height)
    return bool(np.mean(inside) >= _MOST)


def _shares(
    body: Actor, cameras: Sequence[PosedCamera], times: Sequence[float], size: SensorSize
) -> Float64Array:
    """[t, 2] Share of the image's width and height that the box of a body extends over."""
    boxes = [project(camera, size, body.corners(time_s))
             for camera, time_s in zip(cameras, times, strict=True)]  # fmt: skip
    return np.array([np.ptp(one[:, :2], axis=0) / [size.width, size.height]
                     if one[:, 2].min() > 0.0 else (1e3, 1e3) for one in boxes])  # fmt: skip


class _Framing(NamedTuple):
    """Shares of the image that a subject of a framing takes."""

    least: float
    """Least share of its height, of a person."""
    most: float
    """Most share of its width or height."""
    line: str

    def holds(
        self, body: Actor, cameras: Sequence[PosedCamera], times: Sequence[float],
        size: SensorSize,
    ) -> bool:  # fmt: skip
        """Whether a body takes such shares, at half of the instants at least."""
        shares = _shares(body, cameras, times, size)
        is_person = body.noun.name in PERSON_NOUNS
        is_so = shares.max(axis=1) <= self.most
        is_so |= not is_person and self.most > 1.0
        is_so &= (shares[:, 1] >= self.least) | (not is_person)
        return bool(np.mean(is_so) >= _HALF)


def _find_wrong_size(
    main: Actor, framing: str, cameras: Sequence[PosedCamera], times: Sequence[float],
    size: SensorSize,
) -> Iterator[Violation]:  # fmt: skip
    """A framing whose subject takes more or less of the image than it says."""
    framed, line = _FRAMINGS.get(framing), ""
    if framing == "close":
        held = near_part(main, "close", np.array(times))
        shares = [_extent(*each, size) for each in zip(held, cameras, strict=True)]
        if np.mean(np.array(shares) >= _CLOSE) < _HALF:
            line = f"{_SAID['close']} of the {main.name}: it is small in the image"
    elif framed is not None and not framed.holds(main, cameras, times, size):
        line = f"{framing} shot: the {main.name} is {framed.line}"
    if line:
        yield Violation("framing", framing, line)


_FRAMINGS = {
    "medium": _Framing(0.8, 4.0, "too far away or too near"),
    "full": _Framing(0.3, 1.1, "too far away, or cut off"),
    "wide": _Framing(0.0, 0.66, "large in the picture"),
}
"""Framing → what its subject takes of the image."""


def _find_met(scene: ComposedScene, times: Sequence[float]) -> str:
    """Noun of a body of which the camera is inside a part at some instant; "" = of none."""
    for at in np.linspace(times[0], times[-1], _STEPS):
        place = scene.camera(float(at)).position
        for one in scene.actors:
            corners = one.corners(float(at))
            if (corners.min(axis=0) < place).all() and (corners.max(axis=0) > place).all():
                shapes = one.place(float(at))
                boxes = [bounds([part]) for part in moved(shapes.parts, shapes.to_world)]
                if any((np.abs(place - 0.5 * (low + high)) < _CORE * (high - low)).all()
                       for low, high in boxes):  # fmt: skip
                    return one.noun.name
    return ""


def _extent(points: Float64Array, camera: PosedCamera, size: SensorSize) -> float:
    """Greater share of the image's width and height that points [n, 3] extend over, m."""
    x, y, depth = project(camera, size, points).T
    if depth.min() <= 0.0:  # so near that some of it is beside the camera
        return float(depth.max() > 0.0)
    return float(max(np.ptp(x) / size.width, np.ptp(y) / size.height))


def _is_still(one: PosedCamera, other: PosedCamera, reach_m: float) -> bool:
    """Whether the difference of two poses of a camera is not visible.

    `reach_m`: distance of what it looks at; 0: each difference is seen.
    """
    slight = _SLIGHT if reach_m else _STILL
    return all(
        float(np.abs(np.subtract(*pair)).max()) <= most
        for pair, most in (((one.position, other.position), max(_SLIGHT * reach_m, _STILL)),
                           ((one.rotation, other.rotation), slight),
                           ((one.focal, other.focal), slight))
    )  # fmt: skip


def _is_low(camera: PosedCamera, time_s: float, main: Actor | None) -> bool:
    """Whether it looks up, or is below the middle of the subject and looks level."""
    up = float(camera.rotation[2, 2])
    is_below = main is None or camera.position[2] <= main.middle(time_s)[2]
    return up > 0.0 or (is_below and up >= -_LEVEL)


def _sees_side(
    least: float, most: float, camera: PosedCamera, time_s: float, main: Actor | None
) -> bool:
    """Whether the cosine between a body's heading and the way to the camera is between two."""
    if main is None:
        return False
    yaw, away = main.track.at(time_s).yaw, (camera.position - main.middle(time_s))[:2]
    facing = np.array([np.cos(yaw), np.sin(yaw)]) @ away / max(float(np.linalg.norm(away)), 1e-9)
    return bool(least <= facing <= most)


_VIEWS: Mapping[str, Callable[[PosedCamera, float, Actor | None], bool]] = {
    "low": _is_low,
    "aerial": lambda camera, time_s, main: bool(camera.rotation[2, 2] <= _DOWN),
    "top": lambda camera, time_s, main: bool(camera.rotation[2, 2] <= _STEEP),
    "side": partial(_sees_side, -0.6, 0.6),
    "front": partial(_sees_side, 0.7, 1.1),
    "back": partial(_sees_side, -1.1, -0.7),
}
"""View → whether a camera has it at an instant."""
