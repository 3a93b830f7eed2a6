"""Clauses about the camera: which they are, and what they move it by."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import replace
from typing import Any

from texvent_scenes.models.tables import nouns_with
from texvent_scenes.read.camera import claim_way, find_move, go_through, is_standpoint, look_over
from texvent_scenes.read.draft.abilities import MEANS
from texvent_scenes.read.draft.places import names_place
from texvent_scenes.read.draft.scene_draft import SceneDraft
from texvent_scenes.read.parsing.clauses import Clause
from texvent_scenes.read.parsing.groups import Group, Phrase, heads_of, nouns_of
from texvent_scenes.read.parsing.lexicon import Sense, lexicon_of, word_set
from texvent_scenes.read.parsing.tokens import NO_TOKEN, Token
from texvent_scenes.read.phrases import apply_phrase
from texvent_scenes.read.things import name_group

_FIRST_PERSON = ("camera", "view", "first person")


def is_ego(draft: SceneDraft, clause: Clause) -> bool:
    """Whether a camera goes that is not named: "driving through a city"."""
    verbs = clause.verb.verbs("ing") if clause.verb is not None else ()
    travels = any(one.value.kind.startswith("travel") for one in verbs)
    is_place = all(one.head and names_place(one.head, "") for one in clause.subjects)
    before = draft.beside(clause.verb or NO_TOKEN, -1)
    kinds = {one.value[1] for one in before.all("scene")} | {one.kind for one in before.senses}
    is_own = before.is_unknown or kinds & {"noun", "effect", "verb", "weather"}
    if is_own and not kinds & {"shot", "style"}:
        return False  # "rain drops running down a pane"
    is_new = not draft.things and clause.about not in ("nearest", "company")
    return travels and is_place and is_new


def sit_in(draft: SceneDraft, clause: Clause) -> Clause | None:
    """The clause of a driver's view of who goes through a passage, said of the camera itself.

    "A car exits a tunnel, dashcam view"; None: no camera is in a vehicle.
    """
    shots = {sense.value for token in draft.tokens for sense in token.all("shot")}
    nouns = nouns_of(clause.subjects)
    is_driven = [draft.nouns[one].motion for one in nouns] == ["drive"]
    is_driven &= not any(group.is_plural for group in clause.subjects)
    if "travel forward drive" not in shots or draft.things or not (is_driven and clause.verb):
        return None
    way, drive = Sense("relation", "through"), lexicon_of(draft.nouns)[("driving",)]
    first = Phrase(Token("through", clause.verb.at), clause.objects)
    after = [one if isinstance(one, Token) or not _names_passage(one.groups) else
             Phrase(replace(one.preposition, senses=(way,)), one.groups)
             for one in (first, *clause.after) if isinstance(one, Token) or one.groups]  # fmt: skip
    if not any(isinstance(one, Phrase) and _names_passage(one.groups) for one in after):
        return None
    draft.mark(clause.subjects[0].head or NO_TOKEN, "camera")
    verb = replace(clause.verb, senses=drive)
    return replace(clause, subjects=(), objects=(), verb=verb, after=tuple(after))


def look_out(draft: SceneDraft, clause: Clause) -> Clause | None:
    """The clause of a first-person view of who goes somewhere, said of the camera itself.

    "First-person view of a drone flying through a forest"; None: it is another view or an act.
    """
    said = {sense.value for token in draft.tokens for sense in token.all("scene")}
    (first, *others) = clause.subjects or (None,)
    verb = clause.verb
    if _FIRST_PERSON not in said or first is None or others or verb is None:
        return None
    known = [one["noun"] for one in draft.things]
    if known and not (clause.about == "company" and first.noun and known == [first.noun.noun]):
        return None
    goes = [one for one in verb.all("verb") if one.value.who == "camera"]
    is_going = any(one.value.kind.startswith("travel") for one in goes) and not clause.objects
    if first.noun is None or first.is_plural or first.head is None or not is_going:
        return None
    if not draft.nouns[first.noun.noun].speed_m_s:
        return None
    draft.mark(first.head, "camera")
    draft.things.clear()
    draft.claims.clear()
    means = {"fly": "flying", "drive": "driving"}.get(draft.nouns[first.noun.noun].motion)
    if means and not any(one.value.kind in MEANS for one in verb.all("verb")):  # "races"
        verb = replace(verb, senses=lexicon_of(draft.nouns)[(means,)])
    return replace(clause, subjects=(), about="", verb=verb)


def _names_passage(groups: Sequence[Group]) -> bool:
    """Whether some of the groups name what has a way through."""
    return bool({*nouns_of(groups)} & nouns_with("passage"))


def is_shot(clause: Clause) -> bool:
    """Whether a clause without a subject goes on about a shot: "6-DoF motion over a poster"."""
    if clause.subjects or clause.objects or clause.about not in ("", "same"):
        return False
    adverbs = [one for one in clause.after if isinstance(one, Token) and one.has("adverb")]
    if any(sense.value[0] == "speed_m_s" for one in adverbs for sense in one.all("adverb")):
        return False  # it is that of the view
    words = [one for one in clause.after if one not in adverbs]
    first = words[0] if words else None
    if not isinstance(first, Token) or not (first.has("shot") or first.is_view):
        return False
    return clause.verb is None or first.at < clause.verb.at


def apply_to_camera(draft: SceneDraft, clause: Clause, *, is_own: bool) -> None:
    """Move the camera as a clause says, and name what is in view."""
    targets = list[int]()
    move = find_move(draft, clause, is_ego=is_own)
    for group in clause.subjects if clause.about != "company" else ():
        name_group(draft, group, "in")
    for group in clause.objects if not is_own else ():
        targets += name_group(draft, group)
    _lead_followed(draft, move, targets)
    for one in clause.after:
        if not isinstance(one, Phrase):
            draft.set_scene(one)
        elif is_standpoint(draft, one, move or {}):
            continue
        elif targets:  # as "orbits a car in front of a house"
            apply_phrase(draft, one, targets, targets)
        else:
            found, sense = apply_phrase(draft, one, [], []), one.preposition.first("relation")
            kind = sense.value if sense else ""
            targets += found if kind in word_set("things", "aims") else []
            turns = move is not None and move["kind"] in ("pan", "tilt")
            is_swept = turns and one.preposition.text in word_set("things", "swept")
            targets += found if is_swept else []
            is_side = bool(found) and kind in word_set("things", "sides") and not is_swept
            if found and kind in ("through", "out of"):
                is_side = move is None or not go_through(draft, move, one.preposition, found)
            is_over = look_over(draft, one.preposition, found)
            claim_way(draft, move, one.preposition, [] if is_over else found)
            heads = heads_of(one.groups)
            words = heads or [each for group in one.groups for each in group.unknown]
            is_side |= bool(one.groups) and not any(map(draft.shows, words))
            is_side |= kind == "front" and any(each["kind"] == "travel" for each in draft.moves)
            is_side &= not is_over
            is_place = any(each.has("place") for each in heads)
            is_side |= is_place and not found and kind in ("out of", "into")  # it stays there
            goes = any(each["kind"] == "travel" for each in (*draft.moves, move or {"kind": ""}))
            is_side |= goes and bool(found) and kind in ("up", "down")  # it keeps its height
            draft.mark(one.preposition, "lost" if is_side else "shown")  # nothing is put there
    if move is not None:
        draft.add_move(move)
        if targets:
            draft.parts["camera"].setdefault("target", targets[0])
        _lead_followed(draft, move, targets)


def _lead_followed(
    draft: SceneDraft, move: Mapping[str, Any] | None, targets: Sequence[int]
) -> None:
    """Let things go that a camera follows."""
    followed = targets if move is not None and move["kind"] == "follow" else []
    for index in filter(draft.can_go, followed):
        thing = draft.things[index]
        thing["motions"] = thing["motions"] or [{"kind": "move"}]
