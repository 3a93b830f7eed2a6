"""The specification of a data set, and option ranges: values drawn for every video."""

from __future__ import annotations

import math
import re
from collections.abc import Mapping, Sequence
from dataclasses import dataclass, field
from fractions import Fraction
from pathlib import Path
from typing import Any

from texvent._registry import suggest
from texvent.config import FPS_RANGE, check_range
from texvent.errors import ConfigError, shown
from texvent.options.values import plain
from texvent.runtime.identity import derived_seed
from texvent.truth.layout import CLIP_FILES

MAX_SHARD = 100_000
_NAME = re.compile(r"[A-Za-z0-9][A-Za-z0-9_-]{0,63}")
DEFAULT_VARIANT = "events"
FEWEST_SIGNAL = 200
"""At 64×48 pixels most clips with as many show what they are of, hardly any with half as many."""
RANGES = ("uniform", "log_uniform", "integer", "choice")
_UNITS = 2.0**63
SOURCE_KINDS = ("prompts", "file", "videos", "template", "scene")


@dataclass(frozen=True, kw_only=True)
class SampleSource:
    """Source of samples: exactly one of prompts, file, videos, template and scene.

    Raises:
        ConfigError: none or several of them, or a field that does not belong to the one.

    Example:
        >>> from texvent.dataset import SampleSource
        >>> words = {"colour": ("red", "blue"), "thing": ("car", "dog", "ball")}
        >>> source = SampleSource(template="a {colour} {thing}", words=words, label="{thing}")
        >>> source.count is None  # all six of them
        True
    """

    prompts: tuple[str, ...] = ()
    """Prompts themselves."""
    file: Path | None = None
    """A list: `.txt`, `.csv` or `.jsonl`, as `texvent batch` reads it; a column `label` gives the
    class."""
    videos: tuple[str, ...] = ()
    """Videos, folders of videos or of images, patterns such as "clips/*/*.mp4"."""
    template: str | None = None
    """A prompt with words to fill in, such as "a {colour} {thing} drives {direction}"."""
    words: Mapping[str, tuple[str, ...]] = field(default_factory=dict)
    """Name in the template → its words."""
    scene: tuple[str, ...] = ()
    """Scene files, or patterns of their names such as `"scenes/*.toml"`."""
    vary: Mapping[str, Any] = field(default_factory=dict)
    """Path of a field, such as "objects[0].colour", in every scene → a list of its values, or a
    range to draw from, as in `Specification.options`."""
    count: int | None = None
    """Number of combinations of words drawn, without repetition; None: all of them. For a
    scene, how many of each file: combinations of its lists, with values drawn from its ranges."""
    label: str | None = None
    """Class of the samples. In a template, "{thing}" is that word; for a scene,
    "{objects[0].noun}" is that field and "{name}" its file; for videos, "{folder}" is the name of
    the folder of a video."""
    split: str | None = None
    """The split that all of these belong to; None: they are shared out."""
    boxes: Path | None = None
    """Labels of the frames of videos, such as "labels/{name}.json": COCO .json, MOT .txt, or a YOLO
    folder; "{name}" and "{folder}" are those of the video."""
    box_rate: Fraction | None = None
    """Boxes per second, interpolated along tracks; None: those of the labelled frames."""

    def __post_init__(self) -> None:
        if self.boxes is not None and not (self.videos or self.file):
            raise ConfigError("boxes are labels of videos; this source has none")
        if self.box_rate is not None and self.boxes is None:
            raise ConfigError("box_rate is that of boxes; this source names none")
        check_range("box_rate", self.box_rate, *FPS_RANGE)
        given = [name for name in SOURCE_KINDS if getattr(self, name)]
        if len(given) != 1:
            raise ConfigError(
                f"a source has {' and '.join(given) or 'nothing'}; give one of "
                f"{', '.join(SOURCE_KINDS)}"
            )
        if self.template is None and (self.words or (self.count is not None and not self.vary)):
            raise ConfigError(
                "words and count belong to a template, and count to a scene that varies; this "
                "source has none"
            )
        if self.vary and not self.scene:
            raise ConfigError("vary belongs to a scene; this source has none")
        for path, values in self.vary.items():
            if is_range(values):
                range_values(path, values)
            elif not isinstance(values, list | tuple) or not values:
                raise ConfigError(
                    f"vary: {path} is {shown(values)}; it must be a list of values, or a range "
                    f"such as {{uniform = [1.0, 2.0]}}"
                )
        check_range("count", self.count, 1)


@dataclass(frozen=True, kw_only=True)
class Variant:
    """Variant of the simulation of every video: a simulator, a sensor, options.

    Example:
        >>> from texvent.dataset import Variant
        >>> Variant(name="esim", options={"simulator": "esim"}).seeds
        1
    """

    name: str = DEFAULT_VARIANT
    """Name of its folder."""
    seeds: int = 1
    """Simulations of each video, with another seed each."""
    options: Mapping[str, Any] = field(default_factory=dict)
    """Options that replace those of the data set."""

    def __post_init__(self) -> None:
        check_name("variant", self.name)
        check_range(f"seeds of variant {self.name}", self.seeds, 1, 1_000_000)


