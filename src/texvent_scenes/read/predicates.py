"""Predicates of clauses: the verb, who does it, and to what it is done."""

from __future__ import annotations

from collections.abc import Sequence

from texvent_scenes.description import SEEN
from texvent_scenes.read.acts import perform
from texvent_scenes.read.draft.abilities import is_of_people
from texvent_scenes.read.draft.scene_draft import SceneDraft
from texvent_scenes.read.parsing.clauses import Clause
from texvent_scenes.read.parsing.groups import Phrase, nouns_of
from texvent_scenes.read.parsing.lexicon import word_set
from texvent_scenes.read.parsing.tokens import Token
from texvent_scenes.read.prepositions import claim_mutual, find_mutual
from texvent_scenes.read.things import name_group
from texvent_scenes.spec.data import WAYS


def turn_passive(
    draft: SceneDraft, clause: Clause, subjects: list[int], objects: list[int]
) -> tuple[list[int], list[int], Sequence[Phrase | Token]]:
    """The actor, the object and the rest of a passive clause: "a ball kicked by a man"."""
    after = tuple(one for one in clause.after if isinstance(one, Phrase) or not one.is_grammar)
    first = clause.verb.at if clause.verb is not None else 0
    later = [
        one for one in after if (one.preposition if isinstance(one, Phrase) else one).at > first
    ]
    by = later[0] if later else None  # "is kicked by"
    is_passive = clause.verb is not None and clause.verb.verbs("ed") and not objects
    if not is_passive or not isinstance(by, Phrase) or by.preposition.text != "by":
        return subjects, objects, after
    agents = [index for group in by.groups for index in name_group(draft, group)]
    draft.mark(by.preposition, "shown" if agents else "lost")
    rest = tuple(one for one in after if one is not by)
    return (agents, subjects, rest) if agents else (subjects, [], rest)


def add_doer(draft: SceneDraft, clause: Clause) -> list[int]:
    """A person for what only people do, where no subject is said: "slicing a tomato"."""
    verb = clause.verb
    if clause.about or clause.subjects or verb is None or draft.things:
        return []
    nouns = nouns_of(clause.objects)
    acts = [one.value for one in verb.verbs("ing")]
    if not all(one.is_grammar for one in draft.tokens[: verb.at]):
        return []  # "rain falling"
    if not nouns and any(one.who != "person" for one in acts):
        return []  # "falling": what?
    doer, *objects = [draft.add(noun) for noun in ("person", *nouns)]
    acts = [one for one in acts if is_of_people(one) and len(nouns) == len(clause.objects)]
    is_so = any(draft.fits(one, [doer], objects, bool(nouns)) for one in acts)
    del draft.things[is_so:]
    return [doer] if is_so else []


def do_verb(
    draft: SceneDraft, clause: Clause, verb: Token, subjects: list[int], objects: list[int]
) -> tuple[list[int], list[int]]:
    """Apply the verb of a clause; the subjects that do it, and who is moved."""
    heads = [one.head for one in clause.objects]
    is_known = not (clause.is_back and not objects)
    is_known &= all(one and not one.is_liquid and draft.shows(one) for one in heads)
    mutual = find_mutual(clause.objects, clause.after)
    is_known |= bool(mutual)
    ways = {one.value.relation for one in verb.all("verb")} & {*WAYS}
    is_open = bool(ways) and " " in verb.text and not (clause.objects or clause.is_back)
    is_known &= not is_open  # "passengers get on"
    is_within = bool(clause.objects) and not objects and bool(ways & {"into", "out of"})
    is_known &= not is_within  # "enters a room", where it is already
    is_lost = clause.is_back and not objects  # "throws a wug and catches it"
    found = None if is_lost else perform(draft, verb, subjects, objects, has_object=not is_known)
    kind = next((one.value.relation for one in verb.all("verb") if one.value.relation), None)
    if mutual and kind is not None and found:  # "pass each other"
        claim_mutual(draft, [verb, *mutual], kind, subjects)
    kinds = {one.value.kind for one in verb.all("verb")}
    is_own = bool(kinds & word_set("effects", "motions")) or kind == "out of"
    if not subjects and clause.is_of_effect and is_own:
        draft.show(verb)  # "smoke rises from a chimney", as it does by itself
        if kind == "out of" and objects:  # "drops leave a nozzle"
            draft.effects[-1]["source"] = objects[0]
        return [], []
    if found is not None:
        draft.claim(verb, SEEN, "", subjects, objects)
    for index in subjects if found is None else ():  # what it does is not made up
        draft.things[index]["is_lost"] = True
    return ([], []) if found is None else (subjects, found or subjects)
