"""What the reader makes of sentences, against what a person reads in them.

Everything that a person reads (a thing, its count and attributes, what it does, a relation, place,
light, camera, what is excluded) is one of

* right: it is in the scene's description, bound to the thing it belongs to;
* substituted: the thing is shown as another, and the report says so;
* reported: the report says that it is not understood or not shown;
* silent: neither, so that the scene says something else than the sentence.

Whether a verb is known is asked of the reader itself, by a sentence of one clause: what is compared
is how the parts of a sentence are put together.
"""

from __future__ import annotations

import argparse
import functools
import json
from collections import Counter
from collections.abc import Iterator, Sequence
from dataclasses import dataclass, field
from typing import Any

from benchmarks.prompts.gold import GoldAction, GoldSentence, GoldThing, read_gold
from benchmarks.prompts.rates import Share
from benchmarks.prompts.wording import head, stem, stems
from texvent.errors import InputError
from texvent.scenes.description import SceneDescription, SceneObject
from texvent.scenes.inflection import list_finite_forms
from texvent.scenes.language.parser import parse_prompt
from texvent.scenes.models.nouns import NOUNS

STATES = ("right", "substituted", "reported", "silent")
PREPOSITIONS = {
    "next to": "beside", "near": "beside", "by": "beside", "alongside": "beside",
    "in front of": "front", "on top of": "on", "inside": "in", "into": "in", "below": "under",
    "beneath": "under", "underneath": "under", "over": "above", "to": "towards",
    "toward": "towards", "out of": "from", "away from": "away from", "after": "follow",
    "surrounded by": "surround", "amid": "among", "to the left of": "left of",
    "to the right of": "right of", "along with": "with", "onto": "on",
}  # fmt: skip
ALIKE = ({"beside", "with", "left of", "right of"}, {"in", "on"}, {"around", "surround", "among"})
"""Relations that may stand for each other."""


@dataclass
class Findings:
    """States of everything that was asked, by kind, and what is silent."""

    counts: dict[str, Counter[str]] = field(default_factory=dict)
    silent: list[dict[str, str]] = field(default_factory=list)
    objects: int = 0
    """Objects of all descriptions."""
    asked_for: int = 0
    """Of those, what a person reads too."""

    def add(self, sentence: GoldSentence, kind: str, what: str, state: str) -> None:
        """Note what became of something."""
        self.counts.setdefault(kind, Counter())[state] += 1
        if state == "silent":
            self.silent.append(
                {"id": sentence.id, "kind": kind, "what": what, "prompt": sentence.prompt}
            )


def run(options: argparse.Namespace) -> None:
    """Compare and print the table."""
    findings = compare(read_gold(options.gold))
    print(as_markdown(findings))
    if options.json is not None:
        plain = {"counts": findings.counts, "objects": findings.objects,
                 "asked_for": findings.asked_for, "silent": findings.silent}  # fmt: skip
        options.json.write_text(json.dumps(plain, indent=1) + "\n", encoding="utf-8")


def compare(sentences: Sequence[GoldSentence]) -> Findings:
    """Read every sentence and compare."""
    findings = Findings()
    for sentence in sentences:
        for kind, what, state in Reading.of(sentence).judge(findings):
            findings.add(sentence, kind, what, state)
    return findings


def as_markdown(findings: Findings) -> str:
    """A row for each kind of thing that sentences say."""
    lines = [f"| | asked | {' | '.join(STATES)} |", f"|---|---|{'---|' * len(STATES)}"]
    total: Counter[str] = Counter()
    for kind, counts in findings.counts.items():
        lines.append(_row(kind, counts))
        total += counts
    lines.append(_row("all", total))
    share = Share(findings.asked_for, findings.objects)
    lines.append(f"\nobjects of the scenes that a person reads too: {share}")
    return "\n".join(lines)


def _row(kind: str, counts: Counter[str]) -> str:
    asked = counts.total()
    cells = (f"{100 * counts[state] / asked:.0f} %" if asked else "-" for state in STATES)
    return f"| {kind} | {asked} | {' | '.join(cells)} |"


