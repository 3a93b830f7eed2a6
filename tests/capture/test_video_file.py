import errno
import os
import re
from contextlib import nullcontext
from fractions import Fraction
from pathlib import Path
from types import SimpleNamespace

import av
import cv2
import numpy as np
import pytest
from PIL import Image
from tests.capture.conftest import ClipWriter

import texvent
from texvent.capture import decoding, video_file
from texvent.capture.decoding import PixelReader
from texvent.capture.given_times import FrameTimes
from texvent.capture.live import LiveFrames
from texvent.capture.open import open_frames
from texvent.capture.video_file import PresentationClock, VideoFile
from texvent.cli.app import main
from texvent.config import CaptureConfig
from texvent.errors import FileFormatError, InputError, TexventWarning
from texvent.frames import FrameStream, frame_time_us
from texvent.generation.videos.stored_video import open_stored
from texvent.run.check import check_source
from texvent.sensor import SensorSize

EXCERPT = Path(__file__).parents[1] / "clips" / "bigbuckbunny_excerpt.mp4"
GREY = np.tile(np.arange(64, dtype=np.uint8) * 4, (48, 1))


def colours(count=3, level=0):
    pixels = np.zeros((48, 64, 3), np.uint8)
    pixels[:24, :32] = (250, 20, 60)
    return [np.clip(pixels.astype(int) + level * i, 0, 255).astype(np.uint8) for i in range(count)]


def test_a_real_film_is_read_whole_at_its_own_rate():
    stream = open_frames(EXCERPT, CaptureConfig())
    frames = list(stream)
    assert isinstance(stream, FrameStream)
    assert (stream.size, stream.fps, stream.frame_count) == ((320, 180), 25, 25)
    assert [frame.t_us for frame in frames] == [40_000 * i for i in range(25)]
    # A sunny meadow: bright, green above blue, and moving.
    mean = frames[12].pixels.reshape(-1, 3).mean(axis=0)
    assert mean[1] > mean[2] > 40
    assert np.abs(frames[24].luma - frames[0].luma).mean() > 5


def test_variable_frame_rate_times_are_exact_and_start_at_zero(clips):
    times_ms = [70, 71, 104, 137, 500, 1234]
    path = clips.write("vfr.mkv", colours(6, 8), times_ms=times_ms)
    assert [frame.t_us for frame in VideoFile(path)] == [1000 * (t - 70) for t in times_ms]


@pytest.mark.parametrize("times", [FrameTimes(fps=Fraction(30_000, 1001)), None])
def test_ntsc_times_are_rounded_and_do_not_drift(times):
    clock = PresentationClock(Path("x"), times, None)
    frame = type("F", (), {"time_base": Fraction(1, 30_000), "duration": 1001})()
    read = []
    for frame.pts in range(500, 500 + 1001 * 30_001, 1001):
        read.append(clock.read(frame))
    assert read[:4] == [0, 33_367, 66_733, 100_100]
    assert read[-1] == 1_001_000_000


IDENTITY = (1, 0, 0, 1)


def with_display_matrix(path, matrix):
    """The mp4 file with the matrix of its track replaced."""

    def stored(a, b, c, d):
        matrix = np.array([a, b, 0, c, d, 0, 0, 0, 1 << 14]) * 2**16
        return matrix.astype(">i4").tobytes()

    content = path.read_bytes()
    track = content.index(b"tkhd")
    before = stored(*IDENTITY)
    place = content.index(before, track)
    return content[:place] + stored(*matrix) + content[place + len(before) :]


@pytest.mark.parametrize(
    "matrix",
    [(a, 0, 0, d) for a in (1, -1) for d in (1, -1)]
    + [(0, b, c, 0) for b in (1, -1) for c in (1, -1)],
)
def test_every_display_matrix_is_applied(clips, tmp_path, matrix):
    path = clips.write("asym.mp4", colours(), options={"qp": "0"})
    plain = next(iter(VideoFile(path))).pixels
    turned = tmp_path / "turned.mp4"
    turned.write_bytes(with_display_matrix(path, matrix))
    pixels = next(iter(VideoFile(turned))).pixels
    a, b, c, d = matrix
    height, width = plain.shape[:2]
    # Places around the middle: x' = a x + c y, y' = b x + d y.
    y, x = np.mgrid[:height, :width]
    u, v = 2 * x - (width - 1), 2 * y - (height - 1)
    column = (a * u + c * v + pixels.shape[1] - 1) // 2
    row = (b * u + d * v + pixels.shape[0] - 1) // 2
    assert np.array_equal(pixels[row, column], plain)


