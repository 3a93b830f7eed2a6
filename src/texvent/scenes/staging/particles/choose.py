"""Effects of a description → particle systems at their places."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, replace

import numpy as np

from texvent.scenes.description import Effect, SceneDescription
from texvent.scenes.models.anchors import locate
from texvent.scenes.models.effects import EFFECTS
from texvent.scenes.models.lamps import LAMPS
from texvent.scenes.models.people.activities import PERSON_NOUNS
from texvent.scenes.scene import Colour, Float64Array
from texvent.scenes.staging.actors import Actor, seeded
from texvent.scenes.staging.camera.framing import Framing
from texvent.scenes.staging.particles.body_lights import (
    make_beacons,
    make_string,
    make_turn_signals,
)
from texvent.scenes.staging.particles.bursts import Fireball, Fireworks, Pieces, Splash
from texvent.scenes.staging.particles.clouds import PLUMES, Plume, make_bank
from texvent.scenes.staging.particles.falling_water import FallingWater
from texvent.scenes.staging.particles.flakes import FLAKES, Falling
from texvent.scenes.staging.particles.jets import BLOWN, BREATHED, JETS, WATER, Dripping, Jet
from texvent.scenes.staging.particles.light_shows import Lasers, Lightning, StageLights
from texvent.scenes.staging.particles.motion import Source
from texvent.scenes.staging.particles.pouring import pour_into
from texvent.scenes.staging.particles.shapes import ParticleEffect
from texvent.scenes.staging.particles.window_drops import WindowDrops
from texvent.scenes.staging.surroundings.weather import WEATHERS

OF_NOUNS = {"campfire": "fire", "fireplace": "fire", "torch": "fire", "volcano": "smoke",
            "sprinkler": "spray", "waterfall": "falling water"}  # fmt: skip
"""Noun → effect that it always has, unless it is said not to be lit."""
ONCE_AT = 0.4
"""When what happens once does so, if nothing says when: share of the clip."""
_FALL_STEPS = 240
_NO_GROUND = ("sky", "space", "underwater")

_REAR = (-1.0, -0.55, 0.16)
_ANCHORS: dict[tuple[str, str], tuple[float, float, float]] = {
    **{
        (kind, noun): _REAR
        for kind in ("smoke", "steam")
        for noun in ("car", "suv", "van", "pickup", "taxi", "police car", "bus", "motorcycle")
    },
    ("smoke", "truck"): (0.45, 0.5, 1.0),
    ("smoke", "train"): (0.8, 0.0, 1.0),
    ("steam", "train"): (0.8, 0.0, 1.0),
    ("smoke", "airplane"): (-1.0, 0.0, 0.5),
    ("smoke", "rocket"): (0.0, 0.0, 0.0),
    ("smoke", "house"): (0.3, 0.35, 1.0),
    ("smoke", "ship"): (0.1, 0.0, 1.0),
    ("smoke", "volcano"): (0.0, 0.0, 0.58),
    ("spray", "sprinkler"): (0.0, 0.0, 1.0),
    ("fire", "torch"): (0.0, 0.0, 0.72),
    ("fire", "fireplace"): (0.1, 0.0, 0.1),
    **{(kind, "faucet"): (0.7, -0.92, 0.6) for kind in ("drip", "pour")},
    **{(kind, "teapot"): (0.0, -0.92, 0.78) for kind in ("pour", "steam", "drip")},
    **{(kind, "kettle"): (0.0, -0.92, 0.8) for kind in ("pour", "steam", "drip")},
    **{(kind, "watering can"): (0.0, -0.92, 0.95) for kind in ("pour", "spray", "drip")},
    **{(kind, "shower"): (0.0, 0.0, 0.93) for kind in ("pour", "spray", "drip")},
    **{(kind, "hose"): (0.4, 1.0, 0.2) for kind in ("pour", "spray", "fountain")},
}
"""(effect, noun) → where it comes from: x and y in half extents, z in heights from below."""
_AIMS: dict[str, tuple[float, float, float]] = {
    "faucet": (0.0, 0.0, -1.0),
    "shower": (0.0, 0.0, -1.0),
    "teapot": (0.0, -1.0, 0.1),
    "kettle": (0.0, -1.0, 0.1),
    "watering can": (0.0, -1.0, 0.3),
    "hose": (0.0, 1.0, 0.6),
    "elephant": (-0.8, 0.0, 0.35),
}
"""Where water leaves a noun to, in its body coordinates."""
_USUAL_ANCHOR: dict[str, tuple[float, float, float]] = {
    "drip": (0.9, 0.0, 0.85),
    "pour": (0.9, 0.0, 0.92),
    "spray": (0.9, 0.0, 0.9),
    "sparks": (0.6, 0.0, 0.6),
    "dust": (-0.7, 0.0, 0.0),
    "fire": (0.0, 0.0, 0.25),
    "splash": (0.0, 0.0, 0.0),
    "popcorn": (0.0, 0.0, 0.5),
    "confetti": (0.0, 0.0, 1.0),
}
_SIZES: dict[str, float] = {"popcorn": 0.6, "fire": 0.75, "smoke": 0.32, "steam": 0.7, "dust": 0.55,
                            "drip": 0.55,
                            "pour": 0.6, "fountain": 0.9, "sparks": 0.6}  # fmt: skip
"""Size of an effect by that of the object it comes from."""
_NOUN_SIZES = {("fire", "fireplace"): 0.3, ("fire", "torch"): 0.9, ("spray", "sprinkler"): 2.5}
"""The same for some objects of their own."""
_ALONE: dict[str, float] = {"smoke": 0.15, "steam": 0.12, "fire": 0.2, "dust": 0.2, "drip": 0.16,
                            "pour": 0.3, "fountain": 0.42, "sparks": 0.3, "embers": 0.25,
                            "spray": 0.3, "bubbles": 0.25, "popcorn": 0.3}  # fmt: skip
"""Size of an effect that comes from no object, by the distance of the camera."""
_HEADROOM = {"pour into": 1.4, "smoke": 3.0, "steam": 1.8, "fire": 1.5, "fountain": 1.1,
             "embers": 1.5, "sparks": 0.4, "bubbles": 1.0, "spray": 0.5}  # fmt: skip
"""Room that an effect needs above its object, by its size."""


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


@dataclass(frozen=True)
class Staged:
    """The particle systems of a scene, and which objects end when."""

    effects: tuple[ParticleEffect, ...]
    ends_s: dict[int, float]
    """Instance of an object → when it is gone, s."""
    kinds: tuple[tuple[str, int | None], ...] = ()
    """What each of `effects` belongs to: a kind of effect or a weather, and its object's index."""


