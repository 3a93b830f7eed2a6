"""Whatever happens between two runs, the second ends as an undisturbed one, or says why not."""

from collections.abc import Callable, Iterator
from pathlib import Path

import cv2
import numpy as np
import pytest
from tests.cli.running import run
from tests.resume.disturbed import DISTURBANCES, Resumable, Runs, undisturbed

from texvent.dataset.export import LAYOUTS


def write_video(name: str, seed: int) -> None:
    path = Path(name)
    path.parent.mkdir(parents=True, exist_ok=True)
    np.save(path, np.random.default_rng(seed).integers(0, 255, (4, 12, 16), dtype=np.uint8))


def write_videos() -> None:
    for seed, name in enumerate("ab"):
        write_video(f"clips/{name}.npy", seed)
    Path("times.txt").write_text("".join(f"{t / 100}\n" for t in range(4)))
    other_sensor(0.3)


def other_sensor(threshold: float = 0.4) -> None:
    Path("own.toml").write_text(f"contrast_threshold = {threshold}\n")


def other_video() -> None:
    write_video("clips/a.npy", 9)


def other_times() -> None:
    Path("times.txt").write_text("".join(f"{t / 100}\n" for t in (0, 1, 2, 4)))


def write_folders() -> None:
    for name in "ab":
        place = Path("clips", name)
        place.mkdir(parents=True)
        for number in range(4):
            cv2.imwrite(str(place / f"{number}.png"), _picture(number))
    Path("clips/b/timestamps.txt").write_text("0\n0.01\n0.02\n0.03\n")
    Path("folders.toml").write_text(FOLDERS)


def _picture(seed: int) -> np.ndarray:
    return np.random.default_rng(seed).integers(0, 255, (12, 16), dtype=np.uint8)


TIMES = "0\n0.01\n0.02\n0.04\n"
OF_FOLDERS: dict[str, Callable[[], None]] = {
    "image": lambda: cv2.imwrite("clips/a/1.png", _picture(9)) and None,
    "one more": lambda: cv2.imwrite("clips/a/4.png", _picture(9)) and None,
    "one less": Path("clips/a/3.png").unlink,
    "times": lambda: Path("clips/a/timestamps.txt").write_text(TIMES) and None,
    "times beside": lambda: Path("clips/timestamps.txt").write_text(TIMES) and None,
    "no times": Path("clips/b/timestamps.txt").unlink,
}
"""Changes of folders of images, of which one had no times and the other had some."""


FLAT = ("--interpolate", "none", "--simulator", "esim")
DRAFT = ("--samples", 1, *FLAT)
VIDEOS = (
    *("batch", "clips/a.npy", "clips/b.npy", "-o", "out", "--timestamps", "times.txt"),
    *("--format", "atis", "--previews", "png", "--sensor", "own.toml", *FLAT),
)
PROMPTS = (
    *("batch", "p.csv", "-o", "out", "--sensor", "16x12", "--duration", "0.05", *DRAFT),
    *("--format", "atis", "--previews", "png", "--truth", "depth,boxes"),
)


def other_prompts(rows: str) -> Callable[[], None]:
    return lambda: Path("p.csv").write_text("prompt,name\n" + rows) and None


SPECIFICATION = """
name = "tiny"
samples_per_shard = 1
filters = { min_events = 1 }
options = { interpolate = "none", timestamps = "times.txt" }
sources = [{ videos = ["clips/*.npy"] }]
variants = { paper = { seeds = 2 }, esim = { simulator = "esim", sensor = "own.toml" } }
"""
FOLDERS = """
name = "folders"
options = { interpolate = "none", simulator = "esim", fps = 100 }
sources = [{ videos = ["clips/a", "clips/b"] }]
"""
MAKE = ("dataset", "make", "tiny.toml", "-o", "out", "--workers", 1, "-q")


def write_specification() -> None:
    write_videos()
    Path("tiny.toml").write_text(SPECIFICATION)


def other_specification(old: str, new: str) -> Callable[[], None]:
    return lambda: Path("tiny.toml").write_text(SPECIFICATION.replace(old, new)) and None


CARS = """
name = "cars"
samples_per_shard = 1
filters = { min_events = 1 }
splits = { train = 0.5, val = 0.5 }
options = { duration = 0.1, sensor = "32x24", samples = 1, interpolate = "none" }
sources = [{ prompts = ["a red car drives left", "a blue car drives right"], label = "car" }]
variants = { esim = { simulator = "esim" } }
"""


