"""What is seen of a thing at each of some instants, and whether that is enough to tell it."""

from __future__ import annotations

from dataclasses import dataclass, field
from typing import NamedTuple

LEAST_INSTANTS = 2
"""Instants at which a thing must be told: what flits by is missed."""
LEAST_SIZE = 0.05
"""Share of the picture's width or height below which a thing is a speck."""
SPECKS = ((0.1, 0.005), (0.2, 0.003), (0.3, 0.002))
"""Sizes of what is seen, and shares of the picture's points below which that is a speck."""
SLIVER = 0.019
"""Share of the picture's points, as a multiple of its extent, below which a thing is a line: its
mean width is less than that share of the picture's width."""
LEAST_PIXELS = 12
"""Pixels below which nothing can be told of a thing."""
LEAST_INSIDE, LEAST_UNHIDDEN, LEAST_SEEN = 0.6, 0.45, 0.45
"""Shares of a thing of which less is hardly seen: within the picture, before other things, and
both."""
ALL_AROUND = 0.4
"""Share of the picture's points from which on a thing is seen, however far it reaches beyond: a
tunnel, a table top from near."""
LEAST_PIECE = 0.25
"""Share of such a thing that lies in the image: of less, nobody tells what it is a piece of."""
OUT_OF_VIEW = 0.1
"""Share of a thing in the picture below which it is out of view."""


class Glimpse(NamedTuple):
    """What is seen of a thing at an instant."""

    points: int
    """Image points that show it."""
    alone: int
    """Points that would show it if nothing stood before it."""
    extent: float
    """Of its part in the image: share of the image's width or height, the greater one."""
    inside: float
    """Share of it that lies in the image."""

    @property
    def unhidden(self) -> float:
        """Share of what lies in the image that nothing hides."""
        return self.points / max(self.alone, 1)

    @property
    def seen(self) -> float:
        """Share of the thing that is seen."""
        return self.unhidden * self.inside

    def fault(self, all_points: int, pixels: int) -> str | None:
        """Why the thing is not told, or None; of so many points and pixels of the image."""
        share = self.points / all_points
        if not self.points and self.inside < OUT_OF_VIEW:
            return "out of view"
        if not self.points:
            return "hidden" if self.alone else "too small"
        is_speck = any(self.extent < size and share < area for size, area in SPECKS)
        if self.extent < LEAST_SIZE or is_speck or share * pixels < LEAST_PIXELS:
            return "too small"
        if share >= ALL_AROUND and self.inside >= LEAST_PIECE:
            return None
        if self.inside >= LEAST_INSIDE and self.unhidden >= LEAST_UNHIDDEN:
            if self.seen < LEAST_SEEN:
                return "mostly hidden"
            return "too small" if share < SLIVER * self.extent else None
        return "mostly hidden" if self.unhidden < self.inside else "cut off"


@dataclass
class Sight:
    """What is seen of a thing over the clip."""

    glimpses: list[Glimpse] = field(default_factory=list)
    moved_px: float = 0.0
    """Way of the part that goes furthest, in the image of a camera that stands still, pixels."""

    def fault(self, all_points: int, pixels: int) -> str | None:
        """Why it is not shown, or None; of so many points and pixels of the image."""
        faults = [one.fault(all_points, pixels) for one in self.glimpses]
        told = faults.count(None)
        if told >= min(LEAST_INSTANTS, len(faults)):
            return None
        if told:
            return "in view too briefly"
        best = max(
            range(len(faults)), key=lambda n: (self.glimpses[n].seen, self.glimpses[n].inside)
        )
        return faults[best]