def stage_effects(description: SceneDescription, setting: Setting) -> Staged:
    """All effects of a description.

    Nouns that burn get their fire. An effect whose object has several copies is at each of them.
    """
    said = list(description.effects)
    named = {(effect.kind, effect.source) for effect in said}
    for index, one in enumerate(description.objects):
        kind = OF_NOUNS.get(one.noun)
        if kind is not None and one.is_lit is not False and (kind, index) not in named:
            said.append(Effect(kind, index))
    effects = _weather(description, setting)
    fallen = description.surroundings.weather in WEATHERS
    kinds: list[tuple[str, int | None]] = [
        (str(description.surroundings.weather) if fallen and number == 0 else "dust", None)
        for number in range(len(effects))
    ]
    ends: dict[int, float] = {}
    for number, effect in enumerate(said):
        actors: Sequence[Actor | None] = [None]
        if effect.source is not None:
            actors = [one for one in setting.actors if one.object_index == effect.source] or [None]
        for copy, actor in enumerate(actors):
            rng = seeded(setting.seed, "effect", effect.kind, number, copy)
            made = _make(effect, actor, setting, rng)
            effects.extend(made)
            kinds += [(effect.kind, effect.source)] * len(made)
            if actor is not None and EFFECTS[effect.kind].ends_source:
                ends[actor.instance] = _start(effect, actor, setting)
    return Staged(tuple(effects), ends, tuple(kinds))


def _weather(description: SceneDescription, setting: Setting) -> list[ParticleEffect]:
    """Rain and snow, and the dust behind what drives."""
    said, framing = description.surroundings, setting.framing
    base = np.array([framing.target[0], framing.target[1], 0.0])
    made: list[ParticleEffect] = []
    if said.weather is not None and said.weather in WEATHERS:
        rng = seeded(setting.seed, said.weather)
        made.append(WEATHERS[said.weather](base, 1.4 * framing.distance_m, rng))
    for actor in setting.actors if said.weather == "rain" else ():
        if actor.noun.name == "window":
            made.append(WindowDrops.of(actor, seeded(setting.seed, "pane", actor.instance)))
    if said.has_dust:
        for actor in setting.actors:
            if actor.is_mover and actor.noun.habitat == "ground":
                rng = seeded(setting.seed, "dust", actor.instance)
                made.append(Plume.of("dust", _source("dust", actor, setting), rng))
    return made


