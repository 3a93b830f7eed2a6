"""Trainings of reconstruction that differ in one property of the clips, and their scores."""

import sys
from pathlib import Path

import cv2
import numpy as np
import pytest

from texvent.dataset import read_specification
from texvent.dataset.generation.recipe import Recipe
from texvent.errors import ConfigError
from texvent.settings.config_files import read_document as read_configuration
from texvent_lab.bench.document import read_document
from texvent_lab.bench.page import page_files
from texvent_lab.bench.reconstruction.factors import FactorScore, factors_table

from ..train.windowed_specification import TEXT

TRAINING = """\
network = {name = "firenet"}
loss = {lpips = 0.0, l1 = 1.0}
[data]
specification = "tiny.toml"
variant = "paper"
slice_us = 20000
length = 4
crop = 16
cache = "cache"
[schedule]
epochs = 1
batch_size = 1
"""
FACTORS = """\
training = "training.toml"
[factors."as it is"]
[factors."threshold .4"]
options = {contrast_threshold = 0.4}
[factors."frame times"]
video = {fps = 40}
options = {interpolate = "none", timestamp_rule = "end"}
[factors.streamed]
video = {fps = 100}
stream = "v2v"
[factors.esim]
specification = "tiny.toml"
variant = "esim"
"""


@pytest.fixture(scope="module")
def made(torch):
    from texvent_lab.measure import reconstruction_factors

    return reconstruction_factors


@pytest.fixture
def folder(tmp_path):
    for name, text in {"tiny": TEXT, "training": TRAINING, "factors": FACTORS}.items():
        (tmp_path / f"{name}.toml").write_text(text)
    return tmp_path


def test_options_of_the_variant_are_replaced(made, folder):
    spec = read_specification(folder / "tiny.toml")
    found = made.changed(spec, "paper", {"options": {"noise": "none"}}, folder / "list.jsonl")
    (variant,) = found.variants
    assert dict(variant.options) == {"contrast_threshold": 0.2, "noise": "none"}
    assert found.sources == spec.sources


def test_fewer_scenes_give_as_many_clips_and_the_same_validation(made, folder):
    spec = read_specification(folder / "tiny.toml")
    fewer = made.changed(spec, "paper", {"scenes": 1}, folder / "list.jsonl")
    before, after = (Recipe.of(one).clips for one in (spec, fewer))
    assert before.counts == after.counts == {"train": 2, "validation": 2}
    repeated = [after.clip("train", number).item for number in range(2)]
    assert {one.prompt for one in repeated} == {before.clip("train", 0).item.prompt}
    assert len({one.key for one in repeated}) == 2
    told = [
        [clips.clip("validation", n).item.prompt for n in range(2)] for clips in (before, after)
    ]
    assert told[0] == told[1]


def test_fewer_clips_are_learned_and_as_many_validate(made, folder):
    spec = read_specification(folder / "tiny.toml")
    clips = Recipe.of(made.changed(spec, "paper", {}, folder / "list.jsonl", 1)).clips
    assert clips.counts == {"train": 1, "validation": 2}
    with pytest.raises(ConfigError, match="clips"):
        made.Scale(clips=0)


@pytest.mark.parametrize(
    ("changes", "message"),
    [
        ({"scenes": 3}, "scenes is 3; there are 2 prompts"),
        ({"variant": "rvt"}, "unknown variant 'rvt'"),
    ],
)
def test_what_cannot_be_changed_is_refused(made, folder, changes, message):
    spec = read_specification(folder / "tiny.toml")
    with pytest.raises(ConfigError, match=message):
        made.changed(spec, changes.get("variant", "paper"), changes, folder / "list.jsonl")


