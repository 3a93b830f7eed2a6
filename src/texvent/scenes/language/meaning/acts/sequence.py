"""What comes after, or goes with, what an object did before."""

from __future__ import annotations

from dataclasses import replace

from texvent.scenes.description import STANDING, ObjectMotion
from texvent.scenes.language.grammar.syntax import Clause
from texvent.scenes.language.meaning.draft import Draft
from texvent.scenes.language.meaning.referents.referent import Referent
from texvent.scenes.language.meaning.referents.resolver import OWNERS
from texvent.scenes.language.vocabulary.verbs import Verb
from texvent.scenes.language.words.english import VerbForm
from texvent.scenes.language.words.lexicon import Role
from texvent.scenes.models.people.activities import ACTIVITIES, DONE_SEATED

_WHERE_IT_STAYS = {"stand": "slide", "float": "fly"}
"""Usual motion of what stays in its place → how it goes somewhere."""
_HASTE = 1.5
"""Pace above which who walks runs: "races", "rushes"."""
STOPS = ("stop", "halt", "come to a stop", "come to rest")
_SEATED = ("type", "play piano", "play drums", "row")
"""Activities with a seat of their own."""


def comes_next(clause: Clause) -> bool:
    """As in "a bird perched on a fence flies off": a main clause goes on from what was said."""
    return clause.opener is None and not clause.is_participle and not clause.is_relative


def is_done_in(posture: str, kind: str) -> bool:
    """As in "a man standing on a hill waves", "sitting on a bench, reading"."""
    activity = ACTIVITIES.get(kind)
    if posture in ("sit", "sit down"):
        return kind in DONE_SEATED or kind in _SEATED
    return posture == "stand" and activity is not None and not activity.travels


def is_part_of_doer(one: Referent) -> bool:
    """As in "wiggles its hind legs": a part of who does it."""
    determiner, head = one.group.determiner, one.group.head
    is_part = head is not None and head.read_as(Role.PART) is not None
    return is_part and determiner is not None and determiner.text in OWNERS


def carry_on(before: ObjectMotion, motion: ObjectMotion) -> ObjectMotion:
    """What moves on keeps its direction."""
    keeps = motion.direction is None and before.is_moving and motion.kind == before.kind
    return replace(motion, direction=before.direction) if keeps else motion


def add_motion(draft: Draft, index: int, motion: ObjectMotion, clause: Clause) -> bool:
    """Add a motion after those that the object has; False if it comes at the same time."""
    item = draft.objects[index]
    motions, order = item.motions, clause.order
    if order == "same" and item.sentence < clause.sentence:
        order = "after"
    item.sentence = clause.sentence
    if change_turning(draft, index, motion):
        return True
    motion = name_kind(draft, index, motion)
    if not motions:
        motions.append(motion)
    elif order == "same" and is_done_in(motions[-1].kind, motion.kind):
        motions[-1] = motion
    elif order == "same" and motion.kind == "sit" and is_done_in("sit", motions[-1].kind):
        return True  # "reads a book while sitting on a bench"
    elif order == "same" and comes_next(clause) and motion.kind != motions[-1].kind:
        motions.append(motion)
    elif order == "after":
        motions.append(carry_on(motions[-1], motion))
    elif order == "before":
        motions.insert(max(len(motions) - 1, 0), motion)
    elif motions[-1].kind in ("sit", "stand", "lie") and motion.kind != motions[-1].kind:
        return False
    else:
        return motions[-1].kind == motion.kind
    return True


def change_turning(draft: Draft, index: int, motion: ObjectMotion) -> bool:
    """As in "a wheel spins and slows down", "a fan slows down": it turns on, slower or faster."""
    motions, noun = draft.objects[index].motions, draft.noun(index)
    if motion.kind != "move" or motion.end_pace is None:
        return False
    if motions and motions[-1].kind in ("spin", "work"):
        motions[-1] = replace(motions[-1], end_pace=motion.end_pace)
    elif not motions and noun.is_working and noun.motion == "stand":
        motions.append(replace(motion, kind="work"))
    else:
        return False
    return True


def name_kind(draft: Draft, index: int, motion: ObjectMotion) -> ObjectMotion:
    """What "moves" means for the object: a car drives."""
    if motion.kind != "move":
        return motion
    noun = draft.noun(index)
    usual = noun.motion
    if noun.is_working and usual == "stand" and motion.direction is None:
        return replace(motion, kind="work")  # "wipers going"
    if usual == "walk" and motion.pace > _HASTE:
        return replace(motion, kind="run", pace=motion.pace / _HASTE)
    return replace(motion, kind=_WHERE_IT_STAYS.get(usual, usual))


def stand(draft: Draft, clause: Clause, subjects: list[int]) -> list[int]:
    """As in "does not move": only for verbs of motion."""
    word, negation = clause.verb_word, clause.negation
    if negation is None or not isinstance(word.meaning.value, Verb) or not word.meaning.value.kind:
        return []
    word.is_used = negation.is_used = word.is_absent = True
    for index in subjects:
        add_motion(draft, index, STANDING, clause)
    return subjects


def set_off(draft: Draft, index: int, verb: Verb, clause: Clause) -> None:
    """As in "a car stops at a kerb": what stops has moved before; not "a stopped car"."""
    item, noun = draft.objects[index], draft.noun(index)
    is_resting = clause.verb_word.meaning.form is VerbForm.PAST
    if verb.base not in STOPS or item.motions or is_resting or noun.is_working:
        return
    if noun.motion != "stand":
        item.motions.append(name_kind(draft, index, ObjectMotion("move")))
        clause.order = "after"


def find_mount(draft: Draft, index: int) -> int:
    """What the object rides, which moves in its place: "a man on a horse gallops"."""
    for relation in draft.relations:
        if relation.kind == "ride" and relation.subject == index:
            return relation.targets[0]
    return index