@dataclass(frozen=True, kw_only=True)
class Filters:
    """Filters that leave samples out.

    Example:
        >>> from texvent.dataset import Filters
        >>> Filters(max_events=50_000)
        Filters(min_events=200, max_events=50000, failed_videos=False, least_control_agreement=None)
    """

    min_events: int = FEWEST_SIGNAL
    """Fewest events of a sample that its video fires: those of noise do not count."""
    max_events: int | None = None
    """Most events of a sample; the simulation of one that has more is stopped."""
    failed_videos: bool = False
    """Whether videos that look failed (frozen, dark, flickering ...) are left out."""
    least_control_agreement: float | None = None
    """Least share of the edges and the motion of its scene that a learned model's video shows (0:
    chance, 1: all); one that shows less is made again with up to three seeds, then left out."""

    def __post_init__(self) -> None:
        check_range("least_control_agreement", self.least_control_agreement, 0.0, 1.0)
        check_range("min_events", self.min_events, 0)
        check_range("max_events", self.max_events, max(1, self.min_events))


@dataclass(frozen=True, kw_only=True)
class Specification:
    """Everything that decides a data set, but for the files it names.

    Raises:
        ConfigError: a value out of range or a name that cannot be a folder.

    Example:
        >>> from texvent.dataset import SampleSource, Specification, Variant
        >>> spec = Specification(
        ...     name="cars",
        ...     sources=(SampleSource(prompts=("a red car drives left", "a dog runs")),),
        ...     options={"duration": 0.5, "contrast_threshold": {"uniform": [0.1, 0.5]}},
        ...     variants=(Variant(name="paper"), Variant(name="v2e", options={"simulator": "v2e"})),
        ... )
        >>> [variant.name for variant in spec.variants], spec.filters.min_events
        (['paper', 'v2e'], 200)
    """

    name: str
    """Name of the data set."""
    sources: tuple[SampleSource, ...]
    """Sources of the samples."""
    description: str = ""
    """Purpose, for the card."""
    license: str = ""
    """Licence of what is published, such as "cc-by-4.0"."""
    seed: int = 0
    """Seed from which those of all samples are derived, 0..2⁶³−1."""
    repeats: int = 1
    """Videos per prompt, each with a seed of its own."""
    samples_per_shard: int = 100
    """Samples in one file."""
    splits: Mapping[str, float] = field(default_factory=lambda: {"train": 1.0})
    """Split → its share; all videos of a prompt lie in one split."""
    options: Mapping[str, Any] = field(default_factory=dict)
    """Options of `texvent generate`, or of `texvent simulate` for videos. A value may be a range
    to draw from: {uniform = [0.1, 0.5]}, {log_uniform = [...]}, {integer = [...]},
    {choice = [...]}."""
    variants: tuple[Variant, ...] = field(default_factory=lambda: (Variant(),))
    """Ways to simulate each video."""
    filters: Filters = field(default_factory=Filters)
    """Filters that leave samples out."""
    truth: tuple[str, ...] = ()
    """Ground truth in each sample: boxes, flow, depth, ids, poses."""
    classes: Sequence[str] | Mapping[str, str] = ()
    """Objects that have boxes, in the order of their class ids from 0; or object → class, of which
    several may share one. Empty: all objects, by the class ids of nouns."""
    allow_classes: tuple[str, ...] = ()
    """Labels that may hold words which are not understood, and so are not shown."""
    previews: bool = True
    """Whether each sample has an image to look at."""
    store_videos: bool | None = None
    """Whether videos are stored, so that other variants can be made of them later; None: those of
    learned generators are."""

    def __post_init__(self) -> None:
        check_name("name", self.name)
        if not self.sources:
            raise ConfigError("the data set has no sources; give at least one")
        check_range("seed", self.seed, 0, 2**63 - 1)
        check_range("repeats", self.repeats, 1, 100_000_000)
        check_range("samples_per_shard", self.samples_per_shard, 1, MAX_SHARD)
        _check_splits(self.splits, self.sources)
        names = [variant.name.lower() for variant in self.variants]
        if not names or len(set(names)) < len(names):
            raise ConfigError("variants need names of their own, and at least one is needed")
        _check_truth_names(self.truth, self.classes)
        for options in (self.options, *(variant.options for variant in self.variants)):
            if "seed" in options:
                raise ConfigError("every sample has a seed of its own; set seed beside options")
            for option, value in options.items():
                if is_range(value):
                    range_values(option, value)

    @property
    def tables(self) -> dict[str, Any]:
        """Plain values, ready for TOML and JSON."""
        tables: dict[str, Any] = plain(self)
        tables["classes"] = [[*pair] for pair in self.class_of.items()]  # JSON may sort a table
        return {
            name: one
            for name, one in tables.items()
            if one or name not in ("truth", "classes", "allow_classes")
        }

    @property
    def class_of(self) -> dict[str, str]:
        """Object → its class, of the objects that have boxes; empty: all have."""
        classes = self.classes
        return dict(classes) if isinstance(classes, Mapping) else {one: one for one in classes}