def test_each_factor_has_a_training_of_its_own(made, folder):
    found = made.trainings(folder / "factors.toml", folder / "work", None)
    assert list(found) == ["as it is", "threshold .4", "frame times", "streamed", "esim"]
    kept = [config.data.specification for config in found.values()]
    assert len(set(kept)) == len(kept)
    for some in (["streamed"], ["esim", "frame times"]):  # each as among all
        chosen = made.trainings(folder / "factors.toml", folder / "work", some)
        assert chosen == {name: found[name] for name in some}
    slow = read_specification(found["frame times"].data.specification)
    assert slow.options["fps"] == 40
    assert found["esim"].data.variant == "esim"
    written = read_specification(found["threshold .4"].data.specification)
    assert written.variants[0].options == {"contrast_threshold": 0.4}
    with pytest.raises(ConfigError, match="unknown factor 'noise'"):
        made.trainings(folder / "factors.toml", folder / "work", ["noise"])
    (folder / "factors.toml").write_text(FACTORS.replace('"v2v"', '"v3v"'))
    with pytest.raises(ConfigError, match=r"streamed: stream is 'v3v'; .* did you mean 'v2v'"):
        made.trainings(folder / "factors.toml", folder / "work", ["as it is"])


def test_films_count_from_the_folder_of_their_specification(made, folder, monkeypatch):
    before, _, after = TEXT.partition("[[sources]]")
    videos = '[[sources]]\nvideos = ["one.mp4", "two.mp4"]\n'
    (folder / "films.toml").write_text(before + videos + after[after.index("[variants") :])
    text = 'training = "training.toml"\n[factors.films]\nspecification = "films.toml"\n'
    (folder / "films-factors.toml").write_text(text)
    for name in ("one", "two"):
        (folder / f"{name}.mp4").touch()
    monkeypatch.chdir(folder)
    config = made.trainings(Path("films-factors.toml"), folder / "elsewhere/work", None)["films"]
    (source,) = read_specification(config.data.specification).sources
    assert source.videos == (str(folder / "one.mp4"), str(folder / "two.mp4"))


def test_a_streamed_example_is_a_run_of_its_clip_that_chance_alone_decides(made, folder):
    from texvent_lab.train.reconstruction.streamed import StreamedExamples

    config = made.trainings(folder / "factors.toml", folder / "work", ["streamed"])["streamed"]
    examples = StreamedExamples(config, "v2v")
    assert len(examples.prompts) == 2
    clip = examples.clip(1)
    assert len(clip.frames) == 13  # .125 s at 100 frames per second
    first, again, other = (examples(1, np.random.default_rng(n)) for n in (0, 0, 1))
    assert first["voxels"].shape == (4, 5, 16, 16)
    assert all(np.array_equal(first[name], again[name]) for name in first)
    assert not np.array_equal(first["voxels"], other["voxels"])
    kept = StreamedExamples(config, "none")
    assert kept.identity != examples.identity
    assert kept.clip(1) is clip  # rendered once for all trainings
    images = (kept(1, np.random.default_rng(0))["images"][:, 0] * 255).round()
    crops = np.lib.stride_tricks.sliding_window_view(clip.frames, (16, 16), (1, 2))
    found = [(crops == image).all(axis=(-1, -2)).any(axis=(1, 2)) for image in images]
    starts = range(2, 13 - 6)
    assert any(all(found[k][n + 2 * k] for k in range(4)) for n in starts)  # grids of 20 ms


def test_every_factor_of_the_repository_can_be_made(made, tmp_path):
    configs = Path(__file__).parents[3] / "configs/training"
    factors = read_configuration(configs / "reconstruction-factors.toml")["factors"]
    names = [name for name, one in factors.items() if "specification" not in one]  # of own films
    found = made.trainings(
        configs / "reconstruction-factors.toml", tmp_path, names, made.Scale(clips=12)
    )
    assert len(found) == len(names) > 5
    for config in found.values():
        clips = Recipe.of(read_specification(config.data.specification)).clips
        assert clips.counts == {"train": 12, "validation": 2}


def test_the_command_names_what_will_not_do(made, folder, monkeypatch, capsys):
    words = [str(folder / "factors.toml"), str(folder / "none"), "--work", str(folder / "work")]
    monkeypatch.setattr(sys, "argv", ["reconstruction_factors", *words])
    assert made.main() == 2
    assert "there is no recording" in capsys.readouterr().err


