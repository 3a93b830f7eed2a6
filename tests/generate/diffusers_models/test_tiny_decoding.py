"""Pipelines whose frames come from a tiny decoder: the right latents, and refusals before work."""

import dataclasses
import hashlib
import os
from types import SimpleNamespace

import numpy as np
import pytest

pytestmark = [pytest.mark.torch, pytest.mark.usefixtures("model_cache")]
os.environ["HF_HUB_OFFLINE"] = "1"
torch = pytest.importorskip("torch")
torch.set_num_threads(1)  # tiny arrays: more threads only wait for each other
diffusers = pytest.importorskip("diffusers")

from texvent.errors import InputError  # noqa: E402
from texvent.generate.tiny_decoder.fitting import PUBLISHED, tiny_input  # noqa: E402
from texvent.generate.tiny_decoder.network import read_tiny_decoder  # noqa: E402

from ..tiny_decoder.tiny_files import BASE, save_tiny_decoder  # noqa: E402
from ..tiny_models import PROMPT, build, pixels  # noqa: E402

WAN = dataclasses.replace(BASE, latent_channels=16)
COGVIDEOX = dataclasses.replace(BASE, latent_channels=4)


@pytest.mark.parametrize("name", ["wan", "wan22"])
def test_wan_is_decoded_from_what_it_denoises(name, models, tmp_path):
    """Not from what its own decoder takes, which is scaled and shifted."""
    path = save_tiny_decoder(tmp_path / "taew2_1.safetensors", WAN)
    latents = build(models(name)).generate_latents(PROMPT)
    expected = np.stack(list(read_tiny_decoder(path).frames(latents.values)))
    generator = build(models(name), decoder=path)
    video = generator.generate(PROMPT)
    assert expected.shape == (5, 32, 32, 3)
    assert np.abs(pixels(video) / 65_535 - expected).max() < 1e-4
    sha256 = hashlib.sha256(path.read_bytes()).hexdigest()
    assert video.metadata["files"] == [{"file": str(path), "sha256": sha256}]
    again = np.stack(list(generator.decode(latents)))
    assert np.abs(again - expected).max() < 1e-4


@pytest.mark.parametrize(("name", "asked", "made"), [("cogvideox", 9, 9), ("cogvideox15", 5, 8)])
def test_cogvideox_is_decoded_from_what_its_decoder_takes(name, asked, made, models, tmp_path):
    path = save_tiny_decoder(tmp_path / "taecvx.pth", COGVIDEOX)
    latents = build(models(name), frames=asked).generate_latents(PROMPT)
    frames = read_tiny_decoder(path).frames(latents.decoder_input, pads_start=True)
    expected = np.stack(list(frames))
    video = pixels(build(models(name), frames=asked, decoder=path).generate(PROMPT))
    assert len(expected) == len(video) == made
    assert np.abs(video / 65_535 - expected).max() < 1e-4


def test_other_models_are_decoded_from_what_they_denoise():
    """The inverse of what HunyuanVideo's and LTX-2's pipelines do before they decode."""
    denoised = torch.randn(1, 2, 3, 4, 4)
    for name in ("AutoencoderKLHunyuanVideo", "AutoencoderKLHunyuanVideo15"):
        vae = type(name, (), {"config": SimpleNamespace(scaling_factor=0.476986)})()
        assert torch.allclose(tiny_input(vae, denoised / 0.476986), denoised[0])
    mean, deviation = torch.tensor([1.0, -2.0]), torch.tensor([0.5, 3.0])
    facts = {"latents_mean": mean, "latents_std": deviation}
    vae = type("AutoencoderKLLTX2Video", (), facts)()
    vae.config = SimpleNamespace(scaling_factor=2.0)
    scaled = diffusers.LTX2Pipeline._denormalize_latents(denoised, mean, deviation, 2.0)
    assert torch.allclose(tiny_input(vae, scaled), denoised[0], atol=1e-6)


def test_the_decoders_that_have_tiny_ones_exist():
    for name in PUBLISHED:
        assert hasattr(diffusers, name)


def test_another_tiny_decoder_makes_the_video_anew(models, tmp_path):
    path = save_tiny_decoder(tmp_path / "taew2_1.safetensors", WAN)
    first = pixels(build(models("wan"), decoder=path).generate(PROMPT))
    save_tiny_decoder(path, WAN, seed=5)
    assert not np.array_equal(pixels(build(models("wan"), decoder=path).generate(PROMPT)), first)


class Quiet:
    """Fails when a model is loaded."""

    def announce(self, line):
        raise AssertionError(line)


def test_a_decoder_of_other_sizes_is_refused_before_denoising(models, tmp_path):
    wide = dataclasses.replace(WAN, patch=2)
    path = save_tiny_decoder(tmp_path / "mine.safetensors", wide)

    class Watcher:
        def announce(self, line):
            pass

        def advance(self, stage, done, total):
            raise AssertionError(stage)

    with pytest.raises(InputError, match=r"makes 4 frames and 16 pixels .* makes 4 and 8"):
        build(models("wan"), decoder=path).generate(PROMPT, progress=Watcher())
