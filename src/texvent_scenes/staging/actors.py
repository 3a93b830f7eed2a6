"""Actors: models on tracks; and parts of placed models as the renderer's arrays of shapes."""

from __future__ import annotations

import math
import zlib
from collections.abc import Iterable, Sequence
from dataclasses import dataclass, field, fields
from functools import cached_property
from typing import Any

import numpy as np
from numpy.typing import NDArray

from texvent_scenes.models.activities import TIMED
from texvent_scenes.models.anchors import has_places, locate
from texvent_scenes.models.gait import TROT_FROUDE
from texvent_scenes.models.nouns import AFLOAT
from texvent_scenes.models.people.outfit import Prop
from texvent_scenes.models.protocol import Model, ModelPart, Noun, Pose
from texvent_scenes.models.shapes import bounds, compose, moved
from texvent_scenes.models.tables import nouns_with
from texvent_scenes.rendered_scene import Float64Array, Primitives
from texvent_scenes.staging.tracks.keys import GRAVITY_M_S2
from texvent_scenes.staging.tracks.track import Track

_CORNERS = np.array([[x, y, z] for x in (-1, 1) for y in (-1, 1) for z in (-1, 1)])
"""Corners of a box two units wide."""
_LOW = frozenset({"lie"})
"""Activities in which an animal is much lower than it stands."""

_FURNITURE_M = 1.0
"""Height to which the box of what hangs from a ceiling reaches down: the room is seen below it."""


def seeded(seed: int, *role: object) -> np.random.Generator:
    """A random generator for every role, so that no draw depends on the order of others."""
    words = "/".join(str(part) for part in role)
    return np.random.default_rng([seed, zlib.crc32(words.encode())])


def is_centred(noun: Noun) -> bool:
    """Whether its models have their origin at their middle: what flies or dives, not boats."""
    return noun.habitat in ("air", "water") and noun.name not in AFLOAT


def size_of(model: Model) -> float:
    """Scale of a model: 1 = the usual size."""
    return float(getattr(model, "scale", 1.0))


@dataclass(frozen=True)
class PlacedModel:
    """Parts of one object with the pose of its body in the world."""

    parts: Sequence[ModelPart]
    to_world: Float64Array
    """[3, 4] body → world."""
    instance: int
    """Ground-truth id; 0 = scenery."""


CHANGE_S = 0.35
"""Duration of a body's transition from one activity to the next, s."""
_HIPS = 0.6
"""Height of the hips of a four-footed animal, as a share of its own with the head."""
_HALVINGS = 24
_GONE = 1e-4
"""Size of what is broken, as a share of its own: the caster leaves it out."""


def lowest_point(model: Model) -> float:
    """Height of its lowest point above its origin when it stands, m."""
    parts = model.parts(Pose(0.0, 0.0, 0.0, "stand"))
    return float(bounds(parts)[0][2])


