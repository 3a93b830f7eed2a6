"""Set phrases as the plain words that they mean: "on the top of" is "on", "makes its way" "moves".

The tokens keep what the prompt has for them (`Token.said`), so that reports name that.
"""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from functools import lru_cache
from itertools import pairwise

from texvent.scenes.inflection import pluralise
from texvent.scenes.language.phrases.moods import MOODS
from texvent.scenes.language.phrases.set_phrases import SET_PHRASES
from texvent.scenes.language.words.english import Pos, VerbForm, list_readings, list_verb_forms
from texvent.scenes.language.words.tokens import Token

_LYING = {"laying": "lying", "lays": "lies"}
_MISSPELT = {"siting": "sitting"}
_WATERS = frozenset({"ocean", "sea", "pool", "river", "lake", "pond", "tank", "aquarium"})
"""What has a bottom on which things lie: there "on the bottom of" is no "under"."""
_OUTINGS = {"walk": "walk", "stroll": "stroll", "run": "run", "jog": "jog", "swim": "swim",
            "nap": "sleep", "bow": "bow", "leap": "leap", "jump": "jump", "dive": "dive",
            "hike": "hike"}  # fmt: skip
"""What one takes → the verb for it: "takes a walk"."""
_TAKING = {form: kind for base in ("take", "have") for form, kind in list_verb_forms(base)}
_OWN = frozenset({"its", "their", "his", "her", "it's", "it", "our"})
_SUBJECTLESS = frozenset({"it", "they", "he", "she", "we", "i", "you", "who", "that", "which"})
_HAVING = frozenset({"has", "have", "featuring", "including", "includes", "contains"})
_OF_FILM = frozenset({"scene", "shot", "view", "video", "clip", "footage", "image", "photo",
                      "picture", "camera"})  # fmt: skip
_UNREPORTED = frozenset({"a", "on", "in", "of"})
"""Words that reports leave out."""
_OPENS_GROUP = frozenset({"a", "an", "the", "some", "several", "many", "various", "multiple", "its",
                          "their", "his", "her", "no", "lots", "very"})  # fmt: skip


def plain_phrases(tokens: Sequence[Token]) -> list[Token]:
    """The tokens with set phrases replaced by the plain words that they mean."""
    found: list[Token] = []
    at = 0
    while at < len(tokens):
        replaced = _replace(tokens, at)
        if replaced is None:
            found.append(tokens[at])
            at += 1
            continue
        length, new = replaced
        found.extend(new)
        at += length
    return found


def _replace(tokens: Sequence[Token], at: int) -> tuple[int, list[Token]] | None:
    """Number of tokens that a phrase takes, and what it becomes; None where none begins."""
    rules = (
        _replace_fixed,
        _surround,
        _go_the_way,
        _take_outing,
        _have,
        _lie,
        _stand_on_skis,
        _name_game,
        _own,
        _ride_on,
        _run_after,
        _seem,
        _name_kind,
        _name_another,
        _call,
    )
    return next((one for rule in rules if (one := rule(tokens, at)) is not None), None)


def _stand_for(tokens: Sequence[Token], text: str) -> list[Token]:
    """Tokens of the plain words; the first that says something is reported as the prompt has it."""
    words = text.split()
    if len(words) == 2 and words[0] == "beside" and words[-1] == tokens[-1].text:
        # The road of "on the side of the road" is named as it is.
        return [*_stand_for(tokens[:-1], " ".join(words[:-1])), tokens[-1]]
    said = " ".join(token.text for token in tokens).removeprefix("a ")
    written = " ".join(token.written for token in tokens)
    first = next((at for at, word in enumerate(words) if word not in _UNREPORTED), 0)
    return [
        Token(word, written if at == first else word, said=said if at == first else "")
        for at, word in enumerate(words)
    ]


def _replace_fixed(tokens: Sequence[Token], at: int) -> tuple[int, list[Token]] | None:
    table = _by_words()
    for length in range(min(_LONGEST, len(tokens) - at), 0, -1):
        plain = table.get(tuple(token.text for token in tokens[at : at + length]))
        if plain is None or any(token.picture for token in tokens[at : at + length]):
            continue
        if plain == _UPON and not _is_borne(tokens, at + length):
            return None
        coming = {token.text for token in tokens[at + length : at + length + 3]}
        if plain == "under" and coming & _WATERS:
            return None
        if plain.endswith(" horse") and any(_is_plural(token.text) for token in tokens[:at]):
            plain = plain.replace("a horse", "horses")  # as in "two men on horseback"
        return length, _stand_for(tokens[at : at + length], plain) if plain else []
    return None


