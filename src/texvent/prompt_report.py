"""Account of the words of a prompt: one report, the same in every output."""

from __future__ import annotations

from collections import Counter
from collections.abc import Iterable, Mapping
from dataclasses import dataclass, field
from typing import Any

from texvent.errors import MAX_WORD, few

REPORT_KEY = "prompt_report"
"""Name of the report in the metadata of videos and events."""
MOST_REFUSED = 30
"""Words of a kind that the error of `strict` names."""
MAX_LINE = 400
"""Characters of a line on what is not shown."""
MOST_COUNTED = 5
"""Words that a tally names."""
_LISTS = (
    "scene",
    "shown",
    "not_understood",
    "not_shown",
    "uncertain",
    "out_of_view",
    "too_small",
    "notes",
    "meant",
    "caption",
)
"""Fields of a report that are lists of words or lines."""
_OF_OBJECTS = ("out of view", "too small")
"""Kinds of fault that objects have, and no words."""


def _longest(kind: str) -> int:
    """Most characters of an entry: of a word of the prompt, or of a line on what is not shown."""
    return 2 * MAX_WORD if kind == "not understood" else MAX_LINE


@dataclass(frozen=True)
class Substitution:
    """A word that is shown as something else."""

    said: str
    """The word or words of the prompt, such as "spaniel"."""
    shown: str
    """The noun that is shown, such as "dog"."""

    def __str__(self) -> str:
        return f"{self.said} → {self.shown}"


@dataclass(frozen=True)
class PromptReport:
    """Account of a prompt: the scene that is shown, and every word.

    Example:
        >>> report = PromptReport(
        ...     scene=("1 dog, runs",),
        ...     shown=("runs",),
        ...     substituted=(Substitution("spaniel", "dog"),),
        ...     not_understood=("red wug",),
        ... )
        >>> report.lines()
        ['1 dog, runs', 'shown as something else: spaniel → dog', 'not understood: red wug']
        >>> PromptReport.from_json(report.to_json()) == report
        True
    """

    scene: tuple[str, ...] = ()
    """The scene, line by line, for a person to check."""
    shown: tuple[str, ...] = ()
    """Words that the scene shows, in order, each once."""
    substituted: tuple[Substitution, ...] = ()
    """Words that are shown as something else."""
    not_understood: tuple[str, ...] = ()
    """Words that had no effect on the scene, in order; those that stand together are one entry,
    such as "orange gizmo in the background"."""
    not_shown: tuple[str, ...] = ()
    """Parts that cannot be shown, such as "the man's jump after 5 s (the clip ends at 2 s)"."""
    uncertain: tuple[str, ...] = ()
    """Words that are drawn, but perhaps not as meant: words beside them are not understood."""
    out_of_view: tuple[str, ...] = ()
    """Objects that the camera never shows, such as "tree" or "dog (2 of 3)"."""
    too_small: tuple[str, ...] = ()
    """Objects that are a few pixels large at most, such as "bird (2 pixels)"."""
    notes: tuple[str, ...] = ()
    """Decisions where the prompt leaves a choice open, as sentences."""
    meant: tuple[str, ...] = ()
    """Words that are not understood and spelt nearly as a noun, such as "fokrlift: forklift"."""
    caption: tuple[str, ...] = ()
    """The clip as it is drawn, measured on its scene and not read from the prompt: its place, each
    object and the camera, a line each. Shares of the picture are the greatest over the clip."""

    @property
    def is_faithful(self) -> bool:
        """Whether every word is understood and every object in view: what `strict` asks for."""
        return not self.faults()

    def faults(self, most: int | None = None) -> list[str]:
        """Deviations from the prompt: a line for each kind, with so many words; None: all."""
        return [
            f"{kind}: {few(words, len(words) if most is None else most, _longest(kind))}"
            for kind, words in self.kinds().items()
            if words
        ]

    def kinds(self) -> dict[str, list[str]]:
        """Kind of fault → its words or objects."""
        near = dict(one.split(": ", 1) for one in self.meant)
        meant = {phrase: [near[one] for one in phrase.split() if one in near]
                 for phrase in self.not_understood}  # fmt: skip
        lost = [
            f"{phrase} (did you mean {' and '.join(map(repr, words))}?)" if words else phrase
            for phrase, words in meant.items()
        ]
        return {
            "shown as something else": [str(one) for one in self.substituted],
            "not understood": lost,
            "not shown": list(self.not_shown),
            "out of view": list(self.out_of_view),
            "too small": list(self.too_small),
            "uncertain beside them": list(self.uncertain),
        }

    def warnings(self, of: str = "prompt words ") -> list[str]:
        """The faults as sentences by themselves; `of` begins those of words."""
        return [f"{'' if line.startswith(_OF_OBJECTS) else of}{line}" for line in self.faults()]

    def lines(self) -> list[str]:
        """The whole report but for the words that are shown, a line each."""
        drawn = (f"drawn: {line}" for line in self.caption)
        return [*self.scene, *self.notes, *self.faults(), *drawn]

    def refusal(self) -> str | None:
        """Reason for which `strict` refuses the prompt; None where there is none."""
        if self.is_faithful:
            return None
        return (
            f"strict: the prompt is not shown as it says: {'; '.join(self.faults(MOST_REFUSED))}; "
            "say it in words that `texvent scenes` lists, or leave strict out"
        )

    def to_json(self) -> dict[str, Any]:
        """Plain values; lists without entries are left out."""
        plain = {
            "substituted": [{"said": one.said, "shown": one.shown} for one in self.substituted],
            **{name: list(getattr(self, name)) for name in _LISTS},
        }
        return {name: words for name, words in plain.items() if words}

    @classmethod
    def from_json(cls, facts: Mapping[str, Any]) -> PromptReport:
        """The report that `to_json` wrote.

        Raises:
            ValueError: it is something else.
        """
        pairs = facts.get("substituted", ())
        words = [word for name in _LISTS for word in facts.get(name, ())]
        if not all(
            isinstance(word, str) for word in [*words, *(v for p in pairs for v in p.values())]
        ):
            raise ValueError("a report holds lists of words")
        return cls(
            substituted=tuple(Substitution(one["said"], one["shown"]) for one in pairs),
            **{name: tuple(facts.get(name, ())) for name in _LISTS},
        )

    @classmethod
    def of_metadata(cls, metadata: Mapping[str, Any]) -> PromptReport | None:
        """The report in the metadata of a video; None where its generator gives none."""
        return cls.from_json(metadata[REPORT_KEY]) if REPORT_KEY in metadata else None


