"""What lamps, machines and things that burst do by themselves."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import replace

from texvent.scenes.description import SPIN_RATE_HZ, Effect, ObjectMotion
from texvent.scenes.language.grammar.syntax import Clause
from texvent.scenes.language.meaning.acts.sequence import add_motion
from texvent.scenes.language.meaning.capabilities import is_living, is_person
from texvent.scenes.language.meaning.draft import Draft
from texvent.scenes.language.meaning.referents.referent import Referent
from texvent.scenes.language.vocabulary.acts import EFFECT_BY_VERB, HANDLED, JOBS
from texvent.scenes.language.vocabulary.motion import WORK_RATES_HZ
from texvent.scenes.language.vocabulary.scene import DEFAULT_BLINK_HZ
from texvent.scenes.language.words.word import Word, mark_used
from texvent.scenes.models.lamps import LAMPS
from texvent.scenes.models.machine_acts import COLLAPSE, LIFT
from texvent.scenes.models.wrapped.opening import OPENING, opens_after

_SWITCHES = ("turn", "change", "switch", "go")
_SIGNALS = ("red", "yellow", "amber", "green")


def give_effect(draft: Draft, clause: Clause, subjects: list[int]) -> bool:
    """As in "a balloon bursts", "a chimney smokes"."""
    kind = EFFECT_BY_VERB.get(clause.verb_word.lemma)
    if clause.verb_word.lemma == "blow" and _are_whales(draft, subjects):
        kind = "fountain"
    by_people = any(is_person(draft.noun(index)) for index in subjects)
    is_own = any(COLLAPSE in draft.noun(index).acts for index in subjects)
    if kind is None or not subjects or by_people or clause.objects or is_own:
        return False
    clause.verb_word.is_used = True
    for index in subjects:
        draft.effects.append(Effect(kind, source=index))
        if kind == "spray" and draft.noun(index).name == "elephant":
            add_motion(draft, index, ObjectMotion(kind), clause)  # its trunk goes up
    return True


def _are_whales(draft: Draft, subjects: list[int]) -> bool:
    return bool(subjects) and all(draft.objects[index].noun == "whale" for index in subjects)


def switch(draft: Draft, clause: Clause, subjects: list[int]) -> bool:
    """What lamps and traffic lights do by themselves."""
    return (
        switch_signal(draft, clause, subjects)
        or switch_lamps(draft, clause, subjects)
        or do_job(draft, clause, subjects)
        or open_up(draft, clause, subjects)
    )


def do_job(draft: Draft, clause: Clause, subjects: list[int]) -> bool:
    """As in "a robot vacuum cleans the floor", "an excavator digs"."""
    lemma = clause.verb_word.lemma
    doers = [i for i in subjects if lemma in JOBS.get(draft.objects[i].noun, ((), ""))[0]]
    if clause.objects and any(draft.objects[index].noun in HANDLED for index in doers):
        return False  # "takes a box from a shelf": not the block of its model
    for index in doers:
        item = draft.objects[index]
        if not item.motions:
            item.motions.append(ObjectMotion(JOBS[item.noun][1]))
    if doers and lemma in _JOBS_IN_PART:
        clause.verb_word.shown_as = JOBS[draft.objects[doers[0]].noun][1]
    clause.verb_word.is_used = clause.verb_word.is_used or bool(doers)
    return bool(doers)


_JOBS_IN_PART = frozenset({"sort", "stack", "pack", "load", "unload"})
"""Jobs of which only the hand's way from place to place is seen."""

_LIFTED_BY = frozenset({"forklift"})
_LIFTING = frozenset({"lift", "raise", "hoist", "pick", "pick up", "lift up", "elevate"})


def lift_load(draft: Draft, clause: Clause, subjects: list[int], targets: list[int]) -> bool:
    """As in "a forklift lifts a pallet": it goes up on the forks."""
    doers = [index for index in subjects if draft.objects[index].noun in _LIFTED_BY]
    if not doers or not targets or clause.verb_word.lemma not in _LIFTING:
        return False
    for index in doers:
        draft.objects[index].motions.append(ObjectMotion(LIFT))
    clause.verb_word.is_used = draft.relate("with", doers, targets[:1])
    return True


def take_handled(draft: Draft, clause: Clause, subjects: Sequence[int]) -> None:
    """As in "a robot arm picks up a cup": its model has a block for it."""
    doer = next((i for i in subjects if draft.objects[i].noun in HANDLED), None)
    if doer is None or clause.verb is None or clause.is_passive or clause.phrases:
        return
    noun = draft.objects[doer].noun
    if clause.verb.lemma not in JOBS[noun][0]:
        return
    for group in clause.objects:
        for word in group.words:
            if word is group.head:
                word.things = (doer,)
                word.is_used = word.lemma == HANDLED[noun] or word.lemma in _BLOCKS
                is_one = word.is_used and not word.meaning.is_plural
                word.shown_as = None if is_one else f"one {HANDLED[noun]}"
    clause.objects = []


_BLOCKS = ("cube", "box")
_OPENING_VERBS = {"open": "open", "close": "close", "shut": "close", "slam": "close"}
_LEAF_VERBS = frozenset({"swing", "slide", "creak", "fly", "slam", "pop", "flip", "move"})


