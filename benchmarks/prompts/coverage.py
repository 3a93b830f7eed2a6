"""Which names of outside lists are shown: each is read as the prompt "a NAME".

A name is `shown` if every word of it is, `substituted` if it is shown as something else and the
report says so, `partly` if some of its words are reported as not understood or not shown while a
thing is shown, and `not understood` if nothing of it is shown. Whether what is shown as said looks
right is for a grader to say.
"""

from __future__ import annotations

import argparse
import json
from collections.abc import Sequence
from dataclasses import dataclass
from io import StringIO
from pathlib import Path

from benchmarks.prompts.rates import Share
from texvent.errors import InputError
from texvent.scenes.language.parser import parse_prompt

KINDS = ("shown", "substituted", "partly", "not understood")
LISTS = {
    "COCO, 80 classes": Path(__file__).with_name("names_coco.txt"),
    "ImageNet, every tenth class": Path(__file__).with_name("names_imagenet.txt"),
}


@dataclass(frozen=True)
class NameResult:
    """What became of a name."""

    name: str
    kind: str
    """One of `KINDS`."""
    things: tuple[str, ...] = ()
    """Nouns that are shown."""
    said: str = ""
    """What the report says."""


def run(options: argparse.Namespace) -> None:
    """Print counts and names of every list."""
    lists = {path.stem: path for path in options.names} if options.names else LISTS
    results = {title: [judge(name) for name in read_names(path)] for title, path in lists.items()}
    for title, found in results.items():
        print(f"## {title}\n\n{as_markdown(found)}\n")
    if options.json is not None:
        plain = {
            title: [{**vars(one), "things": list(one.things)} for one in found]
            for title, found in results.items()
        }
        options.json.write_text(json.dumps(plain, indent=1) + "\n", encoding="utf-8")


def read_names(path: Path) -> list[str]:
    """The names of a list: one per line, # begins a comment.

    Raises:
        InputError: it cannot be read, or holds no name.
    """
    try:
        lines = list(StringIO(path.read_text(encoding="utf-8")))
    except OSError as error:
        raise InputError(f"cannot read {path}: {error.strerror}") from error
    names = [line.strip() for line in lines if line.strip() and not line.startswith("#")]
    if not names:
        raise InputError(f"{path} holds no name")
    return names


def judge(name: str) -> NameResult:
    """What becomes of "a NAME"."""
    article = "an" if name[0].lower() in "aeiou" else "a"
    try:
        description = parse_prompt(f"{article} {name}")
    except InputError as error:
        return NameResult(name, "not understood", said=str(error))
    things = tuple(scene_object.noun for scene_object in description.objects)
    report = description.report()
    said = "; ".join(report.faults())
    if report.not_understood or report.not_shown:
        return NameResult(name, "partly" if things else "not understood", things, said)
    return NameResult(name, "substituted" if report.substituted else "shown", things, said)


def as_markdown(results: Sequence[NameResult]) -> str:
    """Counts, then the names of each kind with what is shown for them."""
    lines = ["| | |", "|---|---|"]
    for kind in KINDS:
        found = [one for one in results if one.kind == kind]
        lines.append(f"| {kind} | {Share(len(found), len(results))} |")
    for kind in KINDS:
        names = [_describe(one) for one in results if one.kind == kind]
        if names:
            lines.append(f"\n{kind}: {', '.join(names)}")
    return "\n".join(lines)


def _describe(one: NameResult) -> str:
    if one.kind == "not understood" or one.things == (one.name,):
        return one.name
    return f"{one.name} → {' + '.join(one.things) or 'a place'}"
