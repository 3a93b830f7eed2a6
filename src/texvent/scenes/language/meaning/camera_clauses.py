"""Clauses about the camera: "the camera pans left", "filmed from a boat"."""

from __future__ import annotations

from collections.abc import Sequence

from texvent.scenes.language.grammar.syntax import Clause, PrepPhrase
from texvent.scenes.language.meaning.camera_reader import CameraReader
from texvent.scenes.language.meaning.circumstances.reader import CircumstanceReader
from texvent.scenes.language.meaning.referents.referent import Referent
from texvent.scenes.language.meaning.referents.resolver import OWNERS, Referents
from texvent.scenes.language.meaning.scope import Scope
from texvent.scenes.language.words.english import VerbForm
from texvent.scenes.language.words.lexicon import Role

FILMED = ("taken", "filmed", "shot", "seen")
"""Participles that say how it is filmed."""
_ONLY_CAMERAS = frozenset({"pan", "tilt", "zoom", "dolly", "crane", "truck"})
"""Verbs that nothing but a camera does, whatever word names it."""
_STANDPOINTS = ("from", "in", "on", "inside", "aboard")


class CameraClauses:
    """Reads clauses whose subject is the camera, the viewer or a shot."""

    def __init__(
        self, camera: CameraReader, referents: Referents, around: CircumstanceReader
    ) -> None:
        self._camera = camera
        self._referents = referents
        self._around = around

    def is_about(self, clause: Clause, subjects: Sequence[Referent]) -> bool:
        """Whether a clause is about the camera."""
        if any(_is_of_a_thing(one) for one in subjects):
            return False
        if any(one.kind in ("camera", "function") for one in subjects):
            return True
        if clause.verb is None:
            return False
        if clause.verb.role is Role.CAMERA_MOVE:
            is_order = clause.verb.meaning.form is VerbForm.BASE and not clause.objects
            return is_order or not any(self._does_it(one, clause) for one in subjects)
        is_move = clause.verb.read_as(Role.CAMERA_MOVE) is not None
        return is_move and not subjects and self._camera.has_moves

    @staticmethod
    def _does_it(subject: Referent, clause: Clause) -> bool:
        """As in "a baker pulls out two loaves", "paramecia, backing away": no camera does."""
        is_plain = bool(clause.objects) or clause.verb_word.lemma.split()[0] not in _ONLY_CAMERAS
        is_other = subject.kind == "unknown" and is_plain
        return is_other or subject.kind in ("things", "part", "effect", "weather", "clouds")

    def read(
        self, clause: Clause, subjects: Sequence[Referent]
    ) -> tuple[list[Referent], list[Referent]]:
        """Read a clause.

        Args:
            clause: the clause.
            subjects: its cameras, shots and views.

        Returns:
            Its objects, and everything that it names.
        """
        for one in subjects:
            if one.group.head is not None:
                self._camera.read_word(one.group.head)
                one.group.head.is_used = True
            self._camera.read_attributes(one.attributes)
            self._around.read_style(one)
            scope = Scope([], [], is_lost=one.kind == "camera", has_verb=False)
            others = [phrase for phrase in one.group.phrases if not self._stands(one, phrase)]
            self._around.read_phrases(others, scope)
        is_filmed = clause.verb is not None and clause.verb.text in FILMED
        if is_filmed:
            self._forget_standpoint(clause)
        phrases = self._resolve_phrases(clause.phrases)
        objects = [self._referents.resolve(group) for group in clause.objects]
        self._camera.read_clause(clause, objects, phrases)
        for phrase, one in phrases:
            if not one.is_things:
                near = self._referents.recall(phrase.near)
                things = near.things if near is not None else []
                self._around.read_phrase(phrase, Scope(things, [], has_verb=False))
            self._around.read_group_phrases(one, Scope([], []))
        if clause.verb is not None and is_filmed:
            clause.verb.is_used = True
        return objects, [*objects, *(one for _, one in phrases)]

    def _stands(self, camera: Referent, phrase: PrepPhrase) -> bool:
        """As in "camera behind a runner": where it is, not where a thing is."""
        if camera.kind != "camera" or not phrase.groups:
            return False
        place = self._referents.resolve(phrase.groups[0], phrase.preposition.text)
        return self._camera.stand_by(phrase.preposition, place)

    def _forget_standpoint(self, clause: Clause) -> None:
        """As in "filmed from a boat": the boat is not in the picture, and so reported."""
        for phrase in clause.phrases:
            for group in phrase.groups if phrase.preposition.text in _STANDPOINTS else ():
                head = group.head
                if head is not None and head.role is Role.NOUN:
                    self._referents.forget(group)
                    phrase.preposition.is_lost = True

    def _resolve_phrases(self, phrases: Sequence[PrepPhrase]) -> list[tuple[PrepPhrase, Referent]]:
        found = []
        for phrase in phrases:
            for group in phrase.groups:
                group.negation = phrase.negation or group.negation
                found.append((phrase, self._referents.resolve(group, phrase.preposition.text)))
        return found


def _is_of_a_thing(subject: Referent) -> bool:
    """As in "a rover and its mast camera": not the one that films."""
    determiner = subject.group.determiner
    return subject.kind == "camera" and determiner is not None and determiner.text in OWNERS
