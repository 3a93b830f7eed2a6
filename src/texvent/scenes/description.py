"""What a prompt means to the embedded generator: objects, motions, camera, place and light."""

from __future__ import annotations

from dataclasses import dataclass, field

from texvent.scenes.report import PromptReport
from texvent.scenes.report import Substitution as Substitution
from texvent.scenes.scene import Colour
from texvent.scenes.wording import describe


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
    "reverse" (backwards without turning round), "enter" and "leave" (the picture),
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
    rate_hz: float | None = None
    """How often it goes there and back, 1/s, where the prompt states that."""
    shore: str | None = None
    """As `spec.scene.Motion.shore`."""
    is_stuck: bool = False
    """Whether it creeps along in traffic."""

    @property
    def is_moving(self) -> bool:
        """Whether the object leaves its place or turns."""
        return self.kind not in ("stand", "hang")


SPIN_RATE_HZ = 0.5
"""Usual turns per second of what spins."""
STANDING = ObjectMotion("stand")
RIDES = ("ride", "ride along")
"""Kinds of `Relation` of who steers, and of a passenger."""
AMID = frozenset({"surround", "among"})
"""Kinds of `Relation` whose targets stand around, placed as scenery is; some may be out of view."""
TOGETHER = "together"
FORMATIONS = frozenset({"row", "ring", TOGETHER})
"""Values of `SceneObject.side` that say how copies stand to each other."""


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
    """Where in the image: "left", "right", "centre", "far" or "near"; "lane" = on the road; or how
    copies stand to each other: "row", "ring", "together" (at each other's side); None = not
    stated."""
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
    position_m: tuple[float, float] | None = None
    """x and y on the ground where its first copy is at time 0, m; None = not stated."""
    height_m: float | None = None
    """Of its lowest point above the ground, m; None = as usual."""
    heading_deg: float | None = None
    """Where it faces and goes, anticlockwise from x (right); None = not stated."""


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
    """As `spec.scene.Relation.kind`; the subject itself is its target if its copies collide."""
    subject: int
    """Index into `SceneDescription.objects`."""
    targets: tuple[int, ...]
    """Indices into `SceneDescription.objects`."""
    way: str = ""
    """As `spec.scene.Relation.way`; "" = nothing."""
    distance_m: float | None = None
    """From middle to middle on the ground, m, of "left of", "right of", "front", "behind" and
    "beside"; None = not stated."""


@dataclass(frozen=True)
class CameraMove:
    """One move of the camera."""

    kind: str
    """"static", "pan", "tilt", "roll", "zoom", "dolly", "truck", "pedestal", "orbit", "follow",
    "crane" (up or down over what it looks at), "dolly zoom", "handheld", "dutch" (held aslant)
    or "travel" (ego-motion:
    along the road or through the place; from the air with an "aerial" view)."""
    direction: str | None = None
    """"left", "right", "up", "down", "in", "out", "clockwise" or "counter-clockwise"; for travel
    "forward", "backward", "left" or "right" (a bend); for follow: "behind", "front", "side",
    "above" or "slower" (beside it, but left behind, so that it crosses the image: never said); for
    handheld "all axes" (in all six degrees of freedom)."""
    pace: float = 1.0
    """Multiple of the usual rate; of what follows "slower", the share of the subject's way."""
    phase: int = 0
    """Moves of one phase happen together; phases follow each other and share the clip evenly."""
    means: str | None = None
    """For travel: "drive", "cycle", "walk", "run", "fly", "sail" or "swim"; None = what suits the
    place."""
    speed_m_s: float | None = None
    """For travel: speed that the prompt states, m/s."""
    start_s: float | None = None
    """When it starts, s; None = with its phase, or at 0 where `stop_s` is given."""
    stop_s: float | None = None
    """When it stops, s; None = with its phase, or at the end where `start_s` is given."""

    @property
    def is_timed(self) -> bool:
        """Whether it has times of its own instead of a phase."""
        return self.start_s is not None or self.stop_s is not None


