"""Reads what a prompt says about place, light and weather."""

from __future__ import annotations

from texvent.scenes.description import Illumination, NamedColour, Surroundings
from texvent.scenes.language import vocabulary_scene
from texvent.scenes.language.lexicon import Role
from texvent.scenes.language.tagging import Phrase, mark_used

_BACKDROPS = ("mountain", "forest", "city")
_OPEN_PLACES = ("road", "dirt road", "grass", "savanna", "sea", "sand", "snow", "mountain")


class SurroundingsReader:
    """Collects the surroundings; the first place and the first light mentioned win."""

    def __init__(self) -> None:
        self._place: str | None = None
        self._colour: NamedColour | None = None
        self._sky: NamedColour | None = None
        self._weather: str | None = None
        self._clouds: float | None = None
        self._backdrops: list[str] = []
        self._has_dust = False
        self._has_snow = False
        self._light: str | None = None
        self._flicker_hz: float | None = None
        self._shadows: bool | None = None
        self._glows: list[Phrase] = []
        self._hertz: tuple[float, list[Phrase]] | None = None

    def read_place(self, place: str, colour: NamedColour | None) -> tuple[bool, bool]:
        """Take a place and its stated colour; return which of the two had an effect."""
        if self._place is None or self._place == "sky":
            self._place = place
        elif place in _BACKDROPS and self._place in _OPEN_PLACES:
            self._add_backdrop(place)
        elif self._place in _BACKDROPS and place in _OPEN_PLACES:
            self._add_backdrop(self._place)
            self._place = place
        elif place not in (self._place, "sky"):
            return False, False
        if colour is None or place != self._place:
            return True, False
        if place in vocabulary_scene.COLOURABLE:
            self._colour = colour
            return True, True
        natural = vocabulary_scene.NATURAL_COLOURS.get(place, ())
        return True, colour.name.split()[-1] in natural

    def read_sky(self, colour: NamedColour) -> None:
        """Take the colour of the sky."""
        self._sky = colour

    def read_light(self, light: str) -> bool:
        """Take a time of day or a light; return whether it had an effect."""
        if self._light is None or self._light == "day":
            self._light = light
            return True
        pair = {self._light, light}
        return self._light == light or "lamp" in pair or pair <= {"day", "sunny"}

    def read(self, phrase: Phrase, is_negated: bool) -> None:
        """Take a word about weather, flicker or shadows."""
        role, value = phrase.role, phrase.meaning.value
        if role is Role.WEATHER:
            phrase.is_used = self._read_weather(value, is_negated)
        elif role is Role.CLOUDS:
            self._clouds, phrase.is_used = (0.0 if is_negated else value), True
        elif role is Role.SNOW:
            self._has_snow, phrase.is_used = not is_negated, True
        elif role is Role.STEEP:
            self._add_backdrop("mountain")
            phrase.is_used = True
        elif role is Role.DUST:
            self._has_dust, phrase.is_used = not is_negated, True
        elif role is Role.FLICKER:
            self._flicker_hz = None if is_negated else vocabulary_scene.DEFAULT_FLICKER_HZ
            phrase.is_used = True
        elif role is Role.SHADOW:
            self._shadows, phrase.is_used = not is_negated, True
        elif role is Role.GLOW:
            self._glows.append(phrase)

    def read_hertz(self, frequency: float, phrases: list[Phrase]) -> None:
        """Keep a frequency, Hz, until it is clear what flickers."""
        self._hertz = (frequency, phrases)

    def build(self) -> tuple[Surroundings, Illumination]:
        """The surroundings and the light as understood."""
        if self._hertz is not None and (self._flicker_hz is not None or self._is_lit()):
            self._flicker_hz, phrases = self._hertz
            mark_used(phrases)
        if self._is_lit():
            mark_used(self._glows)
        surroundings = Surroundings(
            place=self._place,
            colour=self._colour,
            sky=self._sky,
            weather=self._weather,
            clouds=self._clouds,
            backdrops=tuple(self._backdrops),
            has_dust=self._has_dust,
            has_snow=self._has_snow or self._weather == "snow",
        )
        return surroundings, Illumination(self._light, self._flicker_hz, self._shadows)

    def _is_lit(self) -> bool:
        return self._light is not None or self._flicker_hz is not None or bool(self._glows)

    def _read_weather(self, weather: str, is_negated: bool) -> bool:
        if is_negated:
            return True
        if self._weather is None:
            self._weather = weather
        return self._weather == weather

    def _add_backdrop(self, backdrop: str) -> None:
        if backdrop not in self._backdrops:
            self._backdrops.append(backdrop)
