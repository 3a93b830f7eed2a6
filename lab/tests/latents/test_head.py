"""The head on tiny latents: what it sees, its files, and what it refuses."""

from __future__ import annotations

import dataclasses
from collections.abc import Callable
from fractions import Fraction
from pathlib import Path

import numpy as np
import pytest

torch = pytest.importorskip("torch", reason="make test-torch runs the tests that need torch")

from texvent.errors import ConfigError, FileFormatError, InputError  # noqa: E402
from texvent.generate.diffusers_models.latents import Latents  # noqa: E402
from texvent_lab.latents.autoencoder import Autoencoder  # noqa: E402
from texvent_lab.latents.head import (  # noqa: E402
    HeadConfig,
    LatentHead,
    load_head,
    save_head,
)

from .tiny_autoencoder import write_autoencoder, write_ltx_autoencoder  # noqa: E402

pytestmark = pytest.mark.torch
CONFIG = HeadConfig(
    channels=4, frames_per_latent=2, pixels_per_latent=4, bins=3, width=5, blocks=1, balance=20.0
)


def make_head() -> LatentHead:
    draws = torch.Generator().manual_seed(1)
    head = LatentHead(CONFIG)
    state = {
        name: 0.2 * torch.randn(one.shape, generator=draws) for name, one in head.tensors.items()
    }
    head.load_state_dict(state)
    return head


def make_latents(frames: int = 4, **changed) -> Latents:
    values = np.random.default_rng(0).normal(size=(4, frames, 3, 5)).astype(np.float32)
    ones = np.ones(4, np.float32)
    return dataclasses.replace(Latents(values, ones, ones, Fraction(24), 2, 4), **changed)


def test_the_head_gives_bins_of_pixels_for_every_latent_frame_but_the_first() -> None:
    change = make_head().predict(make_latents())
    assert change.voxels.shape == (3, 3, 12, 20)
    assert change.voxels.dtype == np.float32
    assert (change.fps, change.frames_per_latent, change.balance) == (24, 2, 20.0)
    # Three intervals of two frames.
    assert change.edges_us[-1] == 250_000


def test_later_latent_frames_change_nothing_before_them() -> None:
    head, latents = make_head(), make_latents(5)
    whole = head.predict(latents).voxels
    for count in (2, 3, 4):
        early = head.predict(make_latents(values=latents.values[:, :count])).voxels
        np.testing.assert_allclose(early, whole[: count - 1], rtol=0, atol=1e-5)


def test_a_voxel_is_channel_b_p_p_of_its_latent_pixel() -> None:
    head = LatentHead(CONFIG)
    head.last.bias.data = torch.arange(48.0)
    voxels = head(torch.zeros(1, 4, 2, 2, 2))[0, 0]
    for b, y, x in np.ndindex(3, 8, 8):
        assert voxels[b, y, x] == b * 16 + (y % 4) * 4 + x % 4


def test_a_stored_head_is_the_same_head(tmp_path: Path) -> None:
    head, path = make_head(), tmp_path / "head.safetensors"
    save_head(head, path)
    loaded = load_head(path)
    assert loaded.config == CONFIG
    expected = head.predict(make_latents()).voxels
    np.testing.assert_array_equal(loaded.predict(make_latents()).voxels, expected)
    with pytest.raises(ConfigError, match="safetensors"):
        save_head(head, tmp_path / "head.pt")


def test_files_that_hold_no_head_are_refused(tmp_path: Path) -> None:
    from safetensors.torch import save_file

    head, path = make_head(), tmp_path / "head.safetensors"
    with pytest.raises(InputError, match="there is no file"):
        load_head(path)
    save_file(dict(head.tensors), path)
    with pytest.raises(FileFormatError, match="does not say the sizes"):
        load_head(path)
    head.config = dataclasses.replace(CONFIG, width=6)
    save_head(head, path, overwrite=True)
    with pytest.raises(FileFormatError, match="does not fit the network"):
        load_head(path)
    head.config = CONFIG
    head.first.bias.data[0] = torch.nan
    save_head(head, path, overwrite=True)
    with pytest.raises(FileFormatError, match="NaN"):
        load_head(path)


@pytest.mark.parametrize("write", [write_autoencoder, write_ltx_autoencoder])
def test_latents_have_the_scale_and_shift_that_the_decoder_takes_back(
    write: Callable[[Path], Path], tmp_path: Path
) -> None:
    autoencoder = Autoencoder.load(write(tmp_path))
    frames = np.random.default_rng(0).uniform(0, 255, (5, 8, 12, 3)).astype(np.float32)
    latents = autoencoder.encode(frames, Fraction(24))
    assert latents.values.shape == (4, 3, 2, 3)
    inputs = torch.from_numpy(frames).permute(3, 0, 1, 2)[None] / 127.5 - 1
    with torch.no_grad():
        expected = autoencoder.module.encode(inputs).latent_dist.mode()[0]
        assert autoencoder.module.decode(expected[None]).sample.shape == (1, 3, 5, 8, 12)
    np.testing.assert_allclose(latents.decoder_input, expected, rtol=1e-4, atol=1e-5)
