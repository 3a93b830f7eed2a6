"""What a noun group means."""

from __future__ import annotations

from dataclasses import dataclass, field

from texvent.scenes.language.grammar.syntax import NounGroup
from texvent.scenes.language.meaning.adjectives import Attributes


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
