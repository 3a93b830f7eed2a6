"""What the ground and the walls of a place are like."""

from __future__ import annotations

from dataclasses import dataclass

from texvent.scenes.scene import Colour, Ground, Texture

MEADOW: tuple[Colour, Colour] = ((0.055, 0.14, 0.022), (0.13, 0.21, 0.045))
GREY: tuple[Colour, Colour] = ((0.36, 0.36, 0.35), (0.27, 0.27, 0.26))
PALE: tuple[Colour, Colour] = ((0.66, 0.67, 0.66), (0.58, 0.60, 0.60))
BOARDS: tuple[Colour, Colour] = ((0.50, 0.33, 0.16), (0.58, 0.40, 0.21))
WATER: Colour = (0.016, 0.055, 0.065)
ASPHALT: Colour = (0.04, 0.04, 0.043)


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
