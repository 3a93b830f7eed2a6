"""Words that mean something else beside others: "walks off", "about to fall", "to the next"."""

from __future__ import annotations

from collections.abc import Sequence

from texvent.scenes.language.vocabulary.verbs import Verb
from texvent.scenes.language.words.english import Pos
from texvent.scenes.language.words.lexicon import Meaning, Role
from texvent.scenes.language.words.word import Word

_LEAVING = frozenset(
    {"move", "walk", "run", "drive", "fly", "sail", "swim", "paddle", "crawl", "skate", "ski",
     "slide"}
)  # fmt: skip
"""Motions of which "off" says that they lead away."""
_OF_NOUNS = frozenset({Pos.DETERMINER, Pos.NOUN, Pos.ADJECTIVE, Pos.NUMBER, Pos.PRONOUN})
"""Parts of speech that open a noun group: "falls off a table"."""
_BEFOREHAND = frozenset({"about", "ready", "waiting", "wait", "waits", "prepares", "preparing",
                         "hesitates", "hesitating", "poised", "unable"})  # fmt: skip
"""Words before "to" after which something is not done yet."""
_ANOTHER = frozenset({"another", "next", "other", "the other", "second", "the second"})


def read_neighbours(words: Sequence[Word]) -> None:
    """Change the readings of words that their neighbours decide."""
    _forget_game(words)
    _forget_axis(words)
    for number, word in enumerate(words):
        before = words[number - 1] if number else None
        after = words[number + 1] if number + 1 < len(words) else None
        if word.text == "off" and before is not None and _leads_away(before, after):
            word.meaning = Meaning(Role.DIRECTION, Pos.ADVERB, "away")
        if word.pos is Pos.TO and before is not None and before.text in _BEFOREHAND:
            _put_off(words[number + 1 :])
        if word.text in _ANOTHER and before is not None and _is_goal_alone(words, number):
            word.mean(Meaning(Role.UNKNOWN, Pos.NOUN))
        if _is_measure(word, before, after):
            word.lose(Pos.ADJECTIVE)
        if word.text in _AT_OTHER_TIMES:
            _put_aside_weather(word, words[number + 1 : number + 5])
        if word.text == "left":
            _stay_behind(word, before, after)


def _is_measure(word: Word, before: Word | None, after: Word | None) -> bool:
    """As in "a two layered cake", "a three wheeled cart": one thing, whatever it has of them."""
    is_one = before is not None and before.text in ("a", "an")
    is_number = word.role is Role.COUNT and len(word.tokens) == 1
    if not (is_one and is_number and after is not None) or after.role is Role.UNIT:
        return False
    return after.pos in (Pos.ADJECTIVE, Pos.NOUN, Pos.VERB) and not after.meaning.is_plural


_AT_OTHER_TIMES = ("after", "before")
_SPELLS = ("shower", "storm", "day", "night", "spell")


def _put_aside_weather(preposition: Word, coming: Sequence[Word]) -> None:
    """As in "after a rain shower", "before a storm": no rain falls yet, or any more."""
    group: list[Word] = []
    for word in coming:
        if word.pos not in _OF_NOUNS:
            break
        group.append(word)
    is_of_weather = any(word.role in (Role.WEATHER, Role.SNOW) for word in group)
    is_last = bool(group) and (
        group[-1].role in (Role.WEATHER, Role.SNOW) or group[-1].lemma in _SPELLS
    )
    if not (is_of_weather and is_last):
        return  # "before a snowy mountain"
    preposition.meaning = Meaning(Role.FUNCTION, preposition.pos)
    for word in group:
        if word.pos is not Pos.DETERMINER:
            word.lose(word.pos)


def _stay_behind(word: Word, before: Word | None, after: Word | None) -> None:
    """As in "is left alone", "a bicycle left on a street": nothing goes, to the left neither."""
    if word.pos is Pos.VERB:
        is_left = after is None or after.pos is not Pos.DETERMINER  # "left the garage"
    else:
        is_thing = before is not None and before.role is Role.NOUN and before.pos is Pos.NOUN
        is_left = is_thing and after is not None and after.text.split()[0] in _LEFT_THERE
    if is_left:
        word.lose(Pos.VERB if word.pos is Pos.VERB else Pos.ADVERB)


_LEFT_THERE = frozenset(
    {"on", "in", "at", "under", "inside", "outside", "behind", "beside", "near", "out", "open",
     "alone", "unattended", "abandoned", "empty", "over", "by", "next", "to"}
)  # fmt: skip
"""What follows "left" where it means that something was left there."""


def _forget_game(words: Sequence[Word]) -> None:
    """As in "friends play rock paper scissors": no rock is there; only a hand shows the game."""
    texts = [word.text for word in words]
    for number in range(len(words) - 2):
        if texts[number : number + 3] not in _GAMES:
            continue
        near = (*texts[:number], *texts[number + 3 : number + 5])
        if not any(text.rstrip("s") in _OF_HANDS for text in near):
            for word in words[number : number + 3]:
                word.mean(Meaning(Role.UNKNOWN, Pos.NOUN))


_OF_HANDS = ("hand", "fist", "gesture")
_GAMES = (["rock", "paper", "scissors"], ["rock", "scissors", "paper"],
          ["scissors", "paper", "rock"])  # fmt: skip


def _forget_axis(words: Sequence[Word]) -> None:
    """As in "spins around its own axis": it just spins."""
    for number, word in enumerate(words):
        if word.text not in ("axis", "axes"):
            continue
        first = number
        while first and words[first - 1].text in _OF_AXES:
            first -= 1
        if first and words[first - 1].text in ("around", "about", "round", "on"):
            for one in words[first - 1 : number + 1]:
                one.mean(Meaning(Role.FUNCTION, Pos.ADVERB))
                one.is_used = True


_OF_AXES = ("its", "their", "own", "an", "the", "his", "her")


def _leads_away(verb: Word, after: Word | None) -> bool:
    """As in "a dog runs off"; not "runs off the road"."""
    value = verb.meaning.value
    is_way = isinstance(value, Verb) and value.kind in _LEAVING and value.direction is None
    return is_way and verb.pos is Pos.VERB and (after is None or after.pos not in _OF_NOUNS)


def _put_off(after: Sequence[Word]) -> None:
    """As in "is about to jump": nothing jumps yet."""
    for word in after:
        if word.pos is Pos.VERB:
            word.lose(Pos.VERB)
            return
        if word.pos is not Pos.ADVERB:
            return


def _is_goal_alone(words: Sequence[Word], number: int) -> bool:
    """As in "from one table to another", "to the next": which one is not said by a noun."""
    first = number - 1
    if words[first].pos is Pos.DETERMINER:
        first -= 1
    after = words[number + 1] if number + 1 < len(words) else None
    is_last = after is None or after.pos not in (Pos.NOUN, Pos.ADJECTIVE)
    return first >= 0 and words[first].text in ("to", "towards", "toward", "onto") and is_last