@dataclass(frozen=True)
class Actor:
    """One copy of an object of the prompt."""

    object_index: int
    """Index into `SceneDescription.objects`."""
    noun: Noun
    model: Model
    track: Track
    is_mover: bool
    instance: int
    """Ground-truth id, from 1."""
    lead_m: float = 0.0
    """Head start of its gait, m, so that a herd does not walk in step."""
    props: tuple[Prop, ...] = ()
    """Props of a person's activity, such as a guitar."""
    label: str = ""
    """Name in lines, if that is not its noun."""
    goes_across: bool = False
    """Whether it crosses the road."""
    haste: float = 1.0
    """Speed at which it runs up to a collision, as a multiple of its usual one."""
    breaks_s: float | None = None
    """Instant from which on only pieces of it are left, s."""
    pieces_pace: float = 1.0
    """Rate at which these fly, as a multiple of the real one: slow motion."""
    _corners: dict[float, Float64Array] = field(
        default_factory=dict, init=False, repr=False, compare=False
    )
    """Corners at instants that were asked for: framing asks for the same ones six times."""

    @property
    def name(self) -> str:
        """Name in lines: its noun, or also its id among several of the noun."""
        return self.label or self.noun.name

    @property
    def mean_size_m(self) -> float:
        """Side of a cube as large as its box, m."""
        return float(np.cbrt(self.model.length * self.model.width * self.model.height))

    @property
    def size_m(self) -> float:
        """Its largest extent, m."""
        return max(self.model.length, self.model.width, self.model.height)

    @property
    def is_centred(self) -> bool:
        """Whether its origin is at its middle, not on the ground below."""
        return is_centred(self.noun)

    @property
    def lift_m(self) -> float:
        """Height of its middle above its origin, m."""
        return 0.0 if self.is_centred else 0.5 * self.model.height

    @property
    def foot_m(self) -> float:
        """Height of its origin above its lowest point, m."""
        return 0.5 * self.model.height if self.is_centred else 0.0

    @cached_property
    def _is_trotting(self) -> bool:
        """Whether what it runs at most is a trot, if it has one; the same for the whole clip."""
        most_m_s = max((abs(one.speed_m_s) for one in self.track.keys if one.activity == "run"),
                       default=0.0)  # fmt: skip
        return most_m_s**2 <= TROT_FROUDE * GRAVITY_M_S2 * _HIPS * self.model.height

    @cached_property
    def _has_limbs(self) -> bool:
        return has_places(self.model)

    def own_parts(self, pose: Pose) -> list[ModelPart]:
        """Parts of its model and of what its activity needs, body coordinates."""
        parts = [*self.model.parts(pose)]
        for prop in self.props:
            parts += moved(prop.draw(pose.time_s), locate(self.model, prop.anchor, pose))
        return parts

    def place(self, time_s: float) -> PlacedModel:
        """All that is drawn of it in the world at that instant."""
        to_world = self.track.at(time_s).to_world()
        if self.breaks_s is not None and time_s >= self.breaks_s:
            to_world = compose(to_world, np.diag([_GONE, _GONE, _GONE, 1.0])[:3])
        return PlacedModel(self.own_parts(self.pose(time_s)), to_world, self.instance)

    def pose(self, time_s: float) -> Pose:
        """State of its limbs at that instant."""
        state = self.track.at(time_s)
        is_timed = state.activity in TIMED
        activity = "trot" if state.activity == "run" and self._is_trotting else state.activity
        return Pose(
            state.tempo * time_s + state.run_s + 0.37 * self.lead_m,
            state.distance_m + self.lead_m,
            state.speed_m_s,
            activity,
            *self._change_over(time_s, state.activity),
            act_s=state.tempo * state.act_s if is_timed and state.act_s else state.act_s,
            grips=state.grips,
        )

    def _change_over(self, time_s: float, activity: str) -> tuple[str | None, float]:
        """Previous activity of a body with limbs, and its progress to the next."""
        if not self._has_limbs:
            return None, 1.0
        earlier, later = time_s - CHANGE_S, time_s
        before = self.track.at(earlier).activity
        if before == activity:
            return None, 1.0
        for _ in range(_HALVINGS):
            middle = 0.5 * (earlier + later)
            if self.track.at(middle).activity == activity:
                later = middle
            else:
                earlier = middle
        share = (time_s - later) / CHANGE_S
        return before, share * share * (3.0 - 2.0 * share)

    def anchor(self, name: str, time_s: float) -> Float64Array:
        """[3, 4] axes at a named place of it, in the world: see `anchors.locate`."""
        return compose(
            self.track.at(time_s).to_world(), locate(self.model, name, self.pose(time_s))
        )

    def middle(self, time_s: float) -> Float64Array:
        """[3] world position of its middle, m."""
        to_world = self.track.at(time_s).to_world()
        return np.asarray(to_world @ np.array([0.0, 0.0, self.lift_m, 1.0]))

    def corners(self, time_s: float) -> Float64Array:
        """[8, 3] corners of its box in the world, m."""
        time_s = float(time_s)
        if time_s not in self._corners:
            low, high = self._box(time_s)
            middle, half = 0.5 * (low + high), 0.5 * (high - low)
            to_world = self.track.at(time_s).to_world()
            corners = (middle + _CORNERS * half) @ to_world[:, :3].T + to_world[:, 3]
            corners.setflags(write=False)
            self._corners[time_s] = corners
        return self._corners[time_s]

    def lowest_m(self, time_s: float) -> float:
        """Height of its lowest point in the world, m."""
        placed = self.place(time_s)
        return float(bounds(moved(placed.parts, placed.to_world))[0][2])

    def _box(self, time_s: float) -> tuple[Float64Array, Float64Array]:
        """Least and greatest body coordinates: of a body with limbs, or low, at that instant."""
        pose = self.pose(time_s)
        if self._has_limbs or pose.activity in self.noun.acts | _LOW:
            return bounds(self.own_parts(pose))
        half = 0.5 * np.array([self.model.length, self.model.width, self.model.height])
        lift = np.array([0.0, 0.0, self.lift_m])
        return np.maximum(lift - half, [-math.inf, -math.inf, self._hung_m]), lift + half

    @cached_property
    def _hung_m(self) -> float:
        """Least height of the box of what hangs from a ceiling, m; minus infinity of all else."""
        hangs = self.noun.name in nouns_with("hangs from a ceiling")
        return min(_FURNITURE_M, lowest_point(self.model)) if hangs else -math.inf


