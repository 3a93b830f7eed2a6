"""Colours of ON and OFF events, by name."""

from __future__ import annotations

from dataclasses import dataclass
from types import MappingProxyType

from texvent._registry import suggest
from texvent.errors import ConfigError

Colour = tuple[int, int, int]
"""Red, green, blue, 0..255."""


@dataclass(frozen=True)
class Palette:
    """Colours of an events image."""

    name: str
    on: Colour
    off: Colour
    background: Colour
    source: str
    """Program or paper that draws events this way."""

    @property
    def is_dark(self) -> bool:
        """True if light text is needed on the background."""
        red, green, blue = self.background
        return 0.299 * red + 0.587 * green + 0.114 * blue < 110

    @property
    def ink(self) -> Colour:
        """Text and lines on the background."""
        return (236, 238, 242) if self.is_dark else (38, 42, 50)


PALETTES = MappingProxyType(
    {
        palette.name: palette
        for palette in (
            Palette(
                "paper",
                (0, 0, 255),
                (255, 0, 0),
                (255, 255, 255),
                "Texvent's figures; rpg dvs_renderer",
            ),
            Palette("dv", (0, 93, 183), (43, 43, 43), (255, 255, 255), "iniVation dv-processing"),
            Palette(
                "metavision-light", (64, 126, 200), (30, 37, 52), (255, 255, 255), "Metavision"
            ),
            Palette("metavision-dark", (255, 255, 255), (64, 126, 200), (30, 37, 52), "Metavision"),
            Palette(
                "metavision-coolwarm",
                (220, 60, 50),
                (64, 126, 200),
                (255, 255, 255),
                "Metavision (background chosen here)",
            ),
            Palette("redblue", (255, 0, 0), (0, 0, 255), (255, 255, 255), "eventcv, evlib, AirSim"),
            Palette("v2e", (255, 255, 255), (0, 0, 0), (128, 128, 128), "v2e"),
        )
    }
)
"""Palettes by name; the first is the default. `redblue` is `paper` with ON and OFF swapped:
always show a legend."""
DEFAULT_PALETTE = "paper"


def get_palette(name: str | Palette) -> Palette:
    """The palette called `name`.

    Raises:
        ConfigError: there is none; the message lists them.
    """
    if isinstance(name, Palette):
        return name
    if name not in PALETTES:
        raise ConfigError(f"unknown palette {name!r}; {suggest(name, tuple(PALETTES))}")
    return PALETTES[name]
