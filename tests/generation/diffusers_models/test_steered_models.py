"""Tiny pipelines of the classes that follow a scene, from a scene to labelled events."""

import dataclasses
import shutil

import numpy as np
import pytest

pytestmark = [
    pytest.mark.torch,
    pytest.mark.usefixtures("model_cache"),
    # Of noise schedules in diffusers 0.42.1 under NumPy 2; texvent cannot change it.
    pytest.mark.filterwarnings("ignore:__array_:DeprecationWarning"),
]
torch = pytest.importorskip("torch")
pytest.importorskip("diffusers")
pytest.importorskip("peft")

from safetensors.torch import save_file  # noqa: E402

import texvent  # noqa: E402
from texvent.dataset import SampleSource, Specification  # noqa: E402
from texvent.dataset.generation.shard_files import FAILED, read_record  # noqa: E402
from texvent.dataset.specification.specification import Filters  # noqa: E402
from texvent.errors import InputError, TexventError  # noqa: E402
from texvent.generation.diffusers_models import generator as diffusers_generator  # noqa: E402
from texvent.generation.diffusers_models import pipeline_call  # noqa: E402
from texvent.generation.video_models import controls  # noqa: E402
from texvent.generation.video_models.controls import PIPELINES  # noqa: E402
from texvent.pipeline import text_to_events  # noqa: E402
from texvent.settings.resolution import resolve  # noqa: E402
from texvent_scenes.spec.data import scene_from_data  # noqa: E402

from ..tiny_families import STEERED  # noqa: E402
from ..tiny_models import OPTIONS, build, pixels  # noqa: E402
from ..watcher import Watcher  # noqa: E402

SENTENCE = "a red car drives left"
LAYER = "transformer.transformer_blocks.0.attn1.to_q.lora_"


@pytest.fixture
def options(tmp_path):
    """The options of a family's run."""
    lora = tmp_path / "control.safetensors"
    pair = {f"{LAYER}A.weight": torch.zeros(2, 16), f"{LAYER}B.weight": torch.zeros(16, 2)}
    save_file(pair, lora, {"format": "pt"})

    def of(name):
        own = dict(STEERED[name].options)
        return own | ({"lora": (str(lora),)} if name == "ltx2-control" else {})

    return of


def test_every_class_that_follows_a_scene_has_a_tiny_pipeline():
    assert {family.pipeline for family in STEERED.values()} == set(PIPELINES)


@pytest.mark.parametrize("name", STEERED)
def test_a_scene_goes_through_every_class_to_labelled_events(name, models, options, monkeypatch):
    given = []
    real = pipeline_call._control_argument

    def note(pipe, control):
        given.append(control)
        return real(pipe, control)

    monkeypatch.setattr(pipeline_call, "_control_argument", note)
    family, watcher = STEERED[name], Watcher()
    generator = build(models(name), look="snow", **options(name))
    video = generator.generate(SENTENCE, progress=watcher)
    frames = pixels(video)
    assert frames.shape == (family.frames, 32, 32, 3)
    assert frames.std(axis=(1, 2, 3)).min() > 0
    assert watcher.steps[-1] == ("denoise", 2, 2)
    facts = video.metadata
    assert facts["pipeline"] == family.pipeline
    assert facts["prompt"] == SENTENCE
    assert facts["text"] == f"{SENTENCE}, snow"
    assert set(facts["control_agreement"]) <= {"edges", "flow"}
    assert any(line.startswith("the video follows the scene: ") for line in watcher.lines)
    depth = np.stack([video.ground_truth(f.t_us, f.t_us).depth for f in video.scene]).astype(float)
    near = (1 / depth - (1 / depth).min()) / np.ptp(1 / depth)
    assert np.abs(given[0] - np.rint(255 * near)[..., None]).max() <= 1


def test_a_network_that_lies_elsewhere_is_stored_with_its_commit(models, tmp_path, monkeypatch):
    whole, network = tmp_path / "cosmos2.5-transfer-2b", tmp_path / "0a1b2c"
    shutil.copytree(models("cosmos-transfer"), whole)
    shutil.move(whole / "controlnet", network)
    monkeypatch.setattr(controls, "find_network", lambda repo, revision, announce: network)
    generator = build(whole, control="edges")
    generator.model = dataclasses.replace(generator.model, repo="org/name")
    assert generator.generate(SENTENCE).metadata["controlnet_commit"] == "0a1b2c"


