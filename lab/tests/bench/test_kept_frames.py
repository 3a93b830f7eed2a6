"""Frames of a network that are kept between the runs of a benchmark."""

import numpy as np
import pytest
from tests.interpolate.rife.rife_files import save_published

from texvent.frames import Frame, Video
from texvent.run.prepare import prepare_video
from texvent.settings.resolution import resolve
from texvent_lab.bench import kept_frames
from texvent_lab.bench.kept_frames import FrameStore, keep_frames


def frames(count, level=0):
    return [Frame(np.full((2, 3), level, np.float32), t, is_source=False) for t in range(count)]


def made_anew(store, key, between):
    """Whether a store reads the frames that are offered to it."""
    read = []
    found = list(store.frames(key, (read.append(one) or one for one in between)))
    assert len(found) == len(between)
    return bool(read)


def test_the_frames_that_were_read_least_recently_make_room():
    store = FrameStore(most_bytes=2 * 2 * 24)  # two pairs with two frames of 24 bytes
    assert [made_anew(store, key, frames(2)) for key in "ababcacb"] == [
        True, True, False, False, True, True, False, True
    ]  # fmt: skip
    assert made_anew(FrameStore(most_bytes=0), "a", frames(2))


@pytest.mark.torch
@pytest.mark.parametrize("flow", ["each", "once"])
def test_a_network_makes_the_frames_of_a_video_once_for_all_runs(
    tmp_path, monkeypatch, moving_texture, flow
):
    torch = pytest.importorskip("torch")
    from texvent.interpolate.rife.network import LAYOUTS, RifeNetwork

    weights = save_published(torch, LAYOUTS[0], tmp_path / "rife.pkl")
    options = {"interpolate": "rife", "rife_flow": flow, "interpolator_weights": weights}
    runs = [
        resolve("simulate", {**options, "noise": "random", "noise_rate_hz": 90.0, "seed": seed})
        for seed in (0, 1)
    ]
    images = [moving_texture(2.0 * number, width=16, height=12) for number in range(4)]
    video = Video(np.stack(images), [0, 40_000, 80_000, 120_000])
    whole = [prepare_video(video, one).packets.collect() for one in runs]
    monkeypatch.setattr(kept_frames, "STORE", FrameStore(most_bytes=2**20))
    called, forward = [], RifeNetwork.forward
    monkeypatch.setattr(
        RifeNetwork, "forward", lambda self, *one: called.append(1) or forward(self, *one)
    )
    kept = [keep_frames(prepare_video(video, one)).packets.collect() for one in runs]
    assert kept == whole
    assert whole[0] != whole[1]  # the noise of another seed
    first = len(called)
    assert first > 0
    keep_frames(prepare_video(video, runs[0])).packets.collect()
    assert len(called) == first
    other = Video(np.flip(video.pixels, 2), video.times_us)
    keep_frames(prepare_video(other, runs[0])).packets.collect()
    assert len(called) == 2 * first
