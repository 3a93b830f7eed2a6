"""What a noun group means."""

from __future__ import annotations

from dataclasses import dataclass, field

from texvent.scenes.language.grammar.syntax import NounGroup
from texvent.scenes.language.meaning.adjectives import Attributes
from texvent.scenes.language.words.lexicon import Role

KIND_OF_ROLE = {
    Role.CAMERA: "camera", Role.UNIT: "unit", Role.EFFECT: "effect", Role.PART: "part",
    Role.PICTURE: "picture", Role.FUNCTION: "function", Role.PLACE: "place", Role.LIGHT: "light",
    Role.WEATHER: "weather", Role.SKY: "sky", Role.SNOW: "snow", Role.DUST: "dust",
    Role.SHADOW: "shadow", Role.GLOW: "glow", Role.CLOUDS: "clouds", Role.STEEP: "place",
    Role.WAVES: "waves", Role.FLICKER: "flicker", Role.CAMERA_MOVE: "camera", Role.VIEW: "camera",
    Role.FRAMING: "camera",
}  # fmt: skip
"""Role of a head → kind of referent."""


@dataclass
class Referent:
    """What a noun group means."""

    kind: str
    """"things", "camera", "function" (a shot, a view), "place", "light", "weather", "sky", "snow",
    "dust", "shadow", "glow", "clouds", "effect", "part", "unit", "picture", "absent" or
    "unknown"."""
    group: NounGroup
    things: list[int] = field(default_factory=list)
    """Indices of objects."""
    value: object = None
    """Place, light, weather, effect or unit."""
    attributes: Attributes = field(default_factory=Attributes)

    @property
    def is_things(self) -> bool:
        """Whether it is objects of the scene."""
        return self.kind == "things"

    @property
    def is_water(self) -> bool:
        """Whether it is water itself, as in "splashing water": no place."""
        return self.group.head is not None and self.group.head.text == "water"
