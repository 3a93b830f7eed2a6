"""Videos in memory: frames as a file of them has, on the device of the model too."""

from fractions import Fraction

import numpy as np
import pytest

pytestmark = pytest.mark.torch
torch = pytest.importorskip("torch")

from texvent.errors import InputError  # noqa: E402
from texvent.generation.videos.stored_video import (  # noqa: E402
    MadeVideo,
    to_16_bits_there,
    write_video,
)
from texvent.pairs.on_device import luma_on, pixels_on  # noqa: E402
from texvent.sensor import SensorSize  # noqa: E402

FPS = Fraction(30_000, 1001)


@pytest.mark.parametrize("dtype", [torch.float32, torch.bfloat16, torch.float16])
def test_frames_are_those_of_the_file_and_are_on_the_device_already(dtype, tmp_path):
    random = torch.Generator().manual_seed(0)
    frames = (torch.rand((3, 18, 22, 3), generator=random) * 1.5 - 0.25).to(dtype)
    levels = to_16_bits_there(frames)
    made = MadeVideo(FPS, SensorSize(22, 18), 3, {"seed": 1}, levels=levels)
    host, made = made.pixels, made.with_metadata(seed=2)
    assert made.pixels is host
    stored = write_video(frames.float().numpy(), tmp_path / "v.avi", FPS, {}, overwrite=False)
    assert (made.frame_count, made.size, made.metadata) == (3, stored.size, {"seed": 2})
    for ours, read, level in zip(made, stored, levels, strict=True):
        assert ours.t_us == read.t_us
        assert np.array_equal(ours.pixels, read.pixels)
        assert pixels_on(ours, level.device).data_ptr() == level.data_ptr()
        assert np.array_equal(luma_on(ours, level.device).numpy(), read.luma)


@pytest.mark.parametrize("bad", [float("nan"), float("inf")])
def test_a_model_that_makes_no_numbers_or_no_frame_is_refused(bad):
    frames = torch.full((2, 4, 4, 3), 0.5)
    frames[1, 2, 3, 0] = bad
    with pytest.raises(InputError, match="NaN or infinite values; try another seed"):
        to_16_bits_there(frames)
    with pytest.raises(InputError, match="the video has no frame"):
        to_16_bits_there(frames[:0])
