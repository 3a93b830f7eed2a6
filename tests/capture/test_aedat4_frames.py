"""Frames of AEDAT4 recordings: made byte by byte, by dv-processing, and by a real camera."""

import datetime
import struct
from collections.abc import Mapping
from pathlib import Path

import numpy as np
import pytest

from texvent.capture.open import open_frames
from texvent.cli.app import main
from texvent.config import CaptureConfig
from texvent.errors import FileFormatError, InputError
from texvent.events import EventStream
from texvent.io.aedat.aedat4_container import LZ4_CODE, MAGIC, pack_lz4
from texvent.io.aedat.aedat4_tables import make_header, make_info
from texvent.io.files import save
from texvent.sensor import SensorSize

SIZE = SensorSize(6, 4)
FORMS = "qqqqqbhhhh"
"""Struct formats of the slots 0 to 9."""
GREY, BGR, BGRA = 0, 16, 24


def make_frame(pixels: bytes, numbers: Mapping[int, int]) -> bytes:
    """A table FRME with these slots, written as FlatBuffers describes, fields packed."""
    forms = {slot: "q" if slot == 11 else FORMS[slot] for slot in numbers}
    vtable = [0] * 12
    fields = b""
    for slot, form in forms.items():
        vtable[slot] = 4 + len(fields)
        fields += struct.pack(f"<{form}", numbers[slot])
    vtable[10] = 4 + len(fields)
    table_bytes = 4 + len(fields) + 4
    head = struct.pack("<14H", 28, table_bytes, *vtable)
    table = struct.pack("<i", len(head)) + fields + struct.pack("<I", 4)
    body = struct.pack("<I4s", 8 + len(head), b"FRME") + head + table
    body += struct.pack("<I", len(pixels)) + pixels
    return struct.pack("<I", len(body)) + body


def grey(value: int, *, start: int, end: int) -> bytes:
    numbers = {0: 7, 3: start, 4: end, 6: SIZE.width, 7: SIZE.height}
    return make_frame(bytes([value]) * SIZE.width * SIZE.height, numbers)


def write_file(path: Path, frames: list[bytes], kind: bytes = b"FRME") -> Path:
    xml = make_info(SIZE, "LZ4", "{}").replace(b"EVTS", kind)
    packets = [pack_lz4(frame) for frame in frames]
    body = b"".join(struct.pack("<ii", 0, len(packet)) + packet for packet in packets)
    path.write_bytes(MAGIC + make_header(LZ4_CODE, -1, xml) + body)
    return path


def test_a_frame_has_the_time_of_the_middle_of_its_exposure(tmp_path):
    frames = [grey(9, start=1_000, end=2_001), grey(8, start=41_000, end=42_000)]
    stream = open_frames(write_file(tmp_path / "r.aedat4", frames), CaptureConfig())
    assert (stream.size, stream.frame_count, stream.fps, stream.is_live) == (SIZE, 2, None, False)
    first, second = stream
    assert (first.t_us, second.t_us) == (1_500, 41_500)
    assert (first.pixels == 9).all()
    assert first.pixels.shape == (4, 6)
    assert len(list(stream)) == 2, "it can be read again"
    assert stream.metadata["times"] == "middle of the exposure"
    assert list(stream.times_us) == [1_500, 41_500]
    given = open_frames(tmp_path / "r.aedat4", CaptureConfig(), t_us=[30_000, 70_000])
    assert list(given.times_us) == [frame.t_us for frame in given] == [30_000, 70_000]
    with pytest.raises(InputError, match="t_us has 3 times for 2 frames"):
        open_frames(tmp_path / "r.aedat4", CaptureConfig(), t_us=[30_000, 70_000, 90_000])


@pytest.mark.parametrize(
    ("numbers", "t_us"),
    [
        ({0: 5_000, 11: 800}, 5_400),
        ({0: 5_000}, 5_000),
        ({0: 5_000, 3: 4_000, 4: 4_500, 11: 800}, 4_250),
    ],
)
def test_without_start_and_end_the_middle_follows_from_the_length(tmp_path, numbers, t_us):
    shape = {6: SIZE.width, 7: SIZE.height}
    frames = [make_frame(bytes(24), {**numbers, **shape}), grey(0, start=90_000, end=91_000)]
    stream = open_frames(write_file(tmp_path / "r.aedat4", frames), CaptureConfig())
    assert next(iter(stream)).t_us == t_us


