"""Moves of the camera that clauses say."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from typing import Any

from texvent_scenes.models.tables import nouns_with, read_table
from texvent_scenes.read.draft.abilities import MEANS
from texvent_scenes.read.draft.motions import split_move, turn_by
from texvent_scenes.read.draft.places import names_place
from texvent_scenes.read.draft.scene_draft import SceneDraft
from texvent_scenes.read.parsing.clauses import Clause
from texvent_scenes.read.parsing.groups import Phrase, heads_of, nouns_of, words_of
from texvent_scenes.read.parsing.lexicon import word_set
from texvent_scenes.read.parsing.tokens import Token

_STAYING = frozenset({"handheld", "roll", "truck"})
"""Moves of a camera over what it looks at."""


def go_through(
    draft: SceneDraft, move: dict[str, Any], preposition: Token, targets: Sequence[int]
) -> bool:
    """Lead a camera that goes ahead through what has a way through, or out; whether it has one."""
    is_ahead = move["kind"] == "travel" or split_move("dolly in").items() <= move.items()
    nouns = draft.names(targets)
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
    before = draft.beside(preposition, -1)
    is_view = before.text in word_set("things", "viewed") or before.has("shot")
    if not is_so or (move is None and not is_view):
        return False
    heads = heads_of(phrase.groups)
    if heads and all(one.has("place") for one in heads):
        return False  # "seen from a beach" is there
    for token in (preposition, *words_of(phrase.groups)):
        draft.mark(token, "lost")
    nouns = nouns_of(phrase.groups)
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
    is_faced = draft.names(targets) <= upright
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
