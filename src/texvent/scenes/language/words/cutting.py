"""Tokens to phrases of the lexicon, each with all the readings it can have."""

from __future__ import annotations

from collections.abc import Callable, Iterable, Sequence

from texvent.scenes.language.words.english import (
    Pos,
    VerbForm,
    correct_spelling,
    list_readings,
)
from texvent.scenes.language.words.lexicon import Lexicon, Meaning, Role
from texvent.scenes.language.words.tokens import Token
from texvent.scenes.language.words.word import CONTRACTED


def correct_token(token: Token, known: Lexicon, notes: list[str]) -> Token:
    """The word that a misspelt one stands for, with a note; any other token as it is."""
    is_word = not (token.is_punctuation or token.is_number or token.picture or token.sense)
    if not is_word or token.text in known.words:
        return token
    better = correct_spelling(token.text, known.words)
    if better is None:
        return token
    notes.append(f"'{token.written}' is read as '{better}'")
    return Token(better, token.written)


def _own(tokens: Sequence[Token], known: Lexicon) -> list[Token]:
    """As in "it's tires" is "its tires"."""
    found = list(tokens)
    for index, token in enumerate(tokens[:-1]):
        if token.written.casefold() in ("it's", "it’s"):
            _, meanings = known.find([tokens[index + 1].text])
            if any(one.role in (Role.PART, Role.NOUN) for one in meanings):
                found[index] = Token("its", token.written)
    return found


def cut_tokens(
    tokens: Sequence[Token], known: Lexicon
) -> Iterable[tuple[Sequence[Token], list[Meaning]]]:
    """Longest phrases of the lexicon, each with all its readings."""
    tokens = _own(tokens, known)
    start = 0
    while start < len(tokens):
        window = tokens[start : start + known.longest]
        length, meanings = known.find([token.text for token in window])
        if window[0].picture is not None or window[0].sense is not None:
            length = 0
        elif not any(one.role is Role.VIEW for one in meanings):
            length = _stop_at_sign(window, length)
        elif length < len(window) and window[length].text in _GOES_ON:
            length = 1  # "from the back seat"
        length = _split_particle(window, length, known)
        length = _leave_way(window, length, known)
        length = _leave_head(window, length, known)
        length = _leave_walker(window, length)
        # What is left need be no phrase: the "heavy city" of "heavy city traffic sign".
        length, meanings = known.find([token.text for token in window[:length]])
        joined = _count_joined(window, length, known)
        if joined:
            yield tokens[start : start + joined], [Meaning(Role.UNKNOWN, Pos.ADJECTIVE)]
            start += joined
            continue
        length = max(length, 1)
        yield tokens[start : start + length], _complete(tokens[start : start + length], meanings)
        start += length


def _count_joined(window: Sequence[Token], length: int, known: Lexicon) -> int:
    """Words of an adjective with hyphens that is in no lexicon: "clay-covered", "three-legged".

    None of its words means anything by itself: three-legged dogs are not three dogs, but a 50-Hz
    light has a rate. "Slow-moving" is as slow as "slow", and "red-painted" as red.
    """
    count = 1
    while count < len(window) and window[count - 1].is_joined:
        count += 1
    if count == 1 and length < 2 and _is_measure(window, known):
        return 2
    is_phrase = length >= count and known.find([one.text for one in window[:length]])[0] == length
    if count < 2 or is_phrase:
        return 0
    last = window[count - 1].text
    is_participle = any(
        one.pos is Pos.VERB and one.form in (VerbForm.ING, VerbForm.PAST)
        for one in list_readings(last)
    )
    _, first = known.find([window[0].text])
    if any(one.role is Role.COUNT for one in first) or window[0].is_number:
        _, meanings = known.find([last])
        is_amount = any(one.role in _AMOUNTS for one in meanings) or window[count - 1].is_number
        return 0 if is_amount else count
    is_said = any(one.role in _KEPT for one in first)
    return count if (is_participle or last in _ENDINGS) and not is_said else 0


