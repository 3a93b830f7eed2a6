"""Scenes as staging takes them: every noun, colour and id checked, relations by index.

Motions, pictures, camera moves, lamps, light and place are the values of `spec.scene`; fields
without a text mean the same there.
"""

from __future__ import annotations

from dataclasses import dataclass, field

from texvent.scenes.report import PromptReport
from texvent.scenes.spec import scene as spec
from texvent.scenes.spec.scene import CameraMove as CameraMove
from texvent.scenes.spec.scene import Lamp as SceneLamp
from texvent.scenes.spec.scene import Light as Illumination
from texvent.scenes.spec.scene import Motion as ObjectMotion
from texvent.scenes.spec.scene import Picture as Picture
from texvent.scenes.spec.scene import Place as Surroundings

__all__ = [
    "AMID", "SPIN_RATE_HZ", "STANDING", "CameraMove", "Effect",
    "Illumination", "ObjectMotion", "Picture", "Relation", "SceneDescription", "SceneLamp",
    "SceneObject", "Shot", "Surroundings", "to_description",
]  # fmt: skip

SPIN_RATE_HZ = 0.5
"""Usual turns per second of what spins."""
STANDING = ObjectMotion("stand")
AMID = frozenset({"surround", "among"})
"""Kinds of `Relation` whose targets stand around, placed as scenery is; some may be out of view."""


@dataclass(frozen=True)
class SceneObject:
    """A body of the scene, or several copies of it."""

    noun: str
    count: int = 1
    colour: str | None = None
    scale: float = 1.0
    """Its `size`."""
    motion: ObjectMotion | None = None
    """The first of its `motions`; None: not stated."""
    side: str | None = None
    """Its `placement`."""
    then: tuple[ObjectMotion, ...] = ()
    """Its motions after the first, in order."""
    material: str | None = None
    picture: Picture | None = None
    blink_hz: float | None = None
    is_lit: bool | None = None
    position_m: tuple[float, float] | None = None
    height_m: float | None = None
    heading_deg: float | None = None


@dataclass(frozen=True)
class Effect:
    """A particle effect."""

    kind: str
    source: int | None = None
    """Index of the object that it comes from."""
    colour: str | None = None
    start_s: float | None = None


@dataclass(frozen=True)
class Relation:
    """A position or an action of an object with respect to others."""

    kind: str
    subject: int
    """Index of an object."""
    targets: tuple[int, ...]
    """Indices of objects; the subject itself is its target if its copies collide."""
    distance_m: float | None = None


@dataclass(frozen=True)
class Shot:
    """The camera: its moves, viewpoint and framing."""

    moves: tuple[CameraMove, ...] = ()
    view: str | None = None
    framing: str | None = None
    target: int | None = None
    """Index of the object that it looks at or follows."""
    position_m: tuple[float, float, float] | None = None
    look_at_m: tuple[float, float, float] | None = None
    field_of_view_deg: float | None = None

    @property
    def is_moving(self) -> bool:
        """Whether the camera moves."""
        return any(move.kind not in ("static", "dutch") for move in self.moves)


@dataclass(frozen=True)
class SceneDescription:
    """A scene whose relations, effects and camera name objects by index."""

    prompt: str
    objects: tuple[SceneObject, ...] = ()
    relations: tuple[Relation, ...] = ()
    effects: tuple[Effect, ...] = ()
    shot: Shot = field(default_factory=Shot)
    light: Illumination = field(default_factory=Illumination)
    surroundings: Surroundings = field(default_factory=Surroundings)
    is_timelapse: bool = False
    is_grey: bool = False
    absent: tuple[str, ...] = ()
    words: PromptReport = field(default_factory=PromptReport)
    """What became of the words of a prompt that was read."""
    notes: tuple[str, ...] = ()
    """What was decided where the scene leaves it open, as sentences."""


def to_description(scene: spec.Scene) -> SceneDescription:
    """The description of a scene that `scene_from_data` accepts; what is open stays open."""
    ids = spec.object_ids(scene)
    camera = scene.camera
    return SceneDescription(
        scene.prompt,
        objects=tuple(map(_object, scene.objects)),
        relations=tuple(
            Relation(one.kind, number, tuple(map(ids.index, one.to)), one.distance_m)
            for number, subject in enumerate(scene.objects)
            for one in subject.relations
        ),
        effects=tuple(
            Effect(one.kind, _index(one.source, ids), one.colour, one.start_s)
            for one in scene.effects
        ),
        shot=Shot(
            camera.moves, camera.view, camera.framing, _index(camera.target, ids),
            camera.position_m, camera.look_at_m, camera.field_of_view_deg,
        ),
        light=scene.light,
        surroundings=scene.place,
        is_timelapse=scene.is_timelapse,
        is_grey=camera.is_grey,
        absent=scene.absent,
    )  # fmt: skip


def _object(one: spec.SceneObject) -> SceneObject:
    motion, *then = one.motions or (None,)
    return SceneObject(
        one.noun, one.count, one.colour, one.size, motion, one.placement, tuple(filter(None, then)),
        one.material, one.picture, one.blink_hz, one.is_lit, one.position_m, one.height_m,
        one.heading_deg,
    )  # fmt: skip


def _index(id: str | None, ids: tuple[str, ...]) -> int | None:
    return None if id is None else ids.index(id)
