"""What the reader makes of sentences, against what a person reads in them.

Everything that a sentence says (a thing, its count and attributes, what it does, a relation, place,
light, camera, what is excluded) is one of

* right: it is in the scene's description, bound to the thing it belongs to;
* substituted: the thing is shown as another, and the report says so;
* reported: the report says that it is not understood or not shown;
* silent: neither, so that the scene says something else than the sentence.

`judging.Reading` decides. What a person adds to the sentence, such as the racket of a serve, is not
asked. Whether a verb is known is asked of the reader itself, by a sentence of one clause: what is
compared is how the parts of a sentence are put together.
"""

from __future__ import annotations

import argparse
import json
from collections import Counter
from collections.abc import Sequence
from dataclasses import dataclass, field

from benchmarks.prompts.gold import GoldSentence, read_gold
from benchmarks.prompts.judging import Reading
from benchmarks.prompts.rates import Share

STATES = ("right", "substituted", "reported", "silent")


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
        reading = Reading.of(sentence)
        findings.objects += len(reading.description.objects)
        findings.asked_for += len(reading.list_asked_for())
        for kind, what, state in reading.judge():
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