def _is_borne(tokens: Sequence[Token], at: int) -> bool:
    """Whether an animal follows, on whose back one is, or an animal is on the roof of a car."""
    texts = {token.text for token in tokens[at : at + 3]}
    before = {token.text for token in tokens[:at]}
    return bool(texts & _BACKS) or bool(texts & _ROOFED and before & _ON_ROOFS)


_UPON = "atop"
_BACKS = frozenset(
    {"cow", "horse", "elephant", "camel", "donkey", "pony", "rhino", "zebra", "bull", "buffalo",
     "giraffe", "hippo", "sheep", "turtle", "dog", "goat", "ox"}
)  # fmt: skip
_ROOFED = frozenset({"car", "van", "bus", "suv", "jeep", "taxi", "truck"})
_ON_ROOFS = frozenset({"cat", "dog", "bird", "pigeon", "gull", "seagull", "kitten", "monkey"})


def _surround(tokens: Sequence[Token], at: int) -> tuple[int, list[Token]] | None:
    """As in "people surrounding a cake": around it; "the surrounding hills" are something else."""
    if tokens[at].text != "surrounding" or at == 0 or at + 1 >= len(tokens):
        return None
    is_around = tokens[at + 1].text in _OPENS_GROUP and _is_noun(tokens[at - 1].text)
    return (1, _stand_for(tokens[at : at + 1], "around")) if is_around else None


def _go_the_way(tokens: Sequence[Token], at: int) -> tuple[int, list[Token]] | None:
    """As in "makes its way", "make their way": moves."""
    texts = [token.text for token in tokens[at : at + 3]]
    if len(texts) < 3 or texts[1] not in _OWN or texts[2] != "way":
        return None
    form = _form_of(texts[0], ("make", "work", "wind", "pick"))
    return None if form is None else (3, _stand_for(tokens[at : at + 3], _inflect("move", form)))


def _take_outing(tokens: Sequence[Token], at: int) -> tuple[int, list[Token]] | None:
    """As in "taking a peaceful walk": walking."""
    form = _TAKING.get(tokens[at].text)
    if form is None or at + 2 >= len(tokens) or tokens[at + 1].text not in ("a", "an"):
        return None
    length = 4 if tokens[at + 2].text in MOODS else 3
    last = tokens[at + length - 1].text if at + length <= len(tokens) else ""
    if last not in _OUTINGS:
        return None
    return length, _stand_for(tokens[at : at + length], _inflect(_OUTINGS[last], form))


def _have(tokens: Sequence[Token], at: int) -> tuple[int, list[Token]] | None:
    """As in "A room has two windows": a room with them; "has on a hat": wears it."""
    if tokens[at].text not in _HAVING or at == 0 or at + 1 >= len(tokens):
        return None
    before, after = tokens[at - 1].text, tokens[at + 1].text
    coming = [token.text for token in tokens[at + 2 : at + 3]]
    if after == "on" and coming and coming[0] not in ("it", "them", "top", "its", "the"):
        return 2, _stand_for(tokens[at : at + 2], "wearing")
    if before in _SUBJECTLESS or before in _OF_FILM or not _is_noun(before):
        return None
    return (1, _stand_for(tokens[at : at + 1], "with")) if after in _OPENS_GROUP else None


def _lie(tokens: Sequence[Token], at: int) -> tuple[int, list[Token]] | None:
    """As in "a dog laying on a rug": lying; "laying bricks" is something else."""
    text = tokens[at].text
    if text in _MISSPELT:
        return 1, _stand_for(tokens[at : at + 1], _MISSPELT[text])
    if text not in _LYING:
        return None
    after = tokens[at + 1].text if at + 1 < len(tokens) else "."
    return (1, _stand_for(tokens[at : at + 1], _LYING[text])) if _is_after_lying(after) else None


def _stand_on_skis(tokens: Sequence[Token], at: int) -> tuple[int, list[Token]] | None:
    """As in "a man on skis going down a hill": skiing; "people wearing skis": standing on them."""
    texts = [token.text for token in tokens[at : at + 5]]
    is_on = texts[:1] in (["on"], ["wearing"], ["in"]) and at + 1 < len(tokens)
    if not is_on or tokens[at + 1].written.casefold() not in ("skis", "ski's", "skies") or at == 0:
        return None
    forms = {one.form for one in list_readings(tokens[at - 1].text) if one.pos is Pos.VERB}
    if forms - {VerbForm.BASE} or not _is_noun(tokens[at - 1].text):
        return None
    being = texts[2:3] if texts[2:3] in (["is"], ["are"]) else []
    coming = texts[2 + len(being)] if len(texts) > 2 + len(being) else ""
    if coming == "passing" and not being:
        return 3, _stand_for(tokens[at : at + 3], "skiing past")
    if coming in _GLIDING or coming in _POSING:
        last = 2 + len(being)
        said = [*tokens[at : at + 2], tokens[at + last]]
        plain = "skiing" if coming in _GLIDING else "standing on skis"
        return last + 1, [*tokens[at + 2 : at + last], *_stand_for(said, plain)]
    is_other = coming.endswith("ing")
    return None if is_other else (2, _stand_for(tokens[at : at + 2], "standing on skis"))