@dataclass
class ReportTally:
    """Counts over the reports of many prompts."""

    prompts: int = 0
    """Prompts with a report, and those that were refused."""
    faithful: int = 0
    refused: int = 0
    """Prompts that gave no scene: nothing of them is understood, or `strict` refuses them."""
    kinds: Counter[str] = field(default_factory=Counter)
    """Kind of fault → prompts that have it."""
    words: dict[str, Counter[str]] = field(default_factory=dict)
    """Kind of fault → word → prompts."""

    def add(self, report: PromptReport | None) -> None:
        """Count a prompt; None: it was refused."""
        self.prompts += 1
        if report is None:
            self.refused += 1
            return
        self.faithful += report.is_faithful
        for kind, words in report.kinds().items():
            self._count(kind, (word.partition(" (")[0] for word in words))

    def _count(self, kind: str, words: Iterable[str]) -> None:
        found = set(words)
        if found:
            self.kinds[kind] += 1
            self.words.setdefault(kind, Counter()).update(found)

    @property
    def tables(self) -> dict[str, Any]:
        """Plain values, ready for JSON."""
        return {
            "prompts": self.prompts,
            "shown_as_said": self.faithful,
            "refused": self.refused,
            **{kind.replace(" ", "_"): count for kind, count in self.kinds.items()},
            "words": {
                kind.replace(" ", "_"): dict(ranked(words)) for kind, words in self.words.items()
            },
        }

    def line(self, noun: str = "prompts", verb: str = "shown as they say") -> str:
        """The counts in a line.

        Args:
            noun: what is counted.
            verb: what is true of the faithful ones; of prompts that are only read, without their
                scenes, "understood word for word".

        Example:
            >>> tally = ReportTally()
            >>> tally.add(PromptReport(not_understood=("wug", "dax")))
            >>> tally.add(PromptReport())
            >>> tally.line()
            '1 of 2 prompts shown as they say; 1 with words not understood (dax, wug)'
        """
        parts = [f"{self.faithful:,} of {self.prompts:,} {noun} {verb}"]
        for kind, count in self.kinds.items():
            noun = "objects" if kind in _OF_OBJECTS else "words"
            words = [f"{one} ({n:,})" if n > 1 else one for one, n in ranked(self.words[kind])]
            parts.append(f"{count:,} with {noun} {kind} ({few(words, MOST_COUNTED)})")
        if self.refused:
            parts.append(f"{self.refused:,} refused")
        return "; ".join(parts)


def ranked(counts: Mapping[str, int]) -> list[tuple[str, int]]:
    """Words with their counts, the most frequent first."""
    return sorted(counts.items(), key=lambda pair: (-pair[1], pair[0]))
