"""How things are held and worn: a table of nouns, and defaults from their size for all others."""

from __future__ import annotations

import math
from collections.abc import Iterable, Mapping
from dataclasses import dataclass, replace
from types import MappingProxyType

import numpy as np

from texvent.scenes.description import Relation
from texvent.scenes.models.objects.toys import KITE_TURN_RAD
from texvent.scenes.models.people.activities import PERSON_NOUNS
from texvent.scenes.models.people.outfit import CLOTHES
from texvent.scenes.models.protocol import Model, Pose
from texvent.scenes.models.shapes import Affine
from texvent.scenes.models.support_surface import top_heights
from texvent.scenes.scene import Float64Array
from texvent.scenes.staging.actors import Actor
from texvent.scenes.staging.trajectories.trajectory import Vector, rotation

Grips = tuple[tuple[str, Vector], ...]


@dataclass(frozen=True)
class Hold:
    """How one thing is held."""

    style: str
    """"tool" (along what the right hand holds), "upright" (in the raised right hand), "hanging"
    (from a hand at the side), "front" (in both arms), "string" (floats above the hand),
    "kite" (flies above), "glove" (on the left hand), "page" (flat before the chest), "guitar",
    "mouth", or the name of a place it is worn at."""
    activity: str | None = None
    """What a person who only stands does with it."""


_TOOLS = (
    "baseball bat", "tennis racket", "golf club", "sword", "broom", "mop", "shovel", "spade",
    "hammer", "axe", "knife", "fork", "spoon", "stick", "rod", "fishing rod", "cricket bat",
    "hockey stick", "badminton racket", "rake", "pitchfork", "sledgehammer", "mallet", "saw",
    "ping-pong paddle", "brush", "paintbrush", "toothbrush", "scissors", "pen", "pencil",
    "screwdriver", "wrench", "flashlight", "wand", "magnifying glass", "hair drier", "remote",
    "arrow", "pool cue", "branch",
)  # fmt: skip
_UPRIGHTS = (
    "umbrella", "flag", "candle", "sign", "flower", "bouquet", "cup", "mug", "bottle", "glass",
    "wine glass", "ice cream", "lamp", "trophy", "vase", "apple", "banana", "orange", "sandwich",
    "donut", "lollipop", "key", "soda can", "beer glass", "rose", "tulip", "hot dog", "hamburger",
    "cupcake", "microphone", "leaf", "feather", "clock", "ball", "tennis ball", "torch",
    "lantern", "fan",
)  # fmt: skip
_HANGING = (
    "bag", "handbag", "suitcase", "bucket", "basket", "briefcase", "shopping bag", "watering can",
    "kettle", "guitar case", "toolbox",
)  # fmt: skip
HOLDS: Mapping[str, Hold] = MappingProxyType(
    {
        **{noun: Hold("tool") for noun in _TOOLS},
        **{noun: Hold("upright") for noun in _UPRIGHTS},
        **{noun: Hold("hanging") for noun in _HANGING},
        "baseball glove": Hold("glove"),
        "balloon": Hold("string"),
        "hot air balloon": Hold("kite"),
        "kite": Hold("kite"),
        "broom": Hold("tool", "sweep"),
        "shovel": Hold("tool", "dig"),
        "fishing rod": Hold("tool", "fish"),
        **{noun: Hold("page", "read") for noun in ("book", "newspaper", "map", "page")},
        **{noun: Hold("page") for noun in ("closed book", "tablet", "laptop", "tray", "card")},
        **{
            noun: Hold("guitar", "play guitar") for noun in ("guitar", "electric guitar", "ukulele")
        },
        "cell phone": Hold("upright", "text"),
    }
)
"""Noun → how it is held or carried."""


@dataclass(frozen=True)
class Wear:
    """Where one thing is worn."""

    place: str
    """Place of the wearer."""
    shift: Vector = (0.0, 0.0, 0.0)
    """From there to the bottom of the thing's middle, m."""
    pitch: float = 0.0
    """How far it is tipped forward, radians."""
    yaw: float = 0.0


