"""Rounds of refinement in time: LTX-2.5's pipelines with tiny weights in the published layout."""

import json
import os

import numpy as np
import pytest

pytestmark = [pytest.mark.torch, pytest.mark.usefixtures("model_cache")]
os.environ["HF_HUB_OFFLINE"] = "1"
torch = pytest.importorskip("torch")
torch.set_num_threads(1)  # tiny arrays: more threads only wait for each other
diffusers = pytest.importorskip("diffusers")

from diffusers.pipelines.ltx2 import LTX2LatentUpsamplerModel  # noqa: E402
from diffusers.pipelines.ltx2.utils import TEMPORAL_ANCESTRAL_ETA  # noqa: E402

from texvent.errors import ConfigError, FileFormatError, InputError  # noqa: E402
from texvent.generate.diffusers_models import model_run  # noqa: E402
from texvent.generate.diffusers_models.temporal_refinement import ETA  # noqa: E402
from texvent.generate.video_config import DiffusersConfig  # noqa: E402

from .. import tiny_pipelines  # noqa: E402
from ..tiny_families import FAMILIES  # noqa: E402
from ..tiny_models import PROMPT, build, pixels  # noqa: E402

OPTIONS = {**FAMILIES["ltx2-keyframes"].options, "frames": 13}
"""13 frames are two segments of 6 at this decoder's 2 frames per latent."""


class Steps:
    def __init__(self):
        self.seen = []

    def announce(self, line):
        pass

    def advance(self, stage, done, total):
        self.seen.append((stage, done, total))


def save_upsampler(folder, **facts):
    facts = {"spatial_upsample": False, "temporal_upsample": True, **facts}
    facts = {"in_channels": 4, "num_blocks_per_stage": 1, **facts}
    with tiny_pipelines.random_weights():
        network = LTX2LatentUpsamplerModel(mid_channels=32, **facts)
    network.save_pretrained(folder, safe_serialization=True)
    return folder


@pytest.fixture(scope="module")
def model(tmp_path_factory):
    folder = tmp_path_factory.mktemp("dfr") / "tiny"
    with tiny_pipelines.random_weights():
        FAMILIES["ltx2-keyframes"].build().save_pretrained(folder, safe_serialization=True)
    return folder


@pytest.fixture(scope="module")
def upsampler(tmp_path_factory):
    return save_upsampler(tmp_path_factory.mktemp("upsampler") / "temporal")


@pytest.fixture
def make(model, upsampler):
    def run(refine=2, folder=upsampler, seed=3, **options):
        steps = Steps()
        generator = build(
            model, seed=seed, refine=refine, temporal_upsampler=folder, **{**OPTIONS, **options}
        )
        return generator.generate(PROMPT, progress=steps), steps.seen

    return run


@pytest.mark.parametrize("factor", [2, 4])
def test_refinement_gives_more_frames_in_the_same_time(factor, make):
    video, steps = make(factor)
    frames = pixels(video)
    assert frames.shape == (factor * 12 + 1, 32, 32, 3)
    assert video.fps == 16 * factor
    assert frames.std(axis=(1, 2, 3)).min() > 0
    assert video.metadata["pipeline"] == "LTX2DFRPipeline"
    assert video.metadata["options"]["refine"] == factor
    assert len(video.metadata["temporal_upsampler"]) == 64
    stages = list(dict.fromkeys(stage for stage, _, _ in steps))
    rounds = factor.bit_length() - 1
    assert stages == ["denoise"] + [
        f"refine, round {index + 1} of {rounds}" for index in range(rounds)
    ]
    for stage in stages:
        done = [step for name, *step in steps if name == stage]
        assert done == [[step + 1, len(done)] for step in range(len(done))]
    # Four noise levels for each tile: two in the first round, four in the second.
    assert [len([1 for name, *_ in steps if name == stage]) for stage in stages] == (
        [8, 8, 16][: 1 + rounds]
    )


