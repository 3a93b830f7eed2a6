"""A small data set, made once for the tests of what is done with data sets."""

import shutil
from pathlib import Path
from typing import Any

import numpy as np
import pytest
from tests.dataset.generation.small_sets import make
from tests.dataset.stored.written_set import write_set

from texvent.dataset.generation.recipe import Recipe
from texvent.dataset.sample_table import SampleTable
from texvent.dataset.simulated_samples import SimulatedSamples
from texvent.dataset.specification.reading import specification_from
from texvent.dataset.stored.folder import StoredDataset
from texvent.dataset.stored.stored_samples import open as open_samples
from texvent.events import EventStream

CARS: dict[str, Any] = {
    "name": "cars",
    "description": "Cars & buses <b>that</b> drive left.",
    "license": "cc-by-4.0",
    "seed": 3,
    "samples_per_shard": 2,
    "filters": {"min_events": 1},
    "splits": {"train": 0.67, "test": 0.33},
    "options": {
        "duration": 0.1,
        "sensor": "32x24",
        "interpolate": "none",
        "contrast_threshold": {"uniform": [0.1, 0.3]},
    },
    "sources": [
        {"prompts": ["a red car drives left", "a blue car | zooms & <i>drives</i> left"],
         "label": "car"},
        {"prompts": ["a red bus drives left"], "label": "bus"},
    ],
    "variants": {"paper": {"seeds": 2}, "esim": {"simulator": "esim"}},
}  # fmt: skip
"""Three clips, two splits, two variants: nine samples in four shards."""


def make_set(folder: Path, **changes: Any) -> Path:
    """The data set `CARS`, changed, made in a new folder."""
    recipe = Recipe.of(specification_from({**CARS, **changes}, folder=Path()))
    assert not make(recipe, folder).failures
    return folder


def samples_of(folder: Path, variant: str = "paper") -> dict[str, tuple[str, str, EventStream]]:
    """Key → split, class, events."""
    return {
        sample.key: (shard.record.split, sample.label or "", shard.files(sample).events())
        for shard in StoredDataset.open(folder).shards(variant)
        for sample in shard.samples
    }


def assert_same(columns: Any, events: EventStream) -> None:
    """Columns of numbers of any kind, by their names, are those of the events."""
    for name in "xytp":
        found = np.asarray(columns[name]).astype(np.int64)
        np.testing.assert_array_equal(found, getattr(events, name))


@pytest.fixture(scope="session")
def cars(tmp_path_factory: pytest.TempPathFactory) -> Path:
    """The folder of `CARS`; tests that change it take `copied`."""
    return make_set(tmp_path_factory.mktemp("cars") / "cars")


@pytest.fixture
def copied(cars: Path, tmp_path: Path) -> Path:
    """A copy of `cars` that a test may change."""
    return shutil.copytree(cars, tmp_path / "cars")


CLIP = np.full((6, 12, 16), 200, np.uint8)
for _index in range(6):
    CLIP[_index, 4:8, 2 * _index : 2 * _index + 4] = 20
"""A dark square that steps right."""


@pytest.fixture(scope="session", params=["stored", "simulated"])
def table(request: pytest.FixtureRequest, tmp_path_factory: pytest.TempPathFactory) -> SampleTable:
    """Events of both kinds of samples."""
    if request.param == "simulated":
        options = {"fps": 50, "sensor": "16x12", "interpolate": "none", "randomize": "stoffregen"}
        videos = [CLIP, CLIP[::-1].copy()]
        return SimulatedSamples(videos=videos, representation=None, simulation=options)
    folder = tmp_path_factory.mktemp("set") / "cars"
    write_set(folder)
    return open_samples(folder)


def dropped(events: EventStream, chance: np.random.Generator) -> EventStream:
    """An augmentation: mirrored by chance, some events dropped."""
    events = events.flip("x") if chance.random() < 0.5 else events
    return events[chance.random(len(events)) < 0.7]