def write_recording(folder):
    """A bar that moves to the right, in the layout of the Event-Camera Dataset: 32×24 px, .5 s."""
    (folder / "images").mkdir(parents=True)
    times, events = [], []
    for number in range(25):
        image = np.full((24, 32), 60, np.uint8)
        image[:, number : number + 4] = 200
        cv2.imwrite(str(folder / f"images/{number}.png"), image)
        times.append(f"{number * 0.02:.6f} images/{number}.png")
        events += [f"{number * 0.02 + 0.01:.6f} {number + 4} {y} 1" for y in range(24)]
    (folder / "images.txt").write_text("\n".join(times))
    (folder / "events.txt").write_text("\n".join(events))


@pytest.mark.torch
def test_the_command_trains_and_scores_every_factor_and_repeats_what_is_kept(
    made, folder, monkeypatch, capsys
):
    pytest.importorskip("torch.nn.init")
    write_recording(folder / "bar")
    monkeypatch.setenv("TEXVENT_CACHE", str(folder / "texvent-cache"))  # without LPIPS' weights
    words = [str(folder / "factors.toml"), str(folder / "bar"), "--work", str(folder / "work")]
    words += ["--seeds", "1", "-o", str(folder / "a.json"), "--names", "as it is,streamed"]
    words += ["--clips", "1", "--epochs", "1"]
    monkeypatch.setattr(sys, "argv", ["reconstruction_factors", *words])
    assert made.main() == 0
    rows = read_document(folder / "a.json")["rows"]
    assert [one["factor"] for one in rows] == ["as it is", "streamed"]
    assert {len(values) for one in rows for values in one["scores"].values()} == {1}
    monkeypatch.setattr(sys, "argv", [*sys.argv, "--overwrite"])
    assert made.main() == 0
    assert read_document(folder / "a.json")["rows"] == rows
    assert "| streamed |" in capsys.readouterr().out
    document = read_document(folder / "a.json")
    assert document["protocol"] == {"networks per row": 1, "clips": 1, "epochs": 1}
    pages = page_files(document, "reconstruction-factors.json")
    assert "# Images by simulated training" in pages["reconstruction-factors.md"].decode()
    assert pages["reconstruction-factors.svg"].startswith(b"<?xml")


@pytest.mark.torch
def test_a_published_network_is_scored_as_a_trained_one(made, folder, monkeypatch, capsys):
    pytest.importorskip("torch.nn.init")
    write_recording(folder / "bar")
    monkeypatch.setenv("TEXVENT_CACHE", str(folder / "texvent-cache"))
    words = [str(folder / "factors.toml"), str(folder / "bar"), "--work", str(folder / "work")]
    words += ["--seeds", "1", "--clips", "1", "--names", "as it is", "--published", "firenet"]
    monkeypatch.setattr(
        sys, "argv", ["reconstruction_factors", *words, "-o", str(folder / "a.json")]
    )
    assert made.main() == 2  # there are no weights, which is known before any training
    assert "firenet.pth" in capsys.readouterr().err
    assert not (folder / "work").exists()
    monkeypatch.setattr(sys, "argv", [one for one in sys.argv if one not in words[-2:]])
    assert made.main() == 0
    weights = folder / "texvent-cache/weights/firenet.pth"
    weights.parent.mkdir(parents=True, exist_ok=True)
    weights.write_bytes((folder / "work/factor-0-0/weights.pt").read_bytes())
    monkeypatch.setattr(sys, "argv", [*sys.argv, "--published", "firenet", "--overwrite"])
    assert made.main() == 0
    trained, published = read_document(folder / "a.json")["rows"]
    assert published == {"factor": "firenet, as published", "scores": trained["scores"]}


def test_a_table_has_means_and_errors_over_seeds():
    table = factors_table([FactorScore("a", {"mse": [0.1, 0.3], "ssim": [0.5, 0.5]})])
    assert "| a | 0.200 ± 0.100 | 0.500 ± 0.000 |" in table
