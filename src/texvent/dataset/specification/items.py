"""Items of a data set: the prompts, scenes and videos that its sources give."""

from __future__ import annotations

import itertools
import math
import random
import string
from collections.abc import Iterable, Iterator, Mapping
from dataclasses import asdict, dataclass, replace
from pathlib import Path
from typing import Any, cast

from texvent.dataset.specification.entries import entries_of, moved_together
from texvent.dataset.specification.list_files import ListEntry, read_list
from texvent.dataset.specification.specification import (
    SampleSource,
    Specification,
    draw_options,
    is_range,
)
from texvent.errors import ConfigError, InputError, shown
from texvent.generation.subjects import SceneValue, Subject, scenes
from texvent.runtime.identity import derived_seed, digest
from texvent.settings.provenance import describe_state

MAX_ITEMS = 10_000_000
KEY_DIGITS = 16


@dataclass(frozen=True, slots=True)
class Item:
    """A prompt, a scene or a video, of which `repeats` videos and all variants are made."""

    key: str
    """Identity of the item: a digest of its content and label."""
    prompt: str | None = None
    video: str | None = None
    """Path of the video; None: it is generated."""
    label: str | None = None
    split: str | None = None
    """The split that its source asks for."""
    seed: int | None = None
    """Seed that its list gives."""
    scene: Mapping[str, Any] | None = None
    """Plain values of the scene that is shown; None: that of the prompt."""
    boxes: str | None = None
    """Path of the labels of its video."""
    box_rate: str | None = None
    """Boxes per second of the label clock, as 30 or 30000/1001."""

    @property
    def subject(self) -> Subject:
        """Its scene, or else its prompt."""
        if self.scene is None:
            return self.prompt or ""
        return cast(Subject, scenes().scene_from_data(self.scene))

    @property
    def facts(self) -> dict[str, Any]:
        """Plain values; without those of later versions where there are none."""
        later = ("scene", "boxes", "box_rate")
        return {n: v for n, v in asdict(self).items() if v is not None or n not in later}


@dataclass(frozen=True)
class Items:
    """All of them."""

    all: tuple[Item, ...]
    duplicates: int = 0
    """Number of items left out because an equal one comes before."""

    @property
    def are_videos(self) -> bool:
        """True if nothing is generated."""
        return self.all[0].video is not None

    @property
    def labels(self) -> tuple[str, ...]:
        """All classes in alphabetical order; a sample's number is its place here."""
        return tuple(sorted({item.label for item in self.all if item.label is not None}))


def read_items(specification: Specification) -> Items:
    """Items of the sources, in their order; equal ones once.

    Raises:
        InputError: a source does not exist, or holds nothing.
        FileFormatError: a line of a list cannot be read.
        ConfigError: a template does not fit its words, or prompts and videos are mixed.
    """
    found: dict[str, Item] = {}
    duplicates = 0
    for source in specification.sources:
        for item in _items_of(source, specification):
            item = _told_apart(item, found.get(item.key))
            if item.key in found:
                duplicates += 1
                continue
            found[item.key] = item
            if len(found) > MAX_ITEMS:
                raise ConfigError(
                    f"the sources give over {MAX_ITEMS:,} prompts; give fewer with count, and more "
                    "videos of each with repeats"
                )
    items = Items(tuple(found.values()), duplicates)
    if len({item.video is None for item in items.all}) > 1:
        raise ConfigError("the sources give prompts and videos; make a data set of each")
    labelled = sum(item.label is not None for item in items.all)
    if 0 < labelled < len(items.all):
        raise ConfigError(
            f"{labelled} of {len(items.all)} prompts or videos have a label; give all one, or none"
        )
    return items


def _told_apart(item: Item, other: Item | None) -> Item:
    """An item with a key of its own, if it is another video in a folder of the same name."""
    if other is None or item.video is None or other.video in (None, item.video):
        return item
    own, others = describe_state(item.video), describe_state(str(other.video))
    if own is None or others is None or own["contents"] == others["contents"]:
        return item
    return replace(item, key=digest([item.key, own["contents"]])[:KEY_DIGITS])


def _items_of(source: SampleSource, specification: Specification) -> Iterator[Item]:
    if source.template is not None:
        yield from _of_template(source, specification.seed)
        return
    if source.scene:
        for scene, label in read_scenes(source, specification.seed):
            yield _item(scene.prompt or None, None, label, source.split, scene=scene)
        return
    variants = (variant.options for variant in specification.variants)
    of_stills = any("camera" in options for options in (specification.options, *variants))
    for entry in _entries(source, of_stills):
        label = entry.label if entry.label is not None else _label(source, entry.video)
        item = _item(entry.prompt, entry.video, label, source.split, entry.seed, entry.scene)
        yield item if source.boxes is None else _with_boxes(item, source)


def _entries(source: SampleSource, of_stills: bool) -> Iterable[ListEntry]:
    if source.prompts:
        return [ListEntry(where="prompts", prompt=prompt.strip()) for prompt in source.prompts]
    if source.file is not None:
        if not source.file.is_file():
            raise InputError(f"no such list: {source.file}; file names a .txt, .csv or .jsonl")
        return read_list(source.file)
    return itertools.chain.from_iterable(entries_of(one, of_stills) for one in source.videos)


