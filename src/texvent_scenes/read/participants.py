"""Participants of a clause: what it is about, what its pronouns mean, who does its verb to whom."""

from __future__ import annotations

from collections.abc import Sequence

from texvent_scenes.description import SEEN
from texvent_scenes.models.activities import PERSON_NOUNS
from texvent_scenes.models.effects import LAMPS
from texvent_scenes.models.tables import trait_values
from texvent_scenes.read.acts import begin, perform
from texvent_scenes.read.draft.abilities import Indices, is_of_people
from texvent_scenes.read.draft.scene_draft import SceneDraft
from texvent_scenes.read.parsing.clauses import Clause
from texvent_scenes.read.parsing.groups import Group, Phrase, nouns_of
from texvent_scenes.read.parsing.lexicon import word_set
from texvent_scenes.read.parsing.tokens import Token
from texvent_scenes.read.prepositions import claim_mutual, find_mutual
from texvent_scenes.read.things import name_group, pick_group
from texvent_scenes.spec.data import PLACING, WAYS

_OF_NOBODY = {("light", "kind"), ("place", "wave_height")}
"""Part and name of what clauses about light and waves say."""


def find_subjects(draft: SceneDraft, clause: Clause) -> list[int]:
    """Objects that a clause is about; in company, those that go by themselves."""
    heads = [one.head for one in clause.subjects]
    if clause.about == "told":
        return draft.last.nearest if all(one and draft.shows(one) for one in heads) else []
    if clause.about == "company":
        if clause.is_of_effect or not all(one and draft.shows(one) for one in heads):
            return []
        if listed := _find_listed(draft, clause.subjects):
            return listed
        if clause.verb is not None and clause.verb.text in word_set("things", "hung"):
            return draft.last.nearest  # "a drone with a box hanging below it"
        both = draft.last.nearest, draft.last.subjects
        able = [[one for one in each if _is_able(draft, clause, one)] for each in both]
        going = [one for one in draft.last.nearest if draft.can_go(one)]
        on_belt = draft.names(draft.targets(draft.last.nearest, ["on"])) & {
            *trait_values("belt speed")
        }
        borne = draft.last.nearest if on_belt else []  # "a belt with bottles moving on it"
        return next(filter(None, (*able, going, borne)), draft.last.subjects)
    if clause.subjects:
        known = len(draft.things)
        named = [
            pick_group(draft, group, known) or name_group(draft, group) for group in clause.subjects
        ]
        lost = [
            not one for one, group in zip(named, clause.subjects, strict=True) if group.is_plural
        ]
        draft.last.is_lost = any(lost) or (draft.last.is_lost and not any(named))
        picked = [one for one, group in zip(named, clause.subjects, strict=True) if group.picks]
        leave_places(draft, [index for one in picked for index in one], clause.after[:1])
        return [index for one in (picked if any(picked) else named) for index in one]
    first = clause.after[0] if clause.after and clause.verb is None else None
    is_open = isinstance(first, Token) and (first.is_unknown or first.has("verb"))
    second = clause.after[1] if len(clause.after) > 1 else None
    if isinstance(first, Token) and isinstance(second, Token) and clause.verb is None:
        is_open |= first.has("scene") and bool(second.verbs("s", "base"))  # "snow flies up"
    if isinstance(first, Token) and " " in first.text:
        said = {one.value[:2] for one in first.all("scene")}
        is_open |= not said.isdisjoint(_OF_NOBODY)  # "sunlight shines through the trees"
    if is_open and not clause.about:
        return []  # "as wugs dax against it"
    return draft.last.nearest if clause.about == "nearest" else _find_meant(draft, clause)


def _find_listed(draft: SceneDraft, groups: Sequence[Group]) -> list[int]:
    """Objects of a list that all do what follows: "with cars and dogs running"."""
    if len(groups) < 2 or not all(one.is_plural and not one.article for one in groups):
        return []
    nouns = nouns_of(groups)
    last = range(len(draft.things))[-len(groups) :]
    if [draft.things[index]["noun"] for index in last] != nouns:
        return []
    return [n for n in last if draft.noun(n).habitat != "fixed"]


