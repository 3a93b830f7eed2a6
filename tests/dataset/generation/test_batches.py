"""Clips of a shard as one batch of a device: the samples that each gives alone on the CPU."""

import json
from pathlib import Path
from typing import Any

import numpy as np
import pytest

pytestmark = pytest.mark.torch
torch = pytest.importorskip("torch")
pytest.importorskip("triton")

from tests.dataset.generation.small_sets import make  # noqa: E402

from texvent.dataset.generation.recipe import Recipe  # noqa: E402
from texvent.dataset.generation.shard_files import (  # noqa: E402
    FAILED,
    FILTERED,
    MADE,
    read_members,
    read_record,
)
from texvent.dataset.specification.reading import specification_from  # noqa: E402
from texvent.simulation.gpu import engine  # noqa: E402

LENGTHS = 5, 3, 4, 3, 4
QUIET, DAMAGED, WIDE = 2, 3, 4
"""Clips without events, with NaN, and of another size."""
VARIANTS = {
    "paper": {"preset": "paper", "interpolate": "blend", "max_intermediate": 2, "seeds": 2},
    "esim": {"simulator": "esim", "interpolate": "none"},
    "v2e": {"simulator": "v2e", "interpolate": "none"},
}
"""The last has no kernels for a GPU."""


@pytest.fixture
def batches(monkeypatch: pytest.MonkeyPatch) -> list[int]:
    """Numbers of clips of the calls of kernels; torch's CPU device stands for the GPU."""
    cpu, seen, step = torch.device("cpu"), list[int](), engine.GpuSimulator.step

    def noting(self: Any, frames: Any, *rest: Any) -> Any:
        seen.append(len(frames))
        return step(self, frames, *rest)

    support = "texvent.simulation.gpu.support"
    monkeypatch.setattr(f"{support}.find_gpu", lambda wish: cpu)
    monkeypatch.setattr(f"{support}.triton_fault", lambda: None)
    monkeypatch.setattr(engine.GpuSimulator, "step", noting)
    return seen


def recipe_of(folder: Path) -> Recipe:
    random = np.random.default_rng(0)
    (folder / "clips").mkdir()
    for number, length in enumerate(LENGTHS):
        width = 16 if number == WIDE else 12
        clip = random.integers(40, 200, (length, 8, width)).astype(np.uint8)
        if number == QUIET:
            clip[:] = 100
        if number == DAMAGED:
            clip = np.where(np.arange(length)[:, None, None] == 2, np.nan, clip)
        np.save(folder / "clips" / f"{number}.npy", clip)
    tables = {
        "name": "tiny",
        "samples_per_shard": len(LENGTHS),
        "filters": {"min_events": 1, "max_events": 2_000},
        "options": {"fps": 120},
        "sources": [{"videos": ["clips/*.npy"]}],
        "splits": {"train": 1.0},
        "variants": VARIANTS,
    }
    return Recipe.of(specification_from(tables, folder=folder))


def samples_of(path: Path) -> list[Any]:
    """Record and files of each sample of a shard; without the device, and where the files are."""
    record = read_record(path)
    assert record is not None
    found = []
    for one in record.samples:
        members = dict(read_members(path, one.members)) if one.members else {}
        facts = json.loads(members.pop("json", b"{}"))
        facts.pop("device", None)
        found.append((one.key, one.status, one.reason, one.warnings, members, facts))
    return found


def test_a_batch_gives_the_samples_that_clips_give_alone(tmp_path, batches):
    recipe = recipe_of(tmp_path)
    make(recipe, tmp_path / "alone", device="cpu")
    assert batches == []
    make(recipe, tmp_path / "together", device="auto")
    for variant in VARIANTS:
        alone, together = (
            samples_of(tmp_path / name / variant / "train-000000.tar")
            for name in ("alone", "together")
        )
        assert together == alone
        assert {one[1] for one in alone} == {MADE, FAILED, FILTERED}
    # Those of one size, in two seeds, but for the damaged one.
    assert max(batches) == 6
    batches.clear()
    make(recipe, tmp_path / "together", device="auto", retry_failed=True)
    assert max(batches, default=0) <= 2  # the damaged clip alone
