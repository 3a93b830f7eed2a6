"""Prompts in the style of a telegram: "drone flip", "javelin throw", "head nodding"."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from dataclasses import replace
from functools import lru_cache
from itertools import pairwise

from texvent.scenes.language.grammar.noun_groups import is_done_to_things
from texvent.scenes.language.vocabulary.acts import JOBS
from texvent.scenes.language.vocabulary.scene import TIMELAPSES
from texvent.scenes.language.vocabulary.verbs import Verb
from texvent.scenes.language.words.english import Pos, VerbForm, list_readings
from texvent.scenes.language.words.lexicon import Lexicon, Meaning, Role
from texvent.scenes.language.words.word import Word
from texvent.scenes.models.nouns import NOUNS
from texvent.scenes.models.people.activities import ACTIVITIES
from texvent.scenes.models.wrapped.opening import OPENS

_FINITE = frozenset({Pos.VERB, Pos.AUXILIARY})
_OF_VERBS = (Role.VERB, Role.ACTIVITY, Role.SIMILAR)
_PERSON = "person"
_OF_PEOPLE = frozenset(
    {"head", "face", "mouth", "lip", "arm", "leg", "foot", "finger", "elbow", "knee", "shoulder",
     "hip", "torso", "body"}
)  # fmt: skip
"""Parts that tell of a person by themselves."""
_PASSIVE = frozenset(
    {"fall", "roll", "spin", "topple", "bounce", "swing", "slide", "sway", "rise", "flip"}
)
"""Motions of what does not go by itself."""
_CUTTING = frozenset({"cut", "knock", "shuffle"})
"""What only people do to a thing that stands alone before it: "bread cutting"."""
_GOING = frozenset({"drive", "walk", "cycle", "bike", "run", "fly"})
_DRIFTING = frozenset({"drift", "scroll", "pan", "slide", "rotate"})
"""What a place does before a camera that pans: "a drifting star field"."""
_FORWARD = ("travel", "forward")
_VAGUE = frozenset({"exit", "entry", "move", "pass", "release", "start", "test", "show"})
"""Nouns that do not say what the thing before them does: "tunnel exit"."""


def read_telegrams(words: Sequence[Word], known: Lexicon) -> list[Word]:
    """The words of a prompt, read as a telegram where a part of it has no verb; the words change.

    1. A noun that is known as a verb alone is one after a thing: "a drone flip" is a drone that
       flips; "a javelin throw" is someone throwing a javelin; "a skater fast spin" spins fast.
    2. A part of the body that acts is a person who does: "head nodding"; headlights are a car's.
    3. A material before a verb is the thing: "glass shattering".
    4. What is done to the thing before it comes before the thing: "page turning".
    5. A rate at the end is that of the thing before it: "blinking LED 200 Hz".
    6. Who goes through a place without being named is the camera: "night driving"; before a
       camera that pans it drifts: "star field drifting".
    """
    found: list[Word] = []
    for part in _cut(words):
        _name_material(part)
        _give_body(part, known)
        _give_car(part)
        _set_aside_film(part)
        _let_camera_go(part)
        found.extend(_bring_forward(_turn_into_verb(_move_pace(_move_rate(part)))))
    return found


def _cut(words: Sequence[Word]) -> Iterator[list[Word]]:
    """Parts of a prompt between its signs; each sign ends its part."""
    part: list[Word] = []
    for word in words:
        part.append(word)
        if word.pos is Pos.SIGN:
            yield part
            part = []
    yield part


def _move_rate(part: list[Word]) -> list[Word]:
    words = [word for word in part if word.pos is not Pos.SIGN]
    if len(words) < 3 or any(word.pos is Pos.PREPOSITION for word in words):
        return part
    *things, number, unit = words
    is_rate = unit.role is Role.UNIT and unit.meaning.value[0] == "rate"
    if not is_rate or number.pos is not Pos.NUMBER or things[-1].pos is not Pos.NOUN:
        return part
    first = 1 if things[0].pos is Pos.DETERMINER else 0
    return [*things[:first], number, unit, *things[first:], *part[len(words) :]]


def _move_pace(part: list[Word]) -> list[Word]:
    """As in "horse slow walk": the pace after what is done."""
    for at in range(1, len(part) - 1):
        thing, pace, act = part[at - 1 : at + 2]
        adverb = next((one for one in (pace.meaning, *pace.others)
                       if one.role is Role.PACE and one.pos is Pos.ADVERB), None)  # fmt: skip
        is_after_thing = thing.role is Role.NOUN and thing.pos is Pos.NOUN
        if adverb is not None and is_after_thing and _names_act(act):
            pace.meaning = adverb
            return [*part[:at], act, pace, *part[at + 2 :]]
    return part


def _turn_into_verb(part: list[Word]) -> list[Word]:
    at = next((n for n, word in enumerate(part) if _is_named_act(part, n)), None)
    if at is None or any(word.pos in _FINITE for word in part):
        return part
    word = part[at]
    verbs = [one for one in word.others if one.role in _OF_VERBS]
    done = next((one for one in verbs if is_done_to_things(word.lemma, one)), None)
    jobs = JOBS.get(str(part[at - 1].meaning.value), (frozenset(), ""))[0]
    if done is not None and word.lemma in jobs:
        word.meaning = replace(done, form=VerbForm.ING)
        return part
    verb = done or _find_own(verbs, part[at - 1], word)
    if verb is None:
        return part
    word.meaning = replace(verb, form=VerbForm.ING)
    if done is None:
        return part
    first = at
    while first and part[first - 1].pos in (Pos.NOUN, Pos.ADJECTIVE, Pos.NUMBER, Pos.DETERMINER):
        first -= 1
    return [*part[:first], word, *part[first:at], *part[at + 1 :]]


def _bring_forward(part: list[Word]) -> list[Word]:
    """As in "onion chopping", "guitar playing": the verb before what it is done to."""
    words = [word for word in part if word.pos is not Pos.SIGN]
    if len(words) < 2 or words[-1].meaning.form is not VerbForm.ING:
        return part
    *things, verb = words
    is_bare = all(word.pos in (Pos.NOUN, Pos.ADJECTIVE) for word in things)
    noun = NOUNS.get(str(things[-1].meaning.value)) if things[-1].role is Role.NOUN else None
    if not is_bare or verb.pos is not Pos.VERB or (noun is None and len(things) > 1):
        return part
    lemma = _verb_lemma(verb)
    is_named = (lemma, things[-1].lemma.split()[-1]) in _activity_phrases()
    is_thing = noun is None or noun.habitat == "fixed" or noun.motion == "roll"
    by_hand = noun is not None and not noun.is_working
    is_done = is_done_to_things(lemma, verb.meaning) or lemma in _CUTTING
    by_hand = by_hand and is_done and lemma not in OPENS
    if not is_thing or not (is_named or by_hand):
        return part
    return [verb, *things, *part[len(words) :]]


def _find_own(verbs: Sequence[Meaning], thing: Word, word: Word) -> Meaning | None:
    """What a thing does by itself: not what is fixed, unless it falls, rolls and the like."""
    noun = NOUNS.get(str(thing.meaning.value))
    if noun is None or word.text in _VAGUE:
        return None
    is_fixed = noun.habitat == "fixed"
    return next((one for one in verbs if not is_fixed or _kind(one) in _PASSIVE), None)


@lru_cache(maxsize=1)
def _activity_phrases() -> frozenset[tuple[str, ...]]:
    """Verb and noun of the activities that need both: "play", "guitar"."""
    phrases = (text.replace("-", " ").split() for one in ACTIVITIES.values()
               for text in (*one.words, *one.near))  # fmt: skip
    return frozenset(
        (words[0], words[-1]) for words in phrases if len(words) > 1 and words[-1] not in _OF_PEOPLE
    )


def _verb_lemma(verb: Word) -> str:
    lemmas = [one.lemma for one in list_readings(verb.text) if one.pos is Pos.VERB]
    return (lemmas or [verb.lemma])[0]


def _kind(verb: Meaning) -> str:
    return str(verb.value.kind if isinstance(verb.value, Verb) else verb.value[0])


def _is_named_act(part: Sequence[Word], at: int) -> bool:
    """Whether a word is a noun that only its verb is known of, directly after a thing."""
    is_after_thing = at > 0 and part[at - 1].role is Role.NOUN and part[at - 1].pos is Pos.NOUN
    return is_after_thing and _names_act(part[at])


def _names_act(word: Word) -> bool:
    """Whether it is a noun that only its verb is known of."""
    is_noun = word.role is Role.UNKNOWN and word.pos is Pos.NOUN
    return is_noun and any(one.role in _OF_VERBS for one in word.others)


def _give_body(part: Sequence[Word], known: Lexicon) -> None:
    at = next((n for n, word in enumerate(part) if word.pos is Pos.NOUN), None)
    if at is None or at + 1 >= len(part):
        return
    word, verb = part[at], part[at + 1]
    is_bare = all(one.pos is Pos.DETERMINER and one.text in ("a", "the") for one in part[:at])
    is_part = word.lemma in _OF_PEOPLE and word.role in (Role.PART, Role.UNKNOWN)
    if is_bare and is_part and verb.pos is Pos.VERB and verb.role in _OF_VERBS:
        word.meaning = Meaning(Role.NOUN, Pos.NOUN, _PERSON, is_substitute=True)


_CAR_LIGHTS = frozenset({"headlight", "tail light", "taillight", "brake light"})


def _give_car(part: Sequence[Word]) -> None:
    if any(word.role is Role.NOUN for word in part):
        return
    for word in part:
        if word.lemma in _CAR_LIGHTS and word.pos is Pos.NOUN:
            word.mean(Meaning(Role.NOUN, Pos.NOUN, "car", is_substitute=True))
            return


_SURROUNDINGS = (Role.PLACE, Role.ROAD, Role.LIGHT, Role.LIGHTING, Role.WEATHER, Role.SNOW)


def _set_aside_film(part: Sequence[Word]) -> None:
    """As in "city timelapse": a city, and how it is filmed."""
    for before, word in pairwise(part):
        if word.text in TIMELAPSES and before.pos is Pos.NOUN:
            word.mean(replace(word.meaning, pos=Pos.ADJUNCT))


_DRIVEN_THROUGH = "tunnel"
"""A thing, and a place where one drives through it."""


def _let_camera_go(part: Sequence[Word]) -> None:
    if any(_is_thing(one) or one.pos in _FINITE - {Pos.VERB} for one in part):
        return
    for before, verb in pairwise(part):
        if before.role is Role.PLACE and before.pos is Pos.NOUN and verb.lemma in _DRIFTING:
            verb.mean(Meaning(Role.CAMERA_MOVE, Pos.ADJUNCT, ("pan", None)))
        is_going = verb.meaning.form is VerbForm.ING and verb.lemma in _GOING
        is_around = before.role in _SURROUNDINGS or before.lemma == _DRIVEN_THROUGH
        if is_around and before.pos is not Pos.PREPOSITION and is_going:
            verb.mean(Meaning(Role.CAMERA_MOVE, Pos.ADJUNCT, _FORWARD))


def _is_thing(word: Word) -> bool:
    return word.role is Role.NOUN and word.lemma != _DRIVEN_THROUGH


def _name_material(part: Sequence[Word]) -> None:
    if any(one.pos is Pos.NOUN for one in part):
        return
    for word, after in pairwise(part):
        noun = word.read_as(Role.NOUN)
        is_before_verb = after.pos is Pos.VERB and after.role in _OF_VERBS
        if word.role is Role.MATERIAL and noun is not None and is_before_verb:
            word.meaning = noun
