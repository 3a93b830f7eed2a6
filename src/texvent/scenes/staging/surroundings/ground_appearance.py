"""What the ground and the walls of a place are like."""

from __future__ import annotations

from dataclasses import dataclass

from texvent.scenes.scene import Colour, Ground, Texture


@dataclass(frozen=True)
class GroundAppearance:
    """What the ground is like."""

    ground: Ground
    colour: Colour
    second_colour: Colour
    road_half_width: float = 3.4
    surface: Texture | None = None
    """Material of the ground; None = the usual one of `ground`."""
    walls: Texture = Texture.PLASTER
    """Material of a room's walls."""
    wall_colour: Colour = (0.75, 0.69, 0.61)


def room(
    surface: Texture, floor: tuple[Colour, Colour], walls: Texture, wall_colour: Colour
) -> GroundAppearance:
    """A floor with walls around it."""
    return GroundAppearance(Ground.FLOOR, *floor, 3.4, surface, walls, wall_colour)
