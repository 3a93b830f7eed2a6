"""Moves of the camera: words for them, and how directions change them."""

from __future__ import annotations

from typing import Any, get_args

from texvent.scenes.read.clauses import Clause, Phrase
from texvent.scenes.read.draft import SceneDraft
from texvent.scenes.read.lexicon import read_table
from texvent.scenes.spec.scene import MoveDirection, MoveKind

_KINDS = sorted(get_args(MoveKind), key=len, reverse=True)
_UNTURNED = ("handheld", "static")
_MEANS = ("drive", "cycle", "walk", "run", "fly", "sail", "swim")


def split_move(phrase: str) -> dict[str, Any]:
    """A move of words.toml, such as "dolly zoom in", as fields of `CameraMove`."""
    kind = next(one for one in _KINDS if phrase == one or phrase.startswith(f"{one} "))
    direction = phrase[len(kind) + 1 :]
    is_turned = direction in (get_args(MoveDirection) if kind not in _UNTURNED else ("all axes",))
    return {"kind": kind, **({"direction": direction} if is_turned else {})}


def find_move(draft: SceneDraft, clause: Clause, *, is_ego: bool = False) -> dict[str, Any] | None:
    """The move of a clause with its direction and pace; these words are counted as shown.

    None where the verb is no move of a camera.
    """
    verb = clause.verb
    senses = [one.value for one in verb.all("verb")] if verb is not None else []
    moves = [one.kind for one in senses if one.who == "camera"]
    if verb is None or not moves or (is_ego and "travel forward" not in moves):
        return None
    draft.show(verb)
    move = split_move("travel forward" if is_ego else moves[0])
    for one in clause.after:
        said = None if isinstance(one, Phrase) else one.first("adverb")
        if said is not None and not isinstance(one, Phrase):
            draft.show(one)
            field, value = said.value
            move[field] = move.get("pace", 1.0) * value if field == "pace" else value
    phrase = f"{move['kind']} {move.get('direction', '')}".strip()
    pace = {"pace": move["pace"]} if "pace" in move else {}
    move = split_move(read_table("words")["turned_moves"].get(phrase, phrase)) | pace
    means = [one.kind for one in senses if one.who == "plain" and one.kind in _MEANS]
    if move["kind"] == "travel" and means:
        move["means"] = means[0]
    return move
