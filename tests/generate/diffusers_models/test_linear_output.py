"""Light that LTX-2's HDR pipeline makes of its decoder's output reaches the models unclipped."""

from fractions import Fraction

import numpy as np
import pytest

from texvent.generate.diffusers_models.model_run import LINEAR_PIPELINES
from texvent.generate.videos.stored_video import write_video
from texvent.video import transfer_of

torch = pytest.importorskip("torch")
pytestmark = pytest.mark.torch


def test_the_pipelines_are_those_of_diffusers():
    diffusers = pytest.importorskip("diffusers")
    assert all(hasattr(diffusers, name) for name in LINEAR_PIPELINES)


def test_light_above_white_is_stored_as_logc3_has_it(tmp_path):
    pytest.importorskip("diffusers")
    from diffusers.pipelines.ltx2 import LTX2VideoHDRProcessor

    # LogC3 at EI 800: light (10^((code - 0.385537) / 0.247190) - 0.052272) / 5.555556, and a line
    # below 5.367655 · 0.010591 + 0.092809 = 0.149658. The decoder gives codes as -1..1.
    codes = np.array([0.1, 0.391007, 0.570631, 0.8, 1.0])
    expected = np.where(
        codes < 0.149658,
        (codes - 0.092809) / 5.367655,
        (10 ** ((codes - 0.385537) / 0.247190) - 0.052272) / 5.555556,
    )
    assert expected[1] == pytest.approx(0.18, abs=1e-3)  # a grey card, as ARRI publishes it
    decoded = torch.tensor(2 * codes - 1, dtype=torch.float32).view(1, 1, 1, 1, 5)
    decoded = decoded.expand(1, 3, 2, 4, 5)  # [B, C, F, H, W]
    frames = LTX2VideoHDRProcessor().postprocess_hdr_video(decoded, output_type="np")[0]
    facts = {"transfer": "linear"}
    stored = write_video(frames, tmp_path / "v.avi", Fraction(24), facts, overwrite=False)
    assert transfer_of(stored) == "linear"
    first = next(iter(stored))
    assert first.pixels[0, :, 1] == pytest.approx(255 * expected, rel=1e-3)
    assert first.pixels.max() > 255 * 50
