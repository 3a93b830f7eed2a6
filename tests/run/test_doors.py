"""Every way to make a run: events, provenance and warnings are those of the function."""

import csv
import shutil
import warnings
from collections.abc import Iterable, Mapping
from pathlib import Path
from typing import Any, NamedTuple

import cv2
import numpy as np
import pytest
from tests.cli.running import run
from tests.dataset.generation.small_sets import make
from tests.scenes.assets.glb_bar import write_bar

import texvent
from texvent.dataset.generation.recipe import Recipe
from texvent.dataset.simulated_samples import SimulatedSamples
from texvent.dataset.specification.reading import specification_from
from texvent.dataset.stored.folder import StoredDataset
from texvent.errors import TexventWarning
from texvent.events import EventStream

SEED = 5
CLIP = {"fps": 10, "interpolate": "none"}
SCENE = {"sensor": "32x24", "duration": 0.1, "samples": 1}
FINE = {**SCENE, "contrast_threshold": 0.12}


class Case(NamedTuple):
    """A video or a sentence, and options."""

    subject: str
    options: Mapping[str, Any]
    kind: str = "video"

    @property
    def function(self) -> Any:
        return texvent.simulate if self.kind == "video" else texvent.generate

    @property
    def words(self) -> list[str]:
        """The options as flags."""
        named = [(f"--{name.replace('_', '-')}", one) for name, one in self.options.items()]
        return [flag if one is True else f"{flag}={one}" for flag, one in named]


PROMPT = "a red car drives left"
CASES = {
    "models": Case("clip.npy", {**CLIP, "simulator": "esim", "contrast_threshold": 0.3}),
    "between": Case("clip.npy", {"fps": 10, "interpolate": "blend", "max_intermediate": 3}),
    "sensor": Case("clip.npy", {**CLIP, "sensor": "20x16", "fit": "contain", "white_level": 180.0}),
    "noise": Case("clip.npy", {**CLIP, "noise_rate_hz": 900.0, "keep_events": "noise"}),
    "part": Case("clip.npy", {**CLIP, "label_noise": True, "start": 0.1, "stop": 0.5}),
    "drawn": Case("clip.npy", {**CLIP, "randomize": "v2v", "transfer": "linear"}),
    "rate": Case("clip.npy", {**CLIP, "target_rate": 9000.0, "noise": "none"}),
    "times": Case("images", {"interpolate": "none"}),
    "paper": Case(PROMPT, {**SCENE, "interpolate": "none", "label_noise": True}, "prompt"),
    "esim": Case(PROMPT, {**SCENE, "simulator": "esim", "fps": 40}, "prompt"),
    "assets": Case(
        "a red car drives left past a wug", {**SCENE, "assets": "wugs", "fps": 40}, "prompt"
    ),
    "scene": Case("wug.toml", {**FINE, "assets": "wugs", "interpolate": "none"}, "prompt"),
    "lost": Case("a wug and a red ball", {**SCENE, "contrast_threshold": 3.0}, "prompt"),
}


@pytest.fixture(scope="module")
def bar(tmp_path_factory: pytest.TempPathFactory) -> Path:
    """A model of a user."""
    return write_bar(tmp_path_factory.mktemp("models") / "bar.glb")


@pytest.fixture
def place(tmp_path: Path, bar: Path, monkeypatch: pytest.MonkeyPatch) -> Path:
    """A folder with a clip and a folder of images with their times, where commands run."""
    frames = np.random.default_rng(2).integers(0, 180, (7, 12, 16)).astype(np.uint8)
    np.save(tmp_path / "clip.npy", frames)
    (tmp_path / "images").mkdir()
    for number, image in enumerate(frames):
        cv2.imwrite(str(tmp_path / "images" / f"{number}.png"), image)
    times = "".join(f"{0.02 * number**2 + 0.01 * number:.4f}\n" for number in range(7))
    (tmp_path / "images" / "timestamps.txt").write_text(times)
    (tmp_path / "wugs").mkdir()
    shutil.copy(bar, tmp_path / "wugs" / "wug.glb")
    (tmp_path / "wug.toml").write_text(
        '[[objects]]\nnoun = "wug"\n[[objects]]\nnoun = "ball"\nmotions = [{ kind = "bounce" }]\n'
    )
    monkeypatch.chdir(tmp_path)
    return tmp_path


def by_packets(case: Case) -> EventStream:
    packets = case.function(case.subject, as_packets=True, seed=SEED, **case.options)
    return packets.collect()


def by_saving(case: Case) -> EventStream:
    packets = case.function(case.subject, as_packets=True, seed=SEED, **case.options)
    return texvent.load(packets.save("saved.h5"))


def by_config(case: Case) -> EventStream:
    Path("run.yaml").write_text(
        "".join(f"{name}: {one}\n" for name, one in (case.options | {"seed": SEED}).items())
    )
    return case.function(case.subject, config="run.yaml")


def by_command(case: Case) -> EventStream:
    command = "simulate" if case.kind == "video" else "generate"
    words = [command, case.subject, "-o", "made.h5", f"--seed={SEED}", *case.words]
    assert run(*words, "--previews", "none", "--quiet") == 0
    return texvent.load("made.h5")


