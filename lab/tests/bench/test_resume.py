"""Benchmarks that keep their steps, disturbed between two runs, end as undisturbed ones."""

from __future__ import annotations

import zipfile
from collections.abc import Callable, Iterator
from pathlib import Path
from typing import Any

import pytest
from tests.resume.disturbed import DISTURBANCES, Resumable, Runs, undisturbed

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
}


@pytest.fixture(
    scope="module",
    params=[pytest.param(one, marks=pytest.mark.torch) for one in BENCHMARKS],
)
def runs(
    request: pytest.FixtureRequest, tmp_path_factory: pytest.TempPathFactory
) -> Iterator[Runs]:
    torch = pytest.importorskip("torch", reason="make test-torch runs the tests that need torch")
    torch.set_num_threads(1)
    with undisturbed(BENCHMARKS[request.param], tmp_path_factory.mktemp("runs")) as runs:
        yield runs


@pytest.mark.long
@pytest.mark.parametrize("disturb", DISTURBANCES)
def test_a_benchmark_ends_as_an_undisturbed_one_or_says_why_not(
    runs: Runs,
    disturb: Callable[[Runs, pytest.CaptureFixture[str]], None],
    capsys: pytest.CaptureFixture[str],
) -> None:
    disturb(runs, capsys)
