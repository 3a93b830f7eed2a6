"""Lamps of objects: which glowing parts of a model give off light, where to, and how they blink.

A lamp is a part with emission: it stands where the part stands, has its colour, and gets brighter
and darker with it. This table says what kind of lamp it is.
"""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass
from types import MappingProxyType
from typing import Literal

Wave = Literal["square", "sine", "flame", "rotating"]
"""How a lamp's light goes up and down: on and off; as mains light does; as a flame does; as a beam
that turns."""


@dataclass(frozen=True)
class Lamp:
    """One kind of lamp."""

    intensity: float
    """Light it casts on a surface that faces it at 1 m, where full daylight is 1."""
    direction: tuple[float, float, float] | None = None
    """Where a beam points, in body coordinates; None = to all sides."""
    half_angle: float = 180.0
    """From the middle of the beam to where it has faded, degrees."""
    soft_share: float = 0.5
    """Share of the half angle over which it fades."""
    is_panel: bool = False
    """Whether it is a flat area that shines to one side by its cosine, without a halo: a screen."""
    glows: bool = True
    """Whether the camera sees a bright spot with a halo: not where flames are drawn."""
    always_on: bool = True
    """Whether it is usually on by day as well."""
    least_dark: float = 0.0
    """For what is not always on: strength of artificial light above which it is usually on."""
    blink_hz: float | None = None
    """How often it usually blinks; None = steady."""
    wave: Wave = "square"
    """How it blinks."""
    hue: str = ""
    """Which of a model's glowing parts it is: "white", "red", "blue", "amber", "green"; empty =
    any."""
    boost: float = 1.0
    """The glowing part is drawn this much brighter when the lamp is on."""
    is_single: bool = False
    """Whether only the first of its parts sheds light: the parts of one flame are one lamp."""
    haze_m: float = 0.0
    """How far its beam is seen from the side in the dark, m; 0 = it is not."""
    own_hz: float = 0.0
    """How often the model itself lets its part shine up and down each second."""
    turns_hz: float = 0.0
    """How often its beam turns round the upright axis each second."""


_NIGHT = 0.9
_HEAD = Lamp(
    60.0, (1.0, 0.0, -0.09), 32.0, 0.75, always_on=False, least_dark=_NIGHT, hue="white", boost=4.0
)
_TAIL = Lamp(
    0.35, (-1.0, 0.0, 0.0), 80.0, 1.0, always_on=False, least_dark=_NIGHT, hue="red", boost=3.0
)
_VEHICLE = (_HEAD, _TAIL)
_BEACONS = (
    Lamp(4.0, hue="blue", boost=2.0, own_hz=2.0),
    Lamp(4.0, hue="red", boost=2.0, own_hz=2.0),
)
_SCREEN = (Lamp(0.9, (1.0, 0.0, 0.0), 90.0, 1.0, is_panel=True),)

_BULB = Lamp(1.5, is_single=True, boost=3.0, wave="sine")
_STATUS = Lamp(0.0004, boost=1.2)
_CANDLE = Lamp(0.15, is_single=True, blink_hz=7.0, wave="flame", boost=1.5)

