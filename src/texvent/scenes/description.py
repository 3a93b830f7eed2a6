"""What a prompt means to the embedded generator: objects, motions, camera, place and light."""

from __future__ import annotations

from dataclasses import dataclass, field

from texvent.scenes.inflection import list_finite_forms, pluralise
from texvent.scenes.report import PromptReport
from texvent.scenes.report import Substitution as Substitution
from texvent.scenes.scene import Colour


@dataclass(frozen=True)
class NamedColour:
    """A colour as the prompt names it."""

    name: str
    """Such as "dark red"."""
    rgb: Colour
    """Linear-light RGB, 1.0 = white."""


@dataclass(frozen=True)
class ObjectMotion:
    """How an object moves."""

    kind: str
    """What it does: "drive", "walk", "run", "fly", "swim", "sail", "spin", "roll", "bounce",
    "fall", "rise", "sink", "orbit", "swing", "jump", "hover", "throw", "sway", "slide", "turn" (a
    curve to its own left or right as `direction` says; "around": back where it came from),
    "reverse" (backwards without turning round), "zigzag", "enter" and "leave" (the picture),
    "appear" (from behind what a "behind" or "from" relation names), "sit", "lie", "stand" (also
    for "stops"), or a gesture such as "wave" or "clap"."""
    direction: str | None = None
    """"left", "right", "towards", "away", "forward", "backward", "up", "down", "across", "circle",
    "to and fro", "up and down", "around", "clockwise" or "counter-clockwise"; None = not
    stated."""
    pace: float = 1.0
    """Multiple of the usual speed."""
    speed_m_s: float | None = None
    """Speed that the prompt states, m/s."""
    end_pace: float | None = None
    """Multiple of the usual speed at its end, for what accelerates or brakes (0 = comes to rest);
    None = steady."""
    start_s: float | None = None
    """When it begins, s; None = at once, or when the motion before it ends."""

    @property
    def is_moving(self) -> bool:
        """Whether the object leaves its place or turns."""
        return self.kind != "stand"


SPIN_RATE_HZ = 0.5
"""Usual turns per second of what spins."""
STANDING = ObjectMotion("stand")


@dataclass(frozen=True)
class Picture:
    """What is shown on a flat surface: a poster, a page, a screen."""

    kind: str
    """"file" (an image, or a video that plays), "checkerboard" or "text"."""
    value: str = ""
    """Path of the file, "9x6" squares of the board, or the text."""


@dataclass(frozen=True)
class SceneObject:
    """One noun of the prompt with everything the prompt says about it."""

    noun: str
    """Key of the noun table."""
    count: int = 1
    """How many there are."""
    colour: NamedColour | None = None
    """Its colour; None = its usual one."""
    scale: float = 1.0
    """Multiple of its usual size."""
    motion: ObjectMotion | None = None
    """What it does; None = not stated."""
    side: str | None = None
    """Where in the image: "left", "right", "centre", "far" or "near"; None = not stated."""
    then: tuple[ObjectMotion, ...] = ()
    """What it does after `motion`, in order."""
    material: str | None = None
    """What it is made of, such as "wood"; None = what it usually is."""
    picture: Picture | None = None
    """What it shows; None = its usual surface."""
    blink_hz: float | None = None
    """Frequency at which its own light blinks, Hz; None = as it usually does."""
    is_lit: bool | None = None
    """Whether its lamps are on; None = as usual: headlights at night, a candle always."""


@dataclass(frozen=True)
class Effect:
    """Smoke, sparks, water drops and the like: see `models.effects.EFFECTS`."""

    kind: str
    """Key of `EFFECTS`, such as "smoke", "drip" or "burst"."""
    source: int | None = None
    """Index into `SceneDescription.objects` of what it comes from; None = it is all around, or in
    the middle of the scene."""
    colour: NamedColour | None = None
    """Its colour; None = its usual one."""
    start_s: float | None = None
    """When it begins, s; None = it has always been there, or in the first half for what happens
    once (a burst, a splash, a break, an explosion)."""


@dataclass(frozen=True)
class Relation:
    """Where one object is, or goes, with respect to others."""

    kind: str
    """"beside", "behind", "front", "on", "in", "above", "under", "between", "left of",
    "right of", "past", "overtake", "through" (a tunnel, a gate), "around", "surround", "among",
    "towards", "away from", "from" (with "towards": from one to the other), "follow" or "with"; or
    an act of the subject on the target: "hold", "carry", "wear", "ride", "push", "pull",
    "work on" (hands at it), "kick", "hit", "throw", "catch" or "collide" (the subject itself is its
    target if its copies do)."""
    subject: int
    """Index into `SceneDescription.objects`."""
    targets: tuple[int, ...]
    """Indices into `SceneDescription.objects`."""


