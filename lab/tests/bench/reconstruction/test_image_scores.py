"""Images against frames: which are compared, how, and what counts."""

import math

import numpy as np
import pytest

from texvent.errors import InputError
from texvent.frames import Frame
from texvent.metrics.image_measures import mean_squared_error
from texvent_lab.bench.reconstruction.scores import (
    ImageScores,
    ScoreCollector,
    pool_scores,
    score_images,
)
from texvent_lab.reconstruct.image_measures import (
    ImageMeasure,
    Measures,
    load_measures,
    peak_signal_to_noise,
)

MSE = Measures(chosen=(ImageMeasure("mse", "lower", mean_squared_error),))


def frame(level, t_us):
    return Frame(np.full((4, 5), level, np.float32), t_us)


def image(value):
    return np.full((4, 5), value, np.float32)


def test_errors_are_those_of_hand():
    a, b = np.array([[0.0, 1.0]]), np.array([[0.5, 0.5]])
    assert mean_squared_error(a, b) == 0.25
    assert peak_signal_to_noise(a, b) == pytest.approx(6.0206, abs=1e-4)
    assert peak_signal_to_noise(a, a) == math.inf


def test_images_are_compared_with_frames_up_to_1_ms_away():
    images = [(1_000, image(1.0)), (2_000, image(1.0)), (9_000, image(0.0))]
    frames = [frame(0, 0), frame(255, 3_000), frame(255, 7_999), frame(255, 10_000)]
    scores = score_images(images, frames, ScoreCollector(MSE))
    assert scores.t_us == [1_000, 2_000, 9_000]
    assert scores.values["mse"] == [1.0, 0.0, 1.0]


def test_an_image_without_a_frame_does_not_count():
    frames = [frame(255, 0), frame(255, 5_000)]
    images = [(1_001, image(0)), (5_500, image(0))]
    assert score_images(images, frames, ScoreCollector(MSE)).t_us == [5_500]


def test_the_span_includes_both_its_ends_and_the_first_images_are_skipped():
    images = [(t_us, image(0)) for t_us in range(0, 60, 10)]
    frames = [frame(0, t_us) for t_us in range(0, 60, 10)]
    spanned = score_images(images, frames, ScoreCollector(MSE, span_us=(20, 40)))
    assert spanned.t_us == [20, 30, 40]
    for first_us, count in ((0, 3), (20, 3), (20, 2), (20, 4)):  # of the recording, not of the span
        scores = ScoreCollector(MSE, span_us=(first_us, 40), skip=count)
        skipped = score_images(images, frames, scores)
        assert skipped.t_us == [one for one in (0, 10, 20, 30, 40)[count:] if one >= first_us]


def test_where_nothing_counts_an_error_says_so():
    with pytest.raises(InputError, match="share a clock"):
        score_images([(0, image(0))], [frame(0, 90_000)], ScoreCollector(MSE))


def test_every_frame_of_several_recordings_counts_the_same():
    short = ImageScores(t_us=[0], values={"mse": [1.0]})
    long = ImageScores(t_us=[0, 1, 2], values={"mse": [0.0, 0.0, math.nan]})
    pooled = pool_scores([short, long])
    assert pooled.mean("mse") == pytest.approx(1 / 3)
    assert math.isnan(ImageScores(t_us=[0], values={"mse": [math.nan]}).mean("mse"))


def test_without_its_weights_lpips_is_left_out_with_the_reason(tmp_path, monkeypatch):
    monkeypatch.setenv("TEXVENT_CACHE", str(tmp_path))
    measures = load_measures()
    assert [one.name for one in measures.chosen] == ["mse", "psnr", "ssim"]
    assert "texvent weights pull lpips" in measures.absent["lpips"]