def test_events_boxes_and_looks_of_one_scene(models, tmp_path, monkeypatch):
    scene = scene_from_data(
        {"objects": [{"noun": "car", "motions": [{"kind": "drive", "direction": "left"}]}]}
    )
    shared = {**OPTIONS, "generator": str(models("wan-vace")), "scene_seed": 5, "noise": "none"}

    def run(**options):
        return text_to_events(scene, resolve("generate", {**shared, "look": "rain", **options}))

    first, other = run(seed=1).video, run(seed=2).video
    assert not np.array_equal(pixels(first), pixels(other))
    t_us = [frame.t_us for frame in first]
    one, two = (video.ground_truth(t_us[0], t_us[1]) for video in (first, other))
    assert one.boxes == two.boxes
    assert np.array_equal(one.flow, two.flow, equal_nan=True)
    fitted = run(seed=1, sensor="24x16", contrast_threshold=0.01)
    events = fitted.packets.collect()
    assert events.size == (24, 16)
    assert len(events) > 0
    assert events.metadata["scene"]["objects"][0]["noun"] == "car"
    assert "control_agreement" in events.metadata["source"]

    def forbidden(*_, **__):
        raise AssertionError("the pipeline was called again")

    monkeypatch.setattr(diffusers_generator, "call_pipeline", forbidden)
    run(seed=1)
    for changed in ({"scene_seed": 6}, {"look": "snow"}, {"control": "edges"}):
        with pytest.raises(AssertionError, match="called again"):
            run(seed=1, **changed)


def test_a_video_that_does_not_follow_is_made_again_and_then_refused(models):
    watcher = Watcher()
    faults = {"least_agreement": 1.0, "on_failure": "retry"}
    with pytest.raises(TexventError, match=r"all 4 videos.*agree by .*, below 1"):
        build(models("wan-vace"), **faults).generate(SENTENCE, progress=watcher)
    assert sum("is refused" in line for line in watcher.lines) == 4


def test_folders_that_follow_no_scene_or_lack_a_part_are_refused_before_loading(
    models, tmp_path, monkeypatch
):
    def forbidden(*_, **__):
        raise AssertionError("a network was loaded")

    monkeypatch.setattr(diffusers_generator, "load_pipeline", forbidden)
    for row, name, message in (
        ("wan-vace-1.3b", "wan", "holds a WanTransformer3DModel, and .* needs a WanVACE"),
        ("cogvideox-fun-control-5b", "cogvideox", "without a control, and .* that follows"),
    ):
        folder = tmp_path / row
        shutil.copytree(models(name), folder)
        with pytest.raises(InputError, match=message):
            build(folder, width=32, frames=9, control="depth").generate(SENTENCE)
    whole = tmp_path / "cosmos2.5-transfer-2b"
    shutil.copytree(models("cosmos-transfer"), whole)
    shutil.rmtree(whole / "controlnet")
    with pytest.raises(InputError, match=r"lacks the folder .*controlnet, the network of control"):
        build(whole, control="depth").generate(SENTENCE)
    shutil.rmtree(whole / "vae")
    with pytest.raises(InputError, match=r"lacks the folder .*vae"):
        build(whole, control="depth").generate(SENTENCE)


def test_a_data_set_of_steered_videos_has_the_labels_of_its_scenes(models, tmp_path):
    options = {**OPTIONS, "generator": str(models("wan-vace")), "sensor": "24x16"}
    options |= {"contrast_threshold": 0.01, "on_failure": "ignore"}
    source = SampleSource(prompts=(SENTENCE,))
    of_set = {"name": "steered", "sources": (source,), "truth": ("boxes",), "options": options}
    made = texvent.dataset.make(
        Specification(**of_set, filters=Filters(min_events=0)), tmp_path / "kept", progress=False
    )
    assert not made.failures
    (sample,) = texvent.dataset.open(tmp_path / "kept")
    seed = sample.facts["source"]["seed"]
    video = build(models("wan-vace"), seed=seed).generate(SENTENCE)
    steps = [video.ground_truth(frame.t_us, frame.t_us).boxes for frame in video]
    assert sample.truth.boxes["track_id"].tolist() == [one.instance for row in steps for one in row]
    assert sample.facts["settings"]["interpolate"]["interpolate"] == "motion"
    refused = {"min_events": 0, "least_control_agreement": 1.0}
    left_out = Specification(**of_set | {"filters": Filters(**refused)})
    texvent.dataset.make(left_out, tmp_path / "out", progress=False)
    reasons = [
        one.reason
        for path in (tmp_path / "out").rglob("*.tar")
        for one in read_record(path).samples
        if one.status == FAILED
    ]
    assert len(reasons) == 2
    assert all("all 4 videos" in reason and ", below 1" in reason for reason in reasons)