def corners_over(actors: Iterable[Actor], times: Iterable[float]) -> Float64Array:
    """[n, 3] corners of their boxes at these instants, m."""
    instants = [float(time) for time in times]
    return np.vstack([one.corners(time) for one in actors for time in instants])


def assemble(placed: Sequence[PlacedModel]) -> Primitives:
    """All parts as one structure of arrays, in the order given.

    Args:
        placed: objects with their parts.

    Returns:
        n primitives, where n is the total number of parts; `to_world` is body-to-world times
        part-to-body.
    """
    parts = [part for model in placed for part in model.parts]
    sizes = [len(model.parts) for model in placed]
    to_body = np.array([part.to_body for part in parts], dtype=np.float64).reshape(-1, 3, 4)
    body = np.array([model.to_world for model in placed], dtype=np.float64).reshape(-1, 3, 4)
    body = np.repeat(body, sizes, axis=0)
    to_world = body[:, :, :3] @ to_body
    to_world[:, :, 3] += body[:, :, 3]
    colours = np.array([part.colour for part in parts], dtype=np.float32).reshape(-1, 3)
    seconds = np.array([part.second_colour for part in parts], dtype=np.float32).reshape(-1, 3)
    return Primitives(
        shape=np.array([part.shape for part in parts], dtype=np.int8),
        to_world=to_world,
        colour=colours,
        second_colour=seconds,
        texture=np.array([part.texture for part in parts], dtype=np.int8),
        texture_scale=np.array([part.texture_scale for part in parts], dtype=np.float32),
        emission=np.array([part.emission for part in parts], dtype=np.float32),
        instance=np.repeat(np.array([model.instance for model in placed], dtype=np.int32), sizes),
        mesh=_objects([part.mesh for part in parts]),
        image=_objects([part.image for part in parts]),
    )


def _objects(values: Sequence[object]) -> NDArray[np.object_] | None:
    """The values as an array; None where all are None."""
    if all(value is None for value in values):
        return None
    array = np.empty(len(values), dtype=np.object_)
    array[:] = values
    return array


def join_primitives(groups: Sequence[Primitives]) -> Primitives:
    """The shapes of all groups, in order."""
    names = [field.name for field in fields(Primitives)]
    return Primitives(**{name: _join(groups, name) for name in names})


def _join(groups: Sequence[Primitives], name: str) -> Any:
    """One field of all groups; what only some groups have is empty for the others."""
    values = [getattr(group, name) for group in groups]
    if all(value is None for value in values):
        return None
    return np.concatenate(
        [
            np.full(len(group.shape), None) if value is None else value
            for group, value in zip(groups, values, strict=True)
        ]
    )
