"""Reads what a prompt says about place, light and weather."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from itertools import pairwise

from texvent.scenes.description import Illumination, NamedColour, Surroundings
from texvent.scenes.language.meaning.adjectives import Attributes
from texvent.scenes.language.meaning.referents.referent import Referent
from texvent.scenes.language.vocabulary import scene as vocabulary_scene
from texvent.scenes.language.vocabulary.motion import SHORES
from texvent.scenes.language.words.english import Pos
from texvent.scenes.language.words.lexicon import Role
from texvent.scenes.language.words.word import Word, mark_used

_CLEAR = ("clear",)
"""What the light of the day is anyway."""
_ALIKE = ({"day", "sunny"}, {"day", "overcast"})
"""Lights that go together."""
_WATER = ("water", "waters")
_CALM = ("calm", "tranquil", "placid")
"""What water is unless the prompt says waves."""
_ROUGH = (*vocabulary_scene.ROUGH, "high", "heavy")
_ROCKY = dict.fromkeys(("mountain", "canyon", "cliffs"), ("rocky", "rugged", "stony"))
"""Place → what it is anyway."""
_WAVY, _ROUGH_HEIGHT = 2.2, 3.0
"""Height of waves that are said, and of a rough sea."""
_WATERY = ("lake", "river", "beach", "underwater")
"""Places that have the water that is named after them."""
_USUAL_HZ = {
    "sine": vocabulary_scene.DEFAULT_FLICKER_HZ,
    "strobe": vocabulary_scene.STROBE_HZ,
    "switch": vocabulary_scene.SWITCH_HZ,
}
_BACKDROPS = ("mountain", "forest", "city")
_OPEN_PLACES = ("road", "dirt road", "grass", "savanna", "sea", "lake", "river", "sand", "beach",
                "snow", "mountain", "village", "farmyard", "park", "harbour", "vineyard",
                "wheat field", "cornfield", "railway", "motorway", "runway")  # fmt: skip
"""Places behind which mountains, a forest or a city may stand."""
_ROADS = ("road", "dirt road", "city")
_SCENE_ROLES = frozenset(
    {Role.WEATHER, Role.CLOUDS, Role.SNOW, Role.STEEP, Role.DUST, Role.FLICKER, Role.SHADOW,
     Role.LIGHT, Role.PLACE, Role.ROAD, Role.SHADE}
)  # fmt: skip


_LAMP_LIT = ("night", "lamp", "moonlight")


class SurroundingsReader:
    """Collects the surroundings; the first place and the first light mentioned win."""

    def __init__(self) -> None:
        self._place: str | None = None
        self._colour: NamedColour | None = None
        self._sky: NamedColour | None = None
        self._weather: str | None = None
        self._clouds: float | None = None
        self._backdrops: list[str] = []
        self._road: str | None = None
        self._is_empty = False
        self._has_dust = False
        self._has_snow = False
        self._wave_height = 1.0
        self._light: str | None = None
        self._flicker_hz: float | None = None
        self._wave = "sine"
        self._shadows: bool | None = None
        self._glows: list[Word] = []
        self._readers: dict[Role, Callable[[object, bool], bool]] = {
            Role.WEATHER: lambda said, no: self.read_weather(str(said), is_negated=no),
            Role.LIGHT: lambda said, _: self.read_light(str(said)),
            Role.PLACE: lambda said, _: self.read_place(str(said), None)[0],
            Role.SHADE: lambda *_: self.read_light(vocabulary_scene.DARK_PLACES_LIGHT),
            Role.CLOUDS: self._set_clouds,
            Role.SNOW: self._set_snow,
            Role.DUST: self._set_dust,
            Role.WAVES: self._set_waves,
            Role.SHADOW: self._set_shadows,
            Role.STEEP: self._set_steep,
            Role.ROAD: self._set_road,
            Role.FLICKER: self._set_flicker,
        }

    def read_referent(self, one: Referent, *, is_negated: bool) -> bool:
        """Take a place, light, sky or weather with its adjectives; whether it had an effect."""
        head = one.group.head
        if head is None:
            return False
        is_negated = is_negated or one.group.negation is not None
        self.read_adjectives(one.attributes, one.kind)
        if one.kind == "sky":
            is_used = self._read_sky(one.attributes)
        elif one.kind == "place" and head.is_content:
            is_used, head.is_lost = False, not head.is_used
        elif one.kind == "place":
            is_used = self._read_place_referent(one)
        elif one.kind == "glow":
            self._glows.append(head)
            is_used = head.is_used
        else:
            is_used = self.read(head, is_negated=is_negated, value=one.value)
        head.is_used = head.is_used or is_used
        if is_used and one.kind == "light" and self._light in ("day", "sunny"):
            mark_used(word for word in one.attributes.words if word.text in _CLEAR)
        head.is_absent = is_used and is_negated
        if is_used and is_negated and one.group.negation is not None:
            one.group.negation.is_used = True
        return is_used

    def _read_place_referent(self, one: Referent) -> bool:
        colour = one.attributes.colours[0] if one.attributes.colours else None
        named = colour[0] if colour is not None else None
        is_water = one.group.head is not None and one.group.head.text in _WATER
        place = self._place if is_water and self._place in _WATERY else None
        is_used, is_coloured = self.read_place(place or str(one.value), named)
        if is_coloured and colour is not None:
            mark_used(colour[1])
        if is_used and self._place in SHORES:
            mark_used(word for word in one.attributes.words if word.text in _CALM)
            rough = [word for word in one.attributes.words if word.text in _ROUGH]
            self._wave_height = _ROUGH_HEIGHT if rough else self._wave_height
            mark_used(rough)
        if is_used and str(one.value) in _ROCKY:
            mark_used(word for word in one.attributes.words if word.text in _ROCKY[str(one.value)])
        head = one.group.head
        meaning = head.read_as(Role.PLACE) if head is not None else None
        if not is_used or head is None or meaning is None:
            return is_used
        if head.text in vocabulary_scene.CROSSINGS:
            self._road = "crossing"
        if meaning.is_substitute:
            head.shown_as = str(meaning.value)
        return True

    def read_adjectives(self, attributes: Attributes, kind: str) -> None:
        """As in "A foggy street", "dark water", "a winding road"."""
        for word in attributes.words:
            self._is_empty = self._is_empty or (word.text == "empty" and kind == "place")
            if word.role in _SCENE_ROLES and not word.is_used:
                if word.role is Role.SHADE and not (word.text == "dark" and kind == "place"):
                    continue
                self.read(word, is_negated=False)
            elif kind == "place" and not word.is_used:
                self._read_backdrop(word)

    def _read_backdrop(self, word: Word) -> None:
        """As in "a mountain road", though a mountain is a thing, too."""
        meaning = word.read_as(Role.PLACE)
        if meaning is not None and meaning.value in _BACKDROPS and not meaning.is_substitute:
            word.is_used = self.read_place(str(meaning.value), None)[0]

    def read_place(self, place: str, colour: NamedColour | None) -> tuple[bool, bool]:
        """Take a place and its stated colour; return which of the two had an effect."""
        if self._place is None or self._place == "sky":
            self._place = place
        elif place in _BACKDROPS and self._place in _OPEN_PLACES and place != self._place:
            self._add_backdrop(place)
        elif self._place in _BACKDROPS and place in _OPEN_PLACES:
            self._add_backdrop(self._place)
            self._place = place
        elif (self._place, place) == ("desert", "dunes"):
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

    def stand_before(self, place: str) -> None:
        """As in "next to a forest": on open ground, with the forest behind."""
        if place == "forest" and self._place is None:
            self._place = "grass"

    def _read_sky(self, attributes: Attributes) -> bool:
        if attributes.colours:
            self._sky, words = attributes.colours[0]
            mark_used(words)
        else:
            self.read_place("sky", None)
        return True

    def read_light(self, light: str, *, is_sure: bool = False) -> bool:
        """Take a time of day or a light; return whether it had an effect: the first one wins.

        Args:
            light: key of the lights.
            is_sure: whether it replaces what was said: "the sun sets".
        """
        if is_sure or self._light is None or self._light == "day":
            self._light = light
            return True
        pair = {self._light, light}
        return self._light == light or "lamp" in pair or pair in _ALIKE

    def read(self, word: Word, *, is_negated: bool, value: object = None) -> bool:
        """Take a word about place, weather, light, flicker or shadows."""
        said = word.meaning.value if value is None else value
        if word.role is Role.GLOW:
            self._glows.append(word)
        read = self._readers.get(word.role)
        is_used = read is not None and read(said, is_negated)
        word.is_used = word.is_used or is_used
        if is_used and word.role is Role.PLACE and word.meaning.is_substitute:
            word.shown_as = str(word.meaning.value)
        return is_used

    def read_weather_of_things(self, words: Sequence[Word]) -> None:
        """As in "snowy mountains", "a foggy lighthouse": it is all around them."""
        for word, after in pairwise(words):
            is_of_thing = after.role is Role.NOUN or after.pos is Pos.ADJECTIVE
            is_weather = word.role in (Role.SNOW, Role.WEATHER) and word.pos is Pos.ADJECTIVE
            if is_weather and is_of_thing and not word.is_used:
                self.read(word, is_negated=False)

    def _set_clouds(self, said: object, is_negated: bool) -> bool:
        self._clouds = 0.0 if is_negated or not isinstance(said, float) else said
        return True

    def _set_snow(self, said: object, is_negated: bool) -> bool:
        if said not in vocabulary_scene.SNOW_CAPPED:
            self._has_snow = not is_negated
        return True

    def _set_dust(self, _: object, is_negated: bool) -> bool:
        self._has_dust = not is_negated
        return True

    def _set_waves(self, _: object, is_negated: bool) -> bool:
        if is_negated:
            return True
        self._wave_height = max(self._wave_height, _WAVY)
        return True

    def _set_shadows(self, _: object, is_negated: bool) -> bool:
        self._shadows = not is_negated
        return True

    def _set_steep(self, _: object, is_negated: bool) -> bool:
        self._add_backdrop("mountain")
        return not is_negated

    def _set_road(self, said: object, _: bool) -> bool:
        self._road = str(said) if said != "straight" else None
        return True

    def _set_flicker(self, said: object, is_negated: bool) -> bool:
        if not is_negated:
            self.flicker("strobe" if str(said).startswith("strob") else "sine")
        return True

    def flicker(self, wave: str = "sine") -> None:
        """All light flickers, is a strobe, or is switched on and off."""
        if self._flicker_hz is None:
            self._flicker_hz = _USUAL_HZ[wave]
            self._wave = wave

    def curve_road(self) -> bool:
        """The road bends; whether there is one."""
        if self._place not in _ROADS:
            return False
        self._road = "curved"
        return True

    def darken(self) -> None:
        """It is dark."""
        self.read_light(vocabulary_scene.DARK_PLACES_LIGHT)

    def read_hertz(self, frequency: float) -> bool:
        """The frequency, Hz, of a light that flickers; whether one does."""
        if self._flicker_hz is None and not self._is_lit():
            return False
        self._flicker_hz = frequency
        return True

    def build(self) -> tuple[Surroundings, Illumination]:
        """The surroundings and the light as understood."""
        if self._light is not None or self._flicker_hz is not None:
            mark_used(filter(self._is_shown, self._glows))
        surroundings = Surroundings(
            place=self._place or ("sea" if self._wave_height > 1.0 else None),
            colour=self._colour,
            sky=self._sky,
            weather=self._weather,
            clouds=self._clouds,
            backdrops=tuple(self._backdrops),
            road=self._road,
            is_empty=self._is_empty,
            has_dust=self._has_dust,
            wave_height=self._wave_height,
            has_snow=self._has_snow or self._weather == "snow",
        )
        return surroundings, Illumination(self._light, self._flicker_hz, self._wave, self._shadows)

    def _is_shown(self, glow: Word) -> bool:
        """Whether a word for light is more than a time of day: lamps are lit in the dark."""
        is_dark = self._light in _LAMP_LIT or self._flicker_hz is not None
        return is_dark or glow.text != "lights"

    def _is_lit(self) -> bool:
        return self._light is not None or self._flicker_hz is not None or bool(self._glows)

    def read_weather(self, weather: str, *, is_negated: bool = False) -> bool:
        """Take a weather; whether it had an effect: the first one wins."""
        if is_negated:
            return True
        if self._weather is None:
            self._weather = weather
        return self._weather == weather

    def _add_backdrop(self, backdrop: str) -> None:
        if backdrop not in self._backdrops:
            self._backdrops.append(backdrop)
