"""Scenes of clauses: which objects there are, what they do and where."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import replace

from texvent_scenes.models.activities import ACTIVITIES
from texvent_scenes.models.protocol import Noun
from texvent_scenes.read.account import Reading, finish
from texvent_scenes.read.camera import (
    apply_to_camera,
    goes_itself,
    is_ego,
    is_shot,
    look_out,
    sit_in,
)
from texvent_scenes.read.draft.scene_draft import SceneDraft
from texvent_scenes.read.draft.setting import names_place
from texvent_scenes.read.modifiers import say_word
from texvent_scenes.read.parsing.clauses import Clause, read_clauses
from texvent_scenes.read.parsing.groups import Phrase, heads_of
from texvent_scenes.read.parsing.lexicon import Sense, VerbSense, lexicon_of, word_set
from texvent_scenes.read.parsing.senses import choose_senses
from texvent_scenes.read.parsing.tokens import NO_TOKEN, Token, split_prompt
from texvent_scenes.read.participants import (
    add_doer,
    do_verb,
    find_object,
    find_subjects,
    turn_passive,
)
from texvent_scenes.read.parts import are_own_parts, say_parts
from texvent_scenes.read.phrases import apply_phrase, say_after
from texvent_scenes.read.prepositions import lose_drift, lose_ways
from texvent_scenes.read.relations import relate_one
from texvent_scenes.read.things import name_group


def read(prompt: str, nouns: Mapping[str, Noun]) -> Reading:
    """The scene that any text describes, of these nouns; what it leaves open stays open."""
    tokens = choose_senses(split_prompt(prompt, lexicon_of(nouns)), nouns)
    draft = SceneDraft(tokens, nouns)
    if any(one.has("camera") and one.text in word_set("things", "flown") for one in tokens):
        draft.parts["camera"]["view"] = "aerial"
    for clause in read_clauses(tokens):
        _apply(draft, clause)
    going = [n for n, one in enumerate(draft.things) if one["motions"]]
    for token in (one for one in tokens if one.text.endswith("slow motion")):
        if going and not draft.shows(token):  # "slow motion of a dog running"
            say_word(draft, token, going)
            draft.mark(token, "shown")
    return finish(draft, prompt)


def _apply(draft: SceneDraft, clause: Clause) -> None:
    """Add what a clause says."""
    is_told = any(isinstance(one, Phrase) or not one.has("scene") for one in clause.after)
    is_bare = clause.about == "then" and clause.verb is None and not draft.last.was_camera
    is_bare &= not any(one.has("pose") for one in heads_of(clause.subjects))  # "then a thumbs up"
    if is_bare and (is_told or clause.subjects):
        clause = replace(clause, verb=draft.last.verb)
    draft.last.verb = clause.verb or draft.last.verb
    draft.last.is_then = clause.about == "then"
    draft.last.goes_on = clause.about in ("meanwhile", "company") or bool(clause.subjects)
    draft.phase += clause.about == "then" and bool(draft.moves)
    is_later = bool(draft.things or draft.effects or draft.moves)
    draft.phases += clause.about == "then" and is_later
    for head in heads_of(clause.absent):
        if head.has("noun") and not _is_built_in(draft, head, clause):
            draft.absent.append(head.all("noun")[0].value.noun)
            draft.show(head, *clause.negation)
    goes_on = draft.last.was_camera and clause.about in ("same", "meanwhile", "then")
    goes_on &= not goes_itself(draft, clause)
    is_aboard = any(draft.fates.get(one.at) == "camera" for one in heads_of(clause.subjects))
    is_named = goes_on or is_aboard or clause.about == "camera"
    seated = None if is_named else (sit_in(draft, clause) or look_out(draft, clause))
    clause = seated or clause
    if seated is not None and not draft.things:
        draft.last.nearest, draft.last.subjects, draft.last.before = [], [], []
    is_own = seated is not None or (not is_named and is_ego(draft, clause))
    is_camera = is_named or (is_shot(clause) and not is_own)
    if draft.last.was_camera and _is_of_view(clause):
        draft.last.subjects, draft.last.nearest, draft.last.before = [], [], []
    draft.last.was_camera = is_camera
    if _says_of_parts(draft, clause):
        pass
    elif is_camera or is_own:
        apply_to_camera(draft, clause, is_own=is_own)
    else:
        _apply_to_things(draft, clause)
    _show_following(draft, clause)


def _show_following(draft: SceneDraft, clause: Clause) -> None:
    """Count the words before an act that follows another one with it: "followed by a flip"."""
    acts = [clause.verb] if clause.verb is not None else heads_of(clause.subjects)
    for act in acts[:1] if clause.about == "then" else ():
        before = draft.tokens[: act.at][-3:]
        led = [one for one in before if one.text in ("followed", "by")]
        draft.show(*(led if draft.shows(act) else ()))


def _is_of_view(clause: Clause) -> bool:
    """Whether a clause says what else a camera sees: "the camera pans, with people behind"."""
    first = clause.after[0] if clause.after else None
    is_bare = not (clause.has_subject or clause.verb)
    return is_bare and isinstance(first, Phrase) and first.preposition.text == "with"


def _is_built_in(draft: SceneDraft, head: Token, clause: Clause) -> bool:
    """Whether a body has what it is said to be without: "a car without wheels"."""
    before = draft.tokens[: clause.negation[-1].at] if clause.negation else ()
    words = [one for one in before if one.text != "with"][-1:]
    inner = word_set("things", "built_in")
    return any(one.has("noun") and not one.has("place") for one in words) and bool(
        head.nouns & inner
    )


def _says_of_parts(draft: SceneDraft, clause: Clause) -> bool:
    """Whether a clause is about parts that a thing has: "its second hand moving"."""
    owners = word_set("things", "owners")
    if not clause.subjects or any(one.article not in owners for one in clause.subjects):
        return False
    first, *others = clause.subjects
    verb = () if clause.verb is None else (clause.verb,)
    said = (replace(first, unknown=(*first.unknown, *verb)), *others)
    known, nearest = range(len(draft.things)), draft.last.nearest
    if not say_parts(draft, said, known):
        return False
    phrases = [one for one in clause.after if isinstance(one, Phrase) or one.has("scene")
               or one.says("adverb", "direction")]  # fmt: skip
    say_after(draft, phrases, nearest, nearest, nearest)  # where the whole is
    return True


def _describe_place(clause: Clause) -> Clause:
    """A clause that says of a place what it is like, as a group: "the background is grey"."""
    first = clause.subjects[0] if len(clause.subjects) == 1 else None
    said = [one for one in clause.after if isinstance(one, Token) and one.has("field")]
    is_place = first is not None and first.head is not None and names_place(first.head, "")
    if first is None or not (is_place and said) or clause.verb is not None:
        return clause
    whole = replace(first, modifiers=(*first.modifiers, *said))
    return replace(clause, subjects=(whole,), after=tuple(o for o in clause.after if o not in said))


def _name_doers(draft: SceneDraft, clause: Clause) -> Clause:
    """A clause that names an act "between" some, as what these do: "a match between two men"."""
    act = clause.subjects[0].head if len(clause.subjects) == 1 else None
    first = clause.after[0] if clause.after else None
    poses = act.all("pose") if act is not None and not act.has("noun") else ()
    is_led = isinstance(first, Phrase) and first.preposition.text == "between"
    if clause.verb is not None or not (poses and is_led and isinstance(first, Phrase)):
        return clause
    done = tuple(Sense("verb", VerbSense(*one.value), "base") for one in poses)
    verb = replace(act, senses=done) if act is not None else None
    draft.show(first.preposition)
    return replace(clause, subjects=first.groups, verb=verb, after=clause.after[1:])


def _take_particle(draft: SceneDraft, clause: Clause) -> Clause:
    """A clause with what follows the particle of an act as its object: "throws up snow".

    It is one that without an object is done in the air: to throw, to kick.
    """
    first, *rest = clause.after or (None,)
    acts = [one.value for one in clause.verb.all("verb")] if clause.verb is not None else []
    kinds = {one.kind for one in acts} & {one.relation for one in acts} & ACTIVITIES.keys()
    is_led = isinstance(first, Phrase) and draft.beside(first.preposition, -1) is clause.verb
    if not (kinds and isinstance(first, Phrase) and is_led) or clause.objects:
        return clause
    if first.preposition.text not in word_set("things", "particles") - {"on"}:
        return clause
    return replace(clause, objects=first.groups, after=tuple(rest))


def _apply_to_things(draft: SceneDraft, clause: Clause) -> None:
    clause = _take_particle(draft, _name_doers(draft, _describe_place(clause)))
    known, where = len(draft.things), draft.last.nearest
    draft.last.where = where
    told = subjects = find_subjects(draft, clause)
    draft.last.before = draft.last.nearest
    first = clause.verb.at if clause.verb is not None else 0
    before = [one for one in clause.after if isinstance(one, Phrase) and one.preposition.at < first]
    for phrase in before:
        if are_own_parts(draft, phrase, subjects):
            continue
        told = apply_phrase(draft, phrase, subjects, subjects) or subjects
    told = subjects = subjects or add_doer(draft, clause)
    objects = [index for group in clause.objects for index in name_group(draft, group)]
    objects = objects or (find_object(draft, clause, subjects, where) if clause.is_back else [])
    draft.last.acted = objects or draft.last.acted
    subjects, objects, after = turn_passive(draft, clause, subjects, objects)
    if clause.about != "company":
        draft.last.earlier = draft.last.subjects if clause.subjects else draft.last.earlier
        draft.last.subjects = list(subjects)
    moved = subjects
    draft.last.has_verb = clause.verb is not None
    if clause.verb is not None:
        subjects, moved = do_verb(draft, clause, clause.verb, subjects, objects)
        told = moved or objects
    say_after(draft, tuple(one for one in after if one not in before), subjects, moved, told)
    _look_closely(draft, after, subjects if known else [])
    if clause.is_of_effect and not subjects:
        lose_drift(draft, after)
    is_known = bool(told) or not clause.subjects
    is_known |= any(one.head and draft.shows(one.head) for one in clause.subjects)
    if not is_known or (clause.verb is not None and not draft.shows(clause.verb)):
        lose_ways(draft, clause.after, has_subject=is_known)
    for index in subjects if clause.about == "where" and where else ():
        relate_one(draft, draft.place_by(where[0]), index, where)
    _await(draft, clause, [one for one in subjects if one >= known])


def _await(draft: SceneDraft, clause: Clause, subjects: list[int]) -> None:
    """Have new subjects stand until others have done what was said before: "then a dog runs"."""
    phases = draft.phases
    if clause.about == "then" or (phases and _is_joined(draft, clause)):
        for motions in (draft.things[one]["motions"] for one in subjects):
            motions[:0] = [{"kind": "stand"} for _ in range(phases if motions else 0)]


def _look_closely(
    draft: SceneDraft, after: Sequence[Phrase | Token], subjects: Sequence[int]
) -> None:
    """Aim a close-up that follows the scene at the object it names: "close-up of the cup"."""
    words = [one.text for one in after if isinstance(one, Token)]
    for index in subjects[:1] if any(one.startswith("close up") for one in words) else ():
        draft.parts["camera"]["target"] = index


def _is_joined(draft: SceneDraft, clause: Clause) -> bool:
    """Whether "and" joins a clause with a subject to the one before: "and a dog runs"."""
    head = clause.subjects[0].head if clause.subjects else None
    before = draft.tokens[: head.at] if head is not None else ()
    ends = (one for one in reversed(before) if one.is_sign or one.text == "and")
    return next(ends, NO_TOKEN).text == "and"
