"""What lamps, machines and things that burst do by themselves."""

from __future__ import annotations

from dataclasses import replace

from texvent.scenes.description import SPIN_RATE_HZ, Effect
from texvent.scenes.language.grammar.syntax import Clause
from texvent.scenes.language.meaning.capabilities import is_person
from texvent.scenes.language.meaning.draft import Draft
from texvent.scenes.language.vocabulary.acts import EFFECT_BY_VERB
from texvent.scenes.language.vocabulary.motion import WORK_RATES_HZ
from texvent.scenes.language.vocabulary.scene import DEFAULT_BLINK_HZ
from texvent.scenes.language.words.word import Word, mark_used
from texvent.scenes.models.lamps import LAMPS

_SWITCHES = ("turn", "change", "switch", "go")
_SIGNALS = ("red", "yellow", "amber", "green")


def give_effect(draft: Draft, clause: Clause, subjects: list[int]) -> bool:
    """As in "a balloon bursts", "a chimney smokes"."""
    kind = EFFECT_BY_VERB.get(clause.verb_word.lemma)
    by_people = any(is_person(draft.noun(index)) for index in subjects)
    if kind is None or not subjects or by_people or clause.objects:
        return False
    clause.verb_word.is_used = True
    for index in subjects:
        draft.effects.append(Effect(kind, source=index))
    return True


def switch_signal(draft: Draft, clause: Clause, subjects: list[int]) -> bool:
    """As in "a traffic light turns from red to green", which it does by itself."""
    names = {draft.objects[index].noun for index in subjects}
    if names != {"traffic light"} or clause.verb_word.lemma not in _SWITCHES:
        return False
    clause.verb_word.is_used = True
    draft.note("the traffic light goes through all its colours")
    groups = [group for phrase in clause.phrases for group in phrase.groups]
    for group in (*groups, *clause.complements, *clause.objects):
        mark_used(word for word in group.words if word.text in _SIGNALS)
    return True


def blink(draft: Draft, word: Word, subjects: list[int]) -> list[int]:
    """As in "a lamp flickers": the lamps among the subjects."""
    lamps = [index for index in subjects if draft.objects[index].noun in LAMPS]
    for index in lamps:
        draft.objects[index].blink_hz = DEFAULT_BLINK_HZ
        word.is_used = True
    return lamps


def set_rate(draft: Draft, things: list[int], rate_hz: float) -> bool:
    """Turns per second of what spins, or flashes per second of what blinks."""
    is_used = False
    for index in things:
        item = draft.objects[index]
        if item.blink_hz is not None:
            item.blink_hz, is_used = rate_hz, True
        elif item.motions and item.motions[-1].kind == "spin":
            own_hz = WORK_RATES_HZ.get(item.noun)
            if own_hz is None and draft.noun(index).is_working:
                continue
            pace = rate_hz / (own_hz or SPIN_RATE_HZ)
            item.motions[-1] = replace(item.motions[-1], pace=pace)
            is_used = True
    return is_used