def _is_measure(window: Sequence[Token], known: Lexicon) -> bool:
    """As in "a two story house", "a one way sign": not two of them."""
    if len(window) < 3 or window[2].is_punctuation:
        return False
    counts = [one.value for one in known.find([window[0].text])[1] if one.role is Role.COUNT]
    measures = _MEASURED if counts == [1] else _MEASURED | _MEASURED_IF_MANY
    is_noun = any(one.pos is Pos.NOUN for one in list_readings(window[2].text))
    return bool(counts) and window[1].text in measures and is_noun


_MEASURED = frozenset({"story", "storey", "tier", "tiered", "way", "lane", "level", "wheeler",
                       "seater", "burner"})  # fmt: skip
_MEASURED_IF_MANY = frozenset({"wheel", "piece", "seat", "door", "bedroom", "poster", "engine",
                               "layer"})  # fmt: skip
"""Words of measure in the singular, which stand between a number and a noun."""
_AMOUNTS = frozenset({Role.COUNT, Role.UNIT})
_KEPT = frozenset({Role.COLOUR, Role.SHADE, Role.PACE, Role.SIZE, Role.SNOW, Role.WEATHER})
_ENDINGS = frozenset({"like", "free", "up", "off", "in", "old", "sized", "shaped", "legged"})


_INSIDE = ("inside", "a")


def _leave_head(window: Sequence[Token], length: int, known: Lexicon) -> int:
    """As in "industrial robot arm": "robot arm" is the head, not "industrial robot"."""
    if length == len(_INSIDE) + 1 and tuple(one.text for one in window[: len(_INSIDE)]) == _INSIDE:
        is_longer = known.find([token.text for token in window[len(_INSIDE) :]])[0] > 1
        return 1 if is_longer else length  # "inside a train station"
    if length < 2 or not _is_noun(known.find([token.text for token in window[:length]])[1]):
        return length
    for first in range(1, length):
        words = [token.text for token in window[first:]]
        longer, meanings = known.find(words)
        if longer > length - first and _is_noun(meanings) and window[first].picture is None:
            return first
    return length


def _leave_walker(window: Sequence[Token], length: int) -> int:
    """As in "a pedestrian crossing the street": who crosses it, and no crosswalk."""
    if length != 2 or window[1].text != "crossing" or window[0].text != "pedestrian":
        return length
    return 1 if len(window) > 2 and window[2].text in _CROSSED else length


def _leave_way(window: Sequence[Token], length: int, known: Lexicon) -> int:
    """As in "moves back and forth", "moves in front of a house": no "moves back", "moves in"."""
    if length != 2:
        return length
    longer, meanings = known.find([token.text for token in window[1:]])
    is_way = any(one.role in (Role.DIRECTION, Role.RELATION) for one in meanings)
    is_in = window[1].text == "in" and len(window) > length  # "moves in the wind"
    after = known.find([window[length].text])[1] if is_in else []
    own = known.find([token.text for token in window[:2]])[1]
    is_move = any(one.role is Role.CAMERA_MOVE for one in own)  # "clouds moving in sky"
    is_within = any(one.pos is Pos.DETERMINER or (is_move and one.pos is Pos.NOUN) for one in after)
    return 1 if is_within or (is_way and longer > length) else length


def _is_noun(meanings: Sequence[Meaning]) -> bool:
    return bool(meanings) and all(one.role is Role.NOUN for one in meanings)


def _split_particle(window: Sequence[Token], length: int, known: Lexicon) -> int:
    """As in "Speeds up a road" goes up a road; "speeds up" goes faster."""
    if length != 2 or window[1].text not in _PARTICLES or len(window) < 3:
        return length
    _, meanings = known.find([token.text for token in window[:2]])
    takes_object = any(
        one.role is not Role.VERB or one.value.act or one.value.relation or one.value.object_kind
        for one in meanings
    )
    _, after = known.find([window[2].text])
    opens_group = any(one.pos is Pos.DETERMINER for one in after)
    return 1 if opens_group and not takes_object else length


_CROSSED = frozenset(
    {"the", "a", "an", "in", "from", "at", "left", "right", "road", "street", "roads", "streets",
     "before", "slowly", "quickly", "during", "while"}
)  # fmt: skip
"""Words after "crossing" that tell what is crossed, or how."""
_GOES_ON = frozenset({"seat", "row", "door", "window", "yard", "porch", "cover", "garden"})
"""Words after which "from the back", "from the front" are no views."""
_PARTICLES = frozenset({"up", "down", "over", "around", "off", "through", "by"})


