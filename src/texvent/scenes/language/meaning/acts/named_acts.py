"""Prompts that name an act and no one who does it: "jumping jacks", "lane change", "archery"."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from functools import lru_cache

from texvent.scenes.description import ObjectMotion
from texvent.scenes.language.grammar.syntax import Clause
from texvent.scenes.language.meaning.acts.activities import is_named, name_activity
from texvent.scenes.language.meaning.acts.fitting import fit_verb
from texvent.scenes.language.meaning.acts.partners import PAIRED
from texvent.scenes.language.meaning.acts.sequence import name_kind
from texvent.scenes.language.meaning.circumstances.reader import CircumstanceReader
from texvent.scenes.language.meaning.draft import Draft, PartialObject
from texvent.scenes.language.meaning.scope import Scope
from texvent.scenes.language.vocabulary.named_acts import NAMED_BY_NOUN, NamedAct
from texvent.scenes.language.vocabulary.verbs import VERBS, Verb
from texvent.scenes.language.words.english import Pos
from texvent.scenes.language.words.lexicon import Role
from texvent.scenes.language.words.word import Word, mark_used

_BY_TWO = PAIRED | {"fence"}
"""Activities that are shown by two people where no one is named."""


def read_named_act(draft: Draft, around: CircumstanceReader, clause: Clause) -> bool:
    """Whether the clause names an act alone; its doer is added."""
    words = [word for group in clause.subjects for word in group.words]
    is_act = not draft.objects and _read_motion(draft, around, clause, words)
    if is_act:
        return True
    is_order = clause.verb is not None and clause.verb.role is Role.CAMERA_MOVE
    is_order = is_order and not clause.verb_word.others
    is_gerund = clause.verb is not None and not is_order and is_named([*words, clause.verb])
    if clause.verb is not None and is_gerund:
        words.append(clause.verb)
    elif clause.verb is not None:
        # What seems to be a verb is none if it does not agree: "a tennis serve".
        is_plural = any(word.text != word.lemma for word in words)
        if clause.verb.text != clause.verb.lemma or clause.auxiliaries or is_plural or is_order:
            return False
        words.append(clause.verb)
    said = [w for w in (*words, *clause.adverbs) if w.pos is not Pos.DETERMINER]
    found = name_activity(said)
    if found is None:
        return False
    noun, activity, is_near = found
    mark_used([*words, *clause.adverbs])
    count = 2 if activity in _BY_TWO else 1
    if is_near:
        who = "one person" if count == 1 else "two people"
        for word in words:
            if word.pos is not Pos.DETERMINER and word.read_as(Role.COUNT) is None:
                word.shown_as = f"{who}, {activity}"
    index = draft.add(PartialObject(noun, count, motions=[ObjectMotion(activity)]))
    if index is not None:
        draft.link_motion([*words, *clause.adverbs], [index])
        does = f"a {noun} does it" if count == 1 else "two people do it"
        draft.note(f"{does} ({activity}): no one is named")
        _read_phrases(around, clause, [index])
    return True


def _read_motion(
    draft: Draft, around: CircumstanceReader, clause: Clause, words: Sequence[Word]
) -> bool:
    """As in "lane change", "overtaking on a highway": the thing that usually does it."""
    if clause.verb is not None and words:
        return False
    said = [word for word in words if word.pos is not Pos.DETERMINER]
    said = said if clause.verb is None else [clause.verb]
    act = _by_name().get(" ".join(word.text for word in said)) if said else None
    verb = None if act is None else _verbs()[act.verb]
    if act is None or verb is None or not act.doer or draft.nouns.get(act.doer) is None:
        return False
    verb = fit_verb(verb, draft.nouns[act.doer], clause) or verb
    is_pair = verb.act == "collide" or verb.relation is not None
    motion = ObjectMotion(
        verb.kind, act.direction or verb.direction, verb.pace, end_pace=verb.end_pace
    )
    item = PartialObject(act.doer)
    first = draft.add(item)
    second = draft.add(PartialObject(act.doer)) if is_pair else None
    if first is None:
        return False
    if verb.kind:
        item.motions.append(name_kind(draft, first, motion))
    mark_used(said)
    draft.link_motion(said, [first])
    if second is not None:
        kind = "collide" if verb.act == "collide" else str(verb.relation)
        draft.relate(kind, [first], [second])
        for word in said:
            word.relations = tuple(draft.relations[-1:])
    who = f"two {act.doer}s do it" if is_pair else f"a {act.doer} does it"
    draft.note(f"{who} ({said[-1].text}): nothing is named")
    _read_phrases(around, clause, [first])
    return True


def _read_phrases(around: CircumstanceReader, clause: Clause, things: list[int]) -> None:
    of_subjects = [phrase for group in clause.subjects for phrase in group.phrases]
    scope = Scope(things, things, is_verb_shown=True)
    around.read_phrases([*of_subjects, *clause.phrases], scope)


@lru_cache(maxsize=1)
def _by_name() -> Mapping[str, NamedAct]:
    return {text: act for act in NAMED_BY_NOUN for text in act.nouns}


@lru_cache(maxsize=1)
def _verbs() -> Mapping[str, Verb]:
    return {verb.base: verb for verb in VERBS}
