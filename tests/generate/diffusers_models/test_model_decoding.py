"""From latents to frames: whole pipelines whose clips are decoded a few frames at a time."""

import os

import numpy as np
import pytest

pytestmark = [pytest.mark.torch, pytest.mark.usefixtures("model_cache")]
os.environ["HF_HUB_OFFLINE"] = "1"
torch = pytest.importorskip("torch")
torch.set_num_threads(1)  # tiny arrays: more threads only wait for each other
pytest.importorskip("diffusers")

from texvent.errors import FileFormatError, InputError  # noqa: E402
from texvent.generate.diffusers_models import pipeline_loading  # noqa: E402
from texvent.generate.diffusers_models.decoder_input import SINGLE_DECODE_PIPELINES  # noqa: E402
from texvent.generate.diffusers_models.device_placement import Placement  # noqa: E402

from .. import tiny_pipelines  # noqa: E402
from ..tiny_models import PROMPT, build, pixels  # noqa: E402

STREAMED = ("wan", "wan22", "cogvideox", "cogvideox15", "ltx")


@pytest.mark.parametrize("name", STREAMED)
def test_decoding_step_by_step_gives_the_frames_of_the_pipeline_itself(name, models):
    generator = build(models(name))
    ours = pixels(generator.generate(PROMPT))
    pipe = tiny_pipelines.diffusers.DiffusionPipeline.from_pretrained(models(name))
    whole = pipe(
        prompt=PROMPT,
        num_frames=5,
        width=32,
        height=32,
        num_inference_steps=2,
        guidance_scale=3.0,
        generator=torch.Generator("cpu").manual_seed(3),
        output_type="np",
        **({"frame_rate": 16} if name == "ltx" else {}),
    ).frames[0]
    assert np.abs(ours / 65_535 - whole).max() < 1e-5


def test_latents_come_with_scale_and_shift_and_are_decoded_one_after_another(models):
    generator = build(models("wan"))
    latents = generator.generate_latents(PROMPT)
    assert latents.values.shape == (16, 2, 4, 4)
    assert (latents.frames_per_latent, latents.pixels_per_latent) == (4, 8)
    assert latents.decoder_input[1, 0, 0, 0] == pytest.approx(
        latents.values[1, 0, 0, 0] * 1.4541 - 0.7089, rel=1e-5
    )
    decoded = pixels(generator.generate(PROMPT))
    frames = np.stack(list(generator.decode(latents)))
    assert np.abs(decoded / 65_535 - frames).max() < 1e-5


@pytest.mark.parametrize("frames", [5, None])
def test_latents_of_cogvideox_come_without_its_padding(frames, models):
    """CogVideoX 1.5 pads 3 latent frames (9 frames, its own number) to 4, and 2 to 2."""
    generator = build(models("cogvideox15"), frames=frames)
    decoded = pixels(generator.generate(PROMPT))
    ours = np.stack(list(generator.decode(generator.generate_latents(PROMPT))))
    assert ours.shape == decoded.shape
    assert np.abs(decoded / 65_535 - ours).max() < 1e-5


def test_another_decoder_for_the_same_latents_gives_other_frames(models, tmp_path):
    own = models("wan") / "vae"
    with tiny_pipelines.random_weights(seed=5):
        tiny_pipelines.wan_vae().save_pretrained(tmp_path / "tiny")
    usual = pixels(build(models("wan")).generate(PROMPT))
    assert np.array_equal(pixels(build(models("wan"), decoder=own).generate(PROMPT)), usual)
    other = build(models("wan"), decoder=tmp_path / "tiny").generate(PROMPT)
    assert not np.array_equal(pixels(other), usual)
    with pytest.raises(InputError, match="there is no decoder"):
        build(models("wan"), decoder=tmp_path / "none").generate(PROMPT)
    config = (tmp_path / "tiny" / "config.json").read_text().replace('"z_dim": 16', '"z_dim": 8')
    (tmp_path / "tiny" / "config.json").write_text(config)
    with pytest.raises(FileFormatError, match="tiny cannot be loaded as a decoder"):
        build(models("wan"), decoder=tmp_path / "tiny").generate(PROMPT)


def test_where_memory_is_short_decoders_go_in_steps_and_tiles():
    with tiny_pipelines.random_weights():
        pipe = tiny_pipelines.ltx(None)
    small = Placement("cpu", "float32", "none", tiles_decoder=True)
    pipeline_loading.place_pipeline(pipe, small)
    assert pipe.vae.use_tiling
    assert pipe.vae.use_framewise_decoding


def test_no_clip_is_held_whole_by_a_decoder_that_goes_in_steps(models, monkeypatch):
    run = build(models("wan"), frames=9)
    frames = run.generate(PROMPT)
    assert frames.frame_count == 9
    pipe = run._run._pipe
    calls = []
    forward = pipe.vae.decoder.forward
    monkeypatch.setattr(
        pipe.vae.decoder, "forward", lambda *args, **more: calls.append(1) or forward(*args, **more)
    )
    stream = run._run.frames(PROMPT, 5)
    assert calls == [], "denoised, not decoded"
    next(stream)
    assert len(calls) == 1
    assert len(list(stream)) == 8
    assert len(calls) == 3


def test_the_decoder_is_itself_again_after_a_run_and_after_an_error(models):
    generator = build(models("wan"), reuse_video=False)
    generator.generate(PROMPT)
    vae = generator._run._pipe.vae
    assert "decode" not in vars(vae)
    with pytest.raises(KeyboardInterrupt):
        build(models("wan"), seed=9, reuse_video=False).generate(PROMPT, progress=Interrupter())
    assert "decode" not in vars(vae)


class Interrupter:
    def announce(self, line):
        pass

    def advance(self, stage, done, total):
        raise KeyboardInterrupt


def test_single_decode_pipelines_exist_and_decode_once():
    import inspect

    for name in SINGLE_DECODE_PIPELINES:
        source = inspect.getsource(getattr(tiny_pipelines.diffusers, name))
        calls = source.count("self.vae.decode(")
        assert calls == 1 or (calls == 2 and name == "MotifVideoPipeline"), name


def test_an_image_model_with_a_motion_adapter_makes_a_video(models, tmp_path):
    adapter = tiny_pipelines.save_motion_adapter(tmp_path / "adapter")
    generator = build(models("stable-diffusion"), motion_adapter=adapter)
    video = generator.generate(PROMPT)
    assert video.metadata["pipeline"] == "AnimateDiffPipeline"
    frames = pixels(video)
    assert frames.shape == (5, 32, 32, 3)
    assert not np.array_equal(frames[0], frames[1])
    with pytest.raises(InputError, match="there is no motion_adapter in"):
        build(models("stable-diffusion"), motion_adapter=tmp_path / "none").generate(PROMPT)
    weights = next(adapter.glob("*.safetensors"))
    weights.write_bytes(weights.read_bytes()[:-10])
    with pytest.raises(FileFormatError, match=r"adapter/.*is damaged"):
        build(models("stable-diffusion"), motion_adapter=adapter).generate(PROMPT)
