"""A data set as every process that makes it sees it: specification, items, folder."""

from __future__ import annotations

import functools
import hashlib
import json
from collections.abc import Iterator, Mapping
from dataclasses import dataclass, replace
from io import StringIO
from pathlib import Path
from typing import Any

from texvent._registry import DEFAULT_GENERATOR, GENERATORS, suggest
from texvent._version import full_version
from texvent.config import InterpolateConfig
from texvent.dataset.generation.shard_files import EXTENSION, read_json
from texvent.dataset.specification.clips import Clips, ClipSettings, NumberedClip
from texvent.dataset.specification.items import Item, Items, read_items
from texvent.dataset.specification.prompts import find_untrue
from texvent.dataset.specification.reading import specification_from
from texvent.dataset.specification.specification import (
    Specification,
    Variant,
    extreme_options,
    is_range,
)
from texvent.dataset.specification.truth import check_truth
from texvent.errors import (
    ConfigError,
    FileFormatError,
    InputError,
    OutputError,
    TexventError,
    one_line,
    shown,
    warnings_to,
)
from texvent.generation.protocol import renders_instants
from texvent.io.atomic import atomic_file
from texvent.options.values import option_names
from texvent.run.ledger import describe_differences, write_note
from texvent.run.prepare import check_run
from texvent.runtime.devices import AUTO, check_device_name
from texvent.runtime.files.hidden_parts import is_hidden_part
from texvent.settings.config_files import Command
from texvent.settings.provenance import files_read
from texvent.settings.resolution import SENSOR_FILES, Settings, resolve

SPECIFICATION_FILE, ITEMS_FILE = "specification.json", "items.jsonl"
VIDEOS = "videos"
"""Folder of the shards of videos, and what their records call their variant."""


@dataclass(frozen=True)
class Shard:
    """One file to make: what is in it depends on the specification and this alone."""

    variant: str
    """Name of a variant, or `VIDEOS`."""
    split: str
    number: int

    @property
    def name(self) -> str:
        """Such as "train-000012"."""
        return f"{self.split}-{self.number:06d}"

    @property
    def path(self) -> Path:
        """Its place in the folder of the data set."""
        return Path(self.variant) / f"{self.name}{EXTENSION}"