@dataclass(frozen=True)
class CameraMove:
    """One move of the camera."""

    kind: str
    """"static", "pan", "tilt", "roll", "zoom", "dolly", "truck", "pedestal", "orbit", "follow",
    "crane" (up or down over what it looks at), "dolly zoom", "handheld" or "travel" (ego-motion:
    along the road or through the place; from the air with an "aerial" view)."""
    direction: str | None = None
    """"left", "right", "up", "down", "in", "out", "clockwise" or "counter-clockwise"; for travel
    "forward", "backward", "left" or "right" (a bend); for follow: "behind", "front", "side" or
    "above"."""
    pace: float = 1.0
    """Multiple of the usual rate."""
    phase: int = 0
    """Moves of one phase happen together; phases follow each other and share the clip evenly."""
    means: str | None = None
    """For travel: "drive", "cycle", "walk", "run", "fly", "sail" or "swim"; None = what suits the
    place."""
    speed_m_s: float | None = None
    """For travel: speed that the prompt states, m/s."""


@dataclass(frozen=True)
class Shot:
    """How the camera looks at the scene."""

    moves: tuple[CameraMove, ...] = ()
    """Moves, which add up; empty = static."""
    view: str | None = None
    """"aerial", "top", "low", "side", "front", "back" or "first person"; None = a little above
    eye level."""
    framing: str | None = None
    """"close" or "wide"; None = all objects fit."""
    target: int | None = None
    """Index of the object the camera follows or looks at; None = the first one."""

    @property
    def is_moving(self) -> bool:
        """Whether the camera moves."""
        return any(move.kind != "static" for move in self.moves)


@dataclass(frozen=True)
class Illumination:
    """Time of day and lamps."""

    kind: str | None = None
    """"day", "sunny", "overcast", "dusk", "dawn", "night", "moonlight" or "lamp"; None = not
    said."""
    flicker_hz: float | None = None
    """Frequency at which all light is modulated, Hz; None = steady."""
    shadows: bool | None = None
    """Whether shadows are stated; None = the light's default."""


@dataclass(frozen=True)
class Surroundings:
    """Where the scene is."""

    place: str | None = None
    """Key of `lexicon_scene.PLACES`; never None after
    `parse_prompt`."""
    colour: NamedColour | None = None
    """Colour of the ground, where the place has a ground to paint."""
    sky: NamedColour | None = None
    """Colour of the sky; None = the light's default."""
    weather: str | None = None
    """"fog", "rain" or "snow"; None = fair."""
    clouds: float | None = None
    """0 = none .. 1 = covered; None = the light's default."""
    backdrops: tuple[str, ...] = ()
    """"mountain", "forest" or "city": what stands around a road, a field or a lake. A slope is
    shown as mountains around; the ground itself stays flat."""
    road: str | None = None
    """"curved" or "crossing", where the place has a road; None = straight."""
    is_empty: bool = False
    """Whether nothing else is there: no scenery, no furniture."""
    has_snow: bool = False
    """Whether snow lies on the ground."""
    has_dust: bool = False
    """Whether dust flies up behind what moves on the ground."""


@dataclass(frozen=True)
class SceneDescription:
    """A prompt, understood as far as it could be."""

    prompt: str
    objects: tuple[SceneObject, ...] = ()
    relations: tuple[Relation, ...] = ()
    effects: tuple[Effect, ...] = ()
    """Smoke, sparks, drops ..."""
    shot: Shot = field(default_factory=Shot)
    light: Illumination = field(default_factory=Illumination)
    surroundings: Surroundings = field(default_factory=Surroundings)
    absent: tuple[str, ...] = ()
    """Nouns that the prompt excludes; no scenery shows them."""
    shown: tuple[str, ...] = ()
    """Words of the prompt that the scene shows, in order, each once."""
    substituted: tuple[Substitution, ...] = ()
    """Words that are shown as something else."""
    not_understood: tuple[str, ...] = ()
    """Words that had no effect on the scene, in order, each once."""
    notes: tuple[str, ...] = ()
    """What the parser decided or left out, as sentences."""

    def summary(self) -> list[str]:
        """What will be shown, line by line, for a person to check.

        Example:
            >>> car = SceneObject("car", motion=ObjectMotion("drive", "left"))
            >>> SceneDescription("a left-driving car", objects=(car,)).summary()
            ['1 car, drives left', 'place: what suits the things', 'light: day', 'camera: static']
        """
        return self.report().lines()

    def report(self, not_shown: tuple[str, ...] = ()) -> PromptReport:
        """What becomes of the prompt's words.

        Args:
            not_shown: what the staged scene does not show, as "dog (hidden)" or "on the table".
        """
        hidden = {words.partition(" (")[0] for words in not_shown}
        lines = [self._describe_object(index) for index in range(len(self.objects))]
        lines.extend(self._describe_effect(effect) for effect in self.effects)
        lines.append(f"place: {_describe_surroundings(self.surroundings)}")
        lines.append(f"light: {_describe_light(self.light)}")
        lines.append(f"camera: {_describe_shot(self.shot)}")
        if self.absent:
            lines.append(f"left out as asked: {', '.join(self.absent)}")
        return PromptReport(
            scene=tuple(lines),
            shown=tuple(word for word in self.shown if word not in hidden),
            substituted=self.substituted,
            not_shown=not_shown,
            not_understood=self.not_understood,
            notes=self.notes,
        )

    def _describe_object(self, index: int) -> str:
        scene_object = self.objects[index]
        words = [_describe_count(scene_object)]
        if scene_object.colour is not None:
            words.append(scene_object.colour.name)
        if scene_object.scale != 1.0:
            words.append(f"{scene_object.scale:g} times its usual size")
        if scene_object.motion is not None:
            words.append(describe_motion(scene_object.motion, is_plural=scene_object.count > 1))
        for motion in scene_object.then:
            words.append(f"then {describe_motion(motion, is_plural=scene_object.count > 1)}")
        if scene_object.side is not None:
            words.append(_SIDES[scene_object.side])
        if scene_object.is_lit is not None:
            words.append("lit" if scene_object.is_lit else "not lit")
        if scene_object.blink_hz is not None:
            words.append(f"blinking at {scene_object.blink_hz:g} Hz")
        for relation in self.relations:
            if relation.subject == index:
                others = (_describe_count(self.objects[target]) for target in relation.targets)
                targets = "each other" if relation.targets == (index,) else " and ".join(others)
                words.append(f"{RELATION_WORDS.get(relation.kind, relation.kind)} {targets}")
        return ", ".join(words)

    def _describe_effect(self, effect: Effect) -> str:
        words = effect.kind if effect.colour is None else f"{effect.colour.name} {effect.kind}"
        if effect.source is not None:
            words += f", from {self.objects[effect.source].noun}"
        return words if effect.start_s is None else f"{words}, after {effect.start_s:g} s"


