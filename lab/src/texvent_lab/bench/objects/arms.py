"""Arms of the benchmark of objects: simulators, or one simulator with a property replaced."""

from __future__ import annotations

import math
from collections.abc import Mapping
from dataclasses import dataclass, replace
from pathlib import Path
from typing import Any, Literal, TypeAlias, get_args

import numpy as np

from texvent.dataset.specification.items import Item, read_items
from texvent.dataset.specification.specification import Specification
from texvent.errors import ConfigError, shown
from texvent.extending import suggest
from texvent.options.values import convert
from texvent.runtime.identity import derived_seed
from texvent.settings.config_files import read_document
from texvent.training.draws import RANGES
from texvent_lab.bench.fidelity.event_files import FileEntry

Test: TypeAlias = Literal["table", "turntable"]
Times: TypeAlias = Literal["exact", "frames"]
TIMES = get_args(Times)
CHANGES = ("options", "scenes", "vary", "clips", "threshold", "spread", "times", "stream")


def clip_name(test: Test, item: Item) -> str:
    """Name of the frames of a clip, and of the files of their events."""
    return f"{test}-{item.key}"


@dataclass(frozen=True)
class Arm:
    """Clips, and what makes events of them."""

    specification: Specification
    options: Mapping[str, Any]
    """Options of the simulator."""
    threshold: tuple[float, ...] = ()
    """Contrast threshold, log units: one for all clips; two between which each clip draws its own,
    evenly on a logarithmic scale; none: matched to the recorded share of pixels with an event."""
    spread: float = 0.0
    """Standard deviation of the natural logarithm of the threshold between clips."""
    times: Times = "exact"
    """Whether events have times of their own, or that of the next frame."""
    stream: str = ""
    """Draws of a training stream, by name, in place of the simulator and its thresholds."""
    events: FileEntry | None = None
    """Events that another program made of the clips, in place of a simulator's."""

    @property
    def items(self) -> tuple[Item, ...]:
        """The clips; every class comes by about as often at any place of the list."""
        return tuple(sorted(read_items(self.specification).all, key=lambda one: one.key))

    @property
    def looks(self) -> dict[str, str]:
        """File → content, of the nouns that take the place of embedded ones."""
        folder = self.specification.options.get("assets")
        files = sorted(Path(folder).rglob("*.toml")) if folder else []
        return {one.name: one.read_text(encoding="utf-8") for one in files}

    def threshold_of(self, clip: str, matched: float | None) -> float | None:
        """Contrast threshold of a clip.

        Args:
            clip: name that its chance depends on.
            matched: that of the arm, where the arm says none.
        """
        chance = np.random.default_rng(derived_seed(2, clip))
        if len(self.threshold) > 1:
            low, high = map(math.log, self.threshold)
            return math.exp(chance.uniform(low, high))
        found = self.threshold[0] if self.threshold else matched
        return None if found is None else found * math.exp(chance.normal(0, self.spread))


def read_factors(path: Path, arms: Mapping[Test, Mapping[str, Arm]]) -> dict[Test, dict[str, Arm]]:
    """The arm that a file names, on each test, and the arms that differ from it in one property.

    Args:
        path: a TOML file: `arm`, and a table `factors.NAME.TEST` each with some of `options` (of
            the simulator), `scenes` (options of the scenes), `vary`, `clips` (a factor of their
            number), `threshold`, `spread`, `times` and `stream`; see `Arm`.
        arms: test → arms of its specification.

    Raises:
        InputError: the file cannot be read.
        ConfigError: it names another arm, test or property.
    """
    document = read_document(path)
    _known(document, ("arm", "factors"), str(path))
    first = next(iter(arms.values()))
    name = document.get("arm")
    if name not in first:
        raise ConfigError(f"{path}: arm is {shown(name)}; it must be one of {', '.join(first)}")
    found = {test: {str(name): of_test[str(name)]} for test, of_test in arms.items()}
    for factor, tests in document.get("factors", {}).items():
        _known(tests, tuple(arms), f"{path}: {factor}")
        for test, changes in tests.items():
            where = f"{path}: {factor}, {test}"
            found[test][factor] = _changed(found[test][str(name)], changes, path.parent, where)
    return found


def _changed(arm: Arm, changes: Mapping[str, Any], folder: Path, where: str) -> Arm:
    _known(changes, CHANGES, where)
    times: Times = changes.get("times", arm.times)
    stream = changes.get("stream", arm.stream)
    for name, value, allowed in (("times", times, TIMES), ("stream", stream, ("", *RANGES))):
        if value not in allowed:
            known = suggest(str(value), tuple(one for one in allowed if one))
            raise ConfigError(f"{where}: {name} is {shown(value)}; {known}")
    share, spread = (
        float(convert(changes.get(name, usual), float, f"{where}: {name}"))
        for name, usual in (("clips", 1.0), ("spread", arm.spread))
    )
    sources = tuple(
        replace(
            one,
            vary={**one.vary, **changes.get("vary", {})},
            count=None if one.count is None else max(1, round(one.count * share)),
        )
        for one in arm.specification.sources
    )
    scenes = {**arm.specification.options, **with_folder(changes.get("scenes", {}), folder)}
    threshold = convert(changes.get("threshold", ()), tuple[float, ...], f"{where}: threshold")
    if len(threshold) > 2 or not all(0 < one < math.inf for one in threshold):
        raise ConfigError(
            f"{where}: threshold is {shown(threshold)}; give one above 0, or the lowest and highest"
        )
    return Arm(
        replace(arm.specification, sources=sources, options=scenes),
        {**arm.options, **changes.get("options", {})},
        threshold,
        spread,
        times,
        stream,
    )


def with_folder(options: Mapping[str, Any], folder: Path) -> dict[str, Any]:
    """Options of scenes whose `assets` count from a folder; "" is none."""
    own = options.get("assets")
    return dict(options) if own is None else {**options, "assets": own and str(folder / own)}


def _known(table: Any, names: tuple[str, ...], where: str) -> None:
    if not isinstance(table, Mapping):
        raise ConfigError(f"{where} is {shown(table)}; it must be a table")
    for name in table:
        if name not in names:
            raise ConfigError(f"{where}: unknown {shown(name)}; {suggest(name, names)}")
