"""Account of a draft: its scene, and the lists of its words."""

from __future__ import annotations

import itertools
from collections.abc import Collection, Iterator, Sequence
from dataclasses import dataclass
from typing import Any

from texvent.errors import MAX_WORD
from texvent.prompt_report import Substitution
from texvent_scenes.description import Claim, Dependence
from texvent_scenes.models.activities import PERSON_NOUNS, SAT
from texvent_scenes.models.protocol import Noun
from texvent_scenes.models.tables import nouns_with, trait_values
from texvent_scenes.read.draft.completion import complete
from texvent_scenes.read.draft.copies import OPPOSITE, halve, take_turns
from texvent_scenes.read.draft.scene_draft import SceneDraft
from texvent_scenes.read.parsing.lexicon import word_set
from texvent_scenes.read.parsing.tokens import NO_TOKEN, Token
from texvent_scenes.spec.data import scene_from_data
from texvent_scenes.spec.scene import Scene, number_nouns

_LONGEST = 2 * MAX_WORD
"""Characters of lost words that are told as one: a report shortens what is longer."""


@dataclass(frozen=True, kw_only=True)
class Reading:
    """The scene that a sentence describes, and what became of its words."""

    scene: Scene
    shown: tuple[str, ...]
    """Words that the scene shows."""
    substituted: tuple[Substitution, ...]
    """Words that are shown as something else."""
    not_understood: tuple[str, ...]
    """Words without effect on the scene, a phrase each where they stand together."""
    claims: tuple[Claim, ...] = ()
    """Words, of both lists, of which only the staged scene tells whether it shows them."""
    dependences: tuple[Dependence, ...] = ()
    """Words that are uncertain where others are not understood."""

    @property
    def open_words(self) -> tuple[str, ...]:
        """Words that are neither shown nor lost before the scene is staged."""
        words = dict.fromkeys(one.word for one in self.claims if one.is_open)
        return tuple(one for one in words if one not in self.shown)


def _reach_speed(motion: dict[str, Any], noun: Noun) -> None:
    """Say by paces at which speed a motion ends: "accelerates from 10 km/h to 50 km/h"."""
    end_m_s, start_m_s = motion.pop("end_m_s"), motion.get("speed_m_s")
    pace, end_pace = motion.get("pace", 1.0), motion["end_pace"]
    if start_m_s is None and end_pace > pace:
        motion["speed_m_s"] = end_m_s * pace / end_pace
        return
    start_m_s = pace * (noun.speed_m_s or 1.0) if start_m_s is None else start_m_s
    start_m_s = max(start_m_s, 0.001 * end_m_s)  # paces are multiples of a speed, which is not 0
    most_m_s = max(start_m_s, end_m_s) or 1.0
    paces = (round(one / most_m_s, 6) for one in (start_m_s, end_m_s))
    motion |= {"speed_m_s": start_m_s, **dict(zip(("pace", "end_pace"), paces, strict=True))}


def finish(draft: SceneDraft, prompt: str) -> Reading:
    """The scene, and its words; one that is lost at one place of the prompt is not shown."""
    complete(draft)
    pairs = zip(draft.tokens, (*draft.tokens[1:], NO_TOKEN), strict=False)
    ends = [_decide(draft, token, after) for token, after in pairs]
    _join_lost(draft, ends)
    fates: dict[str, str] = {}
    for token, fate in zip(draft.tokens, ends, strict=True):
        text = draft.text_of(token)
        if fate == "lost" or (fate and fates.get(text, "shown") == "shown"):
            fates[text] = fate
    others = [one for one in fates.items() if one[1] not in ("shown", "lost")]
    lost = tuple(word for word, fate in fates.items() if fate == "lost")
    return Reading(
        scene=_build(draft, prompt),
        shown=tuple(word for word, fate in fates.items() if fate == "shown"),
        substituted=tuple(Substitution(*one) for one in others),
        not_understood=lost,
        claims=tuple(_list_claims(draft)),
        dependences=tuple(_list_dependences(draft, lost)),
    )


def _decide(draft: SceneDraft, token: Token, after: Token) -> str:
    """Fate of a token in the end; "" where there is nothing to tell of it."""
    is_open = token.is_sign or token.is_grammar
    is_open |= token.text == "to" and bool(after.verbs("base"))  # "starts to spin"
    is_begun = token.text in word_set("things", "aspects")
    is_open &= not is_begun or after.text == "to" or bool(after.verbs("ing"))
    is_led = token.has("small") and token.text != "and"
    if is_led and after.has("adverb", "negations") and draft.shows(after):
        draft.show(token)  # "at 50 km/h", "with no cars"
    if token.has("style") and " " in token.text:
        draft.show(token)  # "in front of the camera"
    fate = draft.fates.get(token.at, "" if is_open else "lost")
    return "shown" if fate == "camera" and _sees_itself(draft) else fate


