"""One annotated sentence, beside what the reader made of it."""

from __future__ import annotations

import re
from collections.abc import Iterator, Sequence
from dataclasses import dataclass

from benchmarks.prompts.gold import GoldAction, GoldSentence, GoldThing
from benchmarks.prompts.known import action_kinds, canonical_nouns, motions_of, place_of
from benchmarks.prompts.wording import head, said_stems, share, stem, stems, words_of
from texvent.errors import InputError
from texvent.scenes.description import SceneDescription, SceneObject
from texvent.scenes.language.parser import parse_prompt

PREPOSITIONS = {
    "next to": "beside", "near": "beside", "by": "beside", "alongside": "beside",
    "in front of": "front", "on top of": "on", "inside": "in", "into": "in", "below": "under",
    "beneath": "under", "underneath": "under", "over": "above", "to": "towards",
    "toward": "towards", "out of": "from", "away from": "away from", "after": "follow",
    "surrounded by": "surround", "amid": "among", "to the left of": "left of",
    "to the right of": "right of", "along with": "with", "onto": "on", "at": "beside",
}  # fmt: skip
ALIKE = (
    {"beside", "with", "left of", "right of"}, {"in", "on"}, {"around", "surround", "among"},
    {"with", "hold", "carry"}, {"with", "wear"}, {"in", "wear"}, {"on", "ride"}, {"in", "ride"},
    {"across", "on"}, {"at", "beside"}, {"at", "around"},
)  # fmt: skip
"""Relations that may stand for each other."""
_TRAVELS = frozenset({"travel", "dolly", "truck", "pedestal", "follow"})
"""Moves in which the camera leaves its place."""
EGO_MOTION = "ego-motion"
"""What annotations call a camera that travels, whatever the sentence calls it."""
_PAIRS = frozenset({"hand", "arm", "leg", "foot", "eye", "ear", "wing", "headlight"})
"""Parts of which a whole has two."""

_BY_HAND = frozenset({"hold", "carry", "push", "pull", "work on"})