WORN: Mapping[str, Wear] = MappingProxyType(
    {
        **dict.fromkeys(("hat", "cap"), Wear("crown", (-0.01, 0.0, -0.055))),
        "helmet": Wear("crown", (-0.01, 0.0, -0.11)),
        "crown": Wear("crown", (-0.02, 0.0, -0.045)),
        "glasses": Wear("face", (-0.10, 0.0, -0.02)),
        "mask": Wear("face", (-0.02, 0.0, -0.135)),
        "headphones": Wear("head", (0.0, 0.0, -0.06)),
        "scarf": Wear("neck", (0.0, 0.0, -0.36)),
        "tie": Wear("torso", (0.15, 0.0, 0.24), 0.5 * math.pi),
        "vest": Wear("torso", (0.0, 0.0, 0.02)),
        "backpack": Wear("torso", (-0.25, 0.0, 0.02), 0.0, math.pi),
        **dict.fromkeys(("shoe", "boot", "sandal", "high heel"), Wear("foot", (-0.11, 0.0, -0.07))),
        "glove": Wear("hand"),
    }
)
"""Noun → where it is worn; of a pair of feet or hands, one on each."""
GARMENTS = frozenset(CLOTHES)
"""What the body's own clothes show."""
IN_ITS_COLOUR = frozenset({"shirt", "jacket", "coat", "dress", "robe", "sweater", "hoodie",
                           "wetsuit", "suit", "pyjamas"})  # fmt: skip
"""Those of them that give their colour to the shirt."""

HELD_SCALE: Mapping[str, float] = MappingProxyType({"flag": 0.3, "sign": 0.45, "branch": 0.75})
"""Noun → size of what is carried relative to what stands on the ground."""
LARGE_M = 0.36
"""What is larger is held in both arms."""
_RAISED: Vector = (0.30, -0.24, 1.16)
"""Right hand of who holds something up, adult's body coordinates."""
_GLOVED: Vector = (0.30, 0.22, 1.22)
_UP_HIGH: Vector = (0.24, -0.24, 1.55)


def each_worn(relations: Iterable[Relation]) -> list[Relation]:
    """Each of several things that one wears with a relation of its own."""
    found: list[Relation] = []
    for one in relations:
        targets = one.targets if one.kind == "wear" else ()
        found += [replace(one, targets=(target,)) for target in targets] or [one]
    return found


def is_person(actor: Actor) -> bool:
    """Whether it has hands."""
    return actor.noun.name in PERSON_NOUNS


def size_of(model: Model) -> float:
    """Scale of a model: 1 = the usual size."""
    return float(getattr(model, "scale", 1.0))


def choose_hold(holder: Actor, thing: Actor) -> Hold:
    """How a thing is held: as the table says, else by its size and by who holds it."""
    if not is_person(holder):
        return Hold("mouth")
    if thing.noun.name in HOLDS:
        return HOLDS[thing.noun.name]
    model = thing.model
    large = max(model.length, model.width, model.height) > LARGE_M
    if thing.noun.habitat == "air" and large and thing.noun.motion == "fly":
        return Hold("front")
    return Hold("front" if large else "upright")


def place_in_hold(hold: Hold, holder: Actor, thing: Actor) -> tuple[str, Affine, bool, Grips]:
    """Anchor, offset, whether it stays upright, and where the holder's hands are.

    Args:
        hold: how it is held.
        holder: who holds it.
        thing: what is held.

    Returns:
        Name of the holder's place, [3, 4] the thing's body coordinates in its axes, whether it
        stays upright, and the grips in the holder's body coordinates, m.
    """
    size, model = size_of(holder.model), thing.model
    lift = 0.5 * model.height if thing.is_centred else 0.0
    if holder.trajectory.at(0.0).activity == "lift":
        # A barbell lies across both hands and goes up with them.
        turn = rotation(0.5 * math.pi if model.length > model.width else 0.0, 0.0, 0.0)
        place = np.array([0.03, 0.0, lift - 0.5 * model.height])
        return "hands", np.column_stack([turn, place]), True, ()
    if hold.style == "tool":
        grips = (("right hand", _scaled(_RAISED, size)),)
        return "right hand", along_tool(thing, lift), False, grips
    if hold.style == "page":
        return _page(size, model, lift)
    if hold.style in ("guitar", "glove"):
        return _guitar(size) if hold.style == "guitar" else _on_left_hand(size)
    if hold.style == "upright":
        return _upright(holder, thing, size, lift)
    if hold.style == "hanging":
        return "right hand", _shifted(0.0, 0.0, lift - model.height + 0.02), True, ()
    if hold.style in ("string", "kite"):
        grips = (("right hand", _scaled(_UP_HIGH if hold.style == "kite" else _RAISED, size)),)
        return "right hand", _fly(hold.style, holder, lift), True, grips
    if hold.style == "mouth":
        drop = 0.0 if thing.is_centred else -0.5 * model.height
        return "mouth", _shifted(0.35 * model.length, 0.0, drop), False, ()
    if hold.style == "front":
        return _hold_in_front(holder, thing, size, lift)
    return hold.style, _shifted(0.0, 0.0, lift), False, ()