LAMPS: Mapping[str, tuple[Lamp, ...]] = MappingProxyType({
    **dict.fromkeys(("car", "open car", "suv", "van", "pickup", "truck", "bus", "taxi", "tractor",
                     "train", "motorcycle", "bicycle", "scooter", "forklift"), _VEHICLE),
    **dict.fromkeys(("police car", "fire engine"), (*_BEACONS, *_VEHICLE)),
    **dict.fromkeys(("street lamp", "park lamp"), (
        Lamp(26.0, is_single=True, always_on=False, boost=2.0, wave="sine"),)),
    "traffic light": (Lamp(0.6, (1.0, 0.0, 0.0), 80.0, 1.0, boost=2.0, own_hz=1.0),),
    "railway crossing": (Lamp(0.8, (1.0, 0.0, 0.0), 80.0, 1.0, boost=2.5, blink_hz=1.0,
                              wave="rotating"),),
    "barrier": (Lamp(0.4, boost=2.0, own_hz=1.0),),
    "buoy": (Lamp(1.0, boost=2.0, blink_hz=0.5),),
    "lamp": (Lamp(1.7, is_single=True, always_on=False, boost=2.0, wave="sine"),),
    "desk lamp": (Lamp(0.45, (0.0, 0.25, -1.0), 60.0, 0.6, boost=3.0, wave="sine"),),
    "light bulb": (_BULB,),
    "pendant lamp": (Lamp(0.9, is_single=True, boost=2.0, wave="sine"),),
    "chandelier": (Lamp(0.5, boost=2.0, wave="sine"),),
    "paper lantern": (Lamp(0.6, boost=1.5, wave="sine"),),
    "lava lamp": (Lamp(0.1, is_single=True, boost=1.5, wave="sine"),),
    "neon tube": (Lamp(0.6, boost=2.0, wave="sine"),),
    "lantern": (Lamp(0.7, is_single=True, boost=2.0, blink_hz=5.0, wave="flame"),),
    **dict.fromkeys(("candle", "candlestick", "cake", "lighter"), (_CANDLE,)),
    **dict.fromkeys(("campfire", "fireplace"), (
        Lamp(3.0, is_single=True, glows=False, blink_hz=6.0, wave="flame"),)),
    "torch": (Lamp(0.8, is_single=True, glows=False, blink_hz=6.0, wave="flame"),),
    "flashlight": (Lamp(30.0, (0.0, 1.0, 0.0), 16.0, 0.6, boost=4.0, haze_m=3.0),),
    "projector": (Lamp(20.0, (1.0, 0.0, 0.0), 18.0, 0.15, boost=4.0, haze_m=3.0),),
    "spotlight lamp": (Lamp(60.0, (1.0, 0.0, -0.12), 18.0, 0.4, boost=4.0, haze_m=8.0),),
    "lighthouse": (Lamp(3000.0, (1.0, 0.0, -0.03), 9.0, 0.8, boost=3.0, is_single=True,
                        turns_hz=0.2, haze_m=70.0),),
    "led": (Lamp(0.014, is_single=True, boost=1.2),),
    "led matrix": (Lamp(0.05, is_single=True, glows=False, boost=1.2),),
    **dict.fromkeys(("circuit board", "router", "printer", "video camera", "oven", "microwave"),
                    (_STATUS,)),
    **dict.fromkeys(("robot", "mobile robot", "robot vacuum", "toy robot", "microscope"),
                    (Lamp(0.02, boost=1.5),)),
    **dict.fromkeys(("tv", "monitor", "laptop", "cell phone", "tablet", "screen", "billboard",
                     "vending machine", "arcade machine", "game console"), _SCREEN),
    "drone": (Lamp(0.03, boost=2.0, blink_hz=1.5),),
    "airplane": (Lamp(0.5, boost=2.0, blink_hz=1.0),),
    "helicopter": (Lamp(0.5, boost=2.0, blink_hz=1.0),),
    "ufo": (Lamp(0.5, boost=2.0),),
    "rocket": (Lamp(60.0, is_single=True, boost=2.0, blink_hz=9.0, wave="flame"),),
    "hot air balloon": (Lamp(20.0, boost=2.0, blink_hz=4.0, wave="flame"),),
    "meteor": (Lamp(20.0, is_single=True, boost=2.0, blink_hz=9.0, wave="flame"),),
    "firework": (Lamp(10.0, is_single=True, glows=False),),
    "volcano": (Lamp(900.0, is_single=True, glows=False, boost=1.5, blink_hz=0.7, wave="flame"),),
})  # fmt: skip
"""Noun → its lamps; a part takes the first whose hue suits its colour."""


def hue_of(colour: tuple[float, float, float]) -> str:
    """Name of a lamp colour: "white", "red", "amber", "green" or "blue".

    Example:
        >>> hue_of((0.95, 0.92, 0.75)), hue_of((0.7, 0.02, 0.02)), hue_of((0.9, 0.5, 0.05))
        ('white', 'red', 'amber')
    """
    red, green, _ = colour
    top = max(colour)
    if min(colour) > 0.35 * top:
        return "white"
    if red == top:
        return "amber" if green > 0.35 * red else "red"
    return "green" if green == top else "blue"


def lamp_of(noun: str, colour: tuple[float, float, float]) -> Lamp | None:
    """The lamp that a glowing part of that colour is, if any."""
    hue = hue_of(colour)
    return next((lamp for lamp in LAMPS.get(noun, ()) if lamp.hue in ("", hue)), None)
