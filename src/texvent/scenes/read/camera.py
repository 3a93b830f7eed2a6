"""Clauses about the camera: its moves, what it follows, views and framing."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass
from typing import get_args

from texvent.scenes.read.clauses import Clause
from texvent.scenes.read.draft import SceneDraft
from texvent.scenes.read.lexicon import read_table
from texvent.scenes.read.tokens import Token
from texvent.scenes.spec.scene import MoveDirection, MoveKind

_AIMED = frozenset({"around", "towards", "away from", "from", "at", "on", "beside", "look at"})
"""Relations to what the camera looks at; it only passes others."""


@dataclass(frozen=True)
class CameraVerb:
    """Move that a clause asks for."""

    kind: str
    direction: str | None = None
    pace: float = 1.0
    means: str | None = None


def split_move(phrase: str) -> tuple[str, str | None]:
    """Kind and direction of a move.

    Example:
        >>> split_move("dolly zoom in"), split_move("pan")
        (('dolly zoom', 'in'), ('pan', None))
    """
    kinds = sorted(get_args(MoveKind), key=len, reverse=True)
    kind = next(one for one in kinds if phrase == one or phrase.startswith(f"{one} "))
    return kind, phrase[len(kind) :].strip() or None


def apply_shot(draft: SceneDraft, token: Token, phase: int) -> bool:
    """Add a move, a view or a framing that a phrase names: "handheld camera", "aerial view"."""
    shot = token.first("shots", "views", "framings", "film")
    if shot is None:
        return False
    if shot.kind == "shots":
        kind, direction = split_move(shot.value)
        _add_move(draft, CameraVerb(kind, direction), phase)
    elif shot.kind == "film":
        if shot.value == "grey":
            draft.camera["is_grey"] = True
        else:
            draft.is_timelapse = True
    else:
        draft.camera["view" if shot.kind == "views" else "framing"] = shot.value
    draft.show(token)
    return True


def _add_move(draft: SceneDraft, verb: CameraVerb, phase: int) -> None:
    move: dict[str, object] = {"kind": verb.kind}
    if verb.direction is not None:
        move["direction"] = verb.direction
    if verb.pace != 1.0:
        move["pace"] = verb.pace
    if verb.means is not None:
        move["means"] = verb.means
    if phase:
        move["phase"] = phase
    draft.moves.append(move)


def find_means(verb: Token | None) -> str | None:
    """How a camera goes that is said to drive, walk or fly."""
    table: Mapping[str, str] = read_table("words")["means"]
    if verb is None:
        return None
    kinds = {one.value.kind for one in verb.all("verb") if one.value.who == "plain"}
    return next((means for means in table if means in kinds), None)


def read_move(draft: SceneDraft, clause: Clause, *, is_ego: bool = False) -> CameraVerb | None:
    """The move of a clause with its direction and pace; these words are counted as shown.

    None where the verb is no move of a camera.
    """
    if clause.verb is None:
        return None
    moves = [one.value.kind for one in clause.verb.all("verb") if one.value.who == "camera"]
    if is_ego:
        moves = [move for move in moves if move == "travel"]
    if not moves:
        return None
    draft.show(clause.verb)
    kind, direction = split_move(moves[0])
    pace = 1.0
    for token in clause.after:
        if isinstance(token, Token):
            found = token.first("directions", "paces")
            if found is None:
                continue
            draft.show(token)
            if found.kind == "paces":
                pace *= float(found.value)
            else:
                direction = found.value
    return _resolve(kind, direction, pace, clause.verb)


def _resolve(kind: str, way: str | None, pace: float, verb: Token) -> CameraVerb:
    """As "moves up" = pedestal, "moves forward" = travel, "moves left" = truck."""
    verbs = {one.value.kind for one in verb.all("verb") if one.value.who == "plain"}
    if kind == "pedestal" and way is None:
        way = "down" if "sink" in verbs else "up"
    if kind == "travel":
        return CameraVerb(kind, way or "forward", pace, find_means(verb))
    if kind == "truck" and way in ("up", "down"):
        return CameraVerb("pedestal", way, pace)
    if kind == "truck" and way in ("forward", "backward"):
        return CameraVerb("travel", way, pace)
    if kind in ("truck", "dolly") and way in ("towards", "away", "forward", "backward"):
        return CameraVerb("dolly", "in" if way in ("towards", "forward") else "out", pace)
    if kind in ("handheld", "static") or way not in get_args(MoveDirection):
        way = way if way in ("in", "out") else None
    return CameraVerb(kind, way, pace)


def aims_at(relation: str) -> bool:
    """Whether a camera that moves so looks at what a preposition relates it to."""
    return relation in _AIMED


def add_move(draft: SceneDraft, move: CameraVerb, phase: int) -> None:
    """Add a move; what flies is seen from the air."""
    _add_move(draft, move, phase)
    if move.means == "fly":
        draft.camera.setdefault("view", "aerial")