def _upright(
    holder: Actor, thing: Actor, size: float, lift: float
) -> tuple[str, Affine, bool, Grips]:
    """In the raised right hand, upright."""
    model = thing.model
    grip = _UP_HIGH if thing.noun.name in ("flag", "sign", "torch") else _RAISED
    low = min(0.35 * model.height, 0.06)
    if thing.noun.name == "umbrella":
        low = _CROOK_M
    elif holder.trajectory.at(0.0).activity == "drink":
        low = _RIM * model.height
    x = 0.5 * model.length if model.height < 1.6 * model.length else 0.0
    offset = _shifted(min(x, 0.06), 0.0, lift - low)
    return "right hand", offset, True, (("right hand", _scaled(grip, size)),)


def _on_left_hand(size: float) -> tuple[str, Affine, bool, Grips]:
    """A glove upright on the raised left hand, its pocket ahead."""
    turn = rotation(0.0, 0.5 * math.pi, 0.0)
    offset = np.column_stack([turn, np.array([0.0, 0.0, 0.08])])
    return "left hand", offset, True, (("left hand", _scaled(_GLOVED, size)),)


_RIM = 0.8
"""Share of its height at which one holds what one drinks from, so that its rim is at the mouth."""
_CROOK_M = 0.12
"""From the end of an umbrella's handle to the hand, m."""


def _hold_in_front(
    holder: Actor, thing: Actor, size: float, lift: float
) -> tuple[str, Affine, bool, Grips]:
    """Both arms around it; its longer side goes across."""
    model = thing.model
    is_alive = thing.noun.motion in ("walk", "run", "crawl", "jump")
    is_long = model.length > 1.2 * model.width
    deep, wide = (model.width, model.length) if is_long else (model.length, model.width)
    ahead = 0.16 * size + 0.5 * deep
    middle = 1.08 * size
    reach = min(0.5 * wide, 0.34 * size)
    x = min(ahead, 0.42 * size)
    bottom = max(middle - 0.5 * model.height, 0.75 * size)
    hand_z = min(max(bottom + 0.15 * model.height, 0.9 * size), 1.25 * size)
    turn = rotation(0.5 * math.pi if is_long else 0.0, 0.0, 0.0)
    offset = np.column_stack([turn, np.array([ahead, 0.0, bottom + lift])])
    grips = (("left hand", (x, reach, hand_z)), ("right hand", (x, -reach, hand_z)))
    if is_alive:
        # One arm below it, the other one about it.
        x = min(ahead + 0.3 * deep, 0.42 * size)
        low = max(bottom + 0.18 * model.height, 0.88 * size)
        high = min(bottom + 0.55 * model.height, 1.25 * size)
        grips = (("left hand", (x, -0.02 * size, low)), ("right hand", (x, 0.03 * size, high)))
    return "ground", offset, True, grips


def _fly(style: str, holder: Actor, lift: float) -> Affine:
    """Above the hand at the end of a string; a kite shows its face to the camera's side.

    It trails behind who goes on, and is beside who stands; along the axes of the world.
    """
    if style == "string":
        return _shifted(0.0, 0.0, lift - 0.02)
    yaw = holder.trajectory.at(0.0).yaw
    along = (-math.cos(yaw), -math.sin(yaw)) if holder.is_mover else (1.0, 0.2)
    size = size_of(holder.model)
    place = np.array([size * along[0], size * along[1], 0.8 * size + lift])
    return np.column_stack([rotation(0.3 - 0.5 * math.pi - KITE_TURN_RAD, 0.0, 0.0), place])