def write_cars(how: str) -> Callable[[], None]:
    return lambda: Path("cars.toml").write_text(how + CARS) and None


def make_cars() -> None:
    write_cars('truth = ["boxes"]')()
    assert run("dataset", "make", "cars.toml", "-o", "set", "--workers", 1, "-q") == 0


MAKE_SET = ("dataset", "make", "tiny.toml", "-o", "set", "--workers", 1, "-q")


def make_set() -> None:
    write_specification()
    assert run(*MAKE_SET) == 0


def make_set_again(seed: int | None) -> Callable[[], None]:
    """The same data set with another video, or with one that shows nothing."""

    def change() -> None:
        write_video("clips/a.npy", 9)
        if seed is None:
            np.save("clips/a.npy", np.zeros((4, 12, 16), np.uint8))
        assert run(*MAKE_SET) == 0

    return change


EXPORT_INDEX = ("texvent-export.json", "texvent-export.jsonl")
LISTS = ("*_list.txt", "out/*.txt", "annotations.json", "*.yaml")
EXPORT = ("dataset", "export", "set", "--layout", "timelens", "-o", "out")


RESUMABLE = {
    "batch of videos": Resumable(
        prepare=write_videos,
        words=VIDEOS,
        index=("samples.jsonl", "batch.json"),
        changes={
            "content": other_video,
            "times": other_times,
            "sensor": other_sensor,
            "option": lambda: (*VIDEOS, "--contrast-threshold", 0.4),
            "seed": lambda: (*VIDEOS, "--seed", 5),
        },
    ),
    "batch of folders": Resumable(
        prepare=write_folders,
        words=("batch", "clips/a", "clips/b", "-o", "out", "--fps", 100, "--format", "atis", *FLAT),
        index=("samples.jsonl", "batch.json"),
        changes=OF_FOLDERS,
    ),
    "batch of prompts": Resumable(
        prepare=other_prompts("a red car drives left,car\n"),
        words=PROMPTS,
        index=("samples.jsonl", "batch.json"),
        changes={
            "prompt": other_prompts("a red car drives right,car\n"),
            "row": other_prompts("a ball bounces,ball\na red car drives left,car\n"),
        },
    ),
    "dataset make": Resumable(
        prepare=write_specification,
        words=MAKE,
        index=("specification.json", "items.jsonl", "*/*.json"),
        changes={
            "content": other_video,
            "times": other_times,
            "sensor": other_sensor,
            "option": other_specification("min_events = 1", "min_events = 2"),
            "seed": other_specification("samples_per", "seed = 4\nsamples_per"),
        },
        checks=("dataset", "verify", "out"),
    ),
    "dataset make of folders": Resumable(
        prepare=write_folders,
        words=("dataset", "make", "folders.toml", "-o", "out", "--workers", 1, "-q"),
        index=("specification.json", "items.jsonl", "*/*.json"),
        changes=OF_FOLDERS,
        checks=("dataset", "verify", "out"),
    ),
    "dataset make with videos": Resumable(
        prepare=write_cars("store_videos = true"),
        words=("dataset", "make", "cars.toml", "-o", "out", "--workers", 1, "-q"),
        index=("specification.json", "items.jsonl", "*/*.json"),
        checks=("dataset", "verify", "out"),
    ),
    **{
        f"dataset export {name}": Resumable(
            prepare=make_cars,
            words=("dataset", "export", "set", "--layout", name, "-o", "out"),
            index=EXPORT_INDEX,
            rewritten=LISTS,
        )
        for name in LAYOUTS
    },
    "dataset export of videos": Resumable(
        prepare=make_set,
        words=(*EXPORT, "--variant", "esim"),
        index=EXPORT_INDEX,
        changes={
            "content": make_set_again(9),
            "nothing to see": make_set_again(None),
            "option": lambda: (*EXPORT, "--variant", "paper"),
        },
    ),
}


@pytest.fixture(scope="module", params=RESUMABLE)
def runs(
    request: pytest.FixtureRequest, tmp_path_factory: pytest.TempPathFactory
) -> Iterator[Runs]:
    with undisturbed(RESUMABLE[request.param], tmp_path_factory.mktemp("runs")) as runs:
        yield runs


@pytest.mark.long
@pytest.mark.parametrize("disturb", DISTURBANCES)
def test_a_second_run_ends_as_an_undisturbed_one_or_says_why_not(runs, disturb, capsys):
    disturb(runs, capsys)
