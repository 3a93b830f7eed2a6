"""Effects of a scene → particle systems at their places."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, replace

import numpy as np

from texvent.scenes.colours import rgb_of
from texvent.scenes.description import Effect, SceneDescription
from texvent.scenes.models.anchors import locate
from texvent.scenes.models.effects import EFFECTS, EmitterStyle, LightStyle
from texvent.scenes.models.lamps import LAMPS
from texvent.scenes.models.people.activities import PERSON_NOUNS
from texvent.scenes.models.traits import nouns_with, trait_value
from texvent.scenes.scene import Colour, Float64Array
from texvent.scenes.staging.actors import Actor, seeded
from texvent.scenes.staging.camera.framing import Framing
from texvent.scenes.staging.particles.body_lights import BodyLights
from texvent.scenes.staging.particles.bolts import Lightning
from texvent.scenes.staging.particles.emitter import Emitter
from texvent.scenes.staging.particles.motion import Source
from texvent.scenes.staging.particles.shapes import ParticleEffect
from texvent.scenes.staging.surroundings.weather import WEATHERS

ONCE_AT = 0.4
"""When what happens once does so, if nothing says when: share of the clip."""
_FALL_STEPS = 240
_NO_GROUND = ("sky", "space", "underwater")
_BLUE: Colour = (0.06, 0.2, 1.0)
_SPOUT = "spout"
"""Trait of nouns that water leaves at a point, in a direction."""


@dataclass(frozen=True)
class Setting:
    """What effects need to know about the scene."""

    actors: Sequence[Actor]
    framing: Framing
    place: str
    duration_s: float
    seed: int

    @property
    def floor_m(self) -> float:
        """Height of the ground, m; -inf where there is none."""
        return -np.inf if self.place in _NO_GROUND else 0.0

    @property
    def base(self) -> Float64Array:
        """[3] the point on the ground below what the camera looks at, m."""
        return np.array([self.framing.target[0], self.framing.target[1], 0.0])

    @property
    def away(self) -> Float64Array:
        """[3] horizontal unit vector away from the camera."""
        flat = -self.framing.offset * [1.0, 1.0, 0.0]
        return np.asarray(flat / max(float(np.linalg.norm(flat)), 1e-9))


@dataclass(frozen=True)
class Staged:
    """The particle systems of a scene, and which objects end when."""

    effects: tuple[ParticleEffect, ...]
    ends_s: dict[int, float]
    """Instance of an object → when it is gone, s."""


def stage_effects(description: SceneDescription, setting: Setting) -> Staged:
    """All effects of a scene, those that some nouns always have, weather and dust.

    An effect whose object has several copies is at each of them.
    """
    said = list(description.effects)
    named = {(effect.kind, effect.source) for effect in said}
    for index, one in enumerate(description.objects):
        kind = trait_value("own effect", one.noun)
        if kind is not None and one.is_lit is not False and (kind, index) not in named:
            said.append(Effect(kind, index))
    effects = _weather(description, setting)
    ends: dict[int, float] = {}
    for number, effect in enumerate(said):
        actors: Sequence[Actor | None] = [None]
        if effect.source is not None:
            actors = [one for one in setting.actors if one.object_index == effect.source] or [None]
        for copy, actor in enumerate(actors):
            rng = seeded(setting.seed, "effect", effect.kind, number, copy)
            effects += _make(effect, actor, setting, rng)
            if actor is not None and EFFECTS[effect.kind].ends_source:
                ends[actor.instance] = _start(effect, actor, setting)
    return Staged(tuple(effects), ends)


def _weather(description: SceneDescription, setting: Setting) -> list[ParticleEffect]:
    """Rain and snow, and the dust behind what drives."""
    said = description.surroundings
    made: list[ParticleEffect] = []
    if said.weather is not None and said.weather in WEATHERS:
        rng = seeded(setting.seed, said.weather)
        made.append(WEATHERS[said.weather](setting.base, 1.4 * setting.framing.distance_m, rng))
    for actor in setting.actors if said.has_dust else ():
        if actor.is_mover and actor.noun.habitat == "ground":
            rng = seeded(setting.seed, "dust", actor.instance)
            made += _emit(Effect("dust"), actor, setting, rng)
    return made


def with_headroom(description: SceneDescription, actors: Sequence[Actor]) -> list[Actor]:
    """The objects, with room in the image for what rises from them."""
    room: dict[int, float] = {}
    for effect in description.effects:
        words = EFFECTS[effect.kind]
        if effect.source is not None and words.headroom:
            needed = words.headroom * words.size
            room[effect.source] = max(needed, room.get(effect.source, 0.0))
    return [
        replace(actor, headroom_m=room[actor.object_index] * _bulk(actor))
        if actor.object_index in room
        else actor
        for actor in actors
    ]


def lowest_m(actor: Actor) -> float:
    """Height of a body's lowest point above its origin, m."""
    return -0.5 * actor.model.height if actor.is_centred else 0.0


