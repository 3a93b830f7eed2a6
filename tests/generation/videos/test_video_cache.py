"""Generated videos on disk: lossless, whole or not there, found by what made them."""

import threading
from fractions import Fraction

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st
from tests.examples import examples

from texvent.capture.open import open_frames
from texvent.config import CaptureConfig
from texvent.errors import FileFormatError, InputError, TexventWarning, warnings_to
from texvent.frames import Video, frame_time_us, transfer_of
from texvent.generation.videos.stored_video import reopen, to_16_bits, write_stream, write_video
from texvent.generation.videos.video_cache import VideoCache, content_key, kept_folder
from texvent.runtime.files.hidden_parts import is_hidden_part
from texvent.runtime.work import side_work
from texvent.runtime.work.interrupts import clean_up
from texvent.transfer import Transfer

FPS = Fraction(30_000, 1001)


@pytest.fixture(autouse=True)
def cache(tmp_path, monkeypatch):
    monkeypatch.setenv("TEXVENT_CACHE", str(tmp_path / "cache"))
    return VideoCache(is_kept=True)


def noise(count=5, height=18, width=22, seed=0):
    return np.random.default_rng(seed).random((count, height, width, 3), dtype=np.float32)


def test_frames_come_back_to_within_half_a_16_bit_step(tmp_path):
    frames = noise()
    video = write_video(iter(frames), tmp_path / "v.avi", FPS, {}, overwrite=False)
    back = np.stack([frame.pixels for frame in video])
    assert back.dtype == np.uint16
    assert np.abs(back / 65_535 - frames).max() <= 0.5 / 65_535 + 1e-7
    assert (video.frame_count, video.size) == (5, (22, 18))


def test_a_stored_8_bit_clip_is_the_same_in_16_bits(tmp_path):
    levels = np.arange(256, dtype=np.uint8).reshape(1, 16, 16).repeat(3, axis=0)
    times = [frame_time_us(number, FPS) for number in range(3)]
    stored = write_stream(Video(levels, times, fps=FPS), tmp_path / "v.avi", overwrite=False)
    for frame in stored:
        assert np.array_equal(frame.pixels, levels[0, ..., None].repeat(3, axis=2) * np.uint16(257))


def test_a_stored_video_read_as_any_other_video_gives_the_same_frames(tmp_path):
    video = write_video(noise(), tmp_path / "v.avi", FPS, {"seed": 1}, overwrite=False)
    read = open_frames(video.path, CaptureConfig())
    for ours, theirs in zip(video, read, strict=True):
        assert ours.t_us == theirs.t_us
        assert np.array_equal(ours.pixels, theirs.pixels)


@examples(50)
@given(st.floats(-1, 2, width=32))
def test_rounding_to_16_bits_clips_and_is_nearest(value):
    levels = to_16_bits(np.full((1, 1, 3), value, np.float32))
    assert abs(int(levels[0, 0, 0]) - min(max(value, 0), 1) * 65_535) <= 0.5 + 0.01


def test_a_nan_of_the_model_is_refused_and_leaves_nothing(tmp_path):
    frames = noise()
    frames[3, 0, 0, 0] = np.nan
    with pytest.raises(InputError, match="NaN"):
        write_video(frames, tmp_path / "v.avi", FPS, {}, overwrite=False)
    assert list(tmp_path.iterdir()) == []


def test_a_stream_without_frames_or_rate_is_refused_and_leaves_nothing(tmp_path):
    still = Video(np.zeros((1, 8, 8), np.uint8), [0])
    with pytest.raises(InputError, match="has no frame rate, so it cannot be written; give `fps`"):
        write_stream(still, tmp_path / "v.avi", overwrite=False)
    with pytest.raises(InputError, match="the video has no frame"):
        write_video([], tmp_path / "v.avi", FPS, {}, overwrite=False)
    assert list(tmp_path.iterdir()) == []


