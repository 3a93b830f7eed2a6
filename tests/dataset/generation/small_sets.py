"""Small data sets to make, and what is compared of them."""

import hashlib
from contextlib import closing
from pathlib import Path
from typing import Any

import numpy as np

from texvent.dataset.generation.make import find_work
from texvent.dataset.generation.recipe import Recipe
from texvent.dataset.specification.reading import specification_from
from texvent.runtime.work.engines import Engine, SerialEngine, Work


def clips_recipe(folder: Path, *, clips: int = 6, **changes: Any) -> Recipe:
    """A recipe of tiny clips that are written to a folder: 4 samples per clip, 2 clips a shard."""
    (folder / "clips").mkdir()
    random_pixels = np.random.default_rng(0)
    for number in range(clips):
        clip = random_pixels.integers(0, 255, (6, 12, 16), dtype=np.uint8)
        np.save(folder / "clips" / f"{number}.npy", clip)
    tables = {
        "name": "tiny",
        "samples_per_shard": 2,
        "previews": False,
        "filters": {"min_events": 1},
        "options": {"fps": 120, "interpolate": "none"},
        "sources": [{"videos": ["clips/*.npy"]}],
        "variants": {"paper": {"seeds": 3}, "esim": {"simulator": "esim"}},
    }
    return Recipe.of(specification_from({**tables, **changes}, folder=folder))


def make(recipe: Recipe, folder: Path, engine: Engine | None = None, **options: Any) -> Work:
    """Make a data set, by one process if no engine is given; options as `find_work`."""
    recipe.begin(folder)
    work = find_work(recipe, folder, **options)
    with closing(engine or SerialEngine()) as running:
        list(work.make(running))
    return work


def digests(folder: Path) -> dict[str, str]:
    """Path of every shard → sha256 of its bytes."""
    return {
        str(path.relative_to(folder)): hashlib.sha256(path.read_bytes()).hexdigest()
        for path in sorted(folder.rglob("*.tar"))
    }