def gone(to_world: Float64Array) -> Float64Array:
    """[3, 4] the pose of an object that is no more: too small to be seen."""
    return np.column_stack([1e-6 * to_world[:, :3], to_world[:, 3]])


def _make(
    effect: Effect, actor: Actor | None, setting: Setting, rng: np.random.Generator
) -> list[ParticleEffect]:
    """What shows an effect at an object, or by itself."""
    if effect.kind == "lightning":
        return [Lightning.of(setting.base, setting.away, setting.framing.distance_m, rng)]
    lights = EFFECTS[effect.kind].lights
    if lights is not None:
        return [_light_up(effect, lights, actor, setting)]
    return _emit(effect, actor, setting, rng)


def _light_up(
    effect: Effect, lights: LightStyle, actor: Actor | None, setting: Setting
) -> BodyLights:
    """Lights on an object, or in the air."""
    noun = "" if actor is None else actor.noun.name
    source = _source(effect.kind, None, setting)
    if actor is not None:
        source = Source(_bulk(actor), np.array([0.0, 0.0, lowest_m(actor)]), actor)
    colour = rgb_of(effect.colour, "effect")
    if colour is None and effect.kind == "beacon" and noun in nouns_with("blue beacon"):
        colour = _BLUE
    return BodyLights.of(lights, source, colour, tapers=noun in nouns_with("tapers upwards"))


def _emit(
    effect: Effect, actor: Actor | None, setting: Setting, rng: np.random.Generator
) -> list[ParticleEffect]:
    """The emitters of an effect."""
    words = EFFECTS[effect.kind]
    start_s = _start(effect, actor, setting) if words.happens_once else effect.start_s
    source = _source(effect.kind, actor, setting)
    if effect.kind == "splash":
        middle = source.at(np.array([start_s or 0.0]))[0]
        source = Source(source.size_m, middle * [1.0, 1.0, 0.0])
    colour = rgb_of(effect.colour, "effect")
    return [
        Emitter.of(
            _fitted(style, effect.kind, actor), source, rng, colour=colour, start_s=start_s,
            is_once=words.happens_once, floor_m=setting.floor_m,
        )
        for style in words.emitters
        if style.colours or actor is not None
    ]  # fmt: skip


def _fitted(style: EmitterStyle, kind: str, actor: Actor | None) -> EmitterStyle:
    """The style for an object: from its spout, or without light where it has a lamp."""
    if actor is None:
        return style
    aim = trait_value("spout direction", actor.noun.name)
    if aim is not None and _SPOUT in EFFECTS[kind].anchor_traits and style.body == "drop":
        style = replace(style, aim=tuple(aim))
    if kind in _BLOWN and actor.noun.name in PERSON_NOUNS:
        style = replace(style, aim=(1.0, 0.0, 0.3))
    return replace(style, light=0.0) if actor.noun.name in LAMPS else style


_BLOWN = frozenset(kind for kind, words in EFFECTS.items() if words.breathed)


def _start(effect: Effect, actor: Actor | None, setting: Setting) -> float:
    """When what happens once does so, s: as stated, when its object meets the ground, or early."""
    if effect.start_s is not None:
        return effect.start_s
    if actor is not None and effect.kind in ("splash", "break"):
        times = np.linspace(0.0, setting.duration_s, _FALL_STEPS)
        low = lowest_m(actor)
        heights = np.array([actor.trajectory.at(float(t)).position[2] + low for t in times])
        down = np.flatnonzero((heights[1:] <= 0.01) & (heights[:-1] > 0.01))
        if len(down):
            return float(times[down[0] + 1])
    return ONCE_AT * setting.duration_s


def _bulk(actor: Actor) -> float:
    """Size of an object, m: the side of a cube as large as the box around it."""
    model = actor.model
    return float(np.cbrt(model.length * model.width * model.height))


def _source(kind: str, actor: Actor | None, setting: Setting) -> Source:
    """Where an effect comes from."""
    words = EFFECTS[kind]
    if actor is None:
        reach = setting.framing.distance_m
        target = np.array(setting.framing.target, dtype=np.float64)
        target[2] = target[2] + words.alone_height * reach if words.alone_height else 0.0
        target += words.alone_behind * reach * setting.away
        return Source(words.alone * reach, target)
    size, model, noun = words.size * _bulk(actor), actor.model, actor.noun.name
    if words.breathed and noun in PERSON_NOUNS:
        mouth = locate(model, "mouth", actor.pose(0.0))
        return Source(size, np.asarray(mouth @ [0.12 * _bulk(actor), 0.0, 0.0, 1.0]), actor)
    known = (trait_value(trait, noun) for trait in words.anchor_traits)
    x, y, z = next((one for one in known if one is not None), words.anchor)
    height = lowest_m(actor) + z * model.height
    return Source(size, np.array([0.5 * x * model.length, 0.5 * y * model.width, height]), actor)
