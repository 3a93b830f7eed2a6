"""Draft of a scene: what the clauses have said so far, and what became of each word."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, field
from typing import Any

from texvent.scenes.read.lexicon import Token, word_set
from texvent.scenes.report import Substitution
from texvent.scenes.spec.data import PLACING, scene_from_data
from texvent.scenes.spec.scene import MAX_BODIES, Scene, number_nouns

_GRAMMAR = ("articles", "pronouns", "conjunctions", "relatives", "negations", "small", "style",
            "relation", "camera")  # fmt: skip
"""Senses of words that a report does not list unless they are lost or shown."""


def is_grammar(token: Token) -> bool:
    """Whether a token names nothing by itself: "the", "of", "under", "footage"."""
    return token.has(*_GRAMMAR)


@dataclass(frozen=True, kw_only=True)
class Reading:
    """The scene that a sentence describes, and what became of its words."""

    scene: Scene
    shown: tuple[str, ...]
    """Words that the scene shows."""
    substituted: tuple[Substitution, ...]
    """Words that are shown as something else."""
    not_understood: tuple[str, ...]
    """Words without effect on the scene."""


@dataclass
class SceneDraft:
    """Scene that is being read; clauses are applied one after the other."""

    tokens: Sequence[Token]
    things: list[dict[str, Any]] = field(default_factory=list)
    """Fields of objects, whose relations are to indices of others; "is_lost" if what it does is
    not known; "act", what it does if nothing else is said."""
    moves: list[dict[str, Any]] = field(default_factory=list)
    effects: list[dict[str, Any]] = field(default_factory=list)
    """Effects, each with the index of its source."""
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

    def mark(self, token: Token, fate: str) -> None:
        """Count a token as "lost", or as shown by a noun."""
        self._fates[token.at] = fate

    def relate(self, subject: int, kind: str, targets: Sequence[int]) -> bool:
        """Add a relation of an object to others; False: it has none, or goes round in a circle."""
        is_one = self.things[subject]["count"] == 1
        if not targets or (subject in targets and is_one):
            return False
        if kind in PLACING and any(self._stands_by(target, subject) for target in targets):
            return False
        self.things[subject]["relations"].append({"kind": kind, "to": tuple(targets)})
        return True

    def _stands_by(self, subject: int, other: int) -> bool:
        """Whether where an object stands depends on where another one does."""
        relations = [one for one in self.things[subject]["relations"] if one["kind"] in PLACING]
        return subject == other or any(
            self._stands_by(target, other) for one in relations for target in one["to"]
        )

    def reading(self, prompt: str) -> Reading:
        """The scene, and its words; one that is lost at one place of the prompt is not shown."""
        fates: dict[str, str] = {}
        for token in self.tokens:
            is_open = token.is_sign or is_grammar(token)
            fate = self._fates.get(token.at, "" if is_open else "lost")
            if fate == "lost" or (fate and fates.get(token.text, "shown") == "shown"):
                fates[token.text] = fate
        others = [one for one in fates.items() if one[1] not in ("shown", "lost")]
        return Reading(
            scene=self._build(prompt),
            shown=tuple(word for word, fate in fates.items() if fate == "shown"),
            substituted=tuple(Substitution(*one) for one in others),
            not_understood=tuple(word for word, fate in fates.items() if fate == "lost"),
        )

    def _build(self, prompt: str) -> Scene:
        """The scene; copies of objects that have most are left out until it holds them all."""
        while sum(one["count"] for one in self.things) > MAX_BODIES:
            max(self.things, key=lambda one: int(one["count"]))["count"] -= 1
        ids = number_nouns([one["noun"] for one in self.things])
        for one in self.things:
            act = one.pop("act", "stand" if one.pop("is_lost", False) else "")
            done = {each["kind"] for each in one["relations"]} & word_set("things", "doing")
            if act and not done and not one["motions"]:
                one["motions"].append({"kind": act})
            for relation in one["relations"]:
                relation["to"] = [ids[target] for target in relation["to"]]
        for each in (self.parts["camera"], *self.effects):
            named = {name: each.get(name) for name in ("target", "source")}
            each.update({name: ids[one] for name, one in named.items() if one is not None})
        camera = {"moves": self.moves, **self.parts["camera"]}
        return scene_from_data(
            {"prompt": prompt, "objects": self.things, "effects": self.effects, "camera": camera,
             "light": self.parts["light"], "place": self.parts["place"], "absent": self.absent,
             **self.parts["scene"]}
        )  # fmt: skip