def check_name(what: str, name: Any) -> None:
    """Refuse a name of which no folder or file can be called.

    Raises:
        ConfigError: it is none.
    """
    if not isinstance(name, str) or not _NAME.fullmatch(name):
        raise ConfigError(
            f"{what} is {shown(name)}; use letters, digits, _ and -, at most 64 of them"
        )


def _check_truth_names(truth: tuple[str, ...], classes: Any) -> None:
    for part in truth:
        if part not in CLIP_FILES:
            raise ConfigError(f"truth names {shown(part)}; {suggest(part, tuple(CLIP_FILES))}")
    names = [*classes, *(classes.values() if isinstance(classes, Mapping) else ())]
    if isinstance(classes, str) or not all(isinstance(one, str) and one for one in names):
        raise ConfigError(
            f"classes is {shown(classes)}; give a list of objects, such as ['car', 'bus'], or a "
            "table from objects to classes, such as {car = 'vehicle'}"
        )
    if not isinstance(classes, Mapping) and len(set(classes)) < len(classes):
        raise ConfigError(f"classes is {shown(classes)}; name each object once")
    if classes and "boxes" not in truth:
        raise ConfigError("classes are those of boxes, and truth does not name boxes")


def _check_splits(splits: Mapping[str, float], sources: tuple[SampleSource, ...]) -> None:
    for name, share in splits.items():
        check_name("split", name)
        check_range(f"share of split {name}", share, 0.0, 1.0)
    if not math.isclose(sum(splits.values()), 1.0, abs_tol=1e-6):
        raise ConfigError(f"the shares of splits add up to {sum(splits.values()):.9g}; make it 1")
    for source in sources:
        if source.split is not None and source.split not in splits:
            raise ConfigError(
                f"a source is for split {shown(source.split)}, which splits does not name; it has: "
                f"{', '.join(splits)}"
            )


def is_range(value: Any) -> bool:
    """True if an option's value is a table, and so to be drawn."""
    return isinstance(value, Mapping)


def range_values(option: str, value: Mapping[str, Any]) -> tuple[str, Sequence[Any]]:
    """Kind and values of a range.

    Raises:
        ConfigError: no such kind, or its values do not fit.
    """
    if len(value) != 1 or next(iter(value)) not in RANGES:
        kind = next(iter(value), "")
        raise ConfigError(f"range of {option}: {shown(dict(value))}; {suggest(kind, RANGES)}")
    kind, values = next(iter(value.items()))
    if not isinstance(values, list | tuple) or not values:
        raise ConfigError(f"range of {option}: {kind} is {shown(values)}; it must be a list")
    if kind == "choice":
        return kind, values
    is_number = [type(one) in (int, float) and math.isfinite(one) for one in values]
    if len(values) != 2 or not all(is_number) or values[0] > values[1]:
        raise ConfigError(
            f"range of {option}: {kind} is {shown(list(values))}; it must be [lowest, highest]"
        )
    if kind == "log_uniform" and values[0] <= 0:
        raise ConfigError(f"range of {option}: log_uniform begins at {values[0]}; give more than 0")
    if kind == "integer" and not all(float(one).is_integer() for one in values):
        raise ConfigError(f"range of {option}: integer is {shown(list(values))}; whole numbers")
    return kind, values


def draw_options(options: Mapping[str, Any], *key: object) -> dict[str, Any]:
    """The options with each range replaced by a value that depends on the key and its name alone.

    Example:
        >>> draw_options({"fps": 24, "duration": {"choice": [1.0]}}, 7, "clip")
        {'fps': 24, 'duration': 1.0}
    """
    return {
        name: _drawn(name, value, derived_seed("option", name, *key) / _UNITS)
        if is_range(value)
        else value
        for name, value in options.items()
    }


def _drawn(option: str, value: Mapping[str, Any], u: float) -> Any:
    """The value at a share 0 ≤ u < 1 of a range."""
    kind, values = range_values(option, value)
    if kind == "choice":
        return values[min(int(u * len(values)), len(values) - 1)]
    low, high = values
    if kind == "integer":
        return min(int(low) + int(u * (int(high) - int(low) + 1)), int(high))
    if kind == "log_uniform":
        return math.exp(math.log(low) + u * (math.log(high) - math.log(low)))
    return low + u * (high - low)


def extreme_options(options: Mapping[str, Any]) -> list[dict[str, Any]]:
    """Options without ranges that together hold every end and every choice of each range."""
    ends: dict[str, Sequence[Any]] = {
        name: range_values(name, value)[1] for name, value in options.items() if is_range(value)
    }
    first = {name: ends[name][0] if name in ends else value for name, value in options.items()}
    others = [{**first, name: end} for name, values in ends.items() for end in values[1:]]
    return [first, *others]