@pytest.mark.parametrize(
    ("name", "codec", "is_stated"),
    [
        *(("a.h264", "libx264", True), ("a.m2v", "mpeg2video", True), ("a.y4m", "rawvideo", True)),
        *(("a.mjpeg", "mjpeg", False), ("a.obu", "libsvtav1", False), ("a.y4m", "rawvideo", False)),
    ],
)
def test_a_stream_without_a_container_has_its_own_rate_or_an_assumed_one(
    clips, name, codec, is_stated
):
    stored = "yuvj420p" if codec == "mjpeg" else "yuv420p"
    path = clips.write(name, colours(4, 8), codec=codec, stored=stored, rate=50, ticks=50)
    if codec == "rawvideo" and not is_stated:
        path.write_bytes(path.read_bytes().replace(b" F50:1", b" F0:0"))
    with nullcontext() if is_stated else pytest.warns(TexventWarning, match="so 25 frames per"):
        stream = VideoFile(path)
    step_us = 20_000 if is_stated else 40_000
    assert [frame.t_us for frame in stream] == [step_us * i for i in range(4)]
    times = [frame.t_us for frame in open_frames(path, CaptureConfig(fps=Fraction(50)))]
    assert times == [0, 20_000, 40_000, 60_000]


def wide_pixels(clips):
    path = clips.write("a.y4m", colours(), codec="rawvideo", ticks=25)
    path.write_bytes(path.read_bytes().replace(b" A0:0", b" A2:1"))
    return path


def turned_by_45(clips):
    path = clips.write("a.mp4", colours(), container={"movflags": "faststart"})
    path.write_bytes(with_display_matrix(path, np.array([1, 1, -1, 1]) * 0.5**0.5))
    return path


def transparent_gif(clips):
    images = [Image.new("RGBA", (64, 48), (10, 200, 30, 0)) for _ in range(3)]
    for number, image in enumerate(images):
        image.paste((250, 20, 60, 255), (8 * number, 8, 8 * number + 8, 16))
    path = clips.folder / "a.gif"
    images[0].save(path, save_all=True, append_images=images[1:], duration=40, disposal=2)
    return path


@pytest.mark.parametrize("frames_of", [VideoFile, lambda path: LiveFrames(str(path))])
@pytest.mark.parametrize(
    ("make", "words"),
    [
        (wide_pixels, "states pixels of 2:1, width to height"),
        (turned_by_45, "to be shown turned by 45°"),
        (transparent_gif, "transparent pixels.*read as white"),
    ],
)
def test_marks_that_are_not_followed_are_said(clips, make, words, frames_of):
    path = make(clips)
    with pytest.warns(TexventWarning, match=words):
        assert len(list(frames_of(path))) == 3


def test_the_first_image_of_an_animated_avif_is_no_other_video(clips):
    path = clips.write("a.avif", colours(4, 20), codec="libsvtav1", ticks=25)
    stream = open_frames(path, CaptureConfig())
    assert [frame.t_us for frame in stream] == [0, 40_000, 80_000, 120_000]


def test_reordered_frames_of_an_avi_follow_one_another(clips):
    frames = colours(9, 10)
    path = clips.write("b.avi", frames, ticks=25, options={"bf": "2"})
    read = list(VideoFile(path))
    assert [frame.t_us for frame in read] == [40_000 * i for i in range(9)]
    means = [float(frame.pixels.mean()) for frame in read]
    assert means == sorted(means)


def test_sixteen_bit_grey_is_kept_bit_for_bit(clips):
    grey = [GREY.astype(np.uint16) * 257 + i for i in range(3)]
    path = clips.write("g.mkv", grey, codec="ffv1", stored="gray16le", given="gray16le")
    frames = list(VideoFile(path))
    assert frames[0].pixels.dtype == np.uint16
    assert all(np.array_equal(f.pixels, g) for f, g in zip(frames, grey, strict=True))


def test_ten_bits_are_more_than_eight(clips):
    # One step of 10 bits is a quarter of a step of 8 bits.
    steps = [np.full((48, 64, 3), 32_768 + 64 * i, np.uint16) for i in range(8)]
    path = clips.write("p.mkv", steps, codec="ffv1", stored="yuv444p10le", given="rgb48le")
    lumas = [float(frame.luma.mean()) for frame in VideoFile(path)]
    assert VideoFile(path).metadata["pixel_format"] == "yuv444p10le"
    assert np.all(np.diff(lumas) >= 0)
    assert len(set(lumas)) > 4
    assert lumas[0] == pytest.approx(127.5, abs=1.0)


