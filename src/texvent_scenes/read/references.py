"""References: the things that a clause is about, and those that its pronouns mean."""

from __future__ import annotations

from collections.abc import Sequence

from texvent_scenes.models.activities import PERSON_NOUNS
from texvent_scenes.models.effects import LAMPS
from texvent_scenes.read.again import leave_places
from texvent_scenes.read.draft.scene_draft import SceneDraft
from texvent_scenes.read.parsing.clauses import Clause
from texvent_scenes.read.parsing.groups import Group, nouns_of
from texvent_scenes.read.parsing.lexicon import word_set
from texvent_scenes.read.parsing.tokens import Token
from texvent_scenes.read.things import name_group, pick_group


def find_subjects(draft: SceneDraft, clause: Clause) -> list[int]:
    """Objects that a clause is about; in company, those that go by themselves."""
    heads = [one.head for one in clause.subjects]
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
        return next(filter(None, (*able, going)), draft.last.subjects)
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
    acts = [one.value for one in verbs if one.value.who not in ("plain", "source", "camera")]
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
    return sorted(others, key=draft.can_go, reverse=True)[:1]  # no tree is followed