def _join_lost(draft: SceneDraft, ends: Sequence[str]) -> None:
    """Tell lost words that stand together as one: "orange gizmo in the background".

    What a check may still find stays apart, and each word before a thing that is drawn.
    """
    run: list[Token] = []
    for token, end in zip((*draft.tokens, NO_TOKEN), (*ends, "."), strict=True):
        is_lost = end == "lost" and not any(one.is_open for one in draft.claims.get(token.at, ()))
        is_between = token.is_grammar and not token.has("conjunctions", "camera")
        if token.text in ("and", "or"):  # "white and red streaks"
            sides = [draft.beside(token, step) for step in (-1, 1)]
            is_between = run[-1:] == sides[:1] and all(one.has("field") for one in sides)
        if not end and (is_between or token.text == "to" or token.at in draft.fates):
            continue
        words = draft.tokens[run[0].at : token.at + 1] if run else ()
        if is_lost and sum(len(one.text) + 1 for one in words) <= _LONGEST:
            run.append(token)
            continue
        at = token.at if end != "lost" and token.has("noun", "place", "effect", "hollow") else 0
        while run and run[-1].at == at - 1 and run[-1].at in draft.modifying:
            at = run.pop().at
        draft.join(run)
        run = [token] if is_lost else []


def _sees_itself(draft: SceneDraft) -> bool:
    """Whether a view is that of who goes, who is not seen: "first-person view of a drone"."""
    return draft.is_driven or draft.parts["camera"].get("view") == "first person"


_TIES = ("verb", "pose", "adverb", "relation", "shot", "other")
"""Kinds of words that say how things go together."""


def _list_dependences(draft: SceneDraft, lost: Collection[str]) -> Iterator[Dependence]:
    """Words that depend on how others are read.

    In a clause these are words that say how things go together, such as verbs. Things, lights and
    places, with their colours and numbers, depend on what leads to them: "beneath", "steep".
    A prompt of which most clauses have a lost word is one clause. How the things of a clause go
    together is known only if the staged scene has them all.
    """
    words = [(draft.text_of(one), one) for one in draft.tokens]
    clauses = [*_split_clauses(words, lost)]
    broken = [clause for clause in clauses if any(text in lost for text, _ in clause)]
    for clause in clauses:
        yield from _list_between(clause)
    for clause in [words] if 2 * len(broken) > len(clauses) else clauses:
        others = (pair for pair in clause if not pair[1].has("noun", "place", "field"))
        ties = [text for text, one in others if one.says("scene", "camera") or one.has(*_TIES)]
        whole = tuple(text for text, one in clause if not one.has("field"))
        yield Dependence(tuple(ties), whole)  # a colour that is lost changes nothing else
        before, fields = "", list[str]()
        for text, one in clause:
            if one.has("noun", "place", "scene"):
                yield Dependence((*fields, text), (before,))
            is_lost = text in lost
            is_of_next = one.has("articles", "field", "partitive") or (is_lost and one.is_unknown)
            before = text if is_lost or not is_of_next else before
            fields = [*fields, text] if is_of_next else []


def _list_between(clause: Sequence[tuple[str, Token]]) -> Iterator[Dependence]:
    """Verbs, which depend on the thing before them, and prepositions, on those around them."""
    things = [n for n, (_, one) in enumerate(clause) if one.has("noun", "effect")]
    for n, (text, one) in enumerate(clause):
        before, after = [k for k in things if k < n][-1:], [k for k in things if k > n][:1]
        is_between = n not in things and one.has("verb", "relation")
        around = (*before, *(after if one.has("relation") else ())) if is_between else ()
        if around:
            yield Dependence((text,), tuple(clause[k][0] for k in around), is_staged=True)


def _split_clauses(
    words: Sequence[tuple[str, Token]], lost: Collection[str]
) -> Iterator[list[tuple[str, Token]]]:
    """Clauses between signs and conjunctions; one that begins with a verb goes on with the last."""
    clause: list[tuple[str, Token]] = []
    for is_end, found in itertools.groupby(
        words, lambda one: one[1].is_sign or (one[1].has("conjunctions") and one[0] not in lost)
    ):
        group = [*found]
        goes_on = is_end or group[0][1].has("verb", "pose")
        if clause and (not goes_on or group[-1][0] in (".", "!", "?", ";")):
            yield clause
            clause = []
        clause += [] if is_end else group
    if clause:
        yield clause