_POSING = frozenset({"posing", "poses", "pose", "standing", "stands", "stand"})
_GLIDING = frozenset({"going", "coming", "gliding", "moving", "heading", "traveling", "travelling",
                      "racing", "sliding", "riding"})  # fmt: skip


def _name_game(tokens: Sequence[Token], at: int) -> tuple[int, list[Token]] | None:
    """As in "a football game", "a game of football": people playing it, where none are named."""
    texts = [token.text for token in tokens[at : at + 3]]
    if texts[:1] in (["game"], ["match"]) and texts[1:2] == ["of"]:
        length, sport = 3, texts[-1]
    else:
        length, sport = 2, texts[0]
        if texts[1:2] not in (["game"], ["match"]):
            return None
    is_named = any(_is_noun(token.text) for token in tokens[:at] if token.text not in _NO_PLAYERS)
    if sport not in _SPORTS or is_named:
        return None
    after = [token.text for token in tokens[at + length : at + length + 3]]
    going_on = next((one for one in _GOING_ON if after[: len(one)] == list(one)), ())
    end = at + length + len(going_on)
    people = [Token(text, text, said="") for text in ("three", "people")]
    return end - at, [*people, *_stand_for(tokens[at:end], f"playing {sport}")]


_SPORTS = frozenset({"baseball", "football", "soccer", "tennis", "basketball",
                     "badminton"})  # fmt: skip
_NO_PLAYERS = _OF_FILM | {"a", "the", "of", "an", "view", "professional", "night", "league"}
"""Words before a game that name no one who plays it."""
_GOING_ON = tuple(tuple(text.split()) for text in (
    "is being played", "being played", "in progress", "is going on", "going on", "is played",
    "is underway", "taking place",
))  # fmt: skip


def _own(tokens: Sequence[Token], at: int) -> tuple[int, list[Token]] | None:
    """As in "a persons hand", without the sign of the possessive."""
    texts = [token.text for token in tokens[at : at + 3]]
    if len(texts) < 3 or texts[0] not in ("a", "an") or texts[1] not in _OWNERS_BY_PLURAL:
        return None
    if not _is_plain_noun(texts[2]):
        return None
    owner = _OWNERS_BY_PLURAL[texts[1]]
    return 2, [tokens[at], Token(owner, f"{owner}'s")]


_OWNERS_BY_PLURAL = {
    f"{one}s": one
    for one in ("person", "man", "woman", "girl", "boy", "dog", "cat", "child", "horse", "bird",
                "elephant", "giraffe", "bear", "zebra", "cow", "baby", "player", "lady")
}  # fmt: skip
"""Plural that is no plural after "a" → whose something is."""


def _ride_on(tokens: Sequence[Token], at: int) -> tuple[int, list[Token]] | None:
    """As in "riding on motorcycles": riding them; "rides on the rails" is something else."""
    texts = [token.text for token in tokens[at : at + 5]]
    if _form_of(texts[0], ("ride",)) is None or texts[1:2] not in (["on"], ["upon"]):
        return None
    is_ridden = any(text.rstrip("s") in _RIDDEN for text in texts[2:])
    return (2, _stand_for(tokens[at : at + 2], texts[0])) if is_ridden else None


def _run_after(tokens: Sequence[Token], at: int) -> tuple[int, list[Token]] | None:
    """As in "a dog runs after a cat", "goes after it": it chases it."""
    texts = [token.text for token in tokens[at : at + 4]]
    form = _form_of(texts[0], ("run", "go"))
    if form is None or texts[1:2] != ["after"] or len(texts) < 3 or texts[2] not in _CHASED:
        return None
    is_time = texts[3:4] and texts[3] in _TIMES
    return None if is_time else (2, _stand_for(tokens[at : at + 2], _inflect("chase", form)))


_CHASED = frozenset({"a", "an", "the", "her", "him", "it", "them", "his", "its", "their", "one",
                     "another", "two", "three", "each"})  # fmt: skip
_TIMES = frozenset({"while", "moment", "rain", "storm", "race", "game", "day", "night", "start"})