def _find_meant(draft: SceneDraft, clause: Clause) -> list[int]:
    """Objects of the last clause that a pronoun before a verb means: "drops it, it breaks"."""
    verb = clause.verb
    word = draft.beside(verb, -1).text if verb is not None else ""
    if word not in ("it", "he", "she"):
        return draft.last.subjects
    fits = [one for one in (*draft.last.subjects, *draft.last.acted, *draft.last.nearest)
            if (draft.things[one]["noun"] in PERSON_NOUNS) == (word != "it")]  # fmt: skip
    return draft.last.subjects if {*draft.last.subjects} <= {*fits} else fits[:1]


def _is_able(draft: SceneDraft, clause: Clause, index: int) -> bool:
    """Whether an object can do what not all can."""
    verbs = clause.verb.all("verb") if clause.verb is not None else ()
    anyone = () if draft.last.has_verb and draft.walks(index) else ("plain",)
    acts = [one.value for one in verbs if one.value.who not in (*anyone, "source", "camera")]
    is_lamp, has_object = draft.things[index]["noun"] in LAMPS, bool(clause.objects)
    fitting = (one for one in acts if draft.fits(one, [index], [], has_object))
    return any(is_lamp or one.who != "lamp" for one in fitting)


def find_object(
    draft: SceneDraft, clause: Clause, subjects: list[int], nearest: list[int]
) -> list[int]:
    """Objects that a pronoun after a verb means: "overtakes them", "runs after it"."""
    word = draft.beside(clause.verb, 1).text if clause.verb else ""
    about = draft.last.earlier if draft.last.subjects == subjects else draft.last.subjects
    if word == "them":
        both = about if draft.is_many(about) else [*about, *nearest]
        return [one for one in dict.fromkeys(both) if one not in subjects]
    persons = draft.find(PERSON_NOUNS)
    others = [one for one in dict.fromkeys((*draft.last.acted, *nearest, *about))
              if one not in subjects
              and (one in persons) == (word in ("him", "her"))]  # fmt: skip
    is_taken = clause.verb is not None and any(
        one.value.relation in word_set("things", "of_bodies") for one in clause.verb.all("verb")
    )
    tables = word_set("things", "tables")
    if is_taken:  # "a cup on a desk, and lifts it"
        others = [one for one in others if draft.things[one]["noun"] not in tables] or others
    return sorted(others, key=draft.can_go, reverse=True)[:1]  # no tree is followed


def leave_places(draft: SceneDraft, picked: Indices, after: Sequence[Phrase | Token]) -> None:
    """Take some of several away from where all were: "two on a desk, one on the floor"."""
    words = (one.preposition for one in after if isinstance(one, Phrase))
    kinds = {sense.value for word in words for sense in word.all("relation")}
    for thing in (draft.things[index] for index in picked if kinds & PLACING):
        thing["relations"] = [one for one in thing["relations"] if one["kind"] not in PLACING]


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
    for one in draft.things[doer:]:
        one["is_implied"] = True
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
    is_split = draft.beside(verb, 1).text in word_set("things", "particles") - {"on"}
    is_known &= bool(objects) or not (is_split and clause.objects)  # "throws up snow"
    is_lost = clause.is_back and not objects  # "throws a wug and catches it"
    found = None if is_lost else perform(draft, verb, subjects, objects, not is_known)
    kind = next((one.value.relation for one in verb.all("verb") if one.value.relation), None)
    if mutual and kind is not None and found:  # "pass each other"
        claim_mutual(draft, [verb, *mutual], kind, subjects)
    kinds = {one.value.kind for one in verb.all("verb")}
    is_own = bool(kinds & word_set("effects", "motions")) or kind == "out of"
    if not subjects and clause.is_of_effect and is_own:
        draft.show(verb)  # "smoke rises from a chimney", as it does by itself
        is_off = kind == "out of" or verb.text.endswith(" off")
        if is_off and objects:  # "drops leave a nozzle", "sparks fly off a grinder"
            draft.effects[-1]["source"] = objects[0]
        return [], []
    if found is not None:
        draft.claim(verb, SEEN, "", subjects, objects)
        begin(draft, verb, subjects)
    for index in subjects if found is None else ():  # what it does is not made up
        draft.things[index]["is_lost"] = True
    return ([], []) if found is None else (subjects, found or subjects)
