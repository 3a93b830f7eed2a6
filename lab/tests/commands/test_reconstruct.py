"""`texvent reconstruct` and images in `texvent bench real`, from files to files."""

import json

import cv2
import numpy as np
import pytest

from texvent.cli.app import main

from ..bench.reconstruction.synthetic_network import SIZE, moving_bar, write_recording
from ..reconstruct.network_files import save_published

pytestmark = pytest.mark.torch
torch = pytest.importorskip("torch")


@pytest.fixture(autouse=True)
def empty_cache(tmp_path, monkeypatch):
    monkeypatch.setenv("TEXVENT_CACHE", str(tmp_path / "cache"))


@pytest.fixture
def weights(tmp_path):
    return save_published(torch, "firenet", tmp_path / "firenet.pth")


@pytest.fixture
def events(tmp_path):
    return moving_bar().events.collect().save(tmp_path / "bar.h5")


@pytest.fixture
def recording(tmp_path):
    return write_recording(tmp_path / "bar", moving_bar())


def run(capsys, *words):
    code = main([str(word) for word in words])
    return code, capsys.readouterr()


def network(weights):
    return ("--network", "firenet", "--weights", weights, "--device", "cpu")


def test_events_become_a_folder_of_pictures_with_their_times(events, weights, tmp_path, capsys):
    out = tmp_path / "frames"
    code, said = run(capsys, "reconstruct", events, "-o", out, "--fps", "50", *network(weights))
    assert (code, said.out) == (0, f"{out}\n")
    lines = (out / "timestamps.txt").read_text().splitlines()
    assert len(lines) == len(list(out.glob("frame_*.png"))) == 27
    assert cv2.imread(str(out / "frame_0000000000.png"), cv2.IMREAD_UNCHANGED).shape == SIZE.shape
    facts = json.loads((out / "texvent.json").read_text())
    assert facts["network"] == "firenet"
    assert len(facts["weights_sha256"]) == 64


def test_events_become_a_film_by_count_and_in_a_range(events, weights, tmp_path, capsys):
    out = tmp_path / "film.mp4"
    words = ("--events-per-image", "40", "--time", "0.1,0.4", "--quiet")
    code, said = run(capsys, "reconstruct", events, "-o", out, *words, *network(weights))
    assert (code, said.out, said.err) == (0, "", "")
    assert out.stat().st_size > 0


def test_depth_becomes_a_film_and_pictures_in_colour(events, tmp_path, capsys):
    weights = save_published(torch, "e2depth", tmp_path / "e2depth.pth.tar")
    for out in (tmp_path / "depth.mp4", tmp_path / "depth"):
        words = ("--time", "0.1,0.3", "--network", "e2depth", "--weights", weights)
        assert run(capsys, "reconstruct", events, "-o", out, *words)[0] == 0
    picture = cv2.imread(str(tmp_path / "depth" / "frame_0000000002.png"), cv2.IMREAD_UNCHANGED)
    assert picture.shape == (*SIZE.shape, 3)
    assert np.ptp(picture, axis=2).max() > 50
    film = cv2.VideoCapture(str(tmp_path / "depth.mp4"))
    film.set(cv2.CAP_PROP_POS_FRAMES, 2)
    shown = film.read()[1][: SIZE.height, : SIZE.width]
    assert np.corrcoef(shown.ravel(), picture.ravel())[0, 1] > 0.95


@pytest.mark.parametrize(
    "words",
    [("bench", "real", "RECORDING"), ("bench", "paper", "--table", "8")],
)
def test_depth_is_refused_where_images_are_compared_with_frames(words, recording, capsys):
    words = [str(recording) if one == "RECORDING" else one for one in words]
    code, said = run(capsys, *words, "--network", "e2depth", "-q")
    assert code == 2
    assert "network is e2depth, which gives depth" in said.err
    assert said.err.count("\n") == 1


@pytest.mark.parametrize(
    ("words", "message"),
    [
        (("--fps", "0"), "fps is 0"),
        (("--events-per-image", "0"), "events_per_image is 0"),
        (("--network", "firenets"), "did you mean 'firenet'"),
    ],
)
def test_wrong_options_are_refused_before_any_work(words, message, events, weights, capsys):
    out = weights.parent / "film.mp4"
    code, said = run(capsys, "reconstruct", events, "-o", out, *network(weights), *words)
    assert code == 2
    assert message in said.err
    assert said.err.count("\n") == 1
    assert not out.exists()


def test_the_benchmark_of_recordings_scores_images_too(recording, weights, tmp_path, capsys):
    out = tmp_path / "result.json"
    words = ("--simulators", "esim", "--interpolations", "blend", "--seconds", "0.5", "-q")
    code, said = run(capsys, "bench", "real", recording, *words, "-o", out, *network(weights)[:-2])
    assert code == 0
    assert "## bar, firenet (2 images)" in said.out
    assert "| esim, blend |" in said.out
    document = json.loads(out.read_text())
    assert [row["source"] for row in document["rows"]] == ["recorded", "esim, blend"]
