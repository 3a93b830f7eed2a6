"""Scenes as values: objects, effects, camera, light and place, in SI units.

    scene = Scene(light=Light("dusk"))
    scene += SceneObject("car", motions=[Motion("drive", "left")])
    scene += SceneObject("tree", count=2)

Only nouns and kinds are required: a field that is left out leaves the choice to the generator.
Lists and tables do for fields, as in files; `+=` checks them.
Files, errors and the JSON schema follow from these classes: a field's type says what it takes, and
the text under it is its description.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, field
from typing import Annotated, Any, Literal, Self, TypeAlias, cast

from texvent.errors import ConfigError, shown
from texvent_scenes.spec.limits import Between, Colour, Word
from texvent_scenes.spec.tables import build_table, explain_fields, plain_values

MAX_BODIES = 60
"""Most bodies in a scene: objects with all their copies."""
MAX_LAMPS = 16
"""Most lamps at positions of their own."""

Count: TypeAlias = Annotated[int, Between(1, MAX_BODIES)]
Seconds: TypeAlias = Annotated[float, Between(0.0, 86_400.0)]
Hertz: TypeAlias = Annotated[float, Between(0.001, 100_000.0)]
MetresPerSecond: TypeAlias = Annotated[float, Between(0.0, 1000.0)]
Metres: TypeAlias = Annotated[float, Between(0.0, 10_000.0)]
Coordinate: TypeAlias = Annotated[float, Between(-10_000.0, 10_000.0)]
Pace: TypeAlias = Annotated[float, Between(0.0, 100.0)]
Surface: TypeAlias = Annotated[str, Colour("surface")]

Direction: TypeAlias = Literal[
    "left", "right", "towards", "away", "forward", "backward", "up", "down", "across",
    "to and fro", "up and down", "around", "clockwise", "counter-clockwise", "diagonal",
]  # fmt: skip
RelationKind: TypeAlias = Literal[
    "on", "in", "at", "above", "under", "behind", "front", "beside", "left of", "right of",
    "between", "around",
    "past", "overtake", "through", "towards", "away from", "from", "from behind", "follow",
    "with", "to", "into", "out of", "off", "up", "down",
    "hold", "wear", "ride", "push", "kick", "throw", "roll", "lift", "set down", "drop",
    "collide", "knock over", "catch", "hit", "pull", "act on", "move over", "rally",
]  # fmt: skip
Material: TypeAlias = Literal[
    "wood", "brick", "stone", "marble", "concrete", "metal", "brass", "glass", "plastic",
    "ceramic", "cloth", "leather", "rubber", "paper", "rust", "ice",
    "striped", "checkered", "spotted",
]  # fmt: skip
Placement: TypeAlias = Literal["left", "right", "centre", "far", "near", "lane"]
MoveKind: TypeAlias = Literal[
    "static", "pan", "tilt", "roll", "zoom", "dolly", "truck", "pedestal", "orbit", "follow",
    "handheld", "travel",
]  # fmt: skip
MoveDirection: TypeAlias = Literal[
    "left", "right", "up", "down", "in", "out", "clockwise", "counter-clockwise", "forward",
    "backward", "all axes",
]  # fmt: skip
Waveform: TypeAlias = Literal["sine", "strobe", "switch"]
View: TypeAlias = Literal["aerial", "top", "low", "first person", "side", "front", "back"]


@dataclass(frozen=True)
class Motion:
    """A motion or an activity of an object."""

    kind: Annotated[str, Word("motion")]
    """Motion ("drive", "spin", "bounce") or activity ("wave", "play guitar"); "move" is the usual
    motion of the noun, "stand" is rest."""
    direction: Direction | None = None
    """Direction of travel as the camera sees it. Of a turn, left and right are the driver's,
    "towards" and "away" where it heads then. Clockwise is as seen from above, of wheels and
    pictures as the camera sees them."""
    pace: Pace = 1.0
    """Speed as a multiple of the usual speed."""
    end_pace: Pace | None = None
    """Pace at the end, for acceleration (above `pace`) and braking (0 = rest)."""
    speed_m_s: MetresPerSecond | None = None
    """Speed, m/s; it takes the place of `pace`."""
    rate_hz: Hertz | None = None
    """Repetitions per second: of an oscillation ("sway", "tilt", to and fro), turns of a spin."""
    start_s: Seconds | None = None
    """Start time, s; left out: time 0, or the end of the motion before. An act of the arms that
    starts at 0 after a walk is done on the way."""

    @property
    def is_moving(self) -> bool:
        """Whether the object leaves its place or turns."""
        return self.kind not in ("stand", "hang", "stand open", "stand closed")


@dataclass(frozen=True)
class Relation:
    """A position or an action of an object with respect to others."""

    kind: RelationKind
    """Position ("on", "left of"), route ("past", "follow") or action ("hold", "kick")."""
    to: tuple[str, ...]
    """Ids of the other objects; its own id stands for the copies of a group among each other."""
    distance_m: Metres | None = None
    """Distance on the ground at time 0, m, from middle to middle, of "left of", "right of",
    "front", "behind" and "beside"; along the way of "follow"."""


@dataclass(frozen=True)
class Picture:
    """A texture image on a flat object: a poster, a page, a screen."""

    kind: Literal["file", "checkerboard", "text", "tag"]
    """Source of the texture."""
    value: str
    """Path of an image or video, which a scene file may give relative to its own folder; columns
    and rows of squares, such as "9x6"; the text; or the id of an AprilTag of the family 36h11, 0 to
    586, from which the copies count on."""


@dataclass(frozen=True)
class OwnPart:
    """Number and colour of parts that a body has itself: candles of a cake, blades of a fan."""

    name: str
    """Kind of part, in the plural if there may be several: "candles", "blades", "roof"."""
    count: Count | None = None
    """Number of them; left out: the usual one."""
    colour: Surface | None = None
    """Colour of their surface; left out: the usual one."""


@dataclass(frozen=True)
class SceneObject:
    """A body of the scene, or several copies of it."""

    noun: Annotated[str, Word("noun")]
    """Model: a noun of `texvent scenes`, or of a folder of your own models; any word beside
    `model`."""
    model: str | None = None
    """Path of a model of your own (GLB, OBJ, PLY), which a scene file may give relative to its own
    folder; all objects of one noun share it."""
    id: str = ""
    """Name for relations, and in the truth; left out: the noun, and a number from its second object
    on ("tree 2")."""
    count: Count = 1
    """Number of copies."""
    colour: Surface | None = None
    """Colour of the surface: a name ("red", "dark green") or an sRGB code ("#ff8000")."""
    size: Annotated[float, Between(0.01, 100.0)] = 1.0
    """Scale, as a multiple of the usual size."""
    material: Material | None = None
    """Material of the surface."""
    second_colour: Surface | None = None
    """Other colour of a striped, checkered or spotted surface; left out: one that contrasts."""
    placement: Placement | None = None
    """Region of the image ("left", "right", "centre", "far", "near") or the road ("lane"); of what
    flies, above the road or the water."""
    motions: tuple[Motion, ...] = ()
    """Motions in their order; left out: the usual one where nothing else moves, else rest."""
    relations: tuple[Relation, ...] = ()
    """Relations to other objects."""
    parts: tuple[OwnPart, ...] = ()
    """Parts of its own whose number or colour is not the usual one; its noun says which it has."""
    picture: Picture | None = None
    """Texture image; left out: what the noun usually shows, of each AprilTag another id."""
    blink_hz: Hertz | None = None
    """Frequency of its own lamp, on and off, Hz."""
    switch_s: Seconds | None = None
    """Time at which its lamps are switched, s: from then on they are on, or off where `is_lit` is
    false; until then the other way round."""
    is_lit: bool | None = None
    """Whether its lamps are on; left out: headlights at night, candles always."""
    position_m: tuple[Coordinate, Coordinate] | None = None
    """Position of the (first) copy on the ground at time 0, m: x to the right, y away from the
    default camera."""
    height_m: Metres | None = None
    """Height of its lowest point above the ground at time 0, m; what falls or bounces starts there
    and comes down to the ground."""
    heading_deg: Annotated[float, Between(-360.0, 360.0)] | None = None
    """Heading, degrees anticlockwise seen from above: 0 = right (x), 90 = away (y); it takes the
    place of a motion's direction of travel; what spins begins at it. Left out, boards and
    calibration targets at rest face the camera."""

    @property
    def motion(self) -> Motion | None:
        """The first of its motions; None: not stated."""
        return self.motions[0] if self.motions else None


@dataclass(frozen=True)
class Effect:
    """A particle effect: smoke, sparks, rain of leaves."""

    kind: Annotated[str, Word("effect")]
    """Kind of particles."""
    source: str | None = None
    """Id of the object that it comes from; left out: all around, or the middle of the scene."""
    start_s: Seconds | None = None
    """Start time, s; left out: that of its phase, or the first half for what happens once."""
    phase: Annotated[int, Between(0, 100)] = 0
    """Number of the phase in which it begins; phases share the clip evenly."""


@dataclass(frozen=True)
class CameraMove:
    """A camera move."""

    kind: MoveKind
    """Kind of move; "travel" is ego-motion along the road or through the place."""
    direction: MoveDirection | None = None
    """Direction of the move. An orbit is clockwise as seen from above, which takes the camera to
    the left; a roll as who stands behind the camera sees it turn."""
    pace: Pace = 1.0
    """Speed as a multiple of the usual speed."""
    phase: Annotated[int, Between(0, 100)] = 0
    """Number of the phase: moves of one phase happen together, phases share the clip evenly."""
    start_s: Seconds | None = None
    """Start time, s; left out: that of its phase."""
    duration_s: Annotated[float, Between(0.001, 86_400.0)] | None = None
    """Duration, s; left out: to the end of its phase, or of the clip if it has a start time."""
    means: Literal["drive", "cycle", "walk", "run", "fly", "sail", "swim"] | None = None
    """Vehicle or gait of travel."""
    speed_m_s: MetresPerSecond | None = None
    """Speed of "travel", "dolly", "truck" and "pedestal", m/s; it takes the place of `pace`."""
    rate_deg_s: Annotated[float, Between(0.0, 10_000.0)] | None = None
    """Degrees per second: of turning, of "pan", "tilt", "roll" and "orbit"; by which the field of
    view changes, of "zoom"; it takes the place of `pace`."""


@dataclass(frozen=True)
class Camera:
    """The camera: its moves, viewpoint and framing."""

    moves: tuple[CameraMove, ...] = ()
    """Moves, which add up; left out: a static camera if anything else changes the image."""
    view: View | None = None
    """Viewpoint; left out: a little above eye level."""
    framing: Literal["close", "medium", "full", "wide"] | None = None
    """Size of the subject in the image; left out: all objects fit."""
    target: str | None = None
    """Id of the object that the camera looks at or follows; left out: the first one."""
    position_m: tuple[Coordinate, Coordinate, Metres] | None = None
    """Position x, y, z at time 0, m, given with `look_at_m`, without `target` and "travel"; moves
    begin there."""
    look_at_m: tuple[Coordinate, Coordinate, Coordinate] | None = None
    """Point on the optical axis, m."""
    field_of_view_deg: Annotated[float, Between(1.0, 150.0)] | None = None
    """Horizontal field of view of the lens, degrees."""

    @property
    def is_moving(self) -> bool:
        """Whether the camera moves."""
        return any(move.kind != "static" for move in self.moves)


@dataclass(frozen=True)
class Lamp:
    """A point light at a fixed position, itself out of sight."""

    position_m: tuple[Coordinate, Coordinate, Metres]
    """Position x, y, z, m."""
    strength: Annotated[float, Between(0.0, 10_000.0)] = 1.0
    """Light on a white surface that faces it at 1 m, as a multiple of that surface in full
    daylight; it falls with the square of the distance. Usual at night: 0.02
    (a candle), 1 (a lamp at the ceiling), 5 (a street lamp 5 m up); in a room 5 bleaches."""
    colour: Annotated[str, Colour("light")] | None = None
    """Colour: "warm", "cold", a name or an sRGB code; left out: white."""
    frequency_hz: Hertz | None = None
    """Frequency of modulation, Hz; left out: steady."""
    wave: Waveform = "sine"
    """Waveform of the modulation: "strobe" is short flashes, "switch" on and off."""
    has_shadows: bool = False
    """Whether objects cast shadows in its light; four lamps of a scene can at most."""


@dataclass(frozen=True)
class Light:
    """Illumination of the scene."""

    kind: Literal[
        "day", "sunny", "overcast", "stormy", "morning", "afternoon", "dusk", "dawn", "night",
        "moonlight", "lamp"
    ] | None = None  # fmt: skip
    """Time of day or main light source; left out: day, or what the place has. In the "morning" and
    the "afternoon" the sun is low; "stormy" is dark clouds."""
    flicker_hz: Hertz | None = None
    """Frequency at which all light is modulated, Hz."""
    wave: Waveform = "sine"
    """Waveform of the flicker: "strobe" is short flashes, "switch" on and off."""
    lamps: tuple[Lamp, ...] = ()
    """Lamps beside those of the objects; at most 16."""


@dataclass(frozen=True)
class Place:
    """Ground, sky and weather around the objects."""

    name: Annotated[str, Word("place")] | None = None
    """Place, such as "road", "kitchen" or "plain" (an even ground: no grain gives events); left
    out: the usual one of the objects. Bays of a car park lie around the vehicles that stand
    there."""
    colour: Surface | None = None
    """Colour of an even ground."""
    sky: Surface | None = None
    """Colour of the sky."""
    weather: Literal["fog", "haze", "rain", "snow"] | None = None
    """Weather; left out: fair."""
    weather_amount: Annotated[float, Between(0.2, 5.0)] = 1.0
    """Rain, snow or fog, as a multiple of the usual amount."""
    clouds: Annotated[float, Between(0.0, 1.0)] | None = None
    """Cloud cover, 0 (clear) to 1 (covered)."""
    backdrops: tuple[Literal["mountain", "forest", "city"], ...] = ()
    """Scenery on the horizon."""
    road: Literal["crossing"] | None = None
    """Another road that crosses the straight one."""
    road_m: tuple[Coordinate, Coordinate] | None = None
    """Point on the middle of the road, m; left out: beside its first vehicle, in whose right lane
    that is. The report says where it is."""
    road_heading_deg: Annotated[float, Between(-360.0, 360.0)] | None = None
    """Direction of the road, degrees anticlockwise from x; left out: that of its first vehicle."""
    crossing_m: tuple[Coordinate, Coordinate] | None = None
    """Crossing of the roads, at right angles, m; off the road, a point on the other one. Left out:
    where its first vehicle turns, or in view, as near as can be to 7 m along the road from it."""
    is_empty: bool = False
    """Whether scenery and furniture are left out; walls with their windows and pictures, lines on
    the ground, tracks and `backdrops` stay."""
    is_lit: bool = False
    """Whether the lamps and screens of a room are on at night and by moonlight; left out: only
    lamps of the scene are."""
    has_snow: bool = False
    """Whether snow lies on the ground."""
    is_wet: bool | None = None
    """Whether the ground is wet, as after rain; left out: where it rains."""
    wave_height: Annotated[float, Between(0.0, 20.0)] = 1.0
    """Height of water waves, as a multiple of those in a light breeze."""


Part: TypeAlias = SceneObject | Effect | Lamp | Camera | Light | Place
"""Part of a scene."""


@dataclass(frozen=True)
class Scene:
    """A scene of the embedded generator."""

    prompt: str = ""
    """Sentence that describes the scene; stored with its events."""
    objects: tuple[SceneObject, ...] = ()
    """Bodies, the subject first."""
    effects: tuple[Effect, ...] = ()
    """Particle effects."""
    camera: Camera = field(default_factory=Camera)
    """Camera."""
    light: Light = field(default_factory=Light)
    """Illumination."""
    place: Place = field(default_factory=Place)
    """Surroundings."""
    absent: tuple[Annotated[str, Word("noun")], ...] = ()
    """Nouns that no scenery may show; of people or traffic, one stands for all."""

    file_name = ""  # without a type, so no field: that of the file it was read from, for errors

    def __add__(self, part: Part) -> Self:
        """The scene with one more object, effect or lamp, or with another camera, light or place.

        Another light has the lamps of the one before as well.

        Raises:
            ConfigError: it is something else, or a field is wrong; the message is that of a file.

        Example:
            >>> scene = Scene()
            >>> scene += SceneObject("mug", position_m=(0, 0))
            >>> scene += Lamp((0, 0, 3))
            >>> scene += Light("dusk")
            >>> scene.objects[0].noun, scene.light.kind, len(scene.light.lamps)
            ('mug', 'dusk', 1)
        """
        if type(part) not in _PLACES:
            names = [one.__name__ for one in _PLACES]
            raise ConfigError(f"{shown(part)} is no part of a scene; add one of {', '.join(names)}")
        # Checked before it is added to: its own lists may be anything.
        data = plain_values(build_table(Scene, plain_values(self), "", {}))
        *way, name, is_list = _PLACES[type(part)]
        table = data.setdefault(way[0], {}) if way else data
        new = plain_values(part)
        if isinstance(part, Light):  # the lamps that were added before stay
            new["lamps"] = [*data.get("light", {}).get("lamps", ()), *new.get("lamps", ())]
        table[name] = [*table.get(name, ()), new] if is_list else new
        return cast(Self, build_table(Scene, data, "", {}))


_PLACES: dict[type, tuple[Any, ...]] = {
    SceneObject: ("objects", True),
    Effect: ("effects", True),
    Lamp: ("light", "lamps", True),
    Camera: ("camera", False),
    Light: ("light", False),
    Place: ("place", False),
}
"""Part of a scene → path of its field, and whether that is a list."""


for _owner in (*_PLACES, Motion, Relation, OwnPart, Picture, CameraMove, Scene):
    explain_fields(_owner)


def object_ids(scene: Scene) -> tuple[str, ...]:
    """The id of every object: its own, or its noun, numbered from the second one on.

    Example:
        >>> tree = SceneObject(noun="tree")
        >>> object_ids(Scene(objects=(tree, SceneObject(noun="car", id="taxi"), tree)))
        ('tree', 'taxi', 'tree 2')
    """
    names = number_nouns([one.noun for one in scene.objects])
    return tuple(one.id or name for one, name in zip(scene.objects, names, strict=True))


def number_nouns(nouns: Sequence[str]) -> tuple[str, ...]:
    """Ids of objects without one of their own.

    Example:
        >>> number_nouns(["tree", "car", "tree"])
        ('tree', 'car', 'tree 2')
    """
    counts = [nouns[: n + 1].count(noun) for n, noun in enumerate(nouns)]
    return tuple(
        noun if count == 1 else f"{noun} {count}" for noun, count in zip(nouns, counts, strict=True)
    )
