"""Everything that the paper names is in the product: systems, tables, figures.

Equations are in test_equations_table.py. What needs weights is built with random ones.
"""

from pathlib import Path

import pytest

import texvent
from texvent._registry import GENERATORS, INTERPOLATORS, METRICS, SIMULATORS
from texvent.cli.app import main
from texvent.errors import InputError
from texvent.represent.contrast_maximisation import find_flow, flow_warp_loss
from texvent.sensor import SENSORS
from texvent.settings.resolution import resolve
from texvent_lab.bench.fidelity.entries import read_ablations
from texvent_lab.bench.paper.augmentation import CLASSIFIERS
from texvent_lab.bench.paper.published_tables import FIGURES, TABLES
from texvent_lab.bench.paper.run import ENTRIES
from texvent_lab.registries import RECONSTRUCTORS

CONFIGS = Path(__file__).parents[2] / "configs" / "paper"
GENERATED_BY = {
    "Cosmos": "cosmos-7b",
    "Wan": "wan-14b",
    "CogVideoX": "cogvideox-5b",
    "Open-Sora": "opensora",
}
SIMULATED_BY = {
    "VID2E": "esim",
    "V2E": "v2e",
    "V2CE": "v2ce",
    "DVS-Voltmeter": "voltmeter",
    "SENPI": "senpi",
    "Texvent": "texvent",
}
INTERPOLATED_BY = {"RIFE": "rife", "Super SloMo": "super-slomo", "optical flow": "flow"}
RECONSTRUCTED_BY = {
    "E2VID": "e2vid",
    "HyperE2VID": "hypere2vid",
    "ET-Net": "et-net",
    "E2Depth": "e2depth",
}
SCORED_BY = {"EQS": "eqs", "MSE": "ef_mse", "SSIM": "ef_ssim", "LPIPS": "ef_lpips"}
COMMANDS = {
    "NT-ImageNet, its captions and scores (4.1, 9.7)": ["nt-imagenet", "--help"],
    "prompts that a sample does not show (9.6)": ["align", "--help"],
    "videos that harm events (9.6)": ["check", "--help"],
    "training with simulated streams (4.4, 9.3)": ["train", "classification", "--help"],
    "images of events (4.2)": ["reconstruct", "--help"],
    "warped events and optical flow (Figures 6, 12)": ["render", "--help"],
    "tables and figures": ["bench", "paper", "--help"],
}


@pytest.mark.parametrize("name", GENERATED_BY.values(), ids=GENERATED_BY)
def test_the_papers_video_models_are_generators(name: str):
    assert callable(GENERATORS.load(name))


@pytest.mark.parametrize("name", SIMULATED_BY.values(), ids=SIMULATED_BY)
def test_the_papers_simulators_are_pixel_models(name: str):
    assert set(SIMULATED_BY) == set(ENTRIES)
    assert ENTRIES[next(key for key, one in SIMULATED_BY.items() if one == name)].simulator == name
    if name in SIMULATORS.builtin:
        texvent.check_simulator(SIMULATORS.load(name))
    else:
        assert resolve("simulate", {"simulator": name}).run.simulator == name


@pytest.mark.parametrize("name", INTERPOLATED_BY.values(), ids=INTERPOLATED_BY)
def test_the_papers_interpolators_can_be_named(name: str):
    assert resolve("simulate", {"interpolate": name}).interpolate.interpolate == name
    assert callable(INTERPOLATORS.load(name))


def test_rife_runs_at_every_instant_in_the_papers_setting():
    settings = {one.name: one for one in read_ablations(CONFIGS)}["Texvent"].settings(0)
    assert resolve("simulate", {"interpolate": "rife", "rife_flow": "each"})
    assert settings.interpolate.rife_flow == "each"


@pytest.mark.torch
@pytest.mark.parametrize("name", RECONSTRUCTED_BY.values(), ids=RECONSTRUCTED_BY)
def test_the_papers_reconstructors_make_pictures(name: str):
    torch = pytest.importorskip("torch")
    network = RECONSTRUCTORS.load(name).network.like({}, {})
    with torch.inference_mode():
        side = 2 * network.multiple
        assert network.step(torch.zeros(1, network.bins, side, side)).shape[-2:] == (side, side)


@pytest.mark.parametrize("name", SCORED_BY.values(), ids=SCORED_BY)
def test_the_papers_metrics_can_be_named(name: str):
    assert callable(METRICS.load(name))


def test_contrast_maximisation_finds_a_flow():
    events = texvent.generate("a red ball flies left", duration=0.1, sensor="64x48")
    assert find_flow(events.cut(0, 30_000)).shape == (*events.size.shape, 2)
    assert flow_warp_loss(events, find_flow(events.cut(0, 30_000))) > 0


def test_every_table_and_figure_has_a_number():
    assert set(TABLES) == set(range(1, 10))
    assert set(FIGURES) == {5, 6, 7, 12}
    assert list(CLASSIFIERS) == list(TABLES[6].columns)


def test_noise_differs_between_sensors():
    assert len({one.fill_factor for one in SENSORS.values()}) > 2


@pytest.mark.parametrize("words", COMMANDS.values(), ids=COMMANDS)
def test_what_the_paper_does_has_a_command(words: list[str], capsys: pytest.CaptureFixture[str]):
    assert main(words) == 0
    assert capsys.readouterr().out


def test_a_part_without_its_weights_names_where_they_come_from(monkeypatch, tmp_path):
    monkeypatch.setenv("TEXVENT_CACHE", str(tmp_path))
    with pytest.raises(InputError, match="needs its weights"):
        texvent.generate("a red ball", duration=0.1, simulator="v2ce")