def _list_claims(draft: SceneDraft) -> Iterator[Claim]:
    """Claims of words that are not lost at another place, where nothing is claimed of them."""
    lost = [one for one in draft.tokens if not draft.shows(one) and not one.is_grammar]
    claimed = {at for at, claims in draft.claims.items() if any(one.is_open for one in claims)}
    closed = {draft.text_of(one) for one in lost if one.at not in claimed}
    for at, claims in draft.claims.items():
        fate = draft.fates.get(at, "lost")
        claims = [one for one in claims if one.kind != "sit at" or not _has_seat(draft, one)]
        yield from (one for one in claims if one.word not in closed
                    and (fate == "shown" or (fate == "lost" and one.is_open)))  # fmt: skip


def _has_seat(draft: SceneDraft, claim: Claim) -> bool:
    """Whether the act of who sits somewhere comes with the seat, and with what it is done at."""
    return claim.subject is not None and bool(draft.does([claim.subject]) & SAT)


def _run_belts(draft: SceneDraft) -> None:
    """Let belts run as what is on them moves, which does not go by itself."""
    for index, one in enumerate(draft.things):
        for relation in one["relations"]:
            belt = draft.things[relation["to"][0]]
            is_carried = relation["kind"] == "on" and belt["noun"] in trait_values("belt speed")
            is_carried &= not draft.can_go(index) and len(one["motions"]) == 1
            if is_carried and one["motions"][0]["kind"] in ("move", "slide", "drive"):
                said = one["motions"].pop()
                direction = {"direction": "clockwise"} if said.get("direction") == "left" else {}
                kept = {key: said[key] for key in ("speed_m_s", "pace") if key in said}
                belt["motions"] = belt["motions"] or [{"kind": "work"}]
                belt["motions"][-1] |= {**kept, **direction}


def _give_each(draft: SceneDraft) -> None:
    """One of what has no singular, such as "glasses", for each who wears it.

    So do two who hold umbrellas or ride bicycles have one each, of which no number is said.
    """
    each, things = word_set("things", "each_has"), draft.things
    had = [(things[n]["count"], draft.targets([n], each)) for n in draft.find(PERSON_NOUNS)]
    for index, one in enumerate(things):
        people = sum(count for count, targets in had if index in targets)
        if one.pop("is_open", False) and people > 1:
            one["count"] = people


_SEATS = nouns_with("seat") | trait_values("ridden").keys()
"""Nouns on which people sit of whom nothing else is known."""


def _build(draft: SceneDraft, prompt: str) -> Scene:
    """The scene."""
    for index, one in enumerate([*draft.things]):
        for motion in (each for each in one["motions"] if "end_m_s" in each):
            _reach_speed(motion, draft.nouns[one["noun"]])
        is_chain = one["noun"] in word_set("things", "chained")
        is_chain &= [each["kind"] for each in one["motions"]] in (["fall"], ["topple"])
        in_turn = [each.pop("in_turn", False) for each in one["motions"]]
        if (is_chain or any(in_turn)) and one["count"] > 1:
            take_turns(draft, index)
        if any(each.get("direction") == OPPOSITE for each in one["motions"]):
            halve(draft, index)
    _run_belts(draft)
    _give_each(draft)
    ids = number_nouns([one["noun"] for one in draft.things])
    for one in draft.things:
        done = {each["kind"] for each in one["relations"]} & word_set("things", "doing")
        if one.pop("is_lost", False) and not done and not one["motions"]:
            below = {draft.things[to]["noun"] for each in one["relations"] for to in each["to"]
                     if each["kind"] in ("on", "ride")}  # fmt: skip
            is_seated = one["noun"] in PERSON_NOUNS and bool(below & _SEATS)
            floats = draft.nouns[one["noun"]].motion == "float" and not one["relations"]
            rest = "sit" if is_seated else "float" if floats else "stand"
            one["motions"].append({"kind": rest})
        for relation in one["relations"]:
            relation["to"] = [ids[target] for target in relation["to"]]
    for each in (draft.parts["camera"], *draft.effects):
        named = {name: each.get(name) for name in ("target", "source")}
        each.update({name: ids[one] for name, one in named.items() if one is not None})
    camera = {"moves": draft.moves, **draft.parts["camera"]}
    return scene_from_data(
        {"prompt": prompt, "objects": draft.things, "effects": draft.effects, "camera": camera,
         "light": draft.parts["light"], "place": draft.parts["place"], "absent": draft.absent}
    )  # fmt: skip