def open_up(draft: Draft, clause: Clause, subjects: list[int]) -> bool:
    """As in "a door opens", "a drawer slides open", "the lid is closed"."""
    kind = _OPENING_VERBS.get(clause.verb_word.lemma)
    for word in clause.adverbs:
        if word.text in ("open", "shut", "closed") and clause.verb_word.lemma in _LEAF_VERBS:
            kind = "open" if word.text == "open" else "close"
            word.is_used = True
    if kind is None or clause.objects:
        return False
    doers = [
        index
        for index in subjects
        if draft.noun(index).name in OPENING or kind in draft.noun(index).acts
    ]
    for index in doers:
        before = draft.objects[index].motions
        kind = opens_after(before[-1].kind if before else None, kind)
        draft.objects[index].motions = [ObjectMotion(kind)]
    clause.verb_word.is_used = clause.verb_word.is_used or bool(doers)
    draft.link_motion([clause.verb_word], doers)
    return bool(doers)


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


def light_up(draft: Draft, one: Referent, things: Sequence[int]) -> bool:
    """As in "with flashing blue lights", "with lights": lamps of what has them, or lights on it."""
    flicker, colours = one.attributes.flicker, one.attributes.colours
    colour = colours[0][0] if colours else None
    said = [word for _, words in colours[:1] for word in words]
    for index in things:
        item, noun = draft.objects[index], draft.noun(index)
        if noun.name in BEACONED:
            own = BEACONED[noun.name]
            hues = {named.name.split()[-1] for named, _ in colours}
            said = [one for _, words in colours for one in words] if hues == own else []
        elif noun.motion == "drive" and flicker is not None:
            draft.effects.append(Effect("beacon", index, colour))
            if one.group.head is not None:
                one.group.head.shown_as = "two lights on its roof that flash in turn"
        elif noun.name in LAMPS:
            item.is_lit = True
            item.blink_hz = DEFAULT_BLINK_HZ if flicker is not None else item.blink_hz
            said = []
        elif not is_living(noun):
            kind = "string lights" if flicker is None else "blinking lights"
            draft.effects.append(Effect(kind, index, colour))
        else:
            return False
    mark_used([*said, *([flicker] if flicker is not None else []), *one.group.words[-1:]])
    return bool(things)


BEACONED = {"police car": {"blue", "red"}, "fire engine": {"blue"}, "ambulance": {"blue"}}
"""Vehicles whose models have flashing lights → their colours: a prompt that names one of two
does not get it."""
SWITCHED_HZ = 0.8
"""How often a lamp is switched on and off."""
_ON_AND_OFF = frozenset({"switch", "turn", "flick", "go", "toggle"})

_LIGHTS = ("light", "lamp", "siren", "signal", "blinker")


def switch_lamps(draft: Draft, clause: Clause, subjects: list[int]) -> bool:
    """As in "a lamp goes off"; not as in "a car turns left on a road"."""
    on = {"on", "off"}
    lights = (group.head.lemma.split()[-1] for one in clause.phrases if one.preposition.text in on
              for group in one.groups if group.head is not None)  # fmt: skip
    is_of_lights = bool(clause.objects) or any(one.endswith(_LIGHTS) for one in lights)
    lamps = [
        index
        for index in subjects
        if draft.objects[index].noun in LAMPS and (is_of_lights or not draft.noun(index).speed_m_s)
    ]
    text = {word.text for word in clause.adverbs} | {one.preposition.text for one in clause.phrases}
    if not lamps or clause.verb_word.lemma not in _ON_AND_OFF or not text & on:
        return False
    for index in lamps:
        draft.objects[index].blink_hz = SWITCHED_HZ
    clause.verb_word.is_used = True
    return True


def blink(draft: Draft, word: Word, subjects: list[int]) -> list[int]:
    """As in "a lamp flickers": the lamps among the subjects."""
    if any(draft.objects[index].noun == "eye" for index in subjects) and word.lemma == "blink":
        word.is_used = True
        return []
    lamps = [index for index in subjects if draft.objects[index].noun in LAMPS]
    for index in lamps:
        draft.objects[index].blink_hz = DEFAULT_BLINK_HZ
        word.is_used = True
    return lamps


def _goes_and_returns(motion: ObjectMotion) -> bool:
    return motion.direction in ("to and fro", "up and down") or motion.kind == "sway"


def set_rate(draft: Draft, things: list[int], rate_hz: float) -> bool:
    """Turns per second of what spins, flashes of what blinks, rounds of what goes and returns."""
    is_used = False
    for index in things:
        item = draft.objects[index]
        if item.blink_hz is not None:
            item.blink_hz, is_used = rate_hz, True
        elif item.motions and _goes_and_returns(item.motions[-1]):
            item.motions[-1], is_used = replace(item.motions[-1], rate_hz=rate_hz), True
        elif item.motions and item.motions[-1].kind == "spin":
            own_hz = WORK_RATES_HZ.get(item.noun)
            if own_hz is None and draft.noun(index).is_working:
                continue
            pace = rate_hz / (own_hz or SPIN_RATE_HZ)
            item.motions[-1] = replace(item.motions[-1], pace=pace)
            is_used = True
    return is_used