def _seem(tokens: Sequence[Token], at: int) -> tuple[int, list[Token]] | None:
    """As in "a doll posed as if sitting": it sits, as far as one sees."""
    texts = [token.text for token in tokens[at : at + 3]]
    is_seeming = texts[:1] == ["as"] and texts[1:2] in (["if"], ["though"])
    return (2, []) if is_seeming and len(texts) > 2 and texts[2].endswith("ing") else None


def _name_kind(tokens: Sequence[Token], at: int) -> tuple[int, list[Token]] | None:
    """As in "a hen runs to a flock of its kind": of hens."""
    texts = [token.text for token in tokens[at : at + 3]]
    if texts[:1] != ["of"] or texts[1:2] not in (["its"], ["their"]) or texts[2:] != ["kind"]:
        return None
    first = next((one.text for one in tokens[:at] if _is_plain_noun(one.text)), None)
    if first is None:
        return None
    return 3, _stand_for(tokens[at : at + 3], f"of {pluralise(first)}")


def _name_another(tokens: Sequence[Token], at: int) -> tuple[int, list[Token]] | None:
    """As in "one dog follows another": another dog."""
    if tokens[at].text != "another" or (at + 1 < len(tokens) and not _ends_group(tokens[at + 1])):
        return None
    if any(token.text == "from" for token in tokens[:at]):
        return None  # as in "from one table to another"
    first = next(
        (two.text for number, (one, two) in enumerate(pairwise(tokens[:at]))
         if one.text in ("a", "an", "one", "the") and _is_noun(two.text)
         and (number == 0 or tokens[number - 1].text not in _WHERE)), None
    )  # fmt: skip
    return None if first is None else (1, _stand_for(tokens[at : at + 1], f"another {first}"))


_WHERE = frozenset({"on", "in", "at", "near", "under", "by", "behind", "beside", "of", "with"})


def _ends_group(token: Token) -> bool:
    return token.is_punctuation or token.text in _AFTER_LYING


def _call(tokens: Sequence[Token], at: int) -> tuple[int, list[Token]] | None:
    """As in "holding a phone up to his ear": talking on it."""
    form = _form_of(tokens[at].text, ("hold", "have", "put", "press"))
    texts = [token.text for token in tokens[at : at + 9]]
    ear = next((n for n, text in enumerate(texts) if text in ("ear", "ears")), 0)
    if form is None or not ear or not _PHONES & {*texts[:ear]} or texts[ear - 1] not in _OWN_EAR:
        return None
    plain = _inflect("talk", form)
    return ear + 1, _stand_for(tokens[at : at + ear + 1], f"{plain} on a cell phone")


_PHONES = frozenset({"phone", "cellphone", "telephone", "smartphone", "phones"})
_OWN_EAR = frozenset({"his", "her", "their", "the", "its", "an"})


def _is_plain_noun(word: str) -> bool:
    readings = list_readings(word)
    found = {one.pos for one in readings}
    return Pos.NOUN in found and Pos.ADJECTIVE not in found


_RIDDEN = frozenset({"motorcycle", "horse", "bike", "bicycle", "elephant", "scooter", "skateboard",
                     "camel", "surfboard", "donkey", "pony", "motorbike", "moped"})  # fmt: skip


def _is_after_lying(word: str) -> bool:
    return not word[0].isalnum() or word in _AFTER_LYING


_AFTER_LYING = frozenset(
    {"on", "in", "under", "next", "beside", "near", "down", "by", "across", "at", "atop", "inside",
     "against", "around", "over", "between", "behind", "with", "and", "while", "there", "together",
     "outside", "asleep", "partially", "partly", "upon", "alongside", "out", "still", "beneath",
     "flat", "comfortably"}
)  # fmt: skip


def _is_plural(word: str) -> bool:
    return any(one.is_plural for one in list_readings(word))


def _is_noun(word: str) -> bool:
    readings = list_readings(word)
    return not readings or any(one.pos is Pos.NOUN for one in readings)


def _form_of(word: str, bases: Sequence[str]) -> VerbForm | None:
    return next(
        (form for base in bases for text, form in list_verb_forms(base) if text == word), None
    )


def _inflect(base: str, form: VerbForm) -> str:
    return next((text for text, one in list_verb_forms(base) if one is form), base)


def _list_phrases() -> Iterator[tuple[tuple[str, ...], str]]:
    for plain, phrases in SET_PHRASES.items():
        for phrase in phrases:
            yield tuple(phrase.split()), plain


_LONGEST = max(len(words) for words, _ in _list_phrases())


@lru_cache(maxsize=1)
def _by_words() -> dict[tuple[str, ...], str]:
    return dict(_list_phrases())
