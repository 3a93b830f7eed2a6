"""What stands before a noun: how many, what colour, how large, what it is made of or does."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, field

from texvent.scenes.colours import COLOURS, GREY_LEVELS, shade_colour
from texvent.scenes.description import NamedColour, ObjectMotion, Picture
from texvent.scenes.language.meaning.capabilities import can_do
from texvent.scenes.language.meaning.draft import PartialObject
from texvent.scenes.language.vocabulary import objects as vocabulary_objects
from texvent.scenes.language.vocabulary.scene import DEFAULT_BLINK_HZ
from texvent.scenes.language.vocabulary.verbs import Verb
from texvent.scenes.language.words.english import Pos, VerbForm
from texvent.scenes.language.words.lexicon import Role
from texvent.scenes.language.words.word import Word
from texvent.scenes.models.lamps import LAMPS
from texvent.scenes.models.machine_acts import COLLAPSE
from texvent.scenes.models.protocol import Noun
from texvent.scenes.pictures.checking import can_show, check_picture


@dataclass
class Attributes:
    """The adjectives of one noun group."""

    words: list[Word] = field(default_factory=list)
    count: int | None = None
    number: float | None = None
    colours: list[tuple[NamedColour, list[Word]]] = field(default_factory=list)
    scale: tuple[float, Word] | None = None
    pace: tuple[float, Word] | None = None
    material: tuple[str, Word] | None = None
    motion: tuple[Verb, Word] | None = None
    lit: tuple[bool, Word] | None = None
    flicker: Word | None = None
    still: Word | None = None
    numbers: list[Word] = field(default_factory=list)
    effect: tuple[str, Word] | None = None
    picture: tuple[Picture, Word] | None = None
    rate_hz: tuple[float, list[Word]] | None = None

    @property
    def is_many(self) -> bool:
        """Whether a number above 1 is said."""
        return (self.count or 1) > 1 or (self.number or 1.0) > 1.0

    @property
    def is_new(self) -> bool:
        """Whether a word tells the object from those named before."""
        return bool(self.colours) or any(word.text in ("second", "other") for word in self.words)

    def decide_count(self, bare: int) -> tuple[int, str | None]:
        """How many, `bare` if that is not said; and a note where fewer are shown than said."""
        for word in self.numbers:
            word.is_used = True
        if self.number is not None:
            most = vocabulary_objects.MAX_COUNT
            if self.number > most:
                return most, f"a count of {self.number:g} is shown as {most}, the most of one thing"
            whole = max(round(self.number), 1)
            note = f"a count of {self.number:g} is shown as {whole}"
            return whole, note if whole != self.number else None
        if self.count is not None:
            return self.count, None
        return bare, None

    def apply(self, item: PartialObject, noun: Noun) -> None:
        """Give an object what is said of it; what it cannot have stays unused."""
        self.colour(item)
        if self.scale is not None:
            item.scale, self.scale[1].is_used = self.scale[0], True
        if self.material is not None:
            item.material, self.material[1].is_used = self.material[0], True
        if self.pace is not None:
            item.pace, self.pace[1].is_used = item.pace * self.pace[0], True
        if self.still is not None:
            item.motions, self.still.is_used = [ObjectMotion("stand")], True
        self._move(item, noun)
        self._light(item, noun)
        if self.picture is not None and show_picture(item, self.picture[0]):
            self.picture[1].is_used = True

    def colour(self, item: PartialObject) -> None:
        """The first colour; a second one stays unused."""
        if self.colours and item.colour is None:
            item.colour, words = self.colours[0]
            for word in words:
                word.is_used = True

    def _move(self, item: PartialObject, noun: Noun) -> None:
        if self.motion is None:
            return
        verb, word = self.motion
        kind = verb.kind or verb.object_kind or ""
        if word.meaning.form is VerbForm.PAST and verb.object_kind:
            kind = verb.object_kind
        if kind and can_do(noun, kind):
            kind = COLLAPSE if line_up(item, kind) else kind
            item.motions = [ObjectMotion(kind, verb.direction, verb.pace, end_pace=verb.end_pace)]
            word.is_used = True

    def _light(self, item: PartialObject, noun: Noun) -> None:
        if self.flicker is not None and noun.name in LAMPS:
            item.blink_hz, self.flicker.is_used = DEFAULT_BLINK_HZ, True
            if self.rate_hz is not None:
                item.blink_hz, words = self.rate_hz
                for word in words:
                    word.is_used = True
        if self.lit is not None and noun.name in LAMPS:
            item.is_lit, self.lit[1].is_used = self.lit[0], True


def line_up(item: PartialObject, kind: str) -> bool:
    """As in "dominoes fall", "falling dominoes": a row of them, unless the prompt counts them.

    Returns:
        Whether the object is a row now.
    """
    is_row = item.noun == "domino" and item.count > 1 and not item.is_counted
    if is_row and kind in ("fall", "topple"):
        item.noun, item.count = "domino row", 1
        return True
    return False


def show_picture(item: PartialObject, picture: Picture) -> bool:
    """Put a picture on an object's flat face; False if it has none.

    Raises:
        InputError: the picture cannot be shown.
    """
    check_picture(picture)
    if not can_show(item.noun):
        return False
    item.picture = picture
    return True


def read_attributes(modifiers: Sequence[Word]) -> Attributes:
    """Sort the words before a noun by what they say."""
    found = Attributes(list(modifiers))
    shade: Word | None = None
    for word in modifiers:
        role = word.role
        effect = word.read_as(Role.EFFECT)
        if effect is not None:
            found.effect = (effect.value, word)
        elif role is Role.SHADE:
            shade = word
        elif role is Role.COLOUR:
            found.colours.append(_name_colour(word, shade))
            shade = None
        elif role is Role.UNIT and found.numbers and word.meaning.value[0] == "rate":
            _read_rate(found, word)
        elif role in _FIELDS:
            setattr(found, _FIELDS[role], (word.meaning.value, word))
        else:
            _read_other(found, word)
    level = GREY_LEVELS.get(shade.text) if shade is not None else None
    if shade is not None and level is not None:
        rgb = COLOURS[level]
        found.colours.append((NamedColour(shade.text, rgb), [shade]))
    return found


_FIELDS = {Role.SIZE: "scale", Role.PACE: "pace", Role.MATERIAL: "material"}


def _read_other(found: Attributes, word: Word) -> None:
    if word.role is Role.COUNT:
        _read_number(found, word)
    elif word.role is Role.STILL:
        found.still = word
    elif word.role is Role.PICTURE:
        found.picture = (word.meaning.value, word)
    elif word.role is Role.FLICKER:
        found.flicker = word
    elif word.role is Role.VERB and word.pos is Pos.VERB:
        found.motion = (word.meaning.value, word)
    elif word.text in _LIT:
        found.lit = (_LIT[word.text], word)
    elif word.role is Role.FUNCTION or word.text == "empty":
        word.is_used = True


_LIT = {"lit": True, "glowing": True, "burning": True, "unlit": False, "shining": True}


def _read_number(found: Attributes, word: Word) -> None:
    found.numbers.append(word)
    value = word.meaning.value
    if word.tokens[0].is_number:
        found.number = float(value)
    elif found.count is None or len(word.tokens) == 1:
        found.count = int(value)


def _read_rate(found: Attributes, word: Word) -> None:
    """As in "A 100 Hz flickering lamp"."""
    number = found.number if found.number is not None else float(found.count or 1)
    found.rate_hz = (number * word.meaning.value[1], [found.numbers.pop(), word])
    found.number = found.count = None


def _name_colour(word: Word, shade: Word | None) -> tuple[NamedColour, list[Word]]:
    rgb = COLOURS[word.text]
    if shade is None:
        return NamedColour(word.text, rgb), [word]
    rgb = shade_colour(rgb, shade.text)
    return NamedColour(f"{shade.text} {word.text}", rgb), [shade, word]
