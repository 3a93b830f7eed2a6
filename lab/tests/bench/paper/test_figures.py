"""The paper's figures: a column per simulator, a row per kind of picture."""

import dataclasses
from pathlib import Path

import cv2
import numpy as np
import pytest

from texvent.cli.app import main
from texvent_lab.bench.paper import figures
from texvent_lab.bench.paper.config import PaperConfig
from texvent_lab.bench.paper.published_tables import FIGURES
from texvent_lab.bench.paper.run import ENTRIES
from texvent_lab.bench.real.recording import open_scene
from texvent_lab.commands.bench import paper

from ...reconstruct.network_files import save_published

COLUMNS = {"Texvent": dataclasses.replace(ENTRIES["Texvent"], interpolate="none")}


def read(path: Path) -> np.ndarray:
    return cv2.imread(str(path))[..., ::-1]


@pytest.fixture(autouse=True)
def one_column(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(paper, "find_columns", lambda config: COLUMNS)


def words(recording: Path, number: int, out: Path) -> list[str]:
    given = ["bench", "paper", "--figure", str(number), "--recordings", str(recording), "-q"]
    return [*given, "--no-match-rate", "-o", str(out)]


@pytest.mark.parametrize("number", [one for one in FIGURES if one != figures.ABLATION_FIGURE])
def test_a_figure_shows_the_frame_the_recording_and_each_simulator(
    pan_folder, tmp_path, capsys, number
):
    assert main(words(pan_folder, number, tmp_path / "a.png")) == 0
    printed, scene = capsys.readouterr().out, open_scene(str(pan_folder))
    size, since_us = scene.video.size, scene.whole.start_us
    times_us = np.concatenate([one.t for one in scene.references]) - since_us
    most = int(np.bincount(times_us // figures.SLICE_US).argmax())
    starts_us = [since_us + figures.SLICE_US * (most + step) for step in (0, 1)]
    assert f"{FIGURES[number]}; {starts_us[0]} to {starts_us[1]} µs" in printed
    assert ("not drawn: e2" in printed) == (number in figures.NETWORKS)
    image = read(tmp_path / "a.png")
    width, head = size.width + figures.GAP_PX, 3 * figures.TITLE_PX
    assert image.shape == (head + size.height, 3 * width - figures.GAP_PX, 3)
    panels = [image[head:, n * width : n * width + size.width] for n in range(3)]
    assert all(one.std() > 0 for one in panels)
    assert (panels[1] != panels[2]).any()


def test_the_slice_of_most_recorded_events_is_shown_whatever_is_simulated(pan_folder, monkeypatch):
    scene, counts = open_scene(str(pan_folder)), []
    edges = range(scene.whole.start_us, scene.whole.stop_us, figures.SLICE_US)
    slices = [scene.events.cut(edge, edge + figures.SLICE_US) for edge in edges]
    counts = [len(one) for one in slices]
    fewest = slices[int(np.argmin(counts))]
    monkeypatch.setattr(type(scene), "simulate", lambda *_: [fewest])
    config = PaperConfig(figure=12, recordings=str(pan_folder), match_rate=False)
    _, notes = figures.draw_figure(12, scene, COLUMNS, config, print)
    start_us = edges[int(np.argmax(counts))]
    assert f"; {start_us} to {start_us + figures.SLICE_US} µs" in notes[0]


@pytest.mark.torch
@pytest.mark.parametrize("number", figures.NETWORKS)
def test_a_networks_pictures_are_the_last_row(pan_folder, tmp_path, number):
    torch = pytest.importorskip("torch", reason="make test-torch runs the tests that need torch")
    weights = save_published(torch, figures.NETWORKS[number], tmp_path / "weights.pt")
    given = words(pan_folder, number, tmp_path / "a.png")
    assert main([*given, "--weights", str(weights)]) == 0
    size = open_scene(str(pan_folder)).video.size
    image = read(tmp_path / "a.png")
    assert len(image) == 3 * figures.TITLE_PX + 2 * size.height + figures.GAP_PX
    last = image[-size.height :, size.width + figures.GAP_PX :][:, : size.width]
    assert last.std() > 0
    assert (last == last[..., :1]).all() == (number == 5)  # brightness, or depth in colours


def test_the_ablations_are_columns_by_their_names(pan_folder, tmp_path, capsys):
    configs = tmp_path / "configs"
    configs.mkdir()
    for name in ("Texvent", "E4", "E9"):
        (configs / f"{name}.toml").write_text('interpolate = "none"\n')
    given = words(pan_folder, figures.ABLATION_FIGURE, tmp_path / "a.png")
    assert main([*given, "--configs", str(configs)]) == 0
    size = open_scene(str(pan_folder)).video.size
    assert read(tmp_path / "a.png").shape[1] == 4 * (size.width + figures.GAP_PX) - figures.GAP_PX
    assert "not drawn" not in capsys.readouterr().out


@pytest.mark.parametrize(
    ("given", "message"),
    [
        (["--figure", "3", "-o", "a.png"], "figure is 3; the figures are 5, 6, 7, 12"),
        (["--figure", "5", "--table", "4", "-o", "a.png"], "give one of them"),
        (["--figure", "5", "--recordings", "a,b", "-o", "a.png"], "a figure shows one recording"),
        (["--figure", "5", "-o", "a.json"], "a figure needs -o FILE.png"),
    ],
)
def test_figures_that_cannot_be_drawn_are_refused(capsys, given, message):
    assert main(["bench", "paper", *given]) == 2
    assert message in capsys.readouterr().err