def by_repeating(case: Case) -> EventStream:
    by_command(case)
    return case.function(case.subject, config="made.h5")


def by_batch(case: Case) -> EventStream:
    with open("list.csv", "w", newline="", encoding="utf-8") as file:
        csv.writer(file).writerows([(case.kind, "name", "seed"), (case.subject, "made", SEED)])
    assert run("batch", "list.csv", "-o", "out", *case.words, "--previews", "none") == 0
    return texvent.load("out/made.h5")


def by_samples(case: Case) -> EventStream:
    sources = {f"{case.kind}s": [case.subject]}
    samples = SimulatedSamples(**sources, representation=None, simulation=case.options, seed=SEED)
    run = case.function(case.subject, seed=samples.seed_of(0), as_packets=True, **case.options)
    return samples.make(0)["events"].with_metadata(run.metadata)


def by_data_set(case: Case) -> EventStream:
    kind = "scene" if case.subject.endswith(".toml") else f"{case.kind}s"
    sources = [{kind: case.subject if kind == "scene" else [case.subject]}]
    tables = {"name": "one", "options": dict(case.options), "sources": sources}
    folder, filters = Path().absolute(), {"min_events": 0}
    recipe = Recipe.of(specification_from({**tables, "filters": filters}, folder=folder))
    assert not make(recipe, folder / "set").failures
    (shard,) = StoredDataset.open(folder / "set").shards()
    (sample,) = shard.samples
    return shard.files(sample).events()


def by_truth(case: Case) -> EventStream:
    given = {"seed": SEED, **case.options}
    return case.function(case.subject, truth_folder="a.truth", **given).with_ids(None, None)


DOORS = {
    "packets": by_packets,
    "saving": by_saving,
    "config": by_config,
    "command": by_command,
    "repeating": by_repeating,
    "batch": by_batch,
    "samples": by_samples,
    "data set": by_data_set,
    "truth": by_truth,
}
DRAW_SEEDS = ("samples", "data set")
"""Doors that derive the seed of each sample from their own."""
OF_PLACES = ("source", "format")


def rows(events: EventStream) -> dict[str, list[int]]:
    """All columns."""
    return {name: column.tolist() for name, column in events.columns().items()}


def facts(events: EventStream, names: Iterable[str]) -> dict[str, Any]:
    """Provenance by name, without what names the place of files."""
    return {name: events.metadata.get(name) for name in names if name not in OF_PLACES}


@pytest.mark.parametrize("door", DOORS)
@pytest.mark.parametrize("name", CASES)
@pytest.mark.filterwarnings("ignore")
def test_each_door_makes_the_run_of_the_function(name, door, place):
    case = CASES[name]
    if door == "truth" and case.kind == "video":
        case = CASES["paper"]  # a film without a scene has no truth
    found = DOORS[door](case)
    seed = found.metadata["seed"]
    assert (seed == SEED) is (door not in DRAW_SEEDS)
    expected = case.function(case.subject, seed=seed, **case.options)
    assert len(expected) > 10 or name == "lost"
    assert rows(found) == rows(expected)
    assert facts(found, expected.metadata) == facts(expected, expected.metadata)


@pytest.mark.parametrize("door", ["function", "packets", "command", "batch"])
def test_the_words_for_a_video_are_stored_by_each_door(door, place):
    if door == "command":
        words = ("simulate", "clip.npy", "--fps", 10, "-o", "a.h5", "--previews", "none", "-q")
        assert run(*words, "--prompt", PROMPT) == 0
        events = texvent.load("a.h5")
    elif door == "batch":
        Path("list.csv").write_text(f"video,prompt,name\nclip.npy,{PROMPT},a\n")
        assert run("batch", "list.csv", "-o", "out", "--fps", 10, "--previews", "none", "-q") == 0
        events = texvent.load("out/a.h5")
    else:
        events = texvent.simulate("clip.npy", fps=10, prompt=PROMPT, as_packets=door == "packets")
    assert events.metadata["prompt"] == PROMPT


@pytest.mark.parametrize("door", ["truth", "command", "batch"])
def test_each_door_says_what_the_function_warns_of(door, place, capsys):
    case = CASES["lost"]
    with pytest.warns(TexventWarning) as warned:
        case.function(case.subject, seed=SEED, **case.options)
    with warnings.catch_warnings(record=True) as told:
        warnings.simplefilter("always")
        DOORS[door](case)
    said = [str(one.message) for one in told] + capsys.readouterr().err.splitlines()
    for one in warned:
        assert any(str(one.message)[:60] in line for line in said), said


@pytest.mark.parametrize("assets", [None, "wugs"])
def test_a_written_scene_has_the_models_of_the_user(assets, place, capsys):
    given = [] if assets is None else ["--assets", assets]
    words = ("generate", "a wug and a red bus drive left", "--write-scene", "a.toml", *given)
    assert run(*words) == 0
    scene = Path("a.toml").read_text()
    is_known = assets is not None
    assert ('noun = "wug"' in scene) is is_known
    assert ("not understood: wug" in capsys.readouterr().err) is not is_known
