"""Videos and images: complete or not at all, with their times, and read back as they were."""

import json
from fractions import Fraction
from pathlib import Path

import av
import numpy as np
import pytest

from texvent.capture.open import open_frames
from texvent.config import CaptureConfig
from texvent.errors import InputError, OutputError
from texvent.events import EventStream
from texvent.frames import Frame
from texvent.sensor import SensorSize
from texvent.view import video_writer
from texvent.view.video_writer import VideoWriter, check_image_output, open_image_sink
from texvent.view.windows import EventWindow, WindowCollector

SIZE = SensorSize(32, 24)
Steps = list[tuple[Frame, EventStream]]


def write_video(path: Path, steps: Steps, **options: object) -> Path:
    collector = WindowCollector(SIZE)
    with VideoWriter(path, size=SIZE, fps=Fraction(30_000, 1001), **options) as video:
        for frame, packet in steps:
            window = collector.append(frame, packet)
            if window is not None:
                video.show(window)
        if len(steps) == 1:
            video.show(collector.single_frame())
    return path


def read_video(path: Path) -> tuple[list[int], np.ndarray, av.container.InputContainer]:
    """Times in µs, images, and the container."""
    container = av.open(str(path))
    frames = list(container.decode(video=0))
    times = [round(frame.pts * frame.time_base * 1_000_000) for frame in frames]
    return times, np.stack([frame.to_ndarray(format="rgb24") for frame in frames]), container


def test_mp4_times_are_the_source_frames_times_to_the_microsecond(tmp_path, steps):
    times, _, container = read_video(write_video(tmp_path / "out.mp4", steps))
    source = [frame.t_us for frame, _ in steps if frame.is_source]
    assert times == [t - source[0] for t in source[:-1]]
    stream = container.streams.video[0]
    assert stream.duration * stream.time_base == Fraction(source[-1] - source[0], 1_000_000)
    assert (stream.codec_context.name, stream.codec_context.pix_fmt) == ("h264", "yuv420p")
    assert stream.codec_context.colorspace == 1, "tagged BT.709"


def test_after_a_burst_the_scale_of_colours_falls_by_a_tenth_per_image(tmp_path, monkeypatch):
    scales = []
    draw = video_writer.compose_window
    monkeypatch.setattr(
        video_writer,
        "compose_window",
        lambda *one, ceiling, **more: scales.append(ceiling) or draw(*one, ceiling=ceiling, **more),
    )
    with VideoWriter(tmp_path / "out.mp4", size=SIZE, fps=Fraction(25)) as video:
        for number, count in enumerate([2, 100, 1, 0, 1, 95, 1]):
            counts = np.zeros((2, *SIZE.shape), np.int32)
            counts[1, 3:9] = count
            video.show(EventWindow(40_000 * number, 40_000 * (number + 1), counts))
    assert scales == pytest.approx([2, 100, 90, 81, 72.9, 95, 85.5])


def test_the_index_lies_in_front_so_that_browsers_start_at_once(tmp_path, steps):
    content = write_video(tmp_path / "out.mp4", steps).read_bytes()
    assert 0 < content.index(b"moov") < content.index(b"mdat")


def test_gif_times_are_rounded_but_do_not_drift(tmp_path, steps):
    times, images, _ = read_video(write_video(tmp_path / "out.gif", steps))
    source = [frame.t_us for frame, _ in steps if frame.is_source]
    exact = [t - source[0] for t in source[:-1]]
    assert len(times) == len(exact)
    assert all(0 <= want - got < 10_000 for want, got in zip(exact, times, strict=True))
    right = images[1, :, images.shape[2] // 2 :].astype(int)
    assert (right[..., 2] > right[..., 0] + 100).any()


@pytest.mark.parametrize("extension", [".mp4", ".gif"])
def test_one_frame_gives_a_video_of_one_image(tmp_path, steps, extension):
    path = write_video(tmp_path / f"out{extension}", steps[:1])
    assert len(read_video(path)[0]) == 1


ODD_SIZE = SensorSize(15, 11)


def images():
    return [(1_000_003 + 40_000 * n, np.full(ODD_SIZE.shape, n / 10, np.float32)) for n in range(4)]


def write(path, *, overwrite=False, some=None, size=ODD_SIZE):
    opened = open_image_sink(
        path, size=size, fps=Fraction(25), facts={"network": "firenet"}, overwrite=overwrite
    )
    with opened as sink:
        for t_us, image in images() if some is None else some:
            sink.add(t_us, image)


def test_a_folder_is_read_again_with_its_times(tmp_path):
    write(tmp_path / "frames")
    frames = list(open_frames(str(tmp_path / "frames"), CaptureConfig()))
    assert [frame.t_us for frame in frames] == [t_us for t_us, _ in images()]
    for frame, (_, image) in zip(frames, images(), strict=True):
        assert frame.pixels.dtype == np.uint8
        assert frame.pixels.shape == ODD_SIZE.shape
        np.testing.assert_array_equal(frame.pixels, np.rint(image * 255))
    facts = json.loads((tmp_path / "frames" / "texvent.json").read_text())
    assert facts == {"network": "firenet"}


@pytest.mark.parametrize("size", [ODD_SIZE, SensorSize(16, 11), SensorSize(15, 12)])
@pytest.mark.parametrize(("name", "error"), [("video.mp4", 4), ("video.gif", 0.5)])
def test_a_video_has_even_sides_and_the_times_of_the_images(tmp_path, size, name, error):
    ramp = np.add.outer(*(np.arange(side) for side in size.shape)).astype(np.float32)
    some = [(t_us, ramp * n / 100) for n, (t_us, _) in enumerate(images())]
    write(tmp_path / name, some=some, size=size)
    frames = list(open_frames(str(tmp_path / name), CaptureConfig()))
    assert frames[0].size == SensorSize(16, 12)
    assert [frame.t_us for frame in frames] == [0, 40_000, 80_000, 120_000]
    shown = frames[3].luma[: size.height, : size.width]
    assert np.abs(shown - 255 * some[3][1]).mean() < error


def test_only_a_folder_of_such_images_is_replaced(tmp_path):
    folder = tmp_path / "frames"
    write(folder)
    with pytest.raises(OutputError, match="exists already"):
        check_image_output(folder, overwrite=False)
    write(folder, overwrite=True, some=images()[:2])
    assert len(list(folder.glob("*.png"))) == 2
    (folder / "notes.txt").write_text("mine")
    with pytest.raises(OutputError, match=r"notes\.txt"):
        check_image_output(folder, overwrite=True)


@pytest.mark.parametrize("name", ["frames", "video.mp4"])
def test_without_an_image_nothing_is_left(name, tmp_path):
    with pytest.raises(InputError, match="image"):
        write(tmp_path / name, some=[])
    assert list(tmp_path.iterdir()) == []