def test_a_gif_is_colour_and_its_palette_index_is_not_taken_for_grey(clips):
    path = clips.write("a.gif", colours(3, 20), codec="gif", stored="rgb8")
    frame = next(iter(VideoFile(path)))
    assert frame.pixels.shape == (48, 64, 3)
    assert frame.pixels[5, 5, 0] > 200 > frame.pixels[5, 5, 1]


def test_repeats_that_only_reading_finds_are_stored(clips, tmp_path, monkeypatch, capsys):
    path = clips.write("a.mkv", colours(6, 8), codec="ffv1", times_ms=[0, 0, 40, 80, 80, 120])
    monkeypatch.setattr(video_file, "needs_packet_times", lambda stream: False)
    out = tmp_path / "a.h5"
    assert main(["simulate", str(path), "-o", str(out), "--previews", "none"]) == 0
    assert "2 of 6 frames are left out" in capsys.readouterr().err
    assert texvent.load(out).metadata["source"]["duplicate_times_dropped"] == 2


def test_time_that_goes_back_is_refused():
    clock = PresentationClock(Path("x.mkv"), None, Fraction(25))
    frame = type("F", (), {"time_base": Fraction(1, 1000), "duration": 40})()
    frame.pts = 100
    clock.read(frame)
    frame.pts = 60
    with pytest.raises(FileFormatError, match=r"goes back from 0 to -40000 µs.*`fps`"):
        clock.read(frame)


