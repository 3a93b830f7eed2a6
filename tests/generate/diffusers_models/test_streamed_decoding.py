"""Decoding in order against the decoder's own call, on tiny random decoders of every family."""

import pytest

pytestmark = pytest.mark.torch
diffusers = pytest.importorskip("diffusers")
torch = pytest.importorskip("torch")

from tests.generate.tiny_pipelines import cogvideox_vae, ltx_vae, random_weights, wan_vae  # noqa: E402

from texvent.generate.diffusers_models.streamed_decoding import can_stream, stream_decoder  # noqa: E402


def wan22_5b_vae():
    """Packs 2x2 patches into channels, as the decoder of Wan 2.2 5B does."""
    return diffusers.AutoencoderKLWan(
        base_dim=3,
        decoder_base_dim=3,
        z_dim=16,
        dim_mult=[1, 1, 1, 1],
        num_res_blocks=1,
        is_residual=True,
        patch_size=2,
        in_channels=12,
        out_channels=12,
        scale_factor_spatial=16,
    )


def hunyuan_vae():
    return diffusers.AutoencoderKLHunyuanVideo(
        latent_channels=4,
        block_out_channels=(8, 8, 8, 8),
        layers_per_block=1,
        norm_num_groups=4,
    )


def stepwise_ltx_vae(**facts):
    vae = ltx_vae(**facts)
    vae.use_framewise_decoding = True
    return vae


FAMILIES = {
    "wan": (wan_vae, 16, 4),
    "wan in patches": (wan22_5b_vae, 16, 4),
    "cogvideox": (cogvideox_vae, 4, 5),
    "hunyuan": (hunyuan_vae, 4, 10),
    "ltx": (stepwise_ltx_vae, 8, 5),
}


def make(name, frames, size):
    build, channels, _ = FAMILIES[name]
    with random_weights():
        vae = build().eval()
        latents = torch.randn(1, channels, frames, *size)
    return vae, latents


def compare(vae, latents, *conditions):
    with torch.no_grad():
        whole = vae.decode(latents, *conditions).sample
        chunks = list(stream_decoder(vae, latents, *conditions))
    joined = torch.cat(chunks, dim=2)
    assert joined.shape == whole.shape
    assert torch.allclose(joined, whole, atol=1e-5)
    return chunks


@pytest.mark.parametrize("name", FAMILIES)
def test_the_chunks_are_the_frames_of_one_call(name):
    vae, latents = make(name, FAMILIES[name][2], (4, 5))
    assert can_stream(vae)
    chunks = compare(vae, latents)
    assert len(chunks) > 1


@pytest.mark.parametrize("name", FAMILIES)
def test_tiles_that_advance_together_are_the_frames_of_tiles_one_after_another(name):
    vae, latents = make(name, FAMILIES[name][2], (7, 9))
    ratio = 32 if name == "ltx" else 16 if name == "wan in patches" else 8
    size = {"tile_sample_min_height": 4 * ratio, "tile_sample_min_width": 4 * ratio}
    if name == "cogvideox":
        size |= {"tile_overlap_factor_height": 0.25, "tile_overlap_factor_width": 0.25}
    else:
        size |= {"tile_sample_stride_height": 3 * ratio, "tile_sample_stride_width": 3 * ratio}
    vae.enable_tiling(**size)
    with torch.no_grad():
        whole = vae.decode(latents).sample
        vae.use_tiling = False
        untiled = vae.decode(latents).sample
        vae.use_tiling = True
    assert not torch.allclose(whole, untiled, atol=1e-5), "the tiles are too large to show"
    assert len(compare(vae, latents)) > 1


@pytest.mark.parametrize("frames", [1, 2, 3, 4, 5])
@pytest.mark.parametrize("name", FAMILIES)
def test_any_number_of_latent_frames_is_decoded(name, frames):
    compare(*make(name, frames, (3, 3)))


def test_the_time_step_of_a_decoder_reaches_every_window():
    with random_weights():
        vae = stepwise_ltx_vae(timestep_conditioning=True).eval()
        latents = torch.randn(1, 8, 5, 3, 3)
    early = compare(vae, latents, torch.tensor([0.5]))
    late = compare(vae, latents, torch.tensor([0.05]))
    assert not torch.allclose(early[-1], late[-1], atol=1e-5)


def test_decoders_that_see_the_whole_clip_are_not_streamed():
    assert not can_stream(ltx_vae())
    assert not can_stream(torch.nn.Identity())


def test_decoding_holds_one_step_at_a_time(monkeypatch):
    vae, latents = make("wan", 6, (3, 3))
    calls = []
    forward = vae.decoder.forward
    monkeypatch.setattr(
        vae.decoder, "forward", lambda *args, **more: calls.append(1) or forward(*args, **more)
    )
    with torch.no_grad():
        chunks = stream_decoder(vae, latents)
        next(chunks)
    assert len(calls) == 1
