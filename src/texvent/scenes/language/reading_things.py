"""Reads what a prompt says about things: how many, what colour, what they do, and where."""

from __future__ import annotations

from collections.abc import Mapping

from texvent.scenes.description import Motion, Paint, Relation
from texvent.scenes.language import lexicon, lexicon_scene
from texvent.scenes.language.drafts import Draft, NounGroup, list_able
from texvent.scenes.language.lexicon_motion import SPIN_RATE_HZ, Verb
from texvent.scenes.language.linking import Links
from texvent.scenes.language.tagging import Phrase, Role
from texvent.scenes.model import Noun

MAX_THINGS = 16
"""Most different things; later ones are left out, and said."""

_DEFINITE = ("the", "this", "that", "these", "those", "its", "their", "his", "her")
_CARRIED = ("drive", "fly", "sail")
_HANDLED = ("spin", "bounce", "fall", "roll", "throw", "swing", "sway", "slide")


class ThingReader:
    """Collects things, their motions and relations, sentence by sentence."""

    def __init__(self, nouns: Mapping[str, Noun]) -> None:
        self.drafts: list[Draft] = []
        self.absent: list[str] = []
        self.notes: list[str] = []
        self.group = NounGroup()
        self.subjects: list[int] = []
        """Things that the next verb is about."""
        self.mentioned: list[int] = []
        """Things named last."""
        self.verb_follows = False
        """Whether the noun being read has a verb of its own right after it."""
        self.negation: Phrase | None = None
        self._nouns = nouns
        self._relation: tuple[str, Phrase | None] | None = None
        self._links = Links()
        self._is_joined = False
        self._has_acted = False
        self._is_lost = False
        self._object_motion: Motion | None = None

    @property
    def relations(self) -> list[Relation]:
        """All relations so far."""
        return self._links.relations

    def open_group(self, phrase: Phrase) -> None:
        """A determiner starts a new noun group."""
        self.settle()
        if self.negation is not None and self.negation.is_used:
            self.negation = None
        self.group = NounGroup(
            is_definite=phrase.text in _DEFINITE, motion=self.group.motion, side=self.group.side,
            phrases=self.group.phrases if self.group.motion or self.group.side else [],
        )  # fmt: skip
        if phrase.text in ("a", "an", "another", "each", "every"):
            self.group.count = 1

    def read_adjective(self, phrase: Phrase) -> None:
        """A count, number, colour, shade or size."""
        group, value = self.group, phrase.meaning.value
        if phrase.role is Role.COUNT:
            group.count = value
        elif phrase.role is Role.NUMBER:
            group.number = value
        elif phrase.role is Role.SHADE:
            group.shade = phrase.text
        elif phrase.role is Role.SIZE:
            group.scale = value
        elif phrase.role is Role.COLOUR:
            rgb, name = lexicon.COLOURS[phrase.text], phrase.text
            if group.shade is not None:
                rgb, name = lexicon.shade_colour(rgb, group.shade), f"{group.shade} {name}"
                group.shade = None
            group.paint = Paint(name, rgb)
        group.phrases.append(phrase)

    def take_number(self) -> tuple[float, Phrase] | None:
        """The number just read, when a unit after it shows that it is no count."""
        return self.group.take_number()

    def take_paint(self) -> tuple[Paint | None, list[Phrase]]:
        """The colour waiting for a noun, when a place or the sky comes instead."""
        paint, phrases = self.group.paint, self.group.phrases
        self.group = NounGroup()
        return paint, [p for p in phrases if p.role in (Role.COLOUR, Role.SHADE)]

    def read_noun(self, phrase: Phrase) -> int | None:
        """A noun closes its group; its thing's index, or None if it shows nothing new."""
        name: str = phrase.meaning.value
        phrase.is_used = True
        if self.negation is not None:
            self.negation.is_used = True
            self.group.mark_used()
            self.group = NounGroup()
            if name not in self.absent:
                self.absent.append(name)
            return None
        index = self._recall(name, phrase)
        if index is None:
            index = self._add_draft(name, phrase)
        if index is None:
            return None
        self.group.mark_used()
        self.group = NounGroup()
        self._connect(index)
        self.mentioned = [index]
        return index

    def settle(self) -> None:
        """Give adjectives that met no noun to the subject: "the car is red"."""
        group = self.group
        if not self.subjects or not group.phrases:
            return
        for index in self.subjects:
            draft = self.drafts[index]
            if group.paint is not None and draft.paint is None:
                draft.paint = group.paint
                group.mark_roles(Role.COLOUR, Role.SHADE)
            if group.scale is not None and draft.scale == 1.0:
                draft.scale = group.scale
                group.mark_roles(Role.SIZE)
            if group.pace != 1.0:
                draft.pace *= group.pace
                group.mark_roles(Role.PACE)
        self.group = NounGroup()

    def read_attribute(self, phrase: Phrase) -> None:
        """A participle before its noun: "a running dog"."""
        verb: Verb = phrase.meaning.value
        self.group.motion = Motion(verb.kind, verb.direction, verb.pace)
        self.group.phrases.append(phrase)

    def read_verb(self, phrase: Phrase, has_object: bool) -> None:
        """A verb about the subjects; with an object, some verbs are about the object."""
        self.settle()
        verb: Verb = phrase.meaning.value
        motion = Motion(verb.kind, verb.direction, verb.pace * self.group.pace)
        if self.negation is not None:
            motion = Motion("stand")
            self.negation.is_used, self.negation = True, None
        if not self.subjects:
            if not self._is_lost:
                self.group.motion = motion
                self.group.phrases.append(phrase)
            return
        phrase.is_used = True
        if phrase.meaning.form == "participle" and self._act_on_mentioned(motion):
            return
        self._has_acted = True
        self._relation = (verb.relation, None) if verb.relation else None
        if has_object and verb.kind in _HANDLED:
            self._object_motion, motion = motion, Motion("stand")
        elif has_object and verb.kind in _CARRIED and verb.relation is None:
            self._relation = ("on", None)
            self._object_motion = Motion("move", motion.direction, motion.pace)
            motion = Motion("sit")
        for draft in list_able(
            [self.drafts[index] for index in self.subjects], motion, self._nouns
        ):
            self._set_motion(draft, motion)

    def _act_on_mentioned(self, motion: Motion) -> bool:
        """A participle after a related thing is about that: "a boat with dolphins jumping"."""
        if not self._links.is_last_target(self.mentioned):
            return False
        drafts = [self.drafts[index] for index in self.mentioned]
        if any(d.motion is not None or self._nouns[d.noun].habitat == "fixed" for d in drafts):
            return False
        for draft in drafts:
            self._set_motion(draft, motion)
        return True

    def read_still(self, phrase: Phrase) -> None:
        """The words still, motionless: before a noun or about the subject."""
        if self.subjects:
            for index in self.subjects:
                self.drafts[index].motion = Motion("stand")
            phrase.is_used = True
        else:
            self.group.motion = Motion("stand")
            self.group.phrases.append(phrase)

    def read_direction(self, phrase: Phrase) -> None:
        """Which way the subjects go; without a verb they move that way.

        "Across" is the weakest: it keeps a direction that is already said.
        """
        direction = phrase.meaning.value
        for index in self._movers():
            draft = self.drafts[index]
            motion = draft.motion or Motion("move")
            if motion.kind == "stand":
                continue
            if direction == "across" and motion.direction is not None:
                phrase.is_used = True
                continue
            draft.motion = Motion(motion.kind, direction, motion.pace, motion.speed_m_s)
            phrase.is_used = True

    def read_pace(self, phrase: Phrase, noun_follows: bool) -> None:
        """How fast: an adverb about the verb before or after, or an adjective."""
        has_motion = any(self.drafts[index].motion for index in self._movers())
        if has_motion and not noun_follows:
            for index in self._movers():
                self.drafts[index].pace *= phrase.meaning.value
            phrase.is_used = True
        else:
            self.group.pace *= phrase.meaning.value
            self.group.phrases.append(phrase)

    def read_speed(self, speed_m_s: float, phrases: list[Phrase]) -> None:
        """A speed in numbers, m/s."""
        for index in self._movers():
            draft = self.drafts[index]
            motion = draft.motion or Motion("move")
            if motion.kind != "stand":
                draft.motion = Motion(motion.kind, motion.direction, 1.0, speed_m_s)
                draft.pace = 1.0
                for phrase in phrases:
                    phrase.is_used = True

    def read_rate(self, rate_hz: float, phrases: list[Phrase]) -> bool:
        """Turns per second of what spins; False if nothing spins."""
        spinning = [
            draft
            for draft in (self.drafts[index] for index in self.subjects)
            if draft.motion is not None and draft.motion.kind == "spin"
        ]
        for draft in spinning:
            draft.motion = Motion("spin", pace=rate_hz / SPIN_RATE_HZ)
        if spinning:
            for phrase in phrases:
                phrase.is_used = True
        return bool(spinning)

    def read_relation(self, phrase: Phrase) -> None:
        """A preposition waits for its noun."""
        self.settle()
        self._relation = (phrase.meaning.value, phrase)
        self.group = NounGroup(motion=self.group.motion, phrases=self.group.phrases)

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
        """Where in the picture the thing before, or else the thing after, is."""
        if self.mentioned:
            for index in self.mentioned:
                self.drafts[index].side = phrase.meaning.value
            phrase.is_used = True
        else:
            self.group.side = phrase.meaning.value
            self.group.phrases.append(phrase)

    def read_part(self, phrase: Phrase) -> None:
        """A part that the model shows anyway, if the colour said of it is the one it has."""
        for index in self.mentioned:
            noun = self._nouns[self.drafts[index].noun]
            natural = lexicon_scene.PARTS.get((noun.name, phrase.text))
            is_shown = noun.motion == "drive" and phrase.text in lexicon_scene.VEHICLE_PARTS
            if natural is None and not is_shown:
                continue
            phrase.is_used = True
            if self.group.paint is None or self.group.paint.name == natural:
                self.group.mark_used()
        self.drop_relation(is_used=phrase.is_used)
        self.group = NounGroup()

    def close_subjects(self) -> None:
        """Place or light was said: the next noun starts a list of subjects of its own."""
        self._has_acted = True

    def join(self) -> None:
        """The word and: the next noun joins the last one."""
        self._is_joined = True

    def end_clause(self, sign: str) -> None:
        """A comma or full stop."""
        self.settle()
        self._relation = None
        self._links.close()
        self._is_joined = sign == ","
        self._is_lost &= sign == ","
        if sign != ",":
            self.negation = None

    def refer(self, phrase: Phrase) -> None:
        """A pronoun: "which" and "who" mean the thing named last, "it" the last subject."""
        if phrase.text in ("which", "who") and self.mentioned:
            self.subjects = list(self.mentioned)
        else:
            self.mentioned = list(self.subjects)

    def meet_unknown(self) -> None:
        """A word that may be an unknown noun: what follows is not about the last subject."""
        if self._relation is not None:
            self._relation = None
        else:
            self.subjects, self.mentioned = [], []
            self._is_lost = True
        self.group = NounGroup()

    def _movers(self) -> list[int]:
        """The subjects, or what they ride: "a man rides a horse to the left"."""
        ridden = {
            relation.subject: relation.targets[0]
            for relation in self._links.relations
            if relation.kind == "on" and self.drafts[relation.targets[0]].motion is not None
        }
        return [ridden.get(index, index) for index in self.subjects]

    def _recall(self, name: str, phrase: Phrase) -> int | None:
        """The thing that "the dog" refers to, if there is one already."""
        if not self.group.is_definite or self.group.paint is not None:
            return None
        for index, draft in enumerate(self.drafts):
            if draft.noun == name and (draft.count > 1) == (phrase.meaning.form == "plural"):
                return index
        return None

    def _add_draft(self, name: str, phrase: Phrase) -> int | None:
        group = self.group
        if len(self.drafts) >= MAX_THINGS:
            note = f"only the first {MAX_THINGS} things are shown"
            self.notes.extend([note] if note not in self.notes else [])
            phrase.is_used = False
            return None
        if group.number is not None and group.number > lexicon.MAX_COUNT:
            most = f"{lexicon.MAX_COUNT}, the most of one thing"
            self.notes.append(f"a count of {group.number:g} is shown as {most}")
        count = group.decide_count(
            is_plural=phrase.meaning.form == "plural",
            is_all_around=self.relation in ("surround", "among"),
        )
        if count == 0:
            self.absent.append(name)
            group.mark_used()
            self.group = NounGroup()
            return None
        draft = Draft(
            name, count, group.decide_paint(), group.scale or 1.0, None, group.pace, group.side
        )
        motion = group.motion
        if self._object_motion is not None:
            motion, self._object_motion = self._object_motion, None
        if motion is not None:
            self._set_motion(draft, motion)
        self.drafts.append(draft)
        return len(self.drafts) - 1

    def _set_motion(self, draft: Draft, motion: Motion) -> None:
        noun = self._nouns[draft.noun]
        if (kind := motion.kind) == "move":
            kind = noun.motion if noun.motion != "stand" else "slide"
        old, direction = draft.motion, motion.direction
        if direction is None and old is not None and old.is_moving:
            direction = old.direction
        draft.motion = Motion(kind, direction, motion.pace)

    def _connect(self, index: int) -> None:
        """Make the thing a subject, or the target of the relation that waits for it."""
        is_joined, self._is_joined = self._is_joined, False
        if self._relation is None:
            is_target = is_joined and (self._links.needs_another or not self.verb_follows)
            if not (is_target and self._links.extend(index, self.subjects)):
                self._become_subject(index, is_joined)
            return
        (kind, phrase), self._relation = self._relation, None
        if phrase is not None:
            phrase.is_used = bool(self.subjects) or not self._is_lost
        if kind == "from":
            return
        if self.subjects:
            self._links.relate(kind, [s for s in self.subjects if s != index], index)
        elif not self._is_lost:
            self._links.suspend(kind, index)
        if kind == "with" and self._nouns[self.drafts[index].noun].habitat != "fixed":
            self.subjects.append(index)

    def _become_subject(self, index: int, is_joined: bool) -> None:
        if is_joined and not self._has_acted and self.subjects:
            self.subjects = [*self.subjects, index]
        else:
            self.subjects = [index]
        self._has_acted = self.drafts[index].motion is not None
        self._is_lost = False
        self._links.attach(index)