@dataclass(frozen=True)
class Reading:
    """A sentence beside what the reader made of it."""

    sentence: GoldSentence
    description: SceneDescription
    said: set[str]
    """Stems of the words of the sentence."""
    lost: set[str]
    """Words that the report names as not shown or not understood."""
    reported: set[str]
    """Their stems."""
    swapped: set[str]
    """Stems of words that are shown as something else."""
    shown: set[str]
    """Stems of words that are shown."""
    is_refused: bool = False
    """Whether there is an error instead of a scene."""

    @classmethod
    def of(cls, sentence: GoldSentence) -> Reading:
        """Read a sentence."""
        is_refused = False
        try:
            description = parse_prompt(sentence.prompt)
        except InputError:
            description, is_refused = SceneDescription(sentence.prompt), True
        report = description.report()
        lost = [*report.not_understood, *report.not_shown]
        for note in report.notes:
            lost += re.findall(r"'(.+)'", note)
            lost += re.findall(r"does not touch .*\((.+)\)", note)
        swapped = stems(one.said for one in report.substituted)
        text = " ".join(lost)
        return cls(
            sentence, description, said_stems(sentence.prompt), set(words_of(text)),
            said_stems(text), swapped, stems(report.shown), is_refused,
        )  # fmt: skip

    def list_asked_for(self) -> set[int]:
        """Objects of the description that a person reads too."""
        return {i for thing in self.sentence.things for i in self._indices(thing.noun)}

    def judge(self) -> Iterator[tuple[str, str, str]]:
        """(kind, what, state) of everything that the sentence says."""
        for kind, what, state in self._judge_all():
            yield kind, what, "reported" if self.is_refused and kind != "excluded" else state

    def _judge_all(self) -> Iterator[tuple[str, str, str]]:
        for thing in self.sentence.things:
            if self._is_implied(thing):
                continue
            yield "things", thing.noun, self._thing(thing.noun)
            if thing.count is not None:
                yield "counts", f"{thing.count} {thing.noun}", self._count(thing)
            for attribute in filter(self._says, thing.attributes):
                state = self._attribute(thing, attribute)
                yield "attributes", f"{attribute} {thing.noun}", state
        for action in filter(self._asks, self.sentence.actions):
            what = " ".join(filter(None, (action.subject, action.verb, action.object)))
            yield "actions of their subject", what, self._action(action)
        yield from self._orders()
        implied = {one.noun for one in self.sentence.things if self._is_implied(one)}
        for relation in self.sentence.relations:
            if not implied & {relation[0], relation[2]}:
                yield "relations", " ".join(relation), self._relation(*relation)
        yield from self._judge_setting()

    def _judge_setting(self) -> Iterator[tuple[str, str, str]]:
        said = self.description.surroundings
        light = (self.description.light.kind or "", said.weather or "")
        camera = tuple(self._camera_words())
        for text in filter(self._says, self.sentence.place):
            is_that_place = said.place == place_of(text)
            known = (said.place or "", *said.backdrops)
            yield "place", text, "right" if is_that_place else self._words(text, known)
        for text in self.sentence.camera:
            if self._says(text) or text == EGO_MOTION:
                yield "camera", text, self._words(text, camera)
        for text in filter(self._says, self.sentence.light_weather):
            yield "light and weather", text, self._words(text, light)
        for noun in self.sentence.negated:
            known_nouns = canonical_nouns(noun)
            is_there = any(one.noun in known_nouns for one in self.description.objects)
            yield "excluded", noun, "silent" if is_there else "right"

    def _says(self, text: str) -> bool:
        """Whether a word of a person's text is in the sentence."""
        return self.is_refused or bool(stems([text]) & self.said)

    def _is_implied(self, thing: GoldThing) -> bool:
        """A person adds it: the sentence does not name it."""
        return not self.is_refused and (
            thing.is_implied or not share({head(thing.noun)}, self.said)
        )

    def _asks(self, action: GoldAction) -> bool:
        """Whether the sentence has the verb; as a noun, as in "sign: go", it is none."""
        return not action.is_implied and self._says(action.verb.split()[0])

    def _missing(self, *texts: str) -> str:
        """The state of what is not in the description."""
        words = stems(texts)
        if words & self.swapped:
            return "substituted"
        return "reported" if share(words, self.reported) else "silent"

    def _is_scenery(self, noun: str) -> bool:
        """Whether it is shown, but not as an object: a place, weather, an effect, a part."""
        return not self._indices(noun) and head(noun) in self.shown - self.reported

    def _thing(self, noun: str) -> str:
        if self._indices(noun):
            return "substituted" if head(noun) in self.swapped else "right"
        return "right" if self._is_scenery(noun) else self._missing(noun)

    def _count(self, thing: GoldThing) -> str:
        found = [self.description.objects[index].count for index in self._indices(thing.noun)]
        is_number = isinstance(thing.count, int) or str(thing.count).isdigit()
        wanted = int(thing.count or 0) if is_number else None
        is_pair = wanted == 2 and head(thing.noun) in _PAIRS
        if is_pair and not self._modelled(thing.noun) and self._thing(thing.noun) == "right":
            return "right"
        if not found:
            is_right = self._is_scenery(thing.noun) and wanted in (None, 1)
        elif wanted is None or self._is_group(thing.noun):
            is_right = sum(found) > 1 or thing.count == "mass"
        else:
            is_right = wanted in (*found, sum(found))
        if is_right or not found:
            return "right" if is_right else self._missing(thing.noun)
        words = stems([thing.noun, str(thing.count), *_NUMBERS[wanted or 0 :][:1]])
        return "reported" if share(words, self.reported) else "silent"

    @staticmethod
    def _is_group(noun: str) -> bool:
        """As in "flock of birds", not "blade of grass"."""
        return " of " in noun and noun.endswith("s") and not noun.endswith("ss")

    def _attribute(self, thing: GoldThing, attribute: str) -> str:
        indices = self._indices(thing.noun)
        own = [self.description.objects[index] for index in indices]
        wanted = stems([attribute])
        if any(wanted & attributes_of(one) for one in own):
            return "right"
        others = (one for one in self.description.objects if one not in own)
        if any(wanted & attributes_of(one) for one in others):
            return "silent"
        if not own:
            is_shown = self._is_scenery(thing.noun) and wanted <= self.shown
            return "right" if is_shown else self._missing(attribute, thing.noun)
        if wanted & self.reported:
            return "reported"
        return "right" if wanted <= self.shown else self._missing(attribute)

    def _action(self, action: GoldAction) -> str:
        indices = self._indices(action.subject)
        verb = action.verb.split()[0]
        kinds = action_kinds(action)
        if any(kinds & self._kinds_of(index) for index in indices):
            return "substituted" if stem(verb) in self.swapped else "right"
        if action.subject == "camera":
            is_move = share(stems([verb]), stems(self._camera_words()))
            return "right" if is_move else self._missing(verb)
        if self._is_scenery(action.subject) and stem(verb) in self.shown - self.reported:
            return "right"
        if not indices and share(stems([action.subject]), self.reported):
            return "reported"
        return self._missing(verb)

    def _indices(self, noun: str) -> list[int]:
        """Objects that a noun of a person stands for: of its model, or named by its last word."""
        found = self._modelled(noun)
        for claim in self.description.claims:
            if claim.aspect == "name" and head(claim.word) == head(noun):
                found += claim.things
        return list(dict.fromkeys(found))

    def _modelled(self, noun: str) -> list[int]:
        """Objects of the models that may show the noun."""
        known = canonical_nouns(noun)
        return [i for i, one in enumerate(self.description.objects) if one.noun in known]

    def _kinds_of(self, index: int) -> set[str]:
        """What an object does: kinds of its motions and acts, and of what it is on, as stems."""
        kinds = self._own_kinds(index)
        for relation in self.description.relations:
            if relation.subject == index:
                kinds.add(stem(relation.kind))
                if relation.kind in ("ride", "on"):
                    kinds |= {kind for i in relation.targets for kind in self._own_kinds(i)}
        return kinds

    def _own_kinds(self, index: int) -> set[str]:
        steps = range(len(motions_of(self.description.objects[index])))
        return set[str]().union(*(self._step_kinds(index, step) for step in steps))

    def _step_kinds(self, index: int, step: int) -> set[str]:
        """Kind of one motion, and the words that the reader links to it.

        What a machine does is in its name: a swing swings, a spinning disc spins.
        """
        one = self.description.objects[index]
        motion = motions_of(one)[step]
        kinds = {stem(motion.kind)}
        for claim in self.description.claims:
            if claim.aspect == "motion" and index in claim.things and claim.motion == step:
                kinds |= stems([claim.word])
        return kinds | (stems([one.noun]) if motion.kind == "work" else set())

    def _orders(self) -> Iterator[tuple[str, str, str]]:
        """Whether what a thing does one after the other is in order."""
        actions = [one for one in self.sentence.actions if self._asks(one)]
        for subject in dict.fromkeys(one.subject for one in actions):
            steps = sorted(
                (one for one in actions if one.subject == subject and one.order),
                key=lambda one: one.order or 0,
            )
            if len({one.order for one in steps}) < 2:
                continue
            what = f"{subject}: {', then '.join(one.verb for one in steps)}"
            done = [
                [self._step_kinds(index, step) for step in range(len(motions_of(one)))]
                for index in self._indices(subject)
                for one in (self.description.objects[index],)
            ]
            if any(_in_order(kinds, [action_kinds(one) for one in steps]) for kinds in done):
                yield "sequences", what, "right"
            else:
                yield "sequences", what, self._missing(*(one.verb for one in steps))

    def _relation(self, subject: str, preposition: str, target: str) -> str:
        kind = PREPOSITIONS.get(preposition.lower(), preposition.lower())
        kinds = {kind}.union(*(group for group in ALIKE if kind in group))
        if preposition in ("into", "against"):
            kinds.add("collide")
        subjects, targets = set(self._indices(subject)), set(self._indices(target))
        for relation in self.description.relations:
            ends = {relation.subject}, set(relation.targets)
            is_there = bool(ends[0] & subjects and ends[1] & targets)
            is_turned = bool(ends[0] & targets and ends[1] & subjects)
            is_turned = is_turned and "beside" in kinds and relation.kind in ALIKE[0]
            is_owned = bool(ends[0] & targets and ends[1] & subjects)
            if preposition in ("of", "on") and relation.kind in ("wear", "with") and is_owned:
                return "right"  # "a tourist's backpack", which the tourist wears
            if relation.kind in kinds and (is_there or is_turned):
                return "right"
        is_lost = set(preposition.lower().split()) & self.lost
        if not is_lost and self._is_scenery(target):
            return "right"  # a place: "on the beach"
        if not is_lost and subject == "camera" and (targets or self._is_scenery(target)):
            return "right" if self.description.shot.is_moving else "silent"
        if not is_lost and preposition == "of" and self._is_scenery(subject) and targets:
            return "right"  # a part: "the headlights of a lorry"
        is_handled = any(
            one.kind in _BY_HAND and targets & set(one.targets)
            for one in self.description.relations
        )
        if head(subject) in _PAIRS and is_handled:
            return "right"  # a hand on what is held
        words = stems([preposition, subject, target])
        if is_lost or share(words, self.reported | self.swapped):
            return "reported"
        is_said = set(words_of(preposition)) <= set(words_of(self.sentence.prompt))
        return "reported" if not is_said and self._loses_between(subject, target) else "silent"

    def _loses_between(self, subject: str, target: str) -> bool:
        """Whether the report names a word between two nouns: a basket "loaded with" sunflowers."""
        words = words_of(self.sentence.prompt)
        places = [
            [at for at, word in enumerate(words) if stem(word) == head(noun)]
            for noun in (subject, target)
        ]
        named = self.reported | self.swapped
        spans = (words[min(a, b) + 1 : max(a, b)] for a in places[0] for b in places[1])
        return any(stems(span) & named for span in spans)

    def _words(self, text: str, known: tuple[str, ...]) -> str:
        words = stems([text])
        if words & stems(known):
            return "right"
        if share(words, self.reported):
            return "reported"
        return "right" if words & self.shown else self._missing(text)

    def _camera_words(self) -> Iterator[str]:
        shot = self.description.shot
        yield from filter(None, (shot.view, shot.framing))
        for move in shot.moves:
            yield from filter(None, (move.kind, move.direction, move.means))
            if move.kind in _TRAVELS:
                yield EGO_MOTION
        for claim in self.description.claims:
            if claim.move is not None:
                yield claim.word
        if not shot.is_moving:
            yield "static still fixed"


_NUMBERS = ("", "one", "two", "three", "four", "five", "six", "seven", "eight", "nine", "ten")


def attributes_of(scene_object: SceneObject) -> set[str]:
    """Stems of the words that describe an object."""
    colour = scene_object.colour.name if scene_object.colour is not None else ""
    return stems((colour, scene_object.material or ""))


def _in_order(kinds: Sequence[set[str]], steps: Sequence[frozenset[str]]) -> bool:
    """Whether the steps are met in the kinds, one after the other."""
    left = iter(kinds)
    return all(any(kind & step for kind in left) for step in steps)
