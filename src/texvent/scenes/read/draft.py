"""Draft of a scene: what the clauses have said so far, and what became of each word."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, field
from typing import Any

from texvent.scenes.read.tokens import Token
from texvent.scenes.report import Substitution
from texvent.scenes.spec import scene as spec
from texvent.scenes.spec.data import PLACING

_GRAMMAR = frozenset({"articles", "pronouns", "conjunctions", "relatives", "negations", "small",
                      "style", "relation", "camera"})  # fmt: skip
"""Senses of words that a report does not list unless they are lost or shown."""


def is_grammar(token: Token) -> bool:
    """Whether a token names nothing by itself: "the", "of", "under", "footage"."""
    return any(one.kind in _GRAMMAR for one in token.senses)


@dataclass
class Thing:
    """Object of the scene."""

    noun: str
    usual: str = ""
    """What it does if nothing else is said."""
    values: dict[str, Any] = field(default_factory=dict)
    motions: list[dict[str, Any]] = field(default_factory=list)
    relations: list[dict[str, Any]] = field(default_factory=list)

    @property
    def count(self) -> int:
        """Number of copies."""
        return int(self.values.get("count", 1))

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
    moves: list[dict[str, Any]] = field(default_factory=list)
    effects: list[dict[str, Any]] = field(default_factory=list)
    absent: list[str] = field(default_factory=list)
    parts: dict[str, dict[str, Any]] = field(
        default_factory=lambda: {"camera": {}, "light": {}, "place": {}, "scene": {}}
    )
    """Fields of the camera, the light, the place, and the whole scene."""
    _fates: dict[int, str] = field(default_factory=dict)
    """Number of a token → "lost", "shown", or the noun that it is shown as."""

    def show(self, *tokens: Token) -> None:
        """Count tokens as shown, unless they are lost or shown as something else."""
        for one in tokens:
            self._fates.setdefault(one.at, "shown")

    def lose(self, token: Token) -> None:
        """Count a token as not understood, as all words are that are neither shown nor grammar."""
        self._fates[token.at] = "lost"

    def substitute(self, token: Token, shown: str) -> None:
        """Count a token as shown as something else."""
        self._fates[token.at] = f"as {shown}"

    def relate(self, subject: int, kind: str, targets: Sequence[int], way: str = "") -> bool:
        """Add a relation of an object to others; False: it has none, or goes round in a circle."""
        is_one = self.things[subject].count == 1
        if not targets or (subject in targets and is_one):
            return False
        if kind in PLACING and any(self._stands_by(target, subject) for target in targets):
            return False
        relation = {"kind": kind, "to": tuple(targets), **({"way": way} if way else {})}
        self.things[subject].relations.append(relation)
        return True

    def _stands_by(self, subject: int, other: int) -> bool:
        """Whether where an object stands depends on where another one does."""
        relations = [one for one in self.things[subject].relations if one["kind"] in PLACING]
        return subject == other or any(
            self._stands_by(target, other) for one in relations for target in one["to"]
        )

    def limit_bodies(self) -> None:
        """Leave out copies of objects that have most, until a scene holds them all."""
        while sum(one.count for one in self.things) > spec.MAX_BODIES:
            most = max(self.things, key=lambda one: one.count)
            most.values["count"] -= 1

    def add_effect(self, kind: str, source: int | None) -> None:
        """Add an effect, from an object or all around."""
        self.effects.append({"kind": kind, "source": source})

    def build(self, prompt: str) -> spec.Scene:
        """The scene."""
        ids = spec.number_nouns([one.noun for one in self.things])

        def relation(one: dict[str, Any]) -> spec.Relation:
            return spec.Relation(**{**one, "to": tuple(ids[target] for target in one["to"])})

        def named(index: int | None) -> str | None:
            return None if index is None else ids[index]

        camera = self.parts["camera"]
        return spec.Scene(
            prompt=prompt,
            objects=tuple(
                spec.SceneObject(
                    noun=one.noun,
                    motions=tuple(spec.Motion(**motion) for motion in one.all_motions),
                    relations=tuple(map(relation, one.relations)),
                    **one.values,
                )
                for one in self.things
            ),
            effects=tuple(
                spec.Effect(**{**one, "source": named(one["source"])}) for one in self.effects
            ),
            camera=spec.Camera(
                moves=tuple(spec.CameraMove(**one) for one in self.moves),
                **{**camera, "target": named(camera.get("target"))},
            ),
            light=spec.Light(**self.parts["light"]),
            place=spec.Place(**self.parts["place"]),
            absent=tuple(self.absent),
            **self.parts["scene"],
        )

    def report(self) -> tuple[tuple[str, ...], tuple[Substitution, ...], tuple[str, ...]]:
        """Words that are shown, shown as something else, and not understood, each once.

        A word that is lost at one place of the prompt is not shown.
        """
        fates: dict[str, str] = {}
        for token in self.tokens:
            fate = self._fates.get(token.at)
            if fate is None and not token.is_sign and not is_grammar(token):
                fate = "lost"
            if fate is not None and fates.get(token.text, "shown") == "shown":
                fates[token.text] = fate
            if fate == "lost":
                fates[token.text] = fate
        return (
            tuple(word for word, fate in fates.items() if fate == "shown"),
            tuple(
                Substitution(word, fate.removeprefix("as "))
                for word, fate in fates.items()
                if fate.startswith("as ")
            ),
            tuple(word for word, fate in fates.items() if fate == "lost"),
        )