def _item(
    prompt: str | None,
    video: Path | None,
    label: str | None,
    split: str | None,
    seed: int | None = None,
    scene: SceneValue | None = None,
) -> Item:
    what: list[object] = [prompt, moved_together(video), label, seed]
    data = None if scene is None else scenes().scene_to_data(scene)
    if data is not None:
        what.append(data)
    key = digest(what)[:KEY_DIGITS]
    return Item(key, prompt, None if video is None else str(video), label, split, seed, data)


def _with_boxes(item: Item, source: SampleSource) -> Item:
    """An item with the labels of its video."""
    if item.video is None:
        raise ConfigError("boxes are labels of videos; the list of this source names prompts too")
    boxes = Path(_filled(str(source.boxes), _video_names(Path(item.video)), "boxes"))
    rate = None if source.box_rate is None else str(source.box_rate)
    key = digest([item.key, moved_together(boxes), rate])[:KEY_DIGITS]
    return replace(item, key=key, boxes=str(boxes), box_rate=rate)


def _video_names(video: Path) -> dict[str, str]:
    return {"folder": video.absolute().parent.name, "name": video.stem}


def _label(source: SampleSource, video: Path | None) -> str | None:
    if source.label is None or video is None:
        return source.label
    return _filled(source.label, _video_names(video), "label")


def _of_template(source: SampleSource, seed: int) -> Iterator[Item]:
    """Prompts of a template: all combinations of its words in order, or some drawn of them."""
    template = source.template or ""
    names = _placeholders(template)
    missing = [name for name in names if not source.words.get(name)]
    unused = [name for name in source.words if name not in names]
    if missing or unused:
        which, problem = (missing, "has no words for") if missing else (unused, "does not use")
        raise ConfigError(f"template {shown(template)} {problem} {', '.join(which)}")
    lists = [source.words[name] for name in names]
    total = math.prod(map(len, lists))
    if source.count is not None and source.count > total:
        raise ConfigError(
            f"template {shown(template)} has {total} combinations of words, fewer than count = "
            f"{source.count}; give more words, or more videos of each with repeats"
        )
    if source.count is None:
        numbers: Iterable[int] = range(total)
    else:
        chance = random.Random(derived_seed(seed, "template", template))
        numbers = sorted(chance.sample(range(total), source.count))
    for number in numbers:
        words = {}
        for name, values in zip(reversed(names), reversed(lists), strict=True):
            number, place = divmod(number, len(values))
            words[name] = values[place]
        label = None if source.label is None else _filled(source.label, words, "label")
        yield _item(_filled(template, words, "template"), None, label, source.split)


def _placeholders(template: str) -> list[str]:
    try:
        parts = [name for _, name, _, _ in string.Formatter().parse(template) if name is not None]
    except ValueError as error:
        raise ConfigError(
            f"template {shown(template)}: {error}; write names to fill in as {{name}}"
        ) from error
    return list(dict.fromkeys(parts))


def _filled(template: str, words: dict[str, str], what: str) -> str:
    for name in _placeholders(template):
        if name not in words:
            raise ConfigError(
                f"{what} {shown(template)} names {{{name}}}; there is: {', '.join(words)}"
            )
        template = template.replace(f"{{{name}}}", words[name])
    return template


def read_scenes(source: SampleSource, seed: int) -> Iterator[tuple[SceneValue, str | None]]:
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
                for scene in _varied_scenes(entry.scene, str(entry.name), source, seed):
                    yield scene, _with_scene_fields(source.label, scene, str(entry.name))
            except ConfigError as error:
                raise ConfigError(f"{entry.where}: {error}") from error


def _varied_scenes(
    scene: SceneValue, name: str, source: SampleSource, seed: int
) -> Iterator[SceneValue]:
    """A scene with the values of its varied fields; its sentence with the fields that it names."""
    if not source.vary:
        yield scene
        return
    for path in source.vary:
        scenes().get_field(scene, path)  # before any value: the nearest right field is named
    ranges = {path: values for path, values in source.vary.items() if is_range(values)}
    for number, chosen in enumerate(_combinations(name, source, bool(ranges), seed)):
        varied = scenes().with_fields(scene, chosen | draw_options(ranges, seed, name, number))
        yield replace(varied, prompt=_with_scene_fields(varied.prompt, varied, name) or "")


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


def _with_scene_fields(text: str | None, scene: SceneValue, name: str) -> str | None:
    """A label or sentence with the fields of a scene in place of their paths in braces."""
    if text is None or "{" not in text:
        return text
    for path in _placeholders(text):
        value: Any = name if path == "name" else scenes().get_field(scene, path)
        if value is None or isinstance(value, (Mapping, tuple)):
            raise ConfigError(f"{shown(text)} names {path}, which has no value to write")
        text = text.replace(f"{{{path}}}", f"{value:g}" if isinstance(value, float) else str(value))
    return text
