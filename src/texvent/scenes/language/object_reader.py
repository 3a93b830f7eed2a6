"""Reads what a prompt says about objects: how many, what colour, what they do, and where."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import replace

from texvent.scenes.description import SPIN_RATE_HZ, NamedColour, ObjectMotion, Relation
from texvent.scenes.language import vocabulary_objects, vocabulary_scene
from texvent.scenes.language.lexicon import Role
from texvent.scenes.language.noun_phrase import NounPhrase, PartialObject, list_capable
from texvent.scenes.language.relation_builder import RelationBuilder
from texvent.scenes.language.tagging import Phrase, mark_used
from texvent.scenes.language.vocabulary_motion import Verb
from texvent.scenes.models.protocol import Noun

MAX_OBJECTS = 16
"""Most different objects; later ones are left out, and said."""

_DEFINITE = ("the", "this", "that", "these", "those", "its", "their", "his", "her")
_CARRIED = ("drive", "fly", "sail")
_HANDLED = ("spin", "bounce", "fall", "roll", "throw", "swing", "sway", "slide")


class ObjectReader:
    """Collects objects, their motions and relations, sentence by sentence."""

    def __init__(self, nouns: Mapping[str, Noun]) -> None:
        self.partial_objects: list[PartialObject] = []
        self.absent: list[str] = []
        self.notes: list[str] = []
        self.noun_phrase = NounPhrase()
        self.subjects: list[int] = []
        """Objects that the next verb is about."""
        self.mentioned: list[int] = []
        """Objects named last."""
        self.verb_follows = False
        """Whether the noun being read has a verb of its own right after it."""
        self.negation: Phrase | None = None
        self._nouns = nouns
        self._relation: tuple[str, Phrase | None] | None = None
        self._relation_builder = RelationBuilder()
        self._is_joined = False
        self._has_acted = False
        self._is_lost = False
        self._object_motion: ObjectMotion | None = None

    @property
    def relations(self) -> list[Relation]:
        """All relations so far."""
        return self._relation_builder.relations

    def open_noun_phrase(self, phrase: Phrase) -> None:
        """A determiner starts a new noun phrase."""
        self.apply_adjectives()
        if self.negation is not None and self.negation.is_used:
            self.negation = None
        before = self.noun_phrase
        self.noun_phrase = NounPhrase(
            is_definite=phrase.text in _DEFINITE,
            motion=before.motion,
            side=before.side,
            phrases=before.phrases if before.motion or before.side else [],
        )
        if phrase.text in ("a", "an", "another", "each", "every"):
            self.noun_phrase.count = 1

    def read_adjective(self, phrase: Phrase) -> None:
        """A count, number, colour, shade or size."""
        noun_phrase, value = self.noun_phrase, phrase.meaning.value
        if phrase.role is Role.COUNT:
            noun_phrase.count = value
        elif phrase.role is Role.NUMBER:
            noun_phrase.number = value
        elif phrase.role is Role.SHADE:
            noun_phrase.shade = phrase.text
        elif phrase.role is Role.SIZE:
            noun_phrase.scale = value
        elif phrase.role is Role.COLOUR:
            rgb, name = vocabulary_objects.COLOURS[phrase.text], phrase.text
            if noun_phrase.shade is not None:
                rgb = vocabulary_objects.shade_colour(rgb, noun_phrase.shade)
                name, noun_phrase.shade = f"{noun_phrase.shade} {name}", None
            noun_phrase.colour = NamedColour(name, rgb)
        noun_phrase.phrases.append(phrase)

    def take_colour(self) -> tuple[NamedColour | None, list[Phrase]]:
        """The colour waiting for a noun, when a place or the sky comes instead."""
        colour, phrases = self.noun_phrase.colour, self.noun_phrase.phrases
        self.noun_phrase = NounPhrase()
        return colour, [p for p in phrases if p.role in (Role.COLOUR, Role.SHADE)]

    def read_noun(self, phrase: Phrase) -> int | None:
        """A noun ends its noun phrase. Its object's index, or None if it shows nothing new."""
        name: str = phrase.meaning.value
        phrase.is_used = True
        if self.negation is not None:
            self.negation.is_used = True
            self.noun_phrase.mark_used()
            self.noun_phrase = NounPhrase()
            if name not in self.absent:
                self.absent.append(name)
            return None
        index = self._recall(name, phrase)
        if index is None and (index := self._add_object(name, phrase)) is None:
            return None
        self.noun_phrase.mark_used()
        self.noun_phrase = NounPhrase()
        self._connect(index)
        self.mentioned = [index]
        return index

    def apply_adjectives(self) -> None:
        """Give adjectives that met no noun to the subject: "the car is red"."""
        noun_phrase = self.noun_phrase
        if not self.subjects or not noun_phrase.phrases:
            return
        for partial in self._at(self.subjects):
            if noun_phrase.colour is not None and partial.colour is None:
                partial.colour = noun_phrase.colour
                noun_phrase.mark_roles(Role.COLOUR, Role.SHADE)
            if noun_phrase.scale is not None and partial.scale == 1.0:
                partial.scale = noun_phrase.scale
                noun_phrase.mark_roles(Role.SIZE)
            if noun_phrase.pace != 1.0:
                partial.pace *= noun_phrase.pace
                noun_phrase.mark_roles(Role.PACE)
        self.noun_phrase = NounPhrase()

    def read_attribute(self, phrase: Phrase) -> None:
        """A participle before its noun: "a running dog"."""
        verb: Verb = phrase.meaning.value
        self.noun_phrase.motion = ObjectMotion(verb.kind, verb.direction, verb.pace)
        self.noun_phrase.phrases.append(phrase)

    def read_verb(self, phrase: Phrase, has_object: bool) -> None:
        """A verb about the subjects; with an object, some verbs are about the object."""
        self.apply_adjectives()
        verb: Verb = phrase.meaning.value
        motion = ObjectMotion(verb.kind, verb.direction, verb.pace * self.noun_phrase.pace)
        if self.negation is not None:
            motion = ObjectMotion("stand")
            self.negation.is_used, self.negation = True, None
        if not self.subjects:
            if not self._is_lost:
                self.noun_phrase.motion = motion
                self.noun_phrase.phrases.append(phrase)
            return
        phrase.is_used = True
        if phrase.meaning.form == "participle" and self._act_on_mentioned(motion):
            return
        self._has_acted = True
        self._relation = (verb.relation, None) if verb.relation else None
        if has_object and verb.kind in _HANDLED:
            self._object_motion, motion = motion, ObjectMotion("stand")
        elif has_object and verb.kind in _CARRIED and verb.relation is None:
            self._relation = ("on", None)
            self._object_motion = ObjectMotion("move", motion.direction, motion.pace)
            motion = ObjectMotion("sit")
        for partial in list_capable(self._at(self.subjects), motion, self._nouns):
            partial.move(motion, self._nouns[partial.noun])

    def _act_on_mentioned(self, motion: ObjectMotion) -> bool:
        """A participle after a related object is about that: "a boat with dolphins jumping"."""
        if not self._relation_builder.is_last_target(self.mentioned):
            return False
        named = self._at(self.mentioned)
        if any(d.motion is not None or self._nouns[d.noun].habitat == "fixed" for d in named):
            return False
        for partial in named:
            partial.move(motion, self._nouns[partial.noun])
        return True

    def read_still(self, phrase: Phrase) -> None:
        """The words still, motionless: before a noun or about the subject."""
        if self.subjects:
            for partial in self._at(self.subjects):
                partial.motion = ObjectMotion("stand")
            phrase.is_used = True
        else:
            self.noun_phrase.motion = ObjectMotion("stand")
            self.noun_phrase.phrases.append(phrase)

    def read_direction(self, phrase: Phrase) -> None:
        """Which way the subjects go; without a verb they move that way.

        "Across" is the weakest: it keeps a direction that is already said.
        """
        direction = phrase.meaning.value
        for partial in self._movers():
            motion = partial.motion or ObjectMotion("move")
            if motion.kind == "stand":
                continue
            if direction != "across" or motion.direction is None:
                partial.motion = replace(motion, direction=direction)
            phrase.is_used = True

    def read_pace(self, phrase: Phrase, noun_follows: bool) -> None:
        """How fast: an adverb about the verb before or after, or an adjective."""
        movers = self._movers()
        if not noun_follows and any(partial.motion for partial in movers):
            for partial in movers:
                partial.pace *= phrase.meaning.value
            phrase.is_used = True
        else:
            self.noun_phrase.pace *= phrase.meaning.value
            self.noun_phrase.phrases.append(phrase)

    def read_speed(self, speed_m_s: float, phrases: list[Phrase]) -> None:
        """A speed in numbers, m/s."""
        for partial in self._movers():
            motion = partial.motion or ObjectMotion("move")
            if motion.kind != "stand":
                partial.motion = replace(motion, pace=1.0, speed_m_s=speed_m_s)
                partial.pace = 1.0
                mark_used(phrases)

    def read_rate(self, rate_hz: float, phrases: list[Phrase]) -> bool:
        """Turns per second of what spins; False if nothing spins."""
        spinning = [
            partial
            for partial in self._at(self.subjects)
            if partial.motion is not None and partial.motion.kind == "spin"
        ]
        for partial in spinning:
            partial.motion = ObjectMotion("spin", pace=rate_hz / SPIN_RATE_HZ)
        mark_used(phrases if spinning else ())
        return bool(spinning)

    def read_relation(self, phrase: Phrase) -> None:
        """A preposition waits for its noun."""
        self.apply_adjectives()
        self._relation = (phrase.meaning.value, phrase)
        self.noun_phrase = NounPhrase(
            motion=self.noun_phrase.motion, phrases=self.noun_phrase.phrases
        )

    @property
    def relation(self) -> str | None:
        """The relation that waits for its noun."""
        return self._relation[0] if self._relation else None

    def drop_relation(self, *, is_used: bool) -> None:
        """The noun after the preposition was a place or belongs to the camera."""
        if self._relation is not None and self._relation[1] is not None and is_used:
            self._relation[1].is_used = True
        self._relation = None

    def read_side(self, phrase: Phrase) -> None:
        """Where in the image the object before, or else the object after, is."""
        if self.mentioned:
            for partial in self._at(self.mentioned):
                partial.side = phrase.meaning.value
            phrase.is_used = True
        else:
            self.noun_phrase.side = phrase.meaning.value
            self.noun_phrase.phrases.append(phrase)

    def read_part(self, phrase: Phrase) -> None:
        """A part that the model shows anyway, if the stated colour is its own."""
        for partial in self._at(self.mentioned):
            noun = self._nouns[partial.noun]
            natural = vocabulary_scene.PARTS.get((noun.name, phrase.text))
            is_shown = noun.motion == "drive" and phrase.text in vocabulary_scene.VEHICLE_PARTS
            if natural is None and not is_shown:
                continue
            phrase.is_used = True
            if self.noun_phrase.colour is None or self.noun_phrase.colour.name == natural:
                self.noun_phrase.mark_used()
        self.drop_relation(is_used=phrase.is_used)
        self.noun_phrase = NounPhrase()

    def close_subjects(self) -> None:
        """A place or light was read: the next noun starts a list of subjects of its own."""
        self._has_acted = True

    def read_and(self, _: Phrase) -> None:
        """The word and: the next noun joins the last one."""
        self._is_joined = True

    def read_negation(self, phrase: Phrase) -> None:
        """A word such as no: the next noun is not shown."""
        self.negation = phrase

    def end_clause(self, sign: str) -> None:
        """A comma or full stop."""
        self.apply_adjectives()
        self._relation = None
        self._relation_builder.close()
        self._is_joined = sign == ","
        self._is_lost &= sign == ","
        if sign != ",":
            self.negation = None

    def read_pronoun(self, phrase: Phrase) -> None:
        """A pronoun: "which" and "who" mean the object named last, "it" the last subject."""
        if phrase.text in ("which", "who") and self.mentioned:
            self.subjects = list(self.mentioned)
        else:
            self.mentioned = list(self.subjects)

    def read_unknown_noun(self) -> None:
        """A word that may be an unknown noun: what follows is not about the last subject."""
        if self._relation is not None:
            self._relation = None
        else:
            self.subjects, self.mentioned = [], []
            self._is_lost = True
        self.noun_phrase = NounPhrase()

    def _at(self, indices: list[int]) -> list[PartialObject]:
        return [self.partial_objects[index] for index in indices]

    def _movers(self) -> list[PartialObject]:
        """The subjects, or what they ride: "a man rides a horse to the left"."""
        ridden = {
            relation.subject: relation.targets[0]
            for relation in self._relation_builder.relations
            if relation.kind == "on"
            and self.partial_objects[relation.targets[0]].motion is not None
        }
        return self._at([ridden.get(index, index) for index in self.subjects])

    def _recall(self, name: str, phrase: Phrase) -> int | None:
        """The object that "the dog" refers to, if there is one already."""
        if not self.noun_phrase.is_definite or self.noun_phrase.colour is not None:
            return None
        for index, partial in enumerate(self.partial_objects):
            if partial.noun == name and (partial.count > 1) == (phrase.meaning.form == "plural"):
                return index
        return None

    def _add_object(self, name: str, phrase: Phrase) -> int | None:
        noun_phrase = self.noun_phrase
        if len(self.partial_objects) >= MAX_OBJECTS:
            note = f"only the first {MAX_OBJECTS} things are shown"
            self.notes.extend([note] if note not in self.notes else [])
            phrase.is_used = False
            return None
        if (noun_phrase.number or 0.0) > vocabulary_objects.MAX_COUNT:
            most = f"{vocabulary_objects.MAX_COUNT}, the most of one thing"
            self.notes.append(f"a count of {noun_phrase.number:g} is shown as {most}")
        count = noun_phrase.decide_count(
            is_plural=phrase.meaning.form == "plural",
            is_all_around=self.relation in ("surround", "among"),
        )
        if count == 0:
            self.absent.append(name)
            noun_phrase.mark_used()
            self.noun_phrase = NounPhrase()
            return None
        partial = PartialObject(
            name,
            count,
            noun_phrase.decide_colour(),
            noun_phrase.scale or 1.0,
            pace=noun_phrase.pace,
            side=noun_phrase.side,
        )
        motion, self._object_motion = self._object_motion or noun_phrase.motion, None
        if motion is not None:
            partial.move(motion, self._nouns[partial.noun])
        self.partial_objects.append(partial)
        return len(self.partial_objects) - 1

    def _connect(self, index: int) -> None:
        """Make the object a subject, or the target of the relation that waits for it."""
        is_joined, self._is_joined = self._is_joined, False
        if self._relation is None:
            is_target = is_joined and (
                self._relation_builder.needs_another or not self.verb_follows
            )
            if not (is_target and self._relation_builder.extend(index, self.subjects)):
                self._become_subject(index, is_joined)
            return
        (kind, phrase), self._relation = self._relation, None
        if phrase is not None:
            phrase.is_used = bool(self.subjects) or not self._is_lost
        if kind == "from":
            return
        if self.subjects:
            self._relation_builder.relate(kind, [s for s in self.subjects if s != index], index)
        elif not self._is_lost:
            self._relation_builder.suspend(kind, index)
        if kind == "with" and self._nouns[self.partial_objects[index].noun].habitat != "fixed":
            self.subjects.append(index)

    def _become_subject(self, index: int, is_joined: bool) -> None:
        if is_joined and not self._has_acted and self.subjects:
            self.subjects = [*self.subjects, index]
        else:
            self.subjects = [index]
        self._has_acted = self.partial_objects[index].motion is not None
        self._is_lost = False
        self._relation_builder.attach(index)
