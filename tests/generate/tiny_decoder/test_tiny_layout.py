"""Layouts of tiny decoders: the numbers of the published files, and reading them from shapes."""

import dataclasses

import pytest

from texvent.errors import FileFormatError
from texvent.generate.tiny_decoder.fitting import check_model
from texvent.generate.tiny_decoder.layout import TinyLayout, read_layout

from .tiny_files import LAYOUTS

WAN = TinyLayout(16, (256, 128, 64, 64), (1, 2, 2), 1, is_super=False)
WAN_22 = dataclasses.replace(WAN, latent_channels=48, patch=2)
WAN_22_SUPER = TinyLayout(48, (512, 256, 128, 64), (1, 2, 2), 2, is_super=True)
LTX_2 = TinyLayout(128, (256, 128, 64, 64), (2, 2, 2), 4, is_super=False)


@pytest.mark.parametrize(
    ("layout", "frames", "pixels"), [(WAN, 4, 8), (WAN_22, 4, 16), (LTX_2, 8, 32)]
)
def test_what_a_latent_gives(layout, frames, pixels):
    assert (layout.frames_per_latent, layout.pixels_per_latent) == (frames, pixels)


def test_names_and_shapes_are_those_of_the_published_files():
    """From taehv.py: `nn.Sequential` numbers its layers, those without weights included."""
    shapes = WAN.tensor_shapes()
    assert shapes["decoder.1.weight"] == (256, 16, 3, 3)
    assert shapes["decoder.3.conv.0.weight"] == (256, 512, 3, 3)
    assert shapes["decoder.7.conv.weight"] == (256, 256, 1, 1)
    assert shapes["decoder.13.conv.weight"] == (256, 128, 1, 1)
    assert shapes["decoder.20.weight"] == (64, 64, 3, 3)
    assert shapes["decoder.22.weight"] == (3, 64, 3, 3)
    assert "decoder.8.bias" not in shapes
    shapes = WAN_22_SUPER.tensor_shapes()
    assert shapes["decoder.0.weight"] == (512, 48, 1, 1)
    assert shapes["decoder.1.conv.0.weight"] == (1024, 1, 7, 7)
    assert shapes["decoder.4.weight"] == (1024, 512, 3, 3)
    assert shapes["decoder.7.conv.weight"] == (256, 256, 1, 1)
    assert shapes["decoder.14.conv.weight"] == (256, 128, 1, 1)
    assert shapes["decoder.22.weight"] == (12, 64, 3, 3)
    assert "decoder.0.bias" not in shapes


@pytest.mark.parametrize("layout", [WAN, WAN_22, WAN_22_SUPER, LTX_2, *LAYOUTS.values()])
def test_a_layout_is_read_from_its_shapes(layout):
    assert read_layout(layout.tensor_shapes()) == layout


def test_other_networks_have_no_layout():
    assert read_layout({}) is None
    assert read_layout({"decoder.1.weight": (4,)}) is None


def test_a_damaged_config_of_the_models_own_decoder_is_named(tmp_path):
    config = tmp_path / "vae" / "config.json"
    config.parent.mkdir()
    config.write_text("{")
    index = {"vae": ["diffusers", "AutoencoderKLWan"]}
    with pytest.raises(FileFormatError, match=r"config\.json is damaged"):
        check_model(WAN, tmp_path / "taew2_1.pth", tmp_path, index)