def with_headroom(description: SceneDescription, actors: Sequence[Actor]) -> list[Actor]:
    """The objects, with room in the image for what rises from them."""
    room: dict[int, float] = {}
    for effect in description.effects:
        if effect.source is not None and effect.kind in _HEADROOM:
            needed = _HEADROOM[effect.kind] * _SIZES.get(effect.kind, 0.5)
            room[effect.source] = max(needed, room.get(effect.source, 0.0))
    return [
        replace(actor, headroom_m=room[actor.object_index] * _bulk(actor))
        if actor.object_index in room
        else actor
        for actor in actors
    ]


def _bulk(actor: Actor) -> float:
    """Size of an object, m: the side of a cube as large as the box around it."""
    model = actor.model
    return float(np.cbrt(model.length * model.width * model.height))


def _make(
    effect: Effect, actor: Actor | None, setting: Setting, rng: np.random.Generator
) -> list[ParticleEffect]:
    kind = effect.kind
    colour = None if effect.colour is None else effect.colour.rgb
    base = np.array([setting.framing.target[0], setting.framing.target[1], 0.0])
    reach = setting.framing.distance_m
    if kind in _LIGHTS:
        return _light_up(kind, actor, setting, colour, rng)
    if kind in ("mist", "sand"):
        return [make_bank(kind, base, 3.0 * reach, rng, colour)]
    if kind in FLAKES:
        return [Falling.of(kind, base, 1.4 * reach, rng, colour)]
    if kind == "fireworks":
        behind = -1.1 * reach * setting.framing.offset * [1.0, 1.0, 0.0]
        middle = base + behind + np.array([0.0, 0.0, 0.75 * reach])
        return [Fireworks.of(middle, 0.3 * reach, rng)]
    if EFFECTS[kind].happens_once:
        return _happen_once(effect, actor, setting, rng)
    return _make_stream(effect, actor, setting, rng)


def _make_stream(
    effect: Effect, actor: Actor | None, setting: Setting, rng: np.random.Generator
) -> list[ParticleEffect]:
    """Smoke, drops, flames: what leaves a source."""
    kind, reach = effect.kind, setting.framing.distance_m
    colour = None if effect.colour is None else effect.colour.rgb
    source = _source(kind, actor, setting)
    if kind == "falling water" and actor is not None:
        return [FallingWater.of(actor, rng)]
    if kind == "pour into" and actor is not None:
        return [pour_into(actor, colour, rng)]
    if kind == "drip" and actor is not None and actor.noun.name == "window":
        return [WindowDrops.of(actor, rng)]
    if kind == "drip":
        start = source.at(np.zeros(1))[0]
        height = max(float(start[2]), 0.05) if np.isfinite(setting.floor_m) else reach
        return [Dripping.of(source, height, rng, colour or WATER)]
    made: list[ParticleEffect] = []
    aim = None if actor is None else _AIMS.get(actor.noun.name)
    if kind in PLUMES and not (aim is not None and aim[2] < 0.0):
        plume = Plume.of(kind, source, rng, colour=colour, start_s=effect.start_s)
        has_lamp = actor is not None and actor.noun.name in LAMPS
        made.append(plume.unlit() if has_lamp else plume)
    if kind in JETS:
        jet = Jet.of(kind, source, rng, colour=colour, start_s=effect.start_s)
        is_blown = actor is not None and kind in BREATHED and actor.noun.name in PERSON_NOUNS
        if is_blown and setting.place != "underwater":
            jet = replace(jet, style=replace(jet.style, **BLOWN))
        if aim is not None and kind in ("pour", "spray"):
            jet = replace(jet, style=replace(jet.style, aim=aim))
        made.append(jet.until_ground() if kind == "pour" else jet)
    if kind == "fire" and actor is not None and actor.noun.name not in OF_NOUNS:
        made.append(Plume.of("black smoke", source, rng, start_s=effect.start_s))
    return made


_LIGHTS = frozenset(
    {"lightning", "stage lights", "lasers", "string lights", "blinking lights", "beacon",
     "turn signal", "hazard lights"}
)  # fmt: skip
_BUILT_UP = frozenset({"city", "street", "village", "downtown", "forest"})
"""Places whose houses or trees would hide what is behind them."""
_NEAR = 0.3
"""How near the bolts are there, as a share of their usual distance."""
_BLINK_HZ = {"string lights": 0.0, "blinking lights": 1.1}


