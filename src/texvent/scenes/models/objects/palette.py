"""Surfaces and paints that the things of the noun tables share."""

from __future__ import annotations

from texvent.scenes.models.materials import Material, glowing, mottled
from texvent.scenes.scene import Colour

BRASS = Material((0.58, 0.40, 0.10))
PAPER = Material((0.80, 0.78, 0.72))
INK = Material((0.03, 0.03, 0.035))
PALE = Material((0.80, 0.80, 0.78))
RED_PAINT = Material((0.55, 0.03, 0.02))
YELLOW_PAINT = Material((0.75, 0.45, 0.02))
BLUE_PAINT = Material((0.03, 0.10, 0.45))
SILVER = Material((0.58, 0.59, 0.61))
IRON = Material((0.10, 0.10, 0.11))
BLACK_PLASTIC = Material((0.022, 0.022, 0.025))
GREY_PLASTIC = Material((0.20, 0.20, 0.21))
LEATHER = Material((0.16, 0.07, 0.03))
LEAF = Material((0.06, 0.22, 0.03))
STALK = Material((0.12, 0.07, 0.03))
EARTH = mottled((0.07, 0.04, 0.025))
BREAD = mottled((0.50, 0.28, 0.10), contrast=0.2)
STONE = mottled((0.36, 0.35, 0.33), contrast=0.25, scale=4.0)
BRICK = mottled((0.34, 0.10, 0.06), contrast=0.3, scale=6.0)
ROOF = mottled((0.26, 0.07, 0.04), contrast=0.25, scale=6.0)
SCREEN = glowing((0.10, 0.30, 0.55), 0.8)
"""A display that is switched on."""
BULB = glowing((1.0, 0.85, 0.55), 3.0)
WATER = Material((0.20, 0.34, 0.40))
WOOD_BROWN: Colour = (0.30, 0.15, 0.06)
DARK_WOOD: Colour = (0.14, 0.06, 0.03)
PALE_WOOD: Colour = (0.50, 0.32, 0.16)
SILVERY: Colour = (0.58, 0.59, 0.61)
STEELY: Colour = (0.36, 0.37, 0.39)
BLACKISH: Colour = (0.025, 0.025, 0.028)
CHINA: Colour = (0.80, 0.80, 0.78)
