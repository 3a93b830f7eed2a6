"""The scenes of a source: files, with fields that vary by lists and ranges."""

from __future__ import annotations

import itertools
import math
import random
import string
from collections.abc import Iterator, Mapping
from dataclasses import replace
from typing import Any

from texvent.batch.identity import derived_seed
from texvent.batch.samples import entries_of
from texvent.dataset.specification.option_ranges import draw_options, is_range
from texvent.dataset.specification.specification import SampleSource
from texvent.errors import ConfigError, InputError, shown
from texvent.scenes.spec.data import get_field, with_fields
from texvent.scenes.spec.scene import Scene


def read_scenes(source: SampleSource, seed: int) -> Iterator[tuple[Scene, str | None]]:
    """The scenes of a source, in order, each with its label.

    What is drawn depends on the seed, the file's name, the field and the number of the draw.

    Raises:
        InputError: there is no such file.
        FileFormatError: a file is damaged.
        ConfigError: a field is unknown or wrong; the message names the file.
    """
    for pattern in source.scene:
        for entry in entries_of(pattern):
            if entry.scene is None:
                raise InputError(f"{entry.where} is no scene file; scene names .toml or .json")
            try:
                for scene in _variants(entry.scene, str(entry.name), source, seed):
                    yield scene, _filled(source.label, scene, str(entry.name))
            except ConfigError as error:
                raise ConfigError(f"{entry.where}: {error}") from error


def _variants(scene: Scene, name: str, source: SampleSource, seed: int) -> Iterator[Scene]:
    """A scene with the values of its varied fields; its sentence with the fields that it names."""
    if not source.vary:
        yield scene
        return
    for path in source.vary:
        get_field(scene, path)  # before any value: the nearest right field is named
    ranges = {path: values for path, values in source.vary.items() if is_range(values)}
    for number, chosen in enumerate(_combinations(name, source, bool(ranges), seed)):
        varied = with_fields(scene, chosen | draw_options(ranges, seed, name, number))
        yield replace(varied, prompt=_filled(varied.prompt, varied, name) or "")


def _combinations(
    name: str, source: SampleSource, has_ranges: bool, seed: int
) -> Iterator[dict[str, Any]]:
    """Combinations of the values of lists: all in order, or `count` of them in a random order.

    With ranges, combinations come again where `count` asks for more than there are.
    """
    lists = {path: list(one) for path, one in source.vary.items() if not is_range(one)}
    every = [dict(zip(lists, one, strict=True)) for one in itertools.product(*lists.values())]
    if source.count is None:
        yield from every
        return
    if source.count > len(every) and not has_ranges:
        raise ConfigError(
            f"vary has {len(every)} combinations of values, fewer than count = {source.count}; "
            "give more values or a range, or more videos of each with repeats"
        )
    chance = random.Random(derived_seed(seed, "vary", name))
    rounds = math.ceil(source.count / len(every))
    drawn = itertools.chain.from_iterable(chance.sample(every, len(every)) for _ in range(rounds))
    yield from itertools.islice(drawn, source.count)


def _filled(text: str | None, scene: Scene, name: str) -> str | None:
    """A label or sentence with the fields of a scene in place of their paths in braces."""
    if text is None or "{" not in text:
        return text
    try:
        paths = [path for _, path, _, _ in string.Formatter().parse(text) if path is not None]
    except ValueError as error:
        raise ConfigError(f"{shown(text)}: {error}; fields to fill in stand in {{}}") from error
    for path in paths:
        value: Any = name if path == "name" else get_field(scene, path)
        if value is None or isinstance(value, (Mapping, tuple)):
            raise ConfigError(f"{shown(text)} names {path}, which has no value to write")
        text = text.replace(f"{{{path}}}", f"{value:g}" if isinstance(value, float) else str(value))
    return text
