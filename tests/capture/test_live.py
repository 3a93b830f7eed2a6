import contextlib
import itertools
import os
import signal
import subprocess
import sys
import threading
from pathlib import Path

import cv2
import numpy as np
import pytest

from texvent.capture.live import LiveFrames
from texvent.capture.open import open_frames
from texvent.config import CaptureConfig
from texvent.errors import InputError, TexventWarning

EXCERPT = Path(__file__).parents[1] / "clips" / "bigbuckbunny_excerpt.mp4"


class Pipe:
    """A named pipe that another thread fills, as a camera's driver would."""

    def __init__(self, path: Path) -> None:
        self.path = path
        os.mkfifo(path)

    def fill(self, blocks):
        def write():
            with self.path.open("wb") as end:
                for block in blocks:
                    end.write(block)
                    end.flush()

        threading.Thread(target=write, daemon=True).start()


@pytest.fixture
def pipe(tmp_path):
    return Pipe(tmp_path / "camera")


@pytest.fixture
def film(clips):
    """Matroska can be read from a pipe, an ordinary mp4 cannot; its clock is at 360 ms by then."""
    frames = [np.full((48, 64, 3), 8 * i, np.uint8) for i in range(20)]
    return clips.write("a.mkv", frames, first=9).read_bytes()


def jpegs(count):
    images = (np.full((48, 64, 3), 30 * i, np.uint8) for i in range(count))
    return [cv2.imencode(".jpg", image)[1].tobytes() for image in images]


def test_a_named_pipe_is_live_and_keeps_the_streams_times(pipe, film):
    pipe.fill([film])
    stream = open_frames(pipe.path, CaptureConfig())
    assert (stream.is_live, stream.frame_count, stream.size) == (True, None, (64, 48))
    assert [frame.t_us for frame in stream] == [40_000 * i for i in range(20)]
    assert stream.metadata["clock"] == "presentation"
    with pytest.raises(InputError, match="is live; it can be read once, and was"):
        list(stream)


def test_frames_without_times_get_the_moment_of_arrival(pipe):
    pipe.fill(jpegs(6))
    with pytest.warns(TexventWarning, match=r"holds no times.* give their rate \(`fps`\)"):
        stream = LiveFrames(str(pipe.path))
    times = [frame.t_us for frame in stream]
    assert stream.metadata["clock"] == "arrival"
    assert times[0] == 0
    assert all(later > earlier for earlier, later in itertools.pairwise(times))
    # libav would have said 200 ms sharp, at an invented 25 frames per second.
    assert times[-1] != 200_000


def test_ctrl_c_ends_the_stream_after_the_frame_at_hand(pipe, film):
    pipe.fill([film])
    usual = signal.getsignal(signal.SIGINT)
    times = []
    for frame in open_frames(pipe.path, CaptureConfig()):
        times.append(frame.t_us)
        if len(times) == 3:
            signal.raise_signal(signal.SIGINT)
    assert times == [0, 40_000, 80_000]
    assert signal.getsignal(signal.SIGINT) is usual


def test_a_second_ctrl_c_interrupts(pipe, film):
    pipe.fill([film])
    stream = iter(open_frames(pipe.path, CaptureConfig()))
    next(stream)
    signal.raise_signal(signal.SIGINT)
    with pytest.raises(KeyboardInterrupt):
        signal.raise_signal(signal.SIGINT)
    stream.close()


def test_standard_input_is_read(film):
    script = (
        "from texvent.capture.open import open_frames; from texvent.config import CaptureConfig;"
        "print([f.t_us for f in open_frames('-', CaptureConfig(stop=0.1))])"
    )
    done = subprocess.run(
        [sys.executable, "-c", script], input=film, capture_output=True, check=True, timeout=300
    )
    assert done.stdout.decode().strip() == "[0, 40000, 80000]"


@pytest.mark.parametrize("address", ["/dev/video77", "rtsp://me:secret@127.0.0.1:9/camera"])
def test_a_source_that_does_not_answer_is_named_without_password(address):
    with pytest.raises(InputError) as caught:
        open_frames(address, CaptureConfig())
    assert "secret" not in str(caught.value)
    assert address.split("@")[-1] in str(caught.value)


@pytest.mark.parametrize("again", [0, 1, 3])
def test_frames_without_a_time_of_their_own_are_left_out_and_counted(pipe, clips, again):
    times = [0, 40_000, *(40_100 + number for number in range(again)), 80_000]
    frames = [np.full((48, 64, 3), 8 * i, np.uint8) for i in range(len(times))]
    mjpeg = {"codec": "mjpeg", "stored": "yuvj420p", "ticks": 1_000_000}
    path = clips.write("b.mkv", frames, times_ms=times, **mjpeg)  # which stores whole ms
    pipe.fill([path.read_bytes()])
    stream = open_frames(pipe.path, CaptureConfig())
    said = pytest.warns(TexventWarning, match="frames are left out from 40000 µs on")
    with said if again else contextlib.nullcontext():
        found = [frame.t_us for frame in stream]
    assert found == [0, 40_000, 80_000]
    assert stream.metadata["frames_dropped"] == again