@dataclass(frozen=True)
class Recipe:
    """Everything that decides the bytes of a data set."""

    specification: Specification
    items: Items

    @classmethod
    def of(cls, specification: Specification, device: str = AUTO) -> Recipe:
        """Read the sources and check every option, before any work.

        Args:
            specification: of the data set.
            device: of the pixel model and networks; "auto": that of the specification.

        Raises:
            InputError: a source does not exist or holds nothing.
            ConfigError: an option that some run would refuse, truth that no source knows, or shares
                that leave a split empty.
        """
        recipe = cls(specification, read_items(specification))
        recipe._check_options()
        recipe.check_runs(device)
        for label in specification.allow_classes:
            if label not in recipe.items.labels:
                raise ConfigError(
                    f"allow_classes names {shown(label)}; {suggest(label, recipe.items.labels)}"
                )
        is_cut_off = recipe.stores_videos and not recipe.follows_scenes
        check_truth(specification, recipe.items, is_stored=is_cut_off)
        recipe.clips  # noqa: B018  (refuses splits that would be empty)
        if VIDEOS in (variant.name for variant in specification.variants):
            raise ConfigError(f"a variant cannot be called {VIDEOS}; that folder holds the videos")
        return recipe

    @property
    def command(self) -> Command:
        """Command whose options apply."""
        return "simulate" if self.items.are_videos else "generate"

    @functools.cached_property
    def clips(self) -> Clips:
        """The numbered clips."""
        return Clips(self.specification, self.items)

    @functools.cached_property
    def identity(self) -> str:
        """Digest of everything that decides the samples, but for the version of texvent."""
        return hashlib.sha256(json.dumps(self._facts, sort_keys=True).encode()).hexdigest()

    @property
    def _facts(self) -> dict[str, Any]:
        tables = self.specification.tables
        items = [item.facts for item in self.items.all]
        decides = {n: one for n, one in tables.items() if n not in ("sources", "allow_classes")}
        return decides | {"items": items}

    @property
    def stores_videos(self) -> bool:
        """True if videos are made and stored first, and simulated from there."""
        if self.items.are_videos:
            return False
        if self.specification.store_videos is not None:
            return self.specification.store_videos
        name = self.specification.options.get("generator", DEFAULT_GENERATOR)
        return not renders_instants(GENERATORS.load(name))

    @property
    def follows_scenes(self) -> bool:
        """True if a learned generator makes videos of scenes, which are known when simulated."""
        name = self.specification.options.get("generator", DEFAULT_GENERATOR)
        part: Any = None if self.items.are_videos else GENERATORS.load(name)
        return bool(getattr(part, "makes_whole_videos", False) and part.takes_scenes)

    @property
    def renders(self) -> bool:
        """True if clips are rendered while they are simulated."""
        return not (self.items.are_videos or self.stores_videos)

    @functools.cached_property
    def settings(self) -> Mapping[str, ClipSettings]:
        """Stage → the settings of its clips."""
        found, options, seed = {}, self.specification.options, self.specification.seed
        # A stored video cannot be rendered at any instant, whatever its generator could do.
        is_cut_off = self.stores_videos and not self.follows_scenes
        basis = {"interpolate": InterpolateConfig.interpolate} if is_cut_off else {}
        of_videos = dict(options)
        if (least := self.specification.filters.least_control_agreement) is not None:
            response = "reject" if options.get("on_failure") == "reject" else "retry"
            of_videos |= {"least_agreement": least, "on_failure": response}
        making = options if self.stores_videos else of_videos
        for name, variant in self.variants.items():
            own = {**basis, **making, **variant.options}
            found[name] = ClipSettings(self.command, own, seed)
        return {VIDEOS: ClipSettings(self.command, of_videos, seed), **found}

    def _check_options(self) -> None:
        """Refuse a filter without a use, and options of a variant that change the video."""
        least = self.specification.filters.least_control_agreement
        if least is not None and not self.follows_scenes:
            raise ConfigError(
                "filters sets least_control_agreement, and no generator that follows scenes makes "
                "the videos; leave it out, or name one in options (texvent generators)"
            )
        for name, variant in self.variants.items():
            for settings in self.settings[name].extremes:
                of_video = {"generator", *option_names(type(settings.source))}
                wrong = [one for one in variant.options if one in of_video]
                if wrong and self.command == "generate":
                    raise ConfigError(
                        f"variant {name} sets {wrong[0]}, which changes the video; all variants "
                        "are simulated from the same one: set it in options"
                    )

    def check_runs(self, device: str) -> None:
        """Refuse options, or a device, that some run would refuse.

        Raises:
            ConfigError, InputError, MissingDependencyError: as `texvent.run.prepare.check_run`.
        """
        check_device_name(device)
        for name in self.variants:
            for settings in self.settings[name].extremes:
                run = settings.run if device == AUTO else replace(settings.run, device=device)
                check_run(replace(settings, run=run))

    @property
    def prompt_settings(self) -> Settings:
        """The settings that all prompts share; ranges are left out."""
        options = self.specification.options
        return resolve("generate", {n: one for n, one in options.items() if not is_range(one)})

    def untrue_classes(self) -> dict[str, list[str]]:
        """Classes that prompts do not show, with the words at fault; without those allowed."""
        found = find_untrue(self.items.all, self.prompt_settings)
        allowed = self.specification.allow_classes
        return {label: words for label, words in found.items() if label not in allowed}

    @functools.cached_property
    def files_named(self) -> Mapping[str, tuple[str, ...]]:
        """Stage → files and folders that its options name."""
        return {stage: tuple(dict.fromkeys(self._find_files(stage))) for stage in self.stages}

    def _find_files(self, stage: str) -> Iterator[str]:
        own = self.settings[stage]
        with warnings_to(lambda text: None):  # they were told when the options were checked
            for options, settings in zip(extreme_options(own.options), own.extremes, strict=True):
                yield from files_read(settings)
                sensor = str(options.get("sensor"))
                yield from [sensor] if sensor.lower().endswith(SENSOR_FILES) else ()

    @property
    def stages(self) -> tuple[str, ...]:
        """The videos, where they are stored, then the variants, in the order they are made."""
        return (*([VIDEOS] if self.stores_videos else []), *self.variants)

    @property
    def variants(self) -> Mapping[str, Variant]:
        """Variants by name."""
        return {variant.name: variant for variant in self.specification.variants}

    def shards(self, variant: str) -> Iterator[Shard]:
        """All shards of a variant, or of the videos."""
        for split, count in self.clips.counts.items():
            for number in range(-(-count // self.specification.samples_per_shard)):
                yield Shard(variant, split, number)

    def clips_of(self, shard: Shard) -> Iterator[NumberedClip]:
        """The clips of a shard, in order."""
        size = self.specification.samples_per_shard
        end = min((shard.number + 1) * size, self.clips.counts[shard.split])
        for number in range(shard.number * size, end):
            yield self.clips.clip(shard.split, number)

    def begin(self, folder: Path) -> None:
        """Note in a folder what will be made there.

        Raises:
            ConfigError: the folder holds another data set, or was made by another version.
            OutputError: the folder is a file or cannot be written.
        """
        if (folder / SPECIFICATION_FILE).exists():
            load_recipe(folder).refuse_other(self, folder)
            return
        if folder.exists() and (not folder.is_dir() or _holds_others(folder)):
            raise OutputError(f"{folder} exists and holds no data set of texvent; name another")
        try:
            folder.mkdir(parents=True, exist_ok=True)
        except OSError as error:
            raise OutputError(f"cannot make {folder}: {one_line(error)}") from error
        lines = (json.dumps(item.facts, ensure_ascii=False) for item in self.items.all)
        with atomic_file(folder / ITEMS_FILE, overwrite=True) as part:
            part.write_text("".join(f"{line}\n" for line in lines), encoding="utf-8")
        facts = {
            "texvent_version": full_version(),
            "identity": self.identity,
            "duplicates": self.items.duplicates,
            "labels": list(self.items.labels),
            "specification": self.specification.tables,
        }
        write_note(folder / SPECIFICATION_FILE, facts)

    def refuse_other(self, wanted: Recipe, folder: Path) -> None:
        """Refuse to go on with another specification than the one of the folder.

        Raises:
            ConfigError: they differ; the message says in what.
        """
        if self.identity == wanted.identity:
            return
        before, now = self._facts, wanted._facts
        old, new = ({item["key"] for item in facts.pop("items")} for facts in (before, now))
        if old != new:
            change = f"{len(new - old)} prompts or videos more, {len(old - new)} fewer"
        else:
            change = describe_differences(before, now) or "the order of prompts"
        raise ConfigError(
            f"{folder} was made from another specification: {change}; name another folder with -o"
        )


def _holds_others(folder: Path) -> bool:
    """True if there is more than what `Recipe.begin` leaves when it is killed."""
    return any(one.name != ITEMS_FILE and not is_hidden_part(one) for one in folder.iterdir())


def load_recipe(folder: Path) -> Recipe:
    """The recipe of a data set that was begun.

    Raises:
        InputError: the folder holds no data set.
        FileFormatError: its specification is damaged.
        ConfigError: it was begun by another version of texvent.
    """
    facts = read_facts(folder)
    made_by = facts.get("texvent_version")
    if made_by != full_version():
        raise ConfigError(
            f"{folder} was begun by texvent {made_by}, and this is {full_version()}, whose events "
            "may differ; install that version, or name another folder with -o"
        )
    return read_recipe(folder)


def read_recipe(folder: Path) -> Recipe:
    """The recipe of a data set that any version began, to look at.

    Raises:
        InputError: the folder holds no data set, or a copy to load from.
        FileFormatError: its specification is damaged.
    """
    facts, path, note = read_facts(folder), folder / ITEMS_FILE, folder / SPECIFICATION_FILE
    if not path.exists():
        raise InputError(
            f"{folder} has no {path.name}, so it is a copy to load from and cannot be made further"
        )
    try:
        lines = StringIO(path.read_text(encoding="utf-8"))
        items = tuple(Item(**read_json(line)) for line in lines)
    except (OSError, ValueError, TypeError, KeyError) as error:
        raise FileFormatError(f"{path} is damaged ({one_line(error)})") from error
    try:
        specification = specification_from(facts["specification"], folder=Path())
        recipe = Recipe(specification, Items(items, int(facts.get("duplicates", 0))))
    except (TexventError, ValueError, TypeError, KeyError, AttributeError) as error:
        raise FileFormatError(f"{note} is damaged ({one_line(error)})") from error
    if recipe.identity != facts.get("identity"):
        raise FileFormatError(f"{note} or {path.name} was changed by hand")
    return recipe


def load_recipe_once(folder: Path) -> Recipe:
    """As `load_recipe`, read once per process, until another data set is begun in the folder."""
    facts = folder / SPECIFICATION_FILE
    state = facts.stat() if facts.is_file() else None
    return _recipe_in(folder, state and (state.st_ino, state.st_mtime_ns))


@functools.lru_cache(maxsize=2)
def _recipe_in(folder: Path, state: object) -> Recipe:
    del state  # part of the key
    return load_recipe(folder)


def read_facts(folder: Path) -> Mapping[str, Any]:
    """Facts that `Recipe.begin` noted in a folder.

    Raises:
        InputError: the folder holds no data set.
        FileFormatError: its specification is damaged.
    """
    path = folder / SPECIFICATION_FILE
    try:
        facts = read_json(path.read_text(encoding="utf-8"))
    except OSError as error:
        raise InputError(f"{folder} holds no data set of texvent (no {path.name})") from error
    except (ValueError, RecursionError) as error:
        raise FileFormatError(f"{path} is damaged ({one_line(error)})") from error
    if not isinstance(facts, dict):
        raise FileFormatError(f"{path} is damaged")
    return facts
