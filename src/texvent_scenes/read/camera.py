"""Moves of the camera that clauses say."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import replace
from typing import Any

from texvent_scenes.models.tables import nouns_with, read_table
from texvent_scenes.read.abilities import MEANS
from texvent_scenes.read.clauses import Clause
from texvent_scenes.read.draft import SceneDraft, names_place, split_move, turn_by
from texvent_scenes.read.groups import Group, Phrase
from texvent_scenes.read.lexicon import Sense, lexicon_of, word_set
from texvent_scenes.read.parts import list_words
from texvent_scenes.read.tokens import NO_TOKEN, Token

_FIRST_PERSON = ("camera", "view", "first person")
_STAYING = frozenset({"handheld", "roll", "truck"})
"""Moves of a camera over what it looks at."""


def is_ego(draft: SceneDraft, clause: Clause) -> bool:
    """Whether a camera goes that is not named: "driving through a city"."""
    verbs = clause.verb.verbs("ing") if clause.verb is not None else ()
    travels = any(one.value.kind.startswith("travel") for one in verbs)
    is_place = all(one.head and names_place(one.head, "") for one in clause.subjects)
    before = draft.tokens[verb.at - 1] if (verb := clause.verb) and verb.at else NO_TOKEN
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
    nouns = [group.noun.noun for group in clause.subjects if group.noun is not None]
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
    nouns = {one.noun.noun for one in groups if one.noun is not None}
    return bool(nouns & nouns_with("passage"))


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


def go_through(
    draft: SceneDraft, move: dict[str, Any], preposition: Token, targets: Sequence[int]
) -> bool:
    """Lead a camera that goes ahead through what has a way through, or out; whether it has one."""
    is_ahead = move["kind"] == "travel" or split_move("dolly in").items() <= move.items()
    nouns = {draft.things[one]["noun"] for one in targets}
    if move.get("means") == "fly" or not (is_ahead and nouns <= nouns_with("passage")):
        return False
    if move["kind"] == "dolly":
        move |= split_move("travel forward") | {"means": "walk"}
    is_out = preposition.text == "out of"
    draft.claim(preposition, "camera out", "", [None] if is_out else [], targets)
    for thing in (draft.things[one] for one in targets):
        opens = "stand open" in draft.nouns[thing["noun"]].acts
        thing["motions"] = thing["motions"] or [{"kind": "stand open"}] * opens
        thing |= {"placement": "near"} if is_out else {}
    return True


def is_standpoint(draft: SceneDraft, phrase: Phrase, move: Mapping[str, Any] | None = None) -> bool:
    """Whether it says from where something is seen, which puts nothing there; its words are lost.

    As in "seen from a bridge", "follows from a vehicle"; what a camera leaves is seen.
    """
    preposition, kind = phrase.preposition, (move or {}).get("kind")
    leaves = kind in ("pan", "tilt", "zoom") or (move or {}).get("direction") in ("out", "up")
    is_so = preposition.text.startswith("from") and bool(phrase.groups) and not leaves
    before = draft.tokens[preposition.at - 1]
    is_view = before.text in word_set("things", "viewed") or before.has("shot")
    if not is_so or (move is None and not is_view):
        return False
    heads = [one.head for one in phrase.groups if one.head is not None]
    if heads and all(one.has("place") for one in heads):
        return False  # "seen from a beach" is there
    for token in (preposition, *(one for group in phrase.groups for one in list_words(group))):
        draft.mark(token, "lost")
    nouns = [one.noun.noun for one in phrase.groups if one.noun is not None]
    after = draft.tokens[heads[-1].at + 1 :][:1] if heads else ()
    if any(draft.nouns[one].speed_m_s for one in nouns) and any(map(is_course, after)):
        draft.mark(preposition, "shown")
        draft.mark(heads[-1], "camera")  # "view from a drone flying over a field"
    return True


def is_course(token: Token) -> bool:
    """Whether a participle says where a camera may go with what it is on."""
    return any(one.value.who == "camera" for one in token.verbs("ing"))


def claim_way(
    draft: SceneDraft, move: dict[str, Any] | None, preposition: Token, targets: Sequence[int]
) -> None:
    """Leave it to the staged camera whether it goes or turns so with respect to a thing."""
    kinds = {one.value for one in preposition.all("relation")} & word_set("things", "camera_ways")
    kinds |= {"past"} if preposition.text == "across" else set()
    led = _list_led(draft, move, preposition, targets) if move is not None else []
    if move is not None and len(led) == 1:
        move.clear()
        move |= {"kind": "follow"}
        draft.parts["camera"] |= {"view": "front", "target": led[0]}
        draft.claim(preposition, "camera", "before", [None], led)
        return
    is_led = move is not None and move["kind"] not in ("follow", "zoom", "handheld", "static")
    for kind in sorted(kinds)[:1] if is_led and targets else ():
        draft.claim(preposition, "camera", kind, [None], targets)


def _list_led(
    draft: SceneDraft, move: Mapping[str, Any], preposition: Token, targets: Sequence[int]
) -> list[int]:
    """Things that come along behind a camera: "walks backward in front of her"."""
    kinds, after = {one.value for one in preposition.all("relation")}, preposition.at + 1
    is_back = move["kind"] == "travel" and move.get("direction") == "backward"
    if not (is_back and "front" in kinds):
        return []
    is_meant = after < len(draft.tokens) and draft.tokens[after].has("pronouns")
    about = range(len(draft.things)) if is_meant else targets
    return [index for index in about if draft.goes(index)]


def look_over(draft: SceneDraft, preposition: Token, targets: Sequence[int]) -> bool:
    """Let a camera that stays about look down on things, or at the face of what is upright."""
    kinds = {one.value for one in preposition.all("relation")}
    moves = {one["kind"] for one in draft.moves}
    if "above" not in kinds or not targets or not moves or moves - _STAYING:
        return False
    upright = nouns_with("upright") | nouns_with("flat pattern")
    is_faced = {draft.things[one]["noun"] for one in targets} <= upright
    if not is_faced:
        draft.parts["camera"].setdefault("view", "top")
    draft.claim(preposition, "camera", "before" if is_faced else "over", [None], targets)
    return True


def _lead(move: dict[str, Any], phrase: Phrase) -> dict[str, Any]:
    """The move after a preposition: around what it shows, towards it, or ahead through a place."""
    preposition, heads = phrase.preposition, [group.head for group in phrase.groups]
    kinds, pace = {one.value for one in preposition.all("relation")}, move.get("pace", 1.0)
    if preposition.text == "around" and move["kind"] in ("truck", "travel"):
        return {"kind": "orbit", "pace": pace}
    is_open = move["kind"] == "truck" and "direction" not in move
    if move["kind"] in ("tilt", "pan") and "direction" not in move:
        return move | split_move(f"{move['kind']} {preposition.text.partition(' ')[0]}")  # "up to"
    is_place = bool(heads) and all(head and names_place(head, preposition.text) for head in heads)
    if is_open and is_place and preposition.text in word_set("things", "onward"):
        return {**split_move("travel forward"), "pace": pace}
    return {**split_move("dolly in"), "pace": pace} if is_open and "towards" in kinds else move


def find_move(draft: SceneDraft, clause: Clause, *, is_ego: bool = False) -> dict[str, Any] | None:
    """The move of a clause with its direction and pace; these words are counted as shown.

    None where the verb is no move of a camera.
    """
    verb = clause.verb
    senses = [one.value for one in verb.all("verb")] if verb is not None else []
    moves = [one.kind for one in senses if one.who == "camera"]
    if verb is None or not moves:
        return None
    draft.show(verb)
    moves = [one for one in moves if one.startswith("travel")] if is_ego else moves
    move = split_move(moves[0])
    turned = read_table("words", "read")["turned_moves"]
    for one in clause.after:
        if isinstance(one, Phrase):
            move = _lead(move, one)
            continue
        name, value = sense.value if (sense := one.first("adverb")) else ("", "")
        if name == "direction":
            phrase = f"{move['kind']} {value}"
            side = split_move(turned.get(phrase, phrase))
            name, move = ("pace", move | side) if "direction" in side else ("", move)
        elif name in ("pace", "speed_m_s"):
            move[name] = move.get("pace", 1.0) * value if name == "pace" else value
        elif (led := turn_by(move, name, value)) != move:
            name, move = "pace", led
        if name in ("pace", "speed_m_s"):
            draft.show(one)
    means = [one.kind for one in senses if one.who == "plain" and one.kind in MEANS]
    if move["kind"] == "travel" and means:
        move["means"] = means[0]
    return move