def test_frames_are_those_of_diffusers_own_pipelines(make, model, upsampler):
    """The calls as the docstrings of diffusers have them, with one source of noise."""
    ours = pixels(make(4)[0]) / 65_535
    pipe = diffusers.LTX2DFRPipeline.from_pretrained(model)
    noise = torch.Generator("cpu").manual_seed(3)
    out = pipe(
        PROMPT,
        height=32,
        width=32,
        num_frames=13,
        frame_rate=16.0,
        generator=noise,
        output_type="latent",
    )
    parts = {name: part for name, part in pipe.components.items() if part is not None}
    refiner = diffusers.LTX2DFRTemporalRefinePipeline(
        **{**parts, "scheduler": diffusers.LTXEulerAncestralRFScheduler(eta=0.5)},
        temporal_latent_upsampler=LTX2LatentUpsamplerModel.from_pretrained(upsampler),
    )
    for index, frames, rate, kind in ((1, 13, 16.0, "latent"), (2, 25, 32.0, "np")):
        out = refiner(
            PROMPT,
            latents=out.frames,
            keyframes_latents=out.keyframes,
            keyframe_positions=out.keyframe_positions,
            audio_latents=out.audio,
            height=32,
            width=32,
            num_frames=frames,
            frame_rate=rate,
            source_seconds=13 / 16,
            round_index=index,
            generator=noise,
            output_type=kind,
        )
    assert np.abs(out.frames[0] - ours).max() < 1e-4
    assert ETA == TEMPORAL_ANCESTRAL_ETA


def test_a_seed_repeats_and_another_gives_other_frames(make):
    first, again, other = (pixels(make(seed=seed, reuse_video=False)[0]) for seed in (3, 3, 4))
    assert np.array_equal(first, again)
    assert not np.array_equal(first, other)


def test_one_generator_repeats_itself_and_keeps_its_refiner(model, upsampler):
    options = {**OPTIONS, "refine": 2, "temporal_upsampler": upsampler, "reuse_video": False}
    generator = build(model, **options)
    first = pixels(generator.generate(PROMPT))
    refiner = generator._run._refiner
    assert np.array_equal(first, pixels(generator.generate(PROMPT)))
    assert generator._run._refiner is refiner


def test_frames_that_pad_the_last_segment_are_left_out(make):
    video, _ = make(frames=11)  # made as 13
    assert video.frame_count == 21


def test_factor_and_upsampler_decide_which_video_is_found(make, model, upsampler, tmp_path):
    video, _ = make(2)
    again, steps = make(2)
    assert (again.path, again.fps, steps) == (video.path, 32, [])
    paths = {video.path, make(4)[0].path, build(model, **OPTIONS).generate(PROMPT).path}
    deeper = save_upsampler(tmp_path / "deeper", num_blocks_per_stage=2)
    paths.add(make(2, folder=deeper)[0].path)
    assert len(paths) == 4


def test_an_upsampler_of_other_latents_is_refused_before_denoising(make, tmp_path):
    foreign = save_upsampler(tmp_path / "foreign", in_channels=8)
    with pytest.raises(InputError, match="for latents of 8 channels, those of the model have 4"):
        make(folder=foreign)


def test_weights_that_lack_a_tensor_are_refused(make, tmp_path):
    folder = save_upsampler(tmp_path / "lacking")
    path = folder / "config.json"
    path.write_text(json.dumps({**json.loads(path.read_text()), "num_blocks_per_stage": 2}))
    with pytest.raises(FileFormatError, match="cannot be loaded as a temporal upsampler"):
        make(folder=folder)


def test_other_pipelines_are_refused_before_anything_is_loaded(models, upsampler, monkeypatch):
    monkeypatch.setattr(model_run, "load_pipeline", None)
    options = {"refine": 2, "temporal_upsampler": upsampler}
    with pytest.raises(ConfigError, match="WanPipeline cannot refine its frames in time"):
        build(models("wan"), **options).generate(PROMPT)
    with pytest.raises(ConfigError, match=r"LTX2Pipeline cannot refine .* ltx2\.5-dfr"):
        build("hub:Lightricks/LTX-2.5-Diffusers", **options).generate(PROMPT)


def test_factor_and_upsampler_need_each_other(tmp_path):
    with pytest.raises(ConfigError, match="refine is set, but no temporal_upsampler"):
        DiffusersConfig(refine=2)
    with pytest.raises(ConfigError, match="temporal_upsampler is set, but not refine"):
        DiffusersConfig(temporal_upsampler=tmp_path)
    with pytest.raises(ConfigError, match="refine is 3; allowed: 2, 4"):
        DiffusersConfig(refine=3, temporal_upsampler=tmp_path)
