"""Option dataclasses: what they refuse."""

from fractions import Fraction

import pytest

from texvent.config import CaptureConfig, InterpolateConfig, RunConfig
from texvent.errors import ConfigError


@pytest.mark.parametrize(
    "bad",
    [
        lambda: RunConfig(seed=-1),
        lambda: CaptureConfig(fps=Fraction(0)),
        lambda: CaptureConfig(start=2.0, stop=1.0),
        lambda: InterpolateConfig(max_intermediate=-1),
        lambda: InterpolateConfig(frames_per_pixel=float("nan")),
    ],
)
def test_options_out_of_range_are_refused(bad):
    with pytest.raises(ConfigError, match="must be"):
        bad()