@dataclass(frozen=True)
class Reading:
    """A sentence beside what the reader made of it."""

    sentence: GoldSentence
    description: SceneDescription
    reported: set[str]
    """Stems of words that the report names as not shown or not understood."""
    swapped: set[str]
    """Stems of words that are shown as something else."""
    shown: set[str]
    """Stems of words that are shown."""
    objects_of: dict[str, list[int]]
    """Noun of a person → objects of the description."""

    @classmethod
    def of(cls, sentence: GoldSentence) -> Reading:
        """Read a sentence; one of which nothing is understood reports all its words."""
        try:
            description = parse_prompt(sentence.prompt)
        except InputError:
            words = tuple(sentence.prompt.split())
            description = SceneDescription(sentence.prompt, not_understood=words)
        report = description.report()
        quoted = [note.split("'")[1] for note in report.notes if note.count("'") >= 2]
        names = {thing.noun: canonical_nouns(thing.noun) for thing in sentence.things}
        return cls(
            sentence,
            description,
            stems((*report.not_understood, *report.not_shown, *quoted)),
            stems(one.said for one in report.substituted),
            stems(report.shown),
            {
                noun: [i for i, one in enumerate(description.objects) if one.noun in known]
                for noun, known in names.items()
            },
        )

    def judge(self, findings: Findings) -> Iterator[tuple[str, str, str]]:
        """(kind, what, state) of everything that the sentence says."""
        asked_for = {index for found in self.objects_of.values() for index in found}
        findings.objects += len(self.description.objects)
        findings.asked_for += len(asked_for)
        for thing in self.sentence.things:
            yield "things", thing.noun, self._thing(thing)
            if thing.count is not None:
                yield "counts", f"{thing.count} {thing.noun}", self._count(thing)
            for attribute in thing.attributes:
                state = self._attribute(thing, attribute)
                yield "attributes", f"{attribute} {thing.noun}", state
        for action in self.sentence.actions:
            what = " ".join(filter(None, (action.subject, action.verb, action.object)))
            yield "actions of their subject", what, self._action(action)
        yield from self._orders()
        for relation in self.sentence.relations:
            yield "relations", " ".join(relation), self._relation(*relation)
        said = self.description.surroundings
        fields = {
            "place": (self.sentence.place, (said.place or "", *said.backdrops)),
            "light and weather": (
                self.sentence.light_weather,
                (self.description.light.kind or "", said.weather or ""),
            ),
            "camera": (self.sentence.camera, tuple(self._camera_words())),
        }
        for kind, (texts, known) in fields.items():
            for text in texts:
                is_that_place = kind == "place" and said.place == place_of(text)
                yield kind, text, "right" if is_that_place else self._words(text, known)
        for noun in self.sentence.negated:
            known_nouns = canonical_nouns(noun)
            is_there = any(one.noun in known_nouns for one in self.description.objects)
            yield "excluded", noun, "silent" if is_there else "right"

    def _missing(self, *texts: str) -> str:
        """The state of what is not in the description."""
        words = stems(texts)
        if words & self.swapped:
            return "substituted"
        return "reported" if words & self.reported else "silent"

    def _thing(self, thing: GoldThing) -> str:
        if self.objects_of[thing.noun]:
            return "substituted" if head(thing.noun) in self.swapped else "right"
        if head(thing.noun) in self.shown - self.reported:
            return "right"  # a place, or part of another thing
        return self._missing(thing.noun)

    def _count(self, thing: GoldThing) -> str:
        found = [self.description.objects[index].count for index in self.objects_of[thing.noun]]
        if not found:
            return self._missing(thing.noun)
        is_number = isinstance(thing.count, int) or str(thing.count).isdigit()
        wanted = int(thing.count or 0) if is_number else None
        is_right = sum(found) > 1 if wanted is None else wanted in (*found, sum(found))
        return "right" if is_right else self._missing(str(thing.count))

    def _attribute(self, thing: GoldThing, attribute: str) -> str:
        own = [self.description.objects[index] for index in self.objects_of[thing.noun]]
        wanted = stems([attribute])
        if any(wanted & attributes_of(one) for one in own):
            return "right"
        others = (one for one in self.description.objects if one not in own)
        if any(wanted & attributes_of(one) for one in others):
            return "silent"
        if not own:
            return self._missing(attribute, thing.noun)
        if wanted & self.reported:
            return "reported"
        is_sized = any(one.scale != 1.0 for one in own)
        return "right" if wanted <= self.shown or is_sized else "silent"

    def _action(self, action: GoldAction) -> str:
        indices = self._indices(action.subject)
        kinds = action_kinds(action)
        if any(kinds & self._kinds_of(index) for index in indices):
            return "right"
        if not indices and action.subject and head(action.subject) in self.reported:
            return "reported"
        return self._missing(action.verb.split()[0])

    def _indices(self, noun: str) -> list[int]:
        if noun in self.objects_of:
            return self.objects_of[noun]
        known = canonical_nouns(noun)
        return [i for i, one in enumerate(self.description.objects) if one.noun in known]

    def _kinds_of(self, index: int) -> set[str]:
        """What an object does: kinds of its motions, of its acts, and their stems."""
        kinds = [one.kind for one in motions_of(self.description.objects[index])]
        kinds += [one.kind for one in self.description.relations if one.subject == index]
        return {stem(kind) for kind in kinds}

    def _orders(self) -> Iterator[tuple[str, str, str]]:
        """Whether what a thing does one after the other is in order."""
        for subject in dict.fromkeys(one.subject for one in self.sentence.actions):
            steps = sorted(
                (one for one in self.sentence.actions if one.subject == subject and one.order),
                key=lambda one: one.order or 0,
            )
            if len({one.order for one in steps}) < 2:
                continue
            what = f"{subject}: {', then '.join(one.verb for one in steps)}"
            done = [
                [stem(motion.kind) for motion in motions_of(self.description.objects[index])]
                for index in self._indices(subject)
            ]
            if any(_in_order(kinds, [action_kinds(one) for one in steps]) for kinds in done):
                yield "sequences", what, "right"
            else:
                yield "sequences", what, self._missing(*(one.verb for one in steps))

    def _relation(self, subject: str, preposition: str, target: str) -> str:
        kind = PREPOSITIONS.get(preposition.lower(), preposition.lower())
        kinds = {kind}.union(*(group for group in ALIKE if kind in group))
        subjects, targets = set(self._indices(subject)), set(self._indices(target))
        for relation in self.description.relations:
            ends = {relation.subject}, set(relation.targets)
            is_there = bool(ends[0] & subjects and ends[1] & targets)
            is_turned = "beside" in kinds and bool(ends[0] & targets and ends[1] & subjects)
            if relation.kind in kinds and (is_there or is_turned):
                return "right"
        if not targets and head(target) in self.shown - self.reported:
            return "right"  # a place: "on the beach"
        words = stems([preposition, subject, target])
        return "reported" if words & (self.reported | self.swapped) else "silent"

    def _words(self, text: str, known: tuple[str, ...]) -> str:
        words = stems([text])
        if words & stems(known):
            return "right"
        if words & self.reported:
            return "reported"
        return "right" if words & self.shown else self._missing(text)

    def _camera_words(self) -> Iterator[str]:
        shot = self.description.shot
        yield from filter(None, (shot.view, shot.framing))
        for move in shot.moves:
            yield from filter(None, (move.kind, move.direction))
        if not shot.is_moving:
            yield "static still fixed"


