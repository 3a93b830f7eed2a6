"""What two do together: "hugs a girl", "argues with his boss", "two balls collide"."""

from __future__ import annotations

from collections.abc import Sequence

from texvent.scenes.description import ObjectMotion, Relation
from texvent.scenes.language.grammar.syntax import Clause
from texvent.scenes.language.meaning.acts.activities import find_activity
from texvent.scenes.language.meaning.capabilities import is_living, is_person
from texvent.scenes.language.meaning.draft import Draft, PartialObject
from texvent.scenes.language.meaning.referents.referent import Referent
from texvent.scenes.language.meaning.referents.resolver import PERSON
from texvent.scenes.language.vocabulary.named_acts import NAMED
from texvent.scenes.language.words.word import mark_used
from texvent.scenes.models.people.acts.words import PAIRED as _PAIRED

PAIRED = frozenset(_PAIRED) | {"box"}
"""Activities of two who face each other."""


_TOGETHER = ("with", "against")
_EACH_OTHER = ("each other", "one another")


def take_fellows(clause: Clause) -> None:
    """As in "argues with his boss": who it is done with is the object."""
    if clause.verb is None:
        return
    found = find_activity(clause, is_hand=False)
    if found is None or found[0] not in PAIRED:
        return
    for phrase in list(clause.phrases):
        is_each = all(group.text in _EACH_OTHER for group in phrase.groups)
        if phrase.preposition.text in _TOGETHER or is_each:
            phrase.preposition.is_used = True
            clause.phrases.remove(phrase)
            if not is_each:
                clause.objects.extend(phrase.groups)


_GIVING = frozenset({"give", "hand", "pass", "offer", "present", "deliver", "serve", "bring"})


def take_receivers(clause: Clause) -> None:
    """As in "gives a flower to a woman", "hands her the keys over"."""
    if clause.verb is None or clause.verb.lemma not in _GIVING or clause.is_passive:
        return
    for phrase in list(clause.phrases):
        if phrase.preposition.text in ("to", "over to") and clause.objects:
            clause.objects.extend(phrase.groups)
            clause.phrases.remove(phrase)
            phrase.preposition.is_used = True


def give_to(draft: Draft, clause: Clause, doers: list[int], objects: Sequence[Referent]) -> bool:
    """Whether a person gives a thing to another one."""
    things = [index for one in objects if one.is_things for index in one.things]
    people = [index for index in things if is_person(draft.noun(index))]
    given = [index for index in things if not is_living(draft.noun(index))]
    is_giving = clause.verb_word.lemma in _GIVING and len(people) == 1 and len(given) == 1
    if not is_giving or not all(is_person(draft.noun(index)) for index in doers):
        return False
    clause.verb_word.is_used = True
    draft.objects[doers[0]].motions = [ObjectMotion("give")]
    draft.objects[people[0]].motions = [ObjectMotion("receive")]
    return draft.relate("give", doers[:1], [given[0], people[0]])


def tug(draft: Draft, clause: Clause, doers: Sequence[int]) -> bool:
    """As in "two dogs play tug of war": animals pull at a rope with their mouths."""
    found = find_activity(clause, is_hand=False)
    is_tugging = found is not None and found[0] == "tug of war"
    if not is_tugging or found is None or not all(is_living(draft.noun(one)) for one in doers):
        return False
    if sum(draft.objects[index].count for index in doers) < 2:
        return False
    mark_used(found[1])
    for index in doers:
        draft.objects[index].motions = [ObjectMotion("tug of war")]
    draft.link_motion(found[1], list(doers))
    return True


def join_partners(
    draft: Draft, name: str, doers: Sequence[int], objects: Sequence[Referent]
) -> None:
    """Give the other person the same activity."""
    for one in objects:
        for index in one.things if one.is_things else ():
            if index not in doers and is_person(draft.noun(index)):
                draft.objects[index].motions = [ObjectMotion(name)]
    if not any(one.is_things or one.kind == "unknown" for one in objects):
        add_partner(draft, name, doers)


def add_partner(draft: Draft, name: str, doers: Sequence[int]) -> None:
    """As in "a person is hugging": who one hugs is there, too."""
    if name in _NEVER_ALONE and len(doers) == 1 and draft.objects[doers[0]].count == 1:
        draft.add(PartialObject(PERSON, motions=[ObjectMotion(name)]))
        draft.note(f"a second person is there to {name}")


def collide(draft: Draft, clause: Clause, subjects: list[int], targets: list[int]) -> list[int]:
    """As in "a car crashes into a wall", "two balls collide"; one alone meets nothing."""
    others = [index for index in targets if index not in subjects] or subjects[1:]
    if clause.verb_word.text in NAMED and subjects and not others:
        draft.objects[subjects[0]].count = max(draft.objects[subjects[0]].count, 2)
    is_group = len(subjects) == 1 and draft.objects[subjects[0]].count > 1
    if clause.negation is not None or not subjects or not (others or is_group):
        return []
    target = others[0] if others else subjects[0]
    draft.relations.append(Relation("collide", subjects[0], (target,)))
    for index in subjects:
        item = draft.objects[index]
        if clause.verb_word.lemma == "roll" and not item.motions:
            item.motions.append(ObjectMotion("roll"))
        ways = [one.direction for one in item.motions if one.direction is not None]
        if ways:
            draft.note(f"the {item.noun} may go another way than {ways[-1]}: to the hit")
    if clause.verb_word.lemma in _BLOWS and draft.noun(subjects[0]).habitat == "fixed":
        clause.verb_word.shown_as = "bump into"
    clause.verb_word.is_used = True
    return []


_NEVER_ALONE = frozenset(
    {
        "hug",
        "kiss",
        "shake hands",
        "high five",
        "wrestle",
        "arm wrestle",
        "tango",
        "show fists",
    }
)
"""What one alone is not seen to do."""
_BLOWS = frozenset({"hit", "strike"})
"""What a tool does only in a hand: alone it comes near and touches."""