def _light_up(
    kind: str, actor: Actor | None, setting: Setting, colour: Colour | None,
    rng: np.random.Generator,
) -> list[ParticleEffect]:  # fmt: skip
    """Effects that are light: see `light_shows` and `body_lights`."""
    target = np.asarray(setting.framing.target, dtype=np.float64)
    away = -setting.framing.offset * [1.0, 1.0, 0.0]
    away /= max(float(np.linalg.norm(away)), 1e-9)
    side = np.cross(away, [0.0, 0.0, 1.0])
    reach = setting.framing.distance_m
    if kind == "lightning":
        behind = _NEAR if setting.place in _BUILT_UP else 1.0
        return [Lightning.of(target * [1.0, 1.0, 0.0], away, reach, rng, behind)]
    if kind == "stage lights":
        return [StageLights(target * [1.0, 1.0, 0.0], side, reach, colour)]
    if kind == "lasers":
        return [Lasers(target + 0.1 * reach * away, side, reach, colour)]
    if kind in _BLINK_HZ:
        place = target + reach * (0.22 * np.array([0.0, 0.0, 1.0]) + 0.1 * away)
        string = make_string(
            actor, place, side, 0.9 * reach, blink_hz=_BLINK_HZ[kind], colour=colour
        )
        return [string]
    if actor is None:
        return []
    if kind == "beacon":
        return [make_beacons(actor, colour)]
    return [make_turn_signals(actor, both=kind == "hazard lights")]


def _happen_once(
    effect: Effect, actor: Actor | None, setting: Setting, rng: np.random.Generator
) -> list[ParticleEffect]:
    start = _start(effect, actor, setting)
    size = _size_of(actor, setting)
    target = np.asarray(setting.framing.target, dtype=np.float64)
    if effect.kind == "splash":
        middle = target.copy() if actor is None else actor.middle(start)
        middle[2] = 0.0
        colour: Colour = WATER if effect.colour is None else effect.colour.rgb
        return [Splash.of(middle, 0.9 * size, start, rng, colour)]
    made: list[ParticleEffect] = []
    middle = target if actor is None else actor.middle(start)
    if actor is not None:
        made.append(Pieces.of(actor, effect.kind, start, rng, setting.floor_m))
    if effect.kind == "explode":
        made.append(Fireball.of(middle, 0.7 * size, start, rng))
    return made


def _start(effect: Effect, actor: Actor | None, setting: Setting) -> float:
    """When what happens once does so, s: as stated, when its object meets the ground, or early."""
    if effect.start_s is not None:
        return effect.start_s
    if actor is not None and effect.kind in ("splash", "break"):
        lift = 0.5 * actor.model.height if actor.is_centred else 0.0
        times = np.linspace(0.0, setting.duration_s, _FALL_STEPS)
        heights = np.array([actor.trajectory.at(float(t)).position[2] - lift for t in times])
        down = np.flatnonzero((heights[1:] <= 0.01) & (heights[:-1] > 0.01))
        if len(down):
            return float(times[down[0] + 1])
    return ONCE_AT * setting.duration_s


def _size_of(actor: Actor | None, setting: Setting) -> float:
    """Size of what an effect comes from, m."""
    return 0.16 * setting.framing.distance_m if actor is None else _bulk(actor)


def _source(kind: str, actor: Actor | None, setting: Setting) -> Source:
    """Where an effect comes from."""
    if actor is None:
        target = np.asarray(setting.framing.target, dtype=np.float64)
        lifted = kind in ("drip", "sparks", "pour", "spray")
        reach = setting.framing.distance_m
        height = target[2] + 0.22 * reach if lifted else 0.0
        return Source(_ALONE.get(kind, 0.15) * reach, np.array([target[0], target[1], height]))
    size = _NOUN_SIZES.get((kind, actor.noun.name), _SIZES.get(kind, 0.5)) * _bulk(actor)
    model = actor.model
    x, y, z = _ANCHORS.get((kind, actor.noun.name), _USUAL_ANCHOR.get(kind, (0.0, 0.0, 1.0)))
    low = -0.5 * model.height if actor.is_centred else 0.0
    if kind in BREATHED and actor.noun.name in PERSON_NOUNS:
        mouth = locate(model, "mouth", actor.pose(0.0))
        return Source(size, np.asarray(mouth @ [0.12 * _bulk(actor), 0.0, 0.0, 1.0]), actor)
    trunk = actor.noun.name == "elephant" and kind in ("spray", "fountain", "splash")
    if trunk:
        tip = locate(model, "trunk", actor.pose(0.3))
        return Source(_TRUNK_SHARE * _bulk(actor), np.asarray(tip[:, 3]), actor)
    place = np.array([0.5 * x * model.length, 0.5 * y * model.width, low + z * model.height])
    return Source(size, place, actor)


_TRUNK_SHARE = 0.9
"""Size of what comes from an elephant's trunk, relative to the elephant."""


def gone(to_world: Float64Array) -> Float64Array:
    """[3, 4] the pose of an object that is no more: too small to be seen."""
    return np.column_stack([1e-6 * to_world[:, :3], to_world[:, 3]])