def test_a_video_is_found_again_by_its_key_with_its_metadata(cache):
    stored = cache.store("abc", noise(), FPS, {"prompt": "ä cat", "seed": 0})
    found = cache.find("abc", Fraction(10))
    assert found.path == stored.path
    assert found.metadata["prompt"] == "ä cat"
    assert found.metadata["seed"] == 0
    assert [frame.t_us for frame in found][1] == 100_000
    assert cache.find("abd", FPS) is None


def test_a_kept_video_that_is_damaged_is_not_found_and_made_again(cache):
    path = cache.store("abc", noise(), FPS, {}).path
    content = path.read_bytes()
    for place in range(0, len(content) - 2000, len(content) // 30):
        flipped = content[:place] + bytes([content[place] ^ 16]) + content[place + 1 :]
        for damaged in (content[:place], flipped):
            path.write_bytes(damaged)
            with pytest.warns(TexventWarning, match="is damaged.*is made again"):
                assert cache.find("abc", FPS) is None
        path.write_bytes(content[:place])
        found = reopen(path)
        if found is not None:
            with pytest.raises(FileFormatError, match="delete it and generate again"):
                list(found)
    cache.store("abc", noise(), FPS, {})
    assert len(list(cache.find("abc", FPS))) == 5


def test_without_reuse_nothing_is_kept_in_the_made_folder():
    passing = VideoCache(is_kept=False)
    video = passing.store("abc", noise(), FPS, {})
    assert len(list(video)) == 5
    assert passing.find("abc", FPS) is None
    assert list(kept_folder().iterdir()) == []


def paused_frames(go):
    """Frames of which the second comes when it may."""
    frames = noise()
    yield frames[0]
    assert go.wait(300)
    yield from frames[1:]


def test_a_video_that_is_written_beside_is_waited_for(cache):
    go = threading.Event()
    cache.store_beside("abc", paused_frames(go), FPS, {})
    assert not cache.path("abc").exists()
    go.set()
    assert len(list(cache.find("abc", FPS))) == 5


def test_a_process_that_is_stopped_leaves_a_whole_video_or_none(cache, monkeypatch):
    monkeypatch.setattr(side_work, "PATIENCE_S", 0.0)
    go = threading.Event()
    with warnings_to(lambda text: None):
        cache.store_beside("abc", paused_frames(go), FPS, {})
        clean_up()  # does not wait for what goes on for long
        go.set()
        found = cache.find("abc", FPS)
    assert not [path for path in kept_folder().iterdir() if is_hidden_part(path)]
    assert found is None or len(list(found)) == 5


def test_a_process_that_is_stopped_finishes_what_is_nearly_done(cache):
    cache.store_beside("abc", noise(), FPS, {})
    clean_up()
    assert not side_work._running
    assert len(list(cache.find("abc", FPS))) == 5


def test_the_key_follows_every_fact_and_not_their_order():
    facts = {"prompt": "a cat", "seed": 0, "frames": 9}
    assert content_key(facts) == content_key(dict(reversed(facts.items())))
    keys = {content_key({**facts, name: "other"}) for name in facts} | {content_key(facts)}
    assert len(keys) == 4


def linear_clip():
    """Three frames of light from 1/1000 of white to 2000 times white."""
    rng = np.random.default_rng(4)
    return [np.exp(rng.uniform(-7, 7.6, (6, 8, 3))).astype(np.float32) for _ in range(3)]


def test_light_above_white_is_kept_as_half_floats(tmp_path):
    frames, facts = linear_clip(), {"transfer": "linear", "prompt": "a lamp"}
    path = tmp_path / "v.avi"
    written = write_video(frames, path, Fraction(24), facts, overwrite=False)
    reopened = reopen(path)
    ordinary = open_frames(path, CaptureConfig())
    for stream in (written, reopened, ordinary):
        assert transfer_of(stream) is Transfer.LINEAR
        for frame, light in zip(stream, frames, strict=True):
            assert np.array_equal(frame.pixels, light.astype(np.float16).astype(np.float32) * 255)
            assert frame.transfer is Transfer.LINEAR
    again = write_stream(ordinary, tmp_path / "w.avi", overwrite=False)
    for frame, light in zip(again, frames, strict=True):
        assert frame.pixels == pytest.approx(255 * light, rel=1 / 1024)
