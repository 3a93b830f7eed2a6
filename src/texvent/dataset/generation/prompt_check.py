"""The prompts of a data set read before it is made: what would be shown of them."""

from __future__ import annotations

import random
from collections.abc import Iterable, Iterator, Sequence
from pathlib import Path

from texvent.dataset.generation.recipe import SPECIFICATION_FILE, Recipe
from texvent.dataset.specification.items import Item
from texvent.dataset.specification.option_ranges import is_range
from texvent.errors import InputError, shown
from texvent.run.prepare import is_strict, report_prompt
from texvent.scenes.report import PromptReport, ReportTally
from texvent.settings.resolution import Settings, resolve

MOST_READ = 2_000
"""Prompts that a plan reads, drawn by chance from more; 2,000 take a few seconds."""


def tally_prompts(recipe: Recipe) -> ReportTally | None:
    """How many prompts are understood, of at most `MOST_READ`: read, without their scenes.

    Returns:
        The counts; None for videos, and for learned generators, which give no report.
    """
    if recipe.items.are_videos:
        return None
    items: Sequence[Item] = recipe.items.all
    if len(items) > MOST_READ:
        items = random.Random(recipe.specification.seed).sample(items, MOST_READ)
    tally = ReportTally()
    for _, result in _read(items, _settings(recipe)):
        if result is None:
            return None
        tally.add(result if isinstance(result, PromptReport) else None)
    return tally


def refuse_prompts(recipe: Recipe, folder: Path) -> None:
    """Refuse a data set with wrong scenes, or with prompts that `strict` refuses, before any work.

    All prompts are read, about a millisecond for each. What only the built scene can tell fails
    its sample later.

    Args:
        recipe: of the data set.
        folder: of the data set; one that was begun is not read again.

    Raises:
        InputError: there are such prompts, or scenes that name files that are not there.
        ConfigError: a field of a scene is wrong.
    """
    if recipe.items.are_videos or (folder / SPECIFICATION_FILE).exists():
        return
    settings = _settings(recipe)
    items = [item for item in recipe.items.all if item.scene is not None or is_strict(settings)]
    refused = {
        item.prompt or "": str(result)
        for item, result in _read(items, settings)
        if isinstance(result, InputError)
    }
    if refused:
        prompt, reason = next(iter(refused.items()))
        raise InputError(
            f"{len(refused):,} of {len(recipe.items.all):,} prompts are refused, such as "
            f"{shown(prompt) if prompt else 'a scene'}: {reason}"
        )


def _read(
    items: Iterable[Item], settings: Settings
) -> Iterator[tuple[Item, PromptReport | InputError | None]]:
    for item in items:
        try:
            yield item, report_prompt(item.subject, settings, is_staged=False)
        except InputError as error:
            yield item, error


def _settings(recipe: Recipe) -> Settings:
    """The settings that all prompts share; ranges are left out."""
    options = recipe.specification.options
    return resolve("generate", {n: value for n, value in options.items() if not is_range(value)})
