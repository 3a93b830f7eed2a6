"""Moves of the camera: words for them, and how directions change them."""

from __future__ import annotations

from typing import Any, get_args

from texvent.scenes.read.clauses import Clause, Phrase
from texvent.scenes.read.draft import SceneDraft
from texvent.scenes.read.lexicon import word_set
from texvent.scenes.read.tokens import Token
from texvent.scenes.spec.scene import MoveDirection, MoveKind

_KINDS = sorted(get_args(MoveKind), key=len, reverse=True)
_WAYS = {"towards": "towards", "toward": "towards", "away from": "away", "from": "away"}
_MEANS = ("drive", "cycle", "walk", "run", "fly", "sail", "swim")


def split_move(phrase: str) -> dict[str, Any]:
    """A move of words.toml, as fields of `CameraMove`.

    Example:
        >>> split_move("dolly zoom in"), split_move("pan")
        ({'kind': 'dolly zoom', 'direction': 'in'}, {'kind': 'pan'})
    """
    kind = next(one for one in _KINDS if phrase == one or phrase.startswith(f"{one} "))
    direction = phrase[len(kind) + 1 :]
    return {"kind": kind, **({"direction": direction} if direction else {})}


def find_move(draft: SceneDraft, clause: Clause, *, is_ego: bool = False) -> dict[str, Any] | None:
    """The move of a clause with its direction and pace; these words are counted as shown.

    None where the verb is no move of a camera.
    """
    verb = clause.verb
    moves = (
        [one.value.kind for one in verb.all("verb") if one.value.who == "camera"] if verb else []
    )
    moves = [move for move in moves if move == "travel"] if is_ego else moves
    if verb is None or not moves:
        return None
    draft.show(verb)
    move = split_move(moves[0])
    for phrase in clause.after:
        way = _WAYS.get(phrase.preposition.text) if isinstance(phrase, Phrase) else None
        if way is not None and move["kind"] == "truck":
            move["direction"] = way
    for token in clause.after:
        said = token.first("adverb") if isinstance(token, Token) else None
        if said is None or not isinstance(token, Token):
            continue
        draft.show(token)
        field, value = said.value
        if field == "pace":
            move["pace"] = move.get("pace", 1.0) * value
        elif field == "direction":
            move["direction"] = value
    return _resolve(move, verb)


def _resolve(move: dict[str, Any], verb: Token) -> dict[str, Any]:
    """As "moves up" = pedestal, "moves forward" = travel, "moves towards" = dolly."""
    kind, way = move["kind"], move.get("direction")
    plain = [one.value.kind for one in verb.all("verb") if one.value.who == "plain"]
    if kind == "pedestal":
        return {**move, "direction": way or ("down" if "sink" in plain else "up")}
    if kind == "travel":
        means = [one for one in _MEANS if one in plain]
        return {"direction": "forward", **move, **({"means": means[0]} if means else {})}
    if kind == "truck" and way in ("up", "down"):
        return {**move, "kind": "pedestal"}
    if kind == "truck" and way in ("forward", "backward"):
        return {**move, "kind": "travel"}
    if kind in ("truck", "dolly") and way in ("towards", "away", "forward", "backward"):
        is_in = way in ("towards", "forward")
        return {**move, "kind": "dolly", "direction": "in" if is_in else "out"}
    if kind in ("handheld", "static") or way not in get_args(MoveDirection):
        move.pop("direction", None)
    return move


def add_move(draft: SceneDraft, move: dict[str, Any], phase: int) -> None:
    """Add a move; what flies is seen from the air."""
    draft.moves.append({**move, **({"phase": phase} if phase else {})})
    if move.get("means") == "fly":
        draft.parts["camera"].setdefault("view", "aerial")


def aims_at(relation: str) -> bool:
    """Whether a camera that moves so looks at what a preposition relates it to."""
    return relation in word_set("things", "aims").union(("away from", "look at"))