@pytest.mark.parametrize(
    ("name", "first"),
    [*((name, first) for name in ("a.mp4", "a.mkv") for first in (0, 200)), ("a.avi", 0)],
)
def test_a_truncated_video_says_where_it_ends_and_that_stop_helps(clips, noisy_frames, name, first):
    path = clips.write(
        name,
        noisy_frames,
        container={"movflags": "faststart"} if name == "a.mp4" else None,
        options={"bf": "2"},
        ticks=25,
        first=first,
    )
    whole = list(open_frames(path, CaptureConfig()))
    assert [whole[0].t_us, whole[-1].t_us] == [0, 40_000 * (len(noisy_frames) - 1)]
    data = path.read_bytes()
    path.write_bytes(data[: len(data) * 2 // 3])
    with pytest.raises(FileFormatError, match=r"its frames end at .* stop=") as caught:
        list(open_frames(path, CaptureConfig()))
    promised = re.search(r"header promises ([\d.]+) s", str(caught.value))
    assert promised is None or float(promised[1]) == pytest.approx(len(whole) / 25, abs=0.05)
    stop = float(str(caught.value).split("stop=")[1].split(",")[0])
    kept = list(open_frames(path, CaptureConfig(stop=stop)))
    assert kept[-1].t_us == round(stop * 1e6) - 40_000
    assert len(kept) > 10


def test_damage_in_the_middle_is_an_error_not_a_glitch(clips, noisy_frames):
    path = clips.write("a.mp4", noisy_frames)
    data = bytearray(path.read_bytes())
    middle = len(data) // 2
    data[middle : middle + 3000] = bytes(3000)
    path.write_bytes(data)
    with pytest.raises(FileFormatError, match="is damaged"):
        list(open_frames(path, CaptureConfig()))


@pytest.mark.parametrize("name", ["notes.txt", "data.bin"])
def test_a_file_that_is_no_video_is_refused(tmp_path, name):
    path = tmp_path / name
    path.write_text("0.1 3 4 1\n" * 100)
    with pytest.raises(FileFormatError, match=r"(holds no video|is not a video)"):
        open_frames(path, CaptureConfig())


@pytest.fixture(scope="module")
def long_film(tmp_path_factory):
    """5,000 tiny frames."""
    frames = [np.full((16, 32, 3), index % 200, np.uint8) for index in range(5000)]
    writer = ClipWriter(tmp_path_factory.mktemp("long"))
    return writer.write("long.mkv", frames, codec="mpeg4", rate=50, ticks=50)


@pytest.mark.long
@pytest.mark.skipif(not Path("/proc/self/task").exists(), reason="threads are counted by Linux")
@pytest.mark.parametrize(
    "frames_of",
    [VideoFile, lambda path: LiveFrames(str(path)), lambda path: open_stored(path, 50, {})],
    ids=["file", "live", "generated"],
)
def test_threads_and_memory_do_not_grow_with_the_frames(long_film, frames_of):
    def used():
        pages = Path("/proc/self/statm").read_text().split()[1]
        return len(os.listdir("/proc/self/task")), int(pages) * os.sysconf("SC_PAGE_SIZE")

    after = {index: used() for index, _ in enumerate(frames_of(long_film)) if index in (500, 4999)}
    assert after[4999][0] <= after[500][0]
    assert after[4999][1] < after[500][1] + 2**23


@pytest.mark.parametrize(
    "read",
    [
        lambda path: list(open_frames(path, CaptureConfig())),
        lambda path: check_source(path, progress=False),
        lambda path: texvent.simulate(path, interpolate="none", noise="none"),
        lambda path: list(LiveFrames(str(path))),
    ],
    ids=["open", "check", "simulate", "live"],
)
def test_every_reader_of_video_has_one_scaler_per_stream(clips, monkeypatch, read):
    made = []
    begin = PixelReader.__init__
    monkeypatch.setattr(
        PixelReader, "__init__", lambda one, name: (made.append(1), begin(one, name))[1]
    )
    counts = []
    for length in (4, 40):
        path = clips.write(
            f"{length}.mkv", [np.roll(GREY, 9 * i) for i in range(length)], given="gray"
        )
        made.clear()
        read(path)
        counts.append(len(made))
    assert 1 <= counts[0] == counts[1] <= 2


@pytest.mark.parametrize("number", [errno.EAGAIN, errno.ENOMEM])
@pytest.mark.parametrize("frames_of", [VideoFile, lambda path: LiveFrames(str(path))])
def test_a_lack_of_threads_or_memory_is_not_called_damage(clips, monkeypatch, number, frames_of):
    path = clips.write("a.mkv", colours())

    def refuse(*_, **__):
        raise av.error.classes.get(number, av.error.FFmpegError)(number, "refused")

    monkeypatch.setattr(decoding, "VideoReformatter", lambda: SimpleNamespace(reformat=refuse))
    with pytest.raises(OSError, match="higher limit of processes or memory"):
        list(frames_of(path))


NTSC = Fraction(1000, 1001)


@pytest.mark.parametrize(
    ("name", "codec", "rate"),
    [
        *(("a.mkv", "ffv1", rate) for rate in (24, 25, 30, 50, 60, 120, 240, 1000, 1500, 5000)),
        *(("a.mkv", "ffv1", rate * NTSC) for rate in (24, 30, 60)),
        *(("a.webm", "libvpx-vp9", rate) for rate in (60, 2000)),
        *((name, "libx264", rate) for name in ("a.flv", "a.ts") for rate in (60 * NTSC, 240)),
    ],
)
@pytest.mark.parametrize("first", [0, 7])
def test_a_constant_rate_replaces_times_that_a_clock_rounds(clips, name, codec, rate, first):
    path = clips.write(name, colours(20, 8), codec=codec, rate=rate, ticks=rate, first=first)
    stream = open_frames(path, CaptureConfig())
    times = [frame.t_us for frame in stream]
    assert (stream.frame_count, stream.fps) == (20, rate)
    assert times == stream.times_us or name != "a.mkv"
    assert times == [frame_time_us(i, Fraction(rate)) for i in range(20)]


def test_times_that_no_rate_explains_stay(clips):
    times_ms = [round(1000 * i / 60) + (i % 5 == 3) for i in range(20)]
    path = clips.write("a.mkv", colours(20, 8), codec="ffv1", rate=60, times_ms=times_ms)
    assert [frame.t_us for frame in VideoFile(path)] == [1000 * t for t in times_ms]


@pytest.mark.parametrize("name", ["a.gif", "a.png"])
@pytest.mark.parametrize("delays_ms", [[0, 0, 0], [50, 0, 50], [50, 50, 0]])
def test_frames_without_a_delay_take_a_tenth_of_a_second_and_are_said(tmp_path, name, delays_ms):
    images = [Image.fromarray(pixels) for pixels in colours(3, 20)]
    images[0].save(
        tmp_path / name, save_all=True, append_images=images[1:], duration=delays_ms, loop=0
    )
    count = delays_ms[:-1].count(0)
    with pytest.warns(TexventWarning, match=f"after {count} of its") if count else nullcontext():
        stream = open_frames(tmp_path / name, CaptureConfig())
    steps = np.diff([frame.t_us for frame in stream])
    assert steps == pytest.approx([1000 * (one or 100) for one in delays_ms[:-1]], abs=1)


@pytest.mark.parametrize("lowest", [0, 20])
def test_grey_that_is_marked_as_limited_range_is_read_as_it_is(clips, lowest):
    grey = [np.clip(GREY, lowest, 230) for _ in range(2)]
    path = clips.write("g.mkv", grey, codec="ffv1", stored="gray", given="gray", is_limited=True)
    with pytest.warns(TexventWarning, match="marked as limited") if lowest else nullcontext():
        stream = VideoFile(path)
    assert np.array_equal(next(iter(stream)).pixels, grey[0])


@pytest.mark.parametrize("times_ms", [[0, 0, 0, 40, 90, 90], [0, 40, 40, 40, 41, 41]])
def test_frames_of_equal_times_are_counted_before_and_after_reading(clips, tmp_path, times_ms):
    path = clips.write("a.mkv", colours(6, 8), codec="ffv1", times_ms=times_ms)
    with pytest.warns(TexventWarning, match=r"3 of 6 frames are left out.*give their rate \(`fps`"):
        stream = open_frames(path, CaptureConfig())
    assert stream.frame_count == len(list(stream)) == 3
    assert stream.metadata["duplicate_times_dropped"] == 3
    with pytest.warns(TexventWarning, match="3 of 6"):
        events = texvent.simulate(path, interpolate="none")
    assert events.metadata["source"]["duplicate_times_dropped"] == 3
    assert len(list(open_frames(path, CaptureConfig(fps=Fraction(2000))))) == 6


PLAYLISTS = {
    "a.m3u8": "#EXTM3U\n#EXT-X-TARGETDURATION:1\n#EXTINF:1,\n{}\n#EXT-X-ENDLIST\n",
    "a.mp4": "#EXTM3U\n#EXT-X-TARGETDURATION:1\n#EXTINF:1,\n{}\n#EXT-X-ENDLIST\n",
    "a.ffconcat": "ffconcat version 1.0\nfile {}\n",
    "a.sdp": "v=0\no=- 0 0 IN IP4 127.0.0.1\ns=x\nc=IN IP4 127.0.0.1\nt=0 0\n",
}


@pytest.mark.parametrize("name", PLAYLISTS)
def test_a_playlist_leads_to_no_other_file(clips, tmp_path, name):
    clips.write("private.ts", colours(), codec="mpeg2video", ticks=25)
    path = tmp_path / name
    path.write_text(PLAYLISTS[name].format("private.ts"))
    with pytest.raises(FileFormatError, match="is a playlist, which names other files"):
        open_frames(path, CaptureConfig())
    with pytest.raises(InputError):
        LiveFrames(str(path))


def test_frames_that_memory_has_no_room_for_are_refused_by_the_header(clips, monkeypatch):
    path = clips.write("a.mkv", colours())
    monkeypatch.setattr(video_file, "usable_bytes", lambda: 100_000)
    with pytest.raises(FileFormatError, match="claims frames of 64x48"):
        open_frames(path, CaptureConfig())


@pytest.mark.parametrize("size", [None, SensorSize(20, 20)])
def test_a_size_that_changes_in_mid_stream_is_refused(tmp_path, size):
    path = tmp_path / "a.mjpeg"
    images = [np.full((48, 64, 3), 9 * i, np.uint8) for i in range(6)]
    images[3:] = [image[:24, :32] for image in images[3:]]
    path.write_bytes(b"".join(cv2.imencode(".jpg", image)[1].tobytes() for image in images))
    stream = open_frames(path, CaptureConfig(fps=Fraction(25)), size=size)
    with pytest.raises(InputError, match="is 32x24, those before it are 64x48"):
        list(stream)


def test_one_of_two_videos_is_said(tmp_path):
    path = tmp_path / "two.mkv"
    with av.open(str(path), "w") as clip:
        streams = [clip.add_stream("ffv1", rate=25) for _ in range(2)]
        for stream, (stream.width, stream.height) in zip(
            streams, ((64, 48), (32, 24)), strict=True
        ):
            stream.pix_fmt = "yuv420p"
        for stream in (*streams, *streams):
            pixels = np.zeros((stream.height, stream.width, 3), np.uint8)
            clip.mux(stream.encode(av.VideoFrame.from_ndarray(pixels)))
        for stream in streams:
            clip.mux(stream.encode(None))
    with pytest.warns(TexventWarning, match=r"2 videos \(64x48, 32x24\); number 1 is read"):
        assert open_frames(path, CaptureConfig()).size == (64, 48)
