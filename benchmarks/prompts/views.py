"""How often what a prompt names is out of view, hidden or tiny; nothing is drawn.

Every prompt is staged as `sheet` draws it. The table counts the objects that its words name by what
the camera shows of them, and its words by what the report says of them.
"""

from __future__ import annotations

import argparse
import json
from collections import Counter
from typing import Any

from benchmarks.prompts.measure import DURATION_S, SEED, SIZE
from benchmarks.prompts.rates import Share
from benchmarks.prompts.sheet import read_prompts
from texvent.errors import InputError
from texvent.generate.seen_things import find_evidence
from texvent.scenes.evidence import Evidence, is_to_move, report_on
from texvent.scenes.language.parser import parse_prompt
from texvent.scenes.staging.compose import compose_scene

SEEN = "seen"


def run(options: argparse.Namespace) -> None:
    """Print the table, with a column for each style."""
    counts: dict[str, dict[str, Counter[str]]] = {}
    rows: list[dict[str, Any]] = []
    for prompt in read_prompts(options.prompts):
        try:
            found = measure(prompt.prompt)
        except InputError as error:
            rows.append({"id": prompt.id, "error": str(error)})
            continue
        rows.append({"id": prompt.id, "error": None, **found})
        style = counts.setdefault(prompt.style or "all", {})
        for kind in ("objects", "words"):
            style.setdefault(kind, Counter()).update(
                {state: len(which) for state, which in found[kind].items()}
            )
    print(as_markdown(counts))
    if options.json is not None:
        options.json.write_text(json.dumps(rows, indent=1) + "\n", encoding="utf-8")


def measure(prompt: str) -> dict[str, dict[str, list[str]]]:
    """State → nouns of objects, and state → words of a prompt.

    Raises:
        InputError: nothing of the prompt is understood.
    """
    description = parse_prompt(prompt)
    scene = compose_scene(description, seed=SEED, size=SIZE, duration_s=DURATION_S)
    evidence = find_evidence(scene, description, SIZE, DURATION_S)
    objects: dict[str, list[str]] = {}
    named = {index for claim in description.claims for index in claim.things}
    for index in sorted(named):
        state = state_of(index, evidence)
        if state == SEEN and index in evidence.still and is_to_move(index, description):
            state = "seen, but not moving"
        objects.setdefault(state, []).append(description.objects[index].noun)
    report = report_on(description, evidence)
    words = {
        "shown": list(report.shown),
        "shown as something else": [str(one) for one in report.substituted],
        "not shown": list(report.not_shown),
        "not understood": list(report.not_understood),
    }
    return {"objects": objects, "words": words}


def state_of(index: int, evidence: Evidence) -> str:
    """What is seen of an object: of several copies, of most of them."""
    faults = Counter(fault or SEEN for fault in evidence.faults[index])
    return faults.most_common(1)[0][0]


def as_markdown(counts: dict[str, dict[str, Counter[str]]]) -> str:
    """A row for each state of objects and words."""
    lines = [f"| | {' | '.join(counts)} |", f"|---|{'---|' * len(counts)}"]
    for kind in ("objects", "words"):
        states = list(dict.fromkeys(s for one in counts.values() for s in one[kind]))
        for state in states:
            cells: list[Any] = [
                Share(one[kind][state], one[kind].total()) for one in counts.values()
            ]
            lines.append(f"| {kind} {state} | {' | '.join(map(str, cells))} |")
    return "\n".join(lines)
