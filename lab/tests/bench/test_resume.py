"""Benchmarks that keep their steps, disturbed between two runs, end as undisturbed ones."""

import zipfile
from collections.abc import Callable, Iterator
from dataclasses import replace
from pathlib import Path
from typing import Any

import pytest
from tests.resume.disturbed import DISTURBANCES, Resumable, Runs, undisturbed

from ..train.written_samples import as_weights
from .detection.test_training import CARS
from .digits.synthetic_data import write_mnist, write_recordings
from .objects.stand_in import write_frames, write_specifications, write_turntables

RESULT = ("-o", "out/result.json", "--overwrite", "--quiet", "--seeds", 1)
DIGITS = (
    *("bench", "digits", "--mnist", "mnist", "--nmnist", "../nmnist", "--work", "out/work"),
    *("--quick", "--arms", "frame difference", "--ways", "frames", "--digits", 10, "--jobs", 1),
    *RESULT,
)
OBJECTS = (
    *("bench", "objects", "configs", "--frames", "frames", "--turntables", "turntables"),
    *("--work", "out/work", "--arms", "difference", "--steps", 1, *RESULT),
)
DETECTION = (
    *("bench", "detection", "cars.toml", "--work", "out/work", "--epochs", 1, "--batch-size", 2),
    *("--device", "cpu", *RESULT),
)


def write_digits() -> None:
    Path("out").mkdir()
    images = write_mnist(Path("mnist"), count=200)
    write_recordings(Path("../nmnist"), images, train=500, pairs=100)


def other_digit() -> None:
    path = Path("mnist/t10k-labels-idx1-ubyte")
    content = path.read_bytes()
    path.write_bytes(content[:-1] + bytes([(content[-1] + 1) % 10]))


def write_objects() -> None:
    Path("out").mkdir()
    write_specifications(Path("configs"))
    write_frames(Path("frames"))
    write_turntables(Path("turntables"))


def write_cars() -> None:
    Path("out").mkdir()
    Path("cars.toml").write_text(CARS)


def make_detectors_narrow(patch: pytest.MonkeyPatch) -> None:
    """A quarter of the channels of evlib's smallest network."""
    from evlib.models.rvt_backbone import RVTConfig

    narrow = RVTConfig(embed_dim=8, dim_head=8)
    patch.setattr(RVTConfig, "tiny", lambda: replace(narrow))


def other_text(path: str, old: str, new: str) -> Callable[[], None]:
    return lambda: Path(path).write_text(Path(path).read_text().replace(old, new)) and None


def as_arrays(path: Path) -> dict[str, Any]:
    """Stored bytes of arrays: padding of records that are read is anything."""
    with zipfile.ZipFile(path) as archive:
        return {name: archive.read(name) for name in archive.namelist()}


KEPT = {"index": ("result.json",), "rewritten": ("result.json",)}
KEPT |= {"named": ("*.npz",), "readers": {".npz": as_arrays}}
BENCHMARKS = {
    "digits": Resumable(
        prepare=write_digits,
        words=DIGITS,
        changes={
            "content": other_digit,
            "option": lambda: (*DIGITS, "--digits", 20),
            "seed": lambda: (*DIGITS, "--seeds", 2),
        },
        **KEPT,
    ),
    "objects": Resumable(
        prepare=write_objects,
        words=OBJECTS,
        changes={
            "content": other_text("frames/labels/cup_1.txt", " ", "  "),
            "scene": other_text("configs/scene.toml", "speed_m_s = 0.1", "speed_m_s = 0.2"),
            "option": lambda: (*OBJECTS, "--steps", 2),
            "arm": other_text("configs/table.toml", 'noise = "none"', ""),
        },
        **KEPT,
    ),
    "detection": Resumable(
        prepare=write_cars,
        words=DETECTION,
        changes={
            "clips": other_text("cars.toml", "a red", "a blue"),
            "option": lambda: (*DETECTION, "--passes", 2),
            "seed": lambda: (*DETECTION, "--seeds", 2),
        },
        index=("result.json", "checkpoint.pt", "scores.json", "*.json", "*.jsonl"),
        rewritten=("result.json", "weights.pt", "history.json", "curves.png"),
        readers={".npz": as_arrays, ".pt": as_weights},
    ),
}


@pytest.fixture(
    scope="module",
    params=[
        pytest.param(one, marks=pytest.mark.detect if one == "detection" else pytest.mark.torch)
        for one in BENCHMARKS
    ],
)
def runs(
    request: pytest.FixtureRequest, tmp_path_factory: pytest.TempPathFactory
) -> Iterator[Runs]:
    torch = pytest.importorskip("torch", reason="make test-torch runs the tests that need torch")
    torch.set_num_threads(1)
    places = tmp_path_factory.mktemp("runs")
    with pytest.MonkeyPatch.context() as patch:
        patch.setenv("TEXVENT_DATA", str(places / "no recordings"))
        if request.param == "detection":
            make_detectors_narrow(patch)
        with undisturbed(BENCHMARKS[request.param], places) as runs:
            yield runs


@pytest.mark.long
@pytest.mark.parametrize("disturb", DISTURBANCES)
def test_a_benchmark_ends_as_an_undisturbed_one_or_says_why_not(runs, disturb, capsys):
    disturb(runs, capsys)