def _shifted(x: float, y: float, z: float) -> Affine:
    return np.column_stack([np.eye(3), np.array([x, y, z])])


def _scaled(point: Vector, size: float) -> Vector:
    return (size * point[0], size * point[1], size * point[2])


def shoulder_height(actor: Actor) -> float:
    """Height of a person's shoulders, m; of another model three quarters of its height."""
    return 1.38 * size_of(actor.model) if is_person(actor) else 0.75 * actor.model.height


def arm_reach(actor: Actor, height_m: float) -> float:
    """How far ahead of its middle a pusher's hands are at that height, m."""
    if not is_person(actor):
        return 0.5 * actor.model.length
    size = size_of(actor.model)
    drop = 1.34 - height_m / size
    return size * (0.10 + math.sqrt(max(_STRETCH**2 - drop**2, 0.04)))


_STRETCH = 0.60
"""From the shoulder to the palm of an arm that is nearly straight, m."""


def offset_of_worn(wear: Wear, wearer: Actor, thing: Actor) -> Float64Array:
    """[3, 4] a worn thing's body coordinates in the axes of its place."""
    size = size_of(wearer.model)
    lift = 0.5 * thing.model.height if thing.is_centred else 0.0
    turn = rotation(wear.yaw, wear.pitch, 0.0)
    x, y, z = _scaled(wear.shift, size)
    return np.column_stack([turn, np.array([x, y, z + lift])])


def along_tool(thing: Actor, lift: float) -> Affine:
    """What lies along its x: the handle in the hand, the rest along what the hand points to."""
    model = thing.model
    if model.width > 2.0 * max(model.length, model.height):
        # What lies along its y: a stick.
        return np.column_stack(
            [rotation(0.0, 0.0, 0.5 * math.pi), np.array([0.0, 0.0, 0.36 * model.width])]
        )
    if model.length < 2.0 * model.height:
        return _shifted(0.0, 0.0, lift - 0.12 * model.height)
    sign = _handle_side(model) * (-1.0 if thing.noun.name in _GUARDED else 1.0)
    turn = rotation(0.0, 0.5 * math.pi * sign, 0.0)
    middle = 0.38 * model.length
    return np.column_stack([turn, np.array([0.0, 0.0, middle])])


_GUARDED = frozenset({"sword"})
"""What is wider at its handle."""


def _handle_side(model: Model) -> float:
    """+1 where the handle, the thinner half, is at +x, else -1."""
    parts = model.parts(Pose(0.0, 0.0, 0.0, "stand"))
    along = np.linspace(0.30, 0.48, 7) * model.length
    across = np.linspace(0.0, 0.5, 24) * model.width
    spread = []
    for sign in (1.0, -1.0):
        x, y = (axis.ravel() for axis in np.meshgrid(sign * along, across))
        spread.append(int(np.isfinite(top_heights(parts, x, y)).sum()))
    return 1.0 if spread[0] < spread[1] else -1.0


def _page(size: float, model: Model, lift: float) -> tuple[str, Affine, bool, Grips]:
    """A flat thing before the chest, its face to the holder."""
    turn = rotation(0.0, -1.0, 0.0)
    reach = min(0.45 * model.width, 0.22 * size)
    place = np.array([0.42 * size, 0.0, 1.16 * size])
    grips = (("left hand", (0.38 * size, reach, 1.12 * size)),
             ("right hand", (0.38 * size, -reach, 1.12 * size)))  # fmt: skip
    return "ground", np.column_stack([turn, place]), True, grips


def _guitar(size: float) -> tuple[str, Affine, bool, Grips]:
    """Across the chest, the neck up to the left hand."""
    place = size * np.array([0.20, -0.42, -0.08])
    return "torso", np.column_stack([rotation(0.0, 0.0, -1.05), place]), False, ()
