"""What was chosen, captioned and found doubtful, for programs and for people."""

from __future__ import annotations

import statistics
from collections.abc import Mapping, Sequence
from dataclasses import dataclass, field
from typing import Any

from texvent.extending import full_version
from texvent_lab.nt_imagenet.captions import (
    CHECKS,
    FEWEST_WORDS,
    MOST_WORDS,
    CaptionCheck,
    find_duplicates,
)
from texvent_lab.nt_imagenet.selection import Selection

MOST_LISTED = 20
LONGEST_US = 55_000
"""N-ImageNet's streams are at most this long."""
TERMS = (
    "This folder holds ids, captions, counts and our own specification. ImageNet's images may not "
    "be redistributed, and N-ImageNet's events are AGPL-3.0: neither is here. The terms of the "
    "model that made the captions apply to them (LLaVA-1.5: Llama 2's)."
)


@dataclass(frozen=True, kw_only=True)
class Report:
    """All of it."""

    selection: Selection
    per_class: int
    captions: Mapping[str, str]
    """Id → caption, those that were left out included."""
    checks: Mapping[str, CaptionCheck]
    failures: Mapping[str, str] = field(default_factory=dict)
    """Id → why it has no caption."""
    left_out: Sequence[str] = ()
    """Ids whose caption failed a check that leaves it out."""
    similar: Sequence[tuple[str, str, float]] | None = None
    """Ids of similar captions and their cosine; None: no model was named."""
    made_by: Mapping[str, Any] = field(default_factory=dict)
    """What made the captions."""

    @property
    def facts(self) -> dict[str, Any]:
        """Plain values, ready for JSON."""
        return {
            "texvent_version": full_version(),
            "made_by": dict(self.made_by),
            "streams": self._stream_facts(),
            "captions": self._caption_facts(),
            "left_out": list(self.left_out),
            "terms": TERMS,
        }

    def _stream_facts(self) -> dict[str, Any]:
        selection = self.selection
        events = [stream.events for stream in selection.streams]
        durations = [stream.duration_us for stream in selection.streams]
        return {
            "count": len(events),
            "classes": list(selection.classes),
            "incomplete_classes": selection.incomplete(self.per_class),
            "events": _spread(events),
            "duration_us": _spread(durations),
            "longer_than_55_ms": sum(one > LONGEST_US for one in durations),
            "too_few_events": list(selection.too_few),
            "too_many_events": list(selection.too_many),
            "unreadable": dict(selection.unreadable),
        }

    def _caption_facts(self) -> dict[str, Any]:
        checks = self.checks
        known = [one for one in checks.values() if one.names_class is not None]
        return {
            "count": len(checks),
            "missing": dict(self.failures),
            "words": _spread([one.words for one in checks.values()]),
            "class_names_known": len(known),
            "names_class": _share([bool(one.names_class) for one in known]),
            "names_kind": _share([bool(one.names_kind) for one in known]),
            "problems": {
                name: [id for id, one in checks.items() if name in one.problems] for name in CHECKS
            },
            "duplicates": [list(group) for group in find_duplicates(self.captions)],
            "similar": None if self.similar is None else [list(pair) for pair in self.similar],
        }

    @property
    def text(self) -> str:
        """For people."""
        return "\n".join([*self._stream_lines(), "", *self._caption_lines(), "", TERMS, ""])

    def _stream_lines(self) -> list[str]:
        facts = self._stream_facts()
        lines = [
            f"{facts['count']:,} streams of {len(facts['classes'])} classes, "
            f"{_of(facts['events'])} events, {_of(facts['duration_us'])} µs",
            f"left out: {len(facts['too_few_events'])} with too few events, "
            f"{len(facts['too_many_events'])} with too many, {len(facts['unreadable'])} unreadable",
        ]
        if facts["incomplete_classes"]:
            short = [f"{wnid} {count}" for wnid, count in facts["incomplete_classes"].items()]
            lines.append(f"classes with fewer than {self.per_class} streams: {_some(short)}")
        if facts["longer_than_55_ms"]:
            lines.append(f"{facts['longer_than_55_ms']} streams are longer than 55 ms")
        return lines

    def _caption_lines(self) -> list[str]:
        facts = self._caption_facts()
        problems = facts["problems"]
        if facts["names_class"] is None:
            named = "classes named: unknown; give their names with --class-names"
        else:
            named = (
                f"classes named: {facts['names_class']:.1%} say a name of the class, "
                f"{facts['names_kind']:.1%} at least the last word of one "
                f"(of {facts['class_names_known']:,} captions)"
            )
        lines = [
            f"{facts['count']:,} captions, {_of(facts['words'])} words; "
            f"{len(facts['missing'])} missing",
            named,
            f"length outside {FEWEST_WORDS} to {MOST_WORDS} words: {_some(problems['length'])}",
            f"refusals: {_some(problems['refusal'])}",
            f"duplicates: {len(facts['duplicates'])} groups, {_some(problems['duplicate'])} "
            "too many",
        ]
        if facts["similar"] is not None:
            pairs = [f"{one} {other} {cosine:.3f}" for one, other, cosine in facts["similar"]]
            lines.append(f"pairs with a cosine of at least 0.95: {_some(pairs)}")
        lines.append(f"left out: {_some(self.left_out)}")
        return lines


def _spread(values: Sequence[int]) -> dict[str, float] | None:
    if not values:
        return None
    return {"least": min(values), "median": statistics.median(values), "most": max(values)}


def _of(spread: Mapping[str, float] | None) -> str:
    if spread is None:
        return "no"
    return f"{spread['least']:,} to {spread['most']:,} (median {spread['median']:,.0f})"


def _share(values: Sequence[bool]) -> float | None:
    return sum(values) / len(values) if values else None


def _some(values: Sequence[str]) -> str:
    if not values:
        return "0"
    shown = ", ".join(values[:MOST_LISTED])
    more = len(values) - MOST_LISTED
    return f"{len(values)} ({shown}{f' and {more} more' if more > 0 else ''})"
