"""Draft of a scene: what the clauses have said so far, and what became of each word."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, field
from typing import Any

from texvent.scenes.read.tokens import Token
from texvent.scenes.report import Substitution
from texvent.scenes.spec import scene as spec

_GRAMMAR = frozenset({"articles", "pronouns", "conjunctions", "relatives", "negations", "small", "style",
                      "relations", "camera", "liquid"})  # fmt: skip
"""Senses of words that a report does not list unless they are lost or shown."""


@dataclass
class Thing:
    """Object of the scene."""

    noun: str
    values: dict[str, Any] = field(default_factory=dict)
    motions: list[dict[str, Any]] = field(default_factory=list)
    relations: list[dict[str, Any]] = field(default_factory=list)
    usual: str = ""
    """What it does if nothing else is said."""

    @property
    def all_motions(self) -> list[dict[str, Any]]:
        """Its motions, or the usual one."""
        is_open = self.usual and not self.motions and not self.relations
        return [{"kind": self.usual}] if is_open else self.motions


@dataclass
class SceneDraft:
    """Scene that is being read; clauses are applied one after the other."""

    tokens: Sequence[Token]
    things: list[Thing] = field(default_factory=list)
    camera: dict[str, Any] = field(default_factory=dict)
    moves: list[dict[str, Any]] = field(default_factory=list)
    light: dict[str, Any] = field(default_factory=dict)
    place: dict[str, Any] = field(default_factory=dict)
    effects: list[dict[str, Any]] = field(default_factory=list)
    absent: list[str] = field(default_factory=list)
    is_timelapse: bool = False
    _shown: set[int] = field(default_factory=set)
    _lost: set[int] = field(default_factory=set)
    _substituted: dict[int, str] = field(default_factory=dict)

    @property
    def is_empty(self) -> bool:
        """Whether nothing is said that could be shown."""
        return not (self.things or self.camera or self.moves or self.light or self.place
                    or self.effects)  # fmt: skip

    def show(self, *tokens: Token) -> None:
        """Count tokens as shown."""
        self._shown.update(one.at for one in tokens)

    def lose(self, *tokens: Token) -> None:
        """Count tokens as not understood, whatever else is said of them."""
        self._lost.update(one.at for one in tokens)

    def substitute(self, token: Token, shown: str) -> None:
        """Count a token as shown as something else."""
        self._substituted[token.at] = shown

    def relate(self, subject: int, kind: str, targets: Sequence[int], way: str = "") -> None:
        """Add a relation of an object to others."""
        relation: dict[str, Any] = {"kind": kind, "to": tuple(targets)}
        if way:
            relation["way"] = way
        self.things[subject].relations.append(relation)

    def build(self, prompt: str) -> spec.Scene:
        """The scene."""
        ids = spec.number_nouns([one.noun for one in self.things])
        objects = tuple(
            spec.SceneObject(
                noun=one.noun,
                motions=tuple(spec.Motion(**motion) for motion in one.all_motions),
                relations=tuple(
                    spec.Relation(**{**each, "to": tuple(ids[target] for target in each["to"])})
                    for each in one.relations
                ),
                **one.values,
            )
            for one in self.things
        )
        camera = dict(self.camera)
        if "target" in camera:
            camera["target"] = ids[camera["target"]]
        effects = (
            {**one, "source": None if one["source"] is None else ids[one["source"]]}
            for one in self.effects
        )
        return spec.Scene(
            prompt=prompt,
            objects=objects,
            effects=tuple(spec.Effect(**one) for one in effects),
            camera=spec.Camera(moves=tuple(spec.CameraMove(**one) for one in self.moves), **camera),
            light=spec.Light(**self.light),
            place=spec.Place(**self.place),
            absent=tuple(self.absent),
            is_timelapse=self.is_timelapse,
        )

    def report(self) -> tuple[tuple[str, ...], tuple[Substitution, ...], tuple[str, ...]]:
        """Words that are shown, shown as something else, and not understood, each once."""
        lost = dict.fromkeys(one.text for one in self.tokens if self._is_lost(one))
        others = {
            one.text: Substitution(one.text, self._substituted[one.at])
            for one in self.tokens
            if one.at in self._substituted and one.text not in lost
        }
        shown = dict.fromkeys(
            one.text
            for one in self.tokens
            if one.at in self._shown and one.text not in lost and one.text not in others
        )
        return tuple(shown), tuple(others.values()), tuple(lost)

    def _is_lost(self, token: Token) -> bool:
        if token.at in self._lost:
            return True
        if token.at in self._shown or token.at in self._substituted or token.is_sign:
            return False
        is_known = token.number is None and token.quantity is None and token.picture is None
        return not (is_known and token.senses and is_grammar(token))


def is_grammar(token: Token) -> bool:
    """Whether a token names nothing by itself: "the", "of", "under", "footage"."""
    return any(one.kind in _GRAMMAR for one in token.senses)