_INVENTORS = frozenset({"newton", "rubik"})
"""Whose name is a part of a thing's: "Newton's cradle"."""


def _stop_at_sign(window: Sequence[Token], length: int) -> int:
    """A possessive inside a phrase ends it: "a dog's tail" is not one word."""
    for index, token in enumerate(window[: max(length - 1, 0)]):
        is_owner = token.text not in CONTRACTED and token.text not in _INVENTORS
        if is_owner and token.written.casefold().endswith(("'s", "’s")):
            return index + 1
    return length


def _read_unspelt(token: Token) -> Meaning | None:
    """The one reading of a name, a style, a picture, a number or a sign."""
    if token.sense is not None:
        return _SENSES[token.sense[0]](token.sense[1])
    if token.picture is not None:
        return Meaning(Role.PICTURE, Pos.NOUN, token.picture)
    if token.is_number:
        return Meaning(Role.COUNT, Pos.NUMBER, token.value)
    if token.is_punctuation:
        return Meaning(Role.FUNCTION, Pos.SIGN, token.text)
    return None if token.text[0].isalpha() else Meaning(Role.UNKNOWN, Pos.ADVERB)


_SENSES: dict[str, Callable[[str], Meaning]] = {
    "thing": lambda noun: Meaning(Role.NOUN, Pos.NOUN, noun, is_substitute=True),
    "place": lambda place: Meaning(Role.PLACE, Pos.NOUN, place, is_substitute=True),
    "style": lambda reason: Meaning(Role.STYLE, Pos.ADJUNCT, reason),
}
"""Kind of a `Token.sense` → the reading with what it names."""


def _complete(span: Sequence[Token], meanings: list[Meaning]) -> list[Meaning]:
    """The lexicon's readings, and those of a dictionary for a single word."""
    if len(span) > 1:
        return meanings
    token = span[0]
    fixed = _read_unspelt(token)
    if fixed is not None:
        return [fixed]
    found = list(meanings)
    if token.text == "other":
        found.append(Meaning(Role.FUNCTION, Pos.ADJECTIVE, token.text))  # "two other signs"
    listed = {meaning.pos for meaning in found}
    if listed and listed <= _CLOSED:
        return found
    for one in list_readings(token.text):
        if one.pos not in listed:
            both = one.pos is Pos.NOUN and token.text.endswith("s") and not one.is_plural
            found.append(Meaning(Role.UNKNOWN, one.pos, None, one.form, one.is_plural, both))
            listed.add(one.pos)
    is_gerund = token.text.endswith("ing") and token.text not in _THINGS_IN_ING
    if listed == {Pos.NOUN} and is_gerund and not meanings and len(token.text) > _SHORTEST_GERUND:
        found.append(Meaning(Role.UNKNOWN, Pos.VERB, None, VerbForm.ING))  # "windsurfing"
    if not found:
        found.append(Meaning(Role.UNKNOWN, Pos.NOUN))
        if token.text.endswith("ing"):
            found.append(Meaning(Role.UNKNOWN, Pos.VERB, None, VerbForm.ING))
    return found


_SHORTEST_GERUND = 6
_THINGS_IN_ING = frozenset(
    {"clothing", "earring", "ceiling", "evening", "morning", "lightning", "sibling", "dumpling",
     "awning", "wedding", "pudding", "herring", "starling", "duckling", "gosling", "sapling",
     "seedling", "yearling", "offspring", "shilling", "foundling", "hamstring", "mainspring"}
)  # fmt: skip
"""Nouns that no verb is behind."""
_CLOSED = frozenset(
    {Pos.DETERMINER, Pos.PRONOUN, Pos.CONJUNCTION, Pos.SUBORDINATOR, Pos.AUXILIARY, Pos.TO,
     Pos.RELATIVE, Pos.NEGATION, Pos.PREPOSITION, Pos.ADJUNCT}
)  # fmt: skip
"""Parts of speech whose words are listed in full: no dictionary adds to them."""
