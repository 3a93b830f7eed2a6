"""Prompts and scenes read before any work: refused, or counted."""

from __future__ import annotations

import re
from collections.abc import Iterable, Mapping, Sequence

from texvent.dataset.specification.items import Item
from texvent.errors import ConfigError, InputError
from texvent.generation.subjects import Subject
from texvent.prompt_report import ReportTally
from texvent.run.prepare import is_strict, report_prompt
from texvent.settings.resolution import Settings

MOST_READ = 3
"""Prompts of a class that are read for words that are not understood."""
WORD = re.compile(r"[\w']+")


def refuse_prompts(subjects: Sequence[tuple[str, Subject]], settings: Settings) -> None:
    """Refuse wrong scenes, and prompts that `strict` refuses.

    Scenes are not built, so each takes about a millisecond; errors that only the built scene shows
    fail its sample later.

    Raises:
        InputError: there are such prompts, or scenes that name files that are not there.
        ConfigError: a field of a scene is wrong.
    """
    refused = []
    for where, subject in subjects:
        if is_strict(settings) or not isinstance(subject, str):
            try:
                report_prompt(subject, settings, is_staged=False)
            except InputError as error:
                refused.append(f"{where}: {error}")
            except ConfigError as error:
                raise ConfigError(f"{where}: {error}") from error
    if refused:
        raise InputError(
            f"{len(refused):,} of {len(subjects):,} prompts are refused, such as {refused[0]}"
        )


def find_untrue(items: Iterable[Item], settings: Settings) -> dict[str, list[str]]:
    """Classes that their prompts do not show, with the words at fault.

    These words are not understood, are in all prompts of the class, and tell it apart: they are in
    its label, or another class lacks them.
    """
    prompts: dict[str, list[str]] = {}
    for item in items:
        if item.prompt is not None and item.scene is None and item.label is not None:
            prompts.setdefault(item.label, []).append(_plain(item.prompt))
    lost = {label: _not_understood(said, settings) for label, said in prompts.items()}
    return {
        label: at_fault
        for label, words in lost.items()
        if (at_fault := [word.strip() for word in words if _tells_apart(word, label, prompts)])
    }


def _not_understood(prompts: Sequence[str], settings: Settings) -> list[str]:
    """Words that are in all prompts and not understood in the first of them."""
    words: list[str] | None = None
    for prompt in prompts[:MOST_READ]:
        try:
            report = report_prompt(prompt, settings, is_staged=False)
        except InputError:  # its sample fails
            continue
        lost = () if report is None else report.not_understood
        unknown = [_plain(word) for phrase in lost for word in phrase.split()]
        words = [word for word in (unknown if words is None else words) if word in unknown]
    return [word for word in words or () if all(word in prompt for prompt in prompts)]


def _tells_apart(word: str, label: str, prompts: Mapping[str, Sequence[str]]) -> bool:
    return word in _plain(label) or any(
        not any(word in prompt for prompt in others) for others in prompts.values()
    )


def _plain(text: str) -> str:
    """Lower-case words between blanks."""
    return f" {' '.join(WORD.findall(text.lower()))} "


def tally_prompts(subjects: Sequence[Subject], settings: Settings) -> ReportTally | None:
    """Counts of understood prompts, read without their scenes.

    Returns:
        The counts; None for learned generators, which give no report.
    """
    tally = ReportTally()
    for subject in subjects:
        try:
            report = report_prompt(subject, settings, is_staged=False)
        except InputError:
            tally.add(None)
            continue
        if report is None:
            return None
        tally.add(report)
    return tally
