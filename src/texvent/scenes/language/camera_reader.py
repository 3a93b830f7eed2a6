"""Reads what a prompt says about the camera."""

from __future__ import annotations

from dataclasses import replace

from texvent.scenes.description import CameraMove, Shot
from texvent.scenes.language import vocabulary_scene
from texvent.scenes.language.lexicon import Role
from texvent.scenes.language.tagging import Phrase
from texvent.scenes.language.vocabulary_motion import Verb

_SIDE_BY_RELATION = {
    "behind": "behind",
    "front": "front",
    "beside": "side",
    "past": "side",
    "above": "above",
}
_IN_OUT = {"forward": "in", "backward": "out", "towards": "in", "away": "out"}


class CameraReader:
    """Collects camera moves; has the focus from the word "camera" to the next object."""

    def __init__(self) -> None:
        self.has_focus = False
        """Whether verbs and directions are about the camera."""
        self._moves: list[CameraMove] = []
        self._view: str | None = None
        self._framing: str | None = None
        self._target: int | None = None
        self._pace: tuple[float, Phrase] | None = None
        self._named: Phrase | None = None

    def read(self, phrase: Phrase) -> bool:
        """Take a phrase that is about the camera; return whether it was one."""
        if phrase.role is Role.CAMERA:
            self.has_focus, self._named = True, phrase
            phrase.is_used = bool(self._moves)
        elif phrase.role is Role.CAMERA_MOVE:
            kind, direction = phrase.meaning.value
            self._start(CameraMove(kind, direction), phrase)
        elif phrase.role is Role.VIEW:
            self._view, phrase.is_used = phrase.meaning.value, True
        elif phrase.role is Role.FRAMING:
            self._framing, phrase.is_used = phrase.meaning.value, True
        elif not self.has_focus:
            return False
        elif phrase.role is Role.VERB:
            self._read_verb(phrase)
        elif phrase.role is Role.STILL:
            self._start(CameraMove("static"), phrase)
        elif phrase.role is Role.DIRECTION:
            self._read_direction(phrase)
        elif phrase.role is Role.PACE:
            self._read_pace(phrase)
        else:
            return False
        return True

    def aim(self, object_index: int, relation: str | None) -> bool:
        """Point the camera at an object that its sentence names; return whether it does that."""
        if not self._moves or not self.has_focus:
            return False
        last = self._moves[-1]
        if last.kind not in ("follow", "orbit", "zoom", "dolly"):
            return False
        if last.kind == "follow" and relation in _SIDE_BY_RELATION:
            self._moves[-1] = replace(last, direction=_SIDE_BY_RELATION[relation])
        self._target, self.has_focus = object_index, False
        return True

    def build(self) -> Shot:
        """The shot as understood."""
        return Shot(tuple(self._moves), self._view, self._framing, self._target)

    def _start(self, move: CameraMove, phrase: Phrase) -> None:
        phrase.is_used = self.has_focus = True
        if self._named is not None:
            self._named.is_used = True
        if self._pace is not None:
            factor, said = self._pace
            move = replace(move, pace=move.pace * factor)
            said.is_used, self._pace = True, None
        if move.kind != "static" and self._moves and self._moves[-1].kind == "static":
            self._moves.pop()
        self._moves.append(move)

    def _read_verb(self, phrase: Phrase) -> None:
        verb: Verb = phrase.meaning.value
        if verb.relation == "follow":
            kind: str | None = "follow"
        else:
            kind = vocabulary_scene.CAMERA_VERBS.get(verb.kind)
        if kind is None:
            return
        direction = {"rise": "up", "sink": "down", "fall": "down"}.get(verb.kind)
        if verb.direction is not None:
            direction = _IN_OUT.get(verb.direction, verb.direction)
            kind = "dolly" if direction in ("in", "out") else kind
        self._start(CameraMove(kind, direction, verb.pace), phrase)

    def _read_direction(self, phrase: Phrase) -> None:
        if not self._moves:
            return
        last = self._moves[-1]
        direction = _IN_OUT.get(phrase.meaning.value, phrase.meaning.value)
        kind = last.kind
        if kind == "truck" and direction in ("in", "out"):
            kind = "dolly"
        elif kind == "truck" and direction in ("up", "down"):
            kind = "pedestal"
        self._moves[-1] = replace(last, kind=kind, direction=direction)
        phrase.is_used = True

    def _read_pace(self, phrase: Phrase) -> None:
        if not self._moves:
            self._pace = (phrase.meaning.value, phrase)
            return
        self._moves[-1] = replace(self._moves[-1], pace=self._moves[-1].pace * phrase.meaning.value)
        phrase.is_used = True