@dataclass(frozen=True)
class Shot:
    """How the camera looks at the scene."""

    moves: tuple[CameraMove, ...] = ()
    """Moves, which add up; empty = static."""
    view: str | None = None
    """"aerial", "top", "low", "side", "front", "back", "high" (from a bridge) or "first person";
    None = a little above eye level."""
    framing: str | None = None
    """"close" or "wide"; None = all objects fit."""
    target: int | None = None
    """Index of the object the camera follows or looks at; None = the first one."""
    position_m: tuple[float, float, float] | None = None
    """Where the camera is, at mid clip if it moves, m; None = where it shows the objects."""
    look_at_m: tuple[float, float, float] | None = None
    """The point that it looks at from there, m."""
    field_of_view_deg: float | None = None
    """Horizontal; None = as usual."""

    @property
    def is_moving(self) -> bool:
        """Whether the camera moves."""
        return any(move.kind not in ("static", "dutch") for move in self.moves)


@dataclass(frozen=True)
class SceneLamp:
    """A point light at a fixed position, itself out of sight."""

    position_m: tuple[float, float, float]
    """x, y, z, m."""
    strength: float = 1.0
    """Light on a white surface that faces it at 1 m; 1 is full daylight."""
    colour: NamedColour | None = None
    """None = white."""
    frequency_hz: float | None = None
    """Frequency of its modulation, Hz; None = steady."""
    wave: str = "sine"
    """As `Illumination.wave`."""
    has_shadows: bool = False
    """Whether it casts shadows."""


@dataclass(frozen=True)
class Illumination:
    """Time of day and lamps."""

    kind: str | None = None
    """"day", "sunny", "overcast", "dusk", "dawn", "night", "moonlight" or "lamp"; None = not
    said."""
    flicker_hz: float | None = None
    """Frequency at which all light is modulated, Hz; None = steady."""
    wave: str = "sine"
    """How the flicker goes: "sine", "strobe" (short flashes in the dark) or "switch" (on and
    off)."""
    shadows: bool | None = None
    """Whether shadows are stated; None = the light's default."""
    tint: NamedColour | None = None
    """Its colour: "warm", "golden", "cold" or a named one; None = the light's default."""
    hardness: str | None = None
    """"soft" (no shadow has an edge) or "hard" (dark shadows); None = the light's default."""
    brightness: str | None = None
    """"bright", "gloomy" or "dim"; None = the light's default."""
    direction: str | None = None
    """Where it comes from, seen by the camera: "left", "right", "back", "front" or "above"; None =
    the light's default."""
    is_low: bool = False
    """Whether it comes from near the horizon."""
    lamps: tuple[SceneLamp, ...] = ()
    """Lamps beside those of the objects."""


@dataclass(frozen=True)
class Surroundings:
    """Where the scene is."""

    place: str | None = None
    """Key of `models.places.PLACES`; never None after
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
    wave_height: float = 1.0
    """Of waves on water, as `Environment.wave_height`."""


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
    is_timelapse: bool = False
    """Whether the sky goes much faster than in life."""
    is_grey: bool = False
    """Whether it is filmed in black and white."""
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

    @property
    def is_metric(self) -> bool:
        """Whether anything stands where metres say: nothing is then moved or enlarged."""
        return (
            self.shot.position_m is not None
            or any(one.distance_m is not None for one in self.relations)
            or any((one.position_m, one.height_m) != (None, None) for one in self.objects)
        )

    def summary(self) -> list[str]:
        """What will be shown, line by line, for a person to check.

        Example:
            >>> car = SceneObject("car", motion=ObjectMotion("drive", "left"))
            >>> SceneDescription("a left-driving car", objects=(car,)).summary()
            ['1 car, drives left', 'place: what suits the things', 'light: day', 'camera: static']
        """
        return self.report().lines()

    def report(self) -> PromptReport:
        """What becomes of the prompt's words, before the scene is staged.

        A word that is lost at one place of the prompt is not shown.
        """
        lost = {*self.not_understood, *(one.said for one in self.substituted)}
        return PromptReport(
            scene=describe(self),
            shown=tuple(one for one in self.shown if one not in lost),
            substituted=self.substituted,
            not_understood=self.not_understood,
            notes=self.notes,
        )