_SIDES = {
    "left": "on the left",
    "right": "on the right",
    "centre": "in the middle",
    "far": "far away",
    "near": "in the foreground",
}
RELATION_WORDS = {
    "front": "in front of",
    "surround": "surrounded by",
    "follow": "following",
    "overtake": "overtaking",
    "hold": "holding",
    "carry": "carrying",
    "wear": "wearing",
    "ride": "riding",
    "push": "pushing",
    "work on": "working on",
    "pull": "pulling",
    "kick": "kicking",
    "hit": "hitting",
    "throw": "throwing",
    "catch": "catching",
    "collide": "meeting",
}
"""Relation → words for it, where they differ from its name."""
_BACKDROPS = {
    "mountain": "mountains around (the ground itself stays flat)",
    "forest": "forest around",
    "city": "buildings around",
}
_DIRECTIONS = {
    "towards": "towards the camera",
    "circle": "in a circle",
    "across": "across the picture",
}


def _describe_count(scene_object: SceneObject) -> str:
    name = scene_object.noun
    return f"{scene_object.count} {name if scene_object.count == 1 else pluralise(name)}"


def describe_motion(motion: ObjectMotion, *, is_plural: bool) -> str:
    """A motion in words, such as "runs towards the camera"."""
    if motion.kind in _NAMED or " " in motion.kind:
        words = [f"{'do' if is_plural else 'does'} '{motion.kind}'"]
    else:
        verb, *rest = _PHRASES.get(motion.kind, motion.kind).split()
        words = [verb if is_plural else list_finite_forms(verb)[1], *rest]
    if motion.direction is not None:
        words.append(_DIRECTIONS.get(motion.direction, motion.direction))
    if motion.speed_m_s is not None:
        words.append(f"at {motion.speed_m_s:.3g} m/s")
    elif motion.pace != 1.0:
        words.append(f"at {motion.pace:.2g} times its usual speed")
    return " ".join(words)


_NAMED = ("push-up", "sit-up", "phone", "fist", "victory", "ok")
"""Activities named by a noun."""
_PHRASES = {"throw": "fly through the air", "work": "move in place", "stand": "stand still"}


def _describe_surroundings(surroundings: Surroundings) -> str:
    words = [surroundings.place or "what suits the things"]
    if surroundings.road is not None:
        words.append(f"{surroundings.road} road")
    if surroundings.colour is not None:
        words.append(surroundings.colour.name)
    if surroundings.sky is not None:
        words.append(f"{surroundings.sky.name} sky")
    if surroundings.weather is not None:
        words.append(surroundings.weather)
    if surroundings.clouds is not None:
        words.append("clouds" if surroundings.clouds > 0 else "no clouds")
    words.extend(_BACKDROPS[backdrop] for backdrop in surroundings.backdrops)
    if surroundings.has_snow and surroundings.place != "snow":
        words.append("snow on the ground")
    if surroundings.has_dust:
        words.append("dust")
    return ", ".join(words)


def _describe_light(light: Illumination) -> str:
    words = [light.kind or "day"]
    if light.flicker_hz is not None:
        words.append(f"flickering at {light.flicker_hz:g} Hz")
    if light.shadows is not None:
        words.append("with shadows" if light.shadows else "without shadows")
    return ", ".join(words)


def _describe_shot(shot: Shot) -> str:
    words = [" ".join(filter(None, (move.kind, move.direction))) for move in shot.moves]
    if not words:
        words = ["static"]
    if shot.view is not None:
        words.append(f"{shot.view} view")
    if shot.framing is not None:
        words.append(f"{shot.framing} shot")
    return ", ".join(words)
