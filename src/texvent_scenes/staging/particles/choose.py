"""Effects of a scene → particle systems at their places."""

from __future__ import annotations

import math
from dataclasses import dataclass, replace

import numpy as np

from texvent_scenes.description import SceneDescription
from texvent_scenes.models.effects import EFFECTS, LAMPS, EmitterStyle
from texvent_scenes.models.places import PLACES
from texvent_scenes.models.shapes import bounds
from texvent_scenes.models.tables import trait_value
from texvent_scenes.rendered_scene import Float64Array
from texvent_scenes.spec.scene import Effect, object_ids
from texvent_scenes.staging.actors import Actor, seeded
from texvent_scenes.staging.particles.effect import (
    Setting,
    Source,
)
from texvent_scenes.staging.particles.emitter import Emitter
from texvent_scenes.staging.tracks.track import Term, steady

_JUST_BEFORE_S, _LARGE = 1e-6, 0.02
"""Time before the instant at which something breaks; share of its largest part from which on a part
gives its colour to pieces."""
_RATE_HZ, _DEEP, _MOST_SPLASH_M = 60.0, 0.3, 1.2
"""Instants per second at which a splash is looked for; depth from which on it is one, in heights of
the body; greatest size of one, m."""
_TURN_S = 0.02
"""Time in which a part that goes round has turned, s."""
_GLINT = 0.1
"""Light of drops and flakes at night, as a share of that of a white surface by day."""
FALLING = ("rain", "snow")
"""Weather that is an effect."""


@dataclass(frozen=True)
class Staged:
    """The particle systems of a scene."""

    effects: tuple[Emitter, ...]
    kinds: tuple[str, ...] = ()
    """Weather or kind of effect of each particle system."""


def stage_effects(description: SceneDescription, setting: Setting) -> Staged:
    """Weather, all effects of a scene, and those that some nouns always have.

    An effect whose object has several copies is at each of them.
    """
    weather, amount = description.place.weather, description.place.weather_amount
    said = [Effect(weather)] if weather in FALLING else []
    said += description.effects
    named = {(effect.kind, effect.source) for effect in said}
    for id, one in zip(object_ids(description), description.objects, strict=True):
        kind = trait_value("own effect", one.noun)
        if kind is not None and one.is_lit is not False and (kind, id) not in named:
            said.append(Effect(kind, id))
    moves = [one.phase for one in description.camera.moves]
    acts = [len(one.motions) - 1 for one in description.objects]
    phases = 1 + max([0, *(one.phase for one in said), *moves, *acts])
    effects: list[Emitter] = []
    kinds: list[str] = []
    for number, effect in enumerate(said):
        source = description.index(effect.source)
        copies = [one for one in setting.actors if one.object_index == source]
        for copy, actor in enumerate(copies or [None]):
            rng = seeded(setting.seed, "effect", effect.kind, number, copy)
            start_s = effect.start_s
            if start_s is None and effect.phase:
                start_s = setting.duration_s * effect.phase / phases
            own = amount if effect.kind == weather else 1.0
            effects += _make(replace(effect, start_s=start_s), actor, setting, rng, own)
            kinds += [effect.kind] * (len(effects) - len(kinds))
    for actor in setting.actors:
        kind = trait_value("pieces", actor.noun.name) if actor.breaks_s is not None else None
        if kind is not None:
            effects += _scatter(kind, actor, setting)
            kinds += [kind] * (len(effects) - len(kinds))
    for actor in setting.actors if PLACES[setting.place].has_surface else ():
        effects += _splash(actor, setting)
        kinds += ["splash"] * (len(effects) - len(kinds))
    return Staged(tuple(effects), tuple(kinds))


def _make(
    effect: Effect, actor: Actor | None, setting: Setting, rng: np.random.Generator, amount: float
) -> list[Emitter]:
    """Emitters of an effect at an object, or by itself; `amount` multiplies their particles."""
    words = EFFECTS[effect.kind]
    source = _source(effect.kind, actor, setting)
    styles = [replace(style, count=round(amount * style.count)) for style in words.emitters]
    return [
        Emitter.of(
            _glinting(_fitted(style, effect.kind, actor), effect.kind, setting), source, setting,
            rng,
            start_s=effect.start_s, volley=volley,
        )
        for style in styles
        for volley in range(max(style.salvos, 1))
    ]  # fmt: skip


def _glinting(style: EmitterStyle, kind: str, setting: Setting) -> EmitterStyle:
    """Rain at night, whose drops gather light from all around."""
    is_lit = kind in FALLING and setting.is_dark
    return replace(style, emission=(_GLINT, _GLINT)) if is_lit else style


