"""Colours of ON and OFF events, by name."""

from __future__ import annotations

from dataclasses import dataclass, replace
from types import MappingProxyType

from texvent._registry import suggest
from texvent.errors import ConfigError, shown

Colour = tuple[int, int, int]
"""Red, green, blue, 0..255."""
DARK_BACKGROUND: Colour = (20, 22, 26)
DARK_LUMA = 130.0
"""Least luma of an event's colour on the dark background."""


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
        return _luma(self.background) < 110

    @property
    def dark(self) -> Palette:
        """The same hues on a dark background, for pages in dark mode.

        A palette whose background is not light already stays as it is.
        """
        if _luma(self.background) < 200:
            return self
        return replace(
            self, on=_lighten(self.on), off=_lighten(self.off), background=DARK_BACKGROUND
        )

    @property
    def both(self) -> Colour:
        """Colour of a pixel with as many ON as OFF events."""
        red, green, blue = (
            round((on + off) / 2) for on, off in zip(self.on, self.off, strict=True)
        )
        return red, green, blue

    @property
    def ink(self) -> Colour:
        """Text and lines on the background."""
        return (236, 238, 242) if self.is_dark else (38, 42, 50)


def _luma(colour: Colour) -> float:
    red, green, blue = colour
    return 0.299 * red + 0.587 * green + 0.114 * blue


def _lighten(colour: Colour) -> Colour:
    """The colour mixed with white until it is light enough for the dark background."""
    luma = _luma(colour)
    share = max(0.0, (DARK_LUMA - luma) / (255 - luma))
    red, green, blue = (round(value + share * (255 - value)) for value in colour)
    return red, green, blue


_PAPER = Palette(
    "paper", (0, 0, 255), (255, 0, 0), (255, 255, 255), "Texvent's figures; rpg dvs_renderer"
)
PALETTES = MappingProxyType(
    {
        palette.name: palette
        for palette in (
            _PAPER,
            replace(_PAPER.dark, name="paper-dark", source="pages in dark mode"),
            Palette("dv", (0, 93, 183), (43, 43, 43), (255, 255, 255), "iniVation dv-processing"),
            Palette("metavision-dark", (255, 255, 255), (64, 126, 200), (30, 37, 52), "Metavision"),
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
        raise ConfigError(f"unknown palette {shown(name)}; {suggest(name, tuple(PALETTES))}")
    return PALETTES[name]