@pytest.mark.parametrize(("kind", "channels"), [(BGR, 3), (BGRA, 4)])
def test_colour_is_turned_from_bgr_to_rgb(tmp_path, kind, channels):
    pixel = bytes([10, 20, 30, 255][:channels])
    shape = {6: SIZE.width, 7: SIZE.height}
    frames = [make_frame(pixel * 24, {0: t, 5: kind, **shape}) for t in (1, 2)]
    frame = next(iter(open_frames(write_file(tmp_path / "r.aedat4", frames), CaptureConfig())))
    assert frame.pixels.shape == (4, 6, 3)
    assert frame.pixels[3, 5].tolist() == [30, 20, 10]


def test_a_recording_of_events_alone_is_refused(tmp_path):
    path = save(tmp_path / "e.aedat4", EventStream.empty(SIZE))
    with pytest.raises(FileFormatError, match=r"holds no frames.*EVTS"):
        open_frames(path, CaptureConfig())
    with pytest.raises(FileFormatError, match="holds no frames"):
        open_frames(write_file(tmp_path / "n.aedat4", []), CaptureConfig())


@pytest.mark.parametrize(
    ("numbers", "pixels", "change", "problem"),
    [
        ({5: 5}, 48, bytes, "frame 1.*OpenCV type 5"),
        ({}, 23, bytes, "frame 1.*23 bytes of pixels for 6x4x1"),
        ({7: 3}, 18, bytes, "frame 1 is 6x3, the sensor 6x4; frames of a part"),
        ({}, 24, lambda frame: struct.pack("<I", len(frame) - 5) + frame[4:-1],
            "frame 1: its pixels reach past the end of the packet"),
        ({}, 24, lambda frame: frame.replace(b"FRME", b"EVTS"),
            r"before byte \d+: no FRME table where one must be"),
    ],
)  # fmt: skip
def test_frames_that_cannot_be_are_refused(tmp_path, numbers, pixels, change, problem):
    given = {0: 99_000, 6: SIZE.width, 7: SIZE.height, **numbers}
    frames = [grey(1, start=0, end=10), change(make_frame(bytes(pixels), given))]
    stream = open_frames(write_file(tmp_path / "r.aedat4", frames), CaptureConfig())
    with pytest.raises(FileFormatError, match=problem):
        list(stream)


def test_a_damaged_file_is_refused_wherever_it_was_cut(tmp_path):
    path = write_file(tmp_path / "r.aedat4", [grey(v, start=v, end=v + 2) for v in (10, 20, 30)])
    whole = path.read_bytes()
    reads = 0
    for length in range(len(MAGIC), len(whole)):
        path.write_bytes(whole[:length])
        try:
            reads += len(list(open_frames(path, CaptureConfig())))
        except (FileFormatError, InputError):
            continue
    # Only a cut between packets leaves a file that can be read: here, after two frames of three.
    assert reads == 2


def test_frames_that_dv_processing_writes_are_read(tmp_path):
    dv = pytest.importorskip("dv_processing", reason="dv-processing has no wheel for this machine")
    path = tmp_path / "dv.aedat4"
    config = dv.io.MonoCameraWriter.DAVISConfig("camera", tuple(SIZE))
    writer = dv.io.MonoCameraWriter(str(path), config)
    images = [np.arange(24, dtype=np.uint8).reshape(4, 6) + i for i in range(3)]
    for i, image in enumerate(images):
        frame = dv.Frame(1_000_000 + 40_000 * i, image)
        frame.exposure = datetime.timedelta(microseconds=10_000)
        writer.writeFrame(frame)
    events = dv.EventStore()
    events.push_back(1_020_000, 3, 2, True)
    writer.writeEvents(events)
    del writer
    frames = list(open_frames(path, CaptureConfig()))
    assert [frame.t_us for frame in frames] == [1_005_000, 1_045_000, 1_085_000]
    np.testing.assert_array_equal([frame.pixels for frame in frames], images)
    out = tmp_path / "images"
    assert main(["convert", str(path), str(tmp_path / "e.npz"), "--frames", str(out)]) == 0
    written = list(open_frames(out, CaptureConfig()))
    assert [frame.t_us for frame in written] == [1_005_000, 1_045_000, 1_085_000]
    np.testing.assert_array_equal([frame.pixels for frame in written], images)


def test_frames_of_sixteen_bits_are_kept(tmp_path):
    values = np.arange(24, dtype="<u2") * 2700
    numbers = {5: 2, 6: SIZE.width, 7: SIZE.height}
    frames = [make_frame(values.tobytes(), {0: time, **numbers}) for time in (10, 20)]
    read = list(open_frames(write_file(tmp_path / "r.aedat4", frames), CaptureConfig()))
    np.testing.assert_array_equal(read[1].pixels, values.reshape(SIZE.shape))