def _scatter(kind: str, actor: Actor, setting: Setting) -> list[Emitter]:
    """Pieces of what breaks, from where it is then; on what it stands on, or on the ground."""
    begin_s = actor.breaks_s or 0.0
    state = actor.track.at(begin_s)
    turned = (Term("pitch", offset=state.pitch), Term("roll", offset=state.roll))
    still = replace(steady(state.position, state.yaw), terms=turned, pivot_m=state.pivot_m)
    body = replace(actor, track=still, breaks_s=None)
    floor_m = -math.inf if actor.noun.habitat == "air" else actor.lowest_m(begin_s - _JUST_BEFORE_S)
    source = replace(_source(kind, body, setting), floor_m=floor_m)
    parts = actor.model.parts(actor.pose(begin_s))
    bulks = np.array([abs(float(np.linalg.det(one.to_body[:, :3]))) for one in parts])
    large = [one for one, bulk in zip(parts, bulks, strict=True) if bulk >= _LARGE * bulks.max()]
    colours = tuple(dict.fromkeys(one.colour for one in large))
    rng = seeded(setting.seed, "pieces", actor.instance)
    return [
        Emitter.of(replace(style, colours=style.colours or colours), source, setting, rng,
                   start_s=begin_s, pace=actor.pieces_pace)
        for style in EFFECTS[kind].emitters
    ]  # fmt: skip


def _splash(actor: Actor, setting: Setting) -> list[Emitter]:
    """Drops that who comes from above into water throws up, whose surface is at height 0."""
    times = np.linspace(0.0, setting.duration_s, max(int(_RATE_HZ * setting.duration_s), 2) + 1)
    low = np.array([actor.lowest_m(float(at)) for at in times])
    met = np.flatnonzero((low[:-1] > 0.0) & (low[1:] <= 0.0))
    if not len(met) or low.min() > -_DEEP * actor.model.height:
        return []
    at_s = float(times[met[0] + 1])
    x, y, _ = actor.middle(at_s)
    source = Source(min(actor.size_m, _MOST_SPLASH_M), np.array([x, y, 0.0]))
    rng = seeded(setting.seed, "splash", actor.instance)
    return [
        Emitter.of(one, source, setting, rng, start_s=at_s) for one in EFFECTS["splash"].emitters
    ]


def _fitted(style: EmitterStyle, kind: str, actor: Actor | None) -> EmitterStyle:
    """The style for an object: from its spout or mouth, without light where it has a lamp."""
    if actor is None:
        return style
    noun, words = actor.noun.name, EFFECTS[kind]
    aim = trait_value("spout direction", noun) if "spout" in words.anchor_traits else None
    if aim is not None and style.body == "drop":
        spread = trait_value("spout spread", noun) or style.spread_rad
        style = replace(style, aim=tuple(aim), spread_rad=tuple(spread))
    return replace(style, light=0.0) if noun in LAMPS else style


def _source(kind: str, actor: Actor | None, setting: Setting) -> Source:
    """Source of an effect."""
    words = EFFECTS[kind]
    if actor is None:
        size, height, behind = setting.camera.framing.distance_m * np.array(words.alone)
        target = np.array(setting.camera.framing.target, dtype=np.float64)
        target[2] = target[2] + height if height else 0.0
        return Source(float(size), target + behind * setting.away)
    model, noun = actor.model, actor.noun.name
    known = (trait_value(trait, noun) for trait in words.anchor_traits)
    x, y, z = next((one for one in known if one is not None), words.anchor)
    height = z * model.height - actor.foot_m
    point = np.array([0.5 * x * model.length, 0.5 * y * model.width, height])
    is_tool = words.from_work and actor.noun.is_working
    edge = _find_working_edge(actor) if is_tool else None
    point = point if edge is None else edge
    return Source(words.size * actor.mean_size_m, point, actor)


def _find_working_edge(actor: Actor) -> Float64Array | None:
    """[3] lowest point of the part that goes round in a body, in its coordinates, m.

    That is where the disc of a grinder or the blade of a saw meets the work; None: no part does.
    """
    first, later = (actor.own_parts(actor.pose(time_s)) for time_s in (0.0, _TURN_S))
    parts = [one for one, other in zip(first, later, strict=True)
             if not np.allclose(one.to_body, other.to_body)]  # fmt: skip
    if not parts:
        return None
    low, high = bounds(parts)
    middle = 0.5 * (np.asarray(low) + np.asarray(high))
    return np.array([middle[0], middle[1], low[2]])
