"""Frames of a network that are kept between the runs of a benchmark."""

from dataclasses import replace
from types import SimpleNamespace

import numpy as np
import pytest
from tests.interpolate.rife.rife_files import save_published

from texvent.frames import Frame, Video
from texvent.pairs.frame_pair import FramePair
from texvent.run.prepare import prepare_video
from texvent.settings.resolution import resolve
from texvent_lab.bench import kept_frames
from texvent_lab.bench.kept_frames import FrameStore, KeepingSimulation, keep_frames


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


PAIR = FramePair(*frames(2, level=7)[:2], change=None, between=(), times_us=(1, 2))
CHANGES = {
    "nothing": {},
    "the earlier frame": {"first": frames(1, level=8)[0]},
    "the later frame": {"second": frames(2, level=8)[1]},
    "its time": {"second": replace(PAIR.second, t_us=9)},
    "the kind of its numbers": {"first": replace(PAIR.first, pixels=np.full((2, 3), 7, np.uint8))},
    "an instant": {"times_us": (1, 3)},
}


@pytest.mark.parametrize("change", [*CHANGES, "an option of the network", "its way of motion"])
def test_frames_are_kept_for_the_same_network_pair_and_instants_alone(monkeypatch, change):
    made, facts = [], {"weights": "a", "rife_flow": "once"}
    part = SimpleNamespace(provenance=lambda config: {"weights": facts["weights"]})
    monkeypatch.setattr(kept_frames, "INTERPOLATORS", SimpleNamespace(load=lambda name: part))
    monkeypatch.setattr(kept_frames, "STORE", FrameStore(most_bytes=2**20))

    def show(pair):
        def begin(self, threads):
            made_now = (made.append(1) or one for one in frames(2))
            return None, iter([replace(pair, between=made_now)])

        monkeypatch.setattr(kept_frames.Simulation, "begin", begin)
        settings = SimpleNamespace(interpolate=SimpleNamespace(interpolate="x", **facts))
        run = object.__new__(KeepingSimulation)
        object.__setattr__(run, "settings", settings)
        return [[*one.between] for one in run.begin(None)[1]]

    assert len(show(PAIR)[0]) == len(show(PAIR)[0]) == len(made) == 2
    facts |= {"an option of the network": {"weights": "b"}, "its way of motion":
              {"rife_flow": "each"}}.get(change, {})  # fmt: skip
    show(replace(PAIR, **CHANGES.get(change, {})))
    assert len(made) == (2 if change == "nothing" else 4)


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