def motions_of(scene_object: SceneObject) -> list[Any]:
    """What an object does, in order."""
    first = [] if scene_object.motion is None else [scene_object.motion]
    return [*first, *scene_object.then]


def attributes_of(scene_object: SceneObject) -> set[str]:
    """Stems of the words that describe an object."""
    colour = scene_object.colour.name if scene_object.colour is not None else ""
    return stems((colour, scene_object.material or ""))


def _in_order(kinds: Sequence[str], steps: Sequence[frozenset[str]]) -> bool:
    """Whether the steps are met in the kinds, one after the other."""
    left = iter(kinds)
    return all(any(kind in step for kind in left) for step in steps)


@functools.cache
def canonical_nouns(noun: str) -> frozenset[str]:
    """Names of the models that a noun of a person may be shown by."""
    found = {name for name, one in NOUNS.items() if noun.lower() in (name, *one.synonyms)}
    try:
        description = parse_prompt(f"a {noun}")
    except InputError:
        return frozenset(found)
    if not description.not_understood:
        found |= {one.noun for one in description.objects[:1]}
    return frozenset(found)


@functools.cache
def place_of(text: str) -> str | None:
    """The place that a person's word for it stands for, as far as the reader knows it."""
    try:
        description = parse_prompt(f"a car in the {text}")
    except InputError:
        return None
    known = description.surroundings.place
    return None if stems([text]) & stems(description.not_understood) else known


@functools.cache
def action_kinds(action: GoldAction) -> frozenset[str]:
    """Stems of the kinds of motion or act that a verb stands for, as far as the reader knows it."""
    verb, *rest = action.verb.lower().split()
    kinds = {stem(verb)}
    target = f" the {action.object}" if action.object else ""
    text = " ".join([f"the {action.subject}", list_finite_forms(verb)[1], *rest]) + target
    try:
        description = parse_prompt(text)
    except InputError:
        return frozenset(kinds)
    report = description.report()
    if stem(verb) in stems((*report.not_understood, *report.not_shown)) or not description.objects:
        return frozenset(kinds)
    kinds |= {stem(motion.kind) for motion in motions_of(description.objects[0])}
    kinds |= {stem(one.kind) for one in description.relations if one.subject == 0}
    return frozenset(kinds)
