"""Prompts and scenes read before any work: refused, or counted."""

from __future__ import annotations

from collections.abc import Sequence

from texvent.errors import ConfigError, InputError
from texvent.generation.subjects import Subject
from texvent.prompt_report import ReportTally
from texvent.run.prepare import is_strict, report_prompt
from texvent.settings.resolution import Settings


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
