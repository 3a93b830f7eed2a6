"""What a check advises helps."""

import numpy as np
import pytest
from tests.video_check.made_clips import encode, pan

from texvent.run.check import check_source


def test_frames_without_repeats_at_the_true_rate_are_clean(tmp_path):
    images = pan(32)
    repeated = encode(
        np.repeat(images, np.resize([1, 1, 1, 2], 32), axis=0), tmp_path / "a.mp4", fps=30, crf="18"
    )
    dropped = encode(images, tmp_path / "b.mp4", fps=30, crf="18")
    assert check_source(repeated, progress=False).report.remarks == ("repeated frames",)
    found = check_source(dropped, fps=24, progress=False).report
    assert found.remarks == ()
    assert found.measurements["fps"] == pytest.approx(24)
