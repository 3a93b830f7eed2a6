"""AEDAT2 of jAER and v2e: layouts that explain every address, noise labels, IMU samples."""

import struct
from pathlib import Path

import numpy as np
import pytest
from numpy.typing import NDArray

from texvent.errors import FileFormatError, InputError, TexventWarning
from texvent.events import EventStream
from texvent.io.files import codec_that_reads, load
from texvent.sensor import SensorSize

from ..format_cases import random_events

V2E = b"#!AER-DAT2.0\r\n# This is a raw AE data file created by AEDat2Output in v2e (see ...)\r\n"
LABELLED = b"# noise events are labeled as addressed external input events when ...\r\n"
OTHER = b"#!AER-DAT2.0\r\n# made elsewhere\r\n"


def v2e_addresses(events: EventStream) -> NDArray[np.int64]:
    """As v2e's AEDat2Output computes them."""
    width, height = events.size
    x, y = width - 1 - events.x.astype(np.int64), height - 1 - events.y.astype(np.int64)
    places = (11, 1, 0) if (width, height) == (640, 480) else (22, 12, 11)
    return y << places[0] | x << places[1] | events.p.astype(np.int64) << places[2]


def write(path: Path, header: bytes, address: NDArray[np.int64], t: NDArray[np.int64]) -> Path:
    records = np.stack([address, t], axis=1).astype(">u4")
    path.write_bytes(header + records.tobytes())
    return path


@pytest.mark.parametrize("header", [V2E, OTHER])
@pytest.mark.parametrize("size", [(640, 480), (346, 260), (240, 180)])
def test_the_layout_is_that_in_which_every_address_is_a_pixel(tmp_path, header, size):
    events = random_events(300, SensorSize(*size))
    path = write(tmp_path / "e.aedat", header, v2e_addresses(events), events.t)
    assert load(path, size=size).equals(events)
    if header == V2E:
        assert not codec_that_reads(path).side_data(path), "v2e writes events alone"


def test_addresses_that_are_no_pixels_are_counted(tmp_path, monkeypatch):
    events = random_events(300, SensorSize(640, 480))
    address = v2e_addresses(events)
    path = write(tmp_path / "e.aedat", OTHER, address, events.t)
    with pytest.raises(InputError, match=r"sensor of 346x260: of the first 300, \d+ in the layout"):
        load(path, size="davis346")
    address[250:253] |= 1 << 25
    write(path, OTHER, address, events.t)
    with pytest.raises(InputError, match="and 3 in the layout dvs640"):
        load(path, size=(640, 480))
    with pytest.warns(TexventWarning, match="outside sensor: 3"):
        assert len(load(path, size=(640, 480), repair=True)) == 297
    monkeypatch.setattr("texvent.io.byte_blocks.BLOCK_BYTES", 8 * 100)
    with pytest.raises(FileFormatError, match="640x480: 3 of 100 in the layout dvs640"):
        load(path, size=(640, 480))


def test_two_layouts_that_fit_are_named(tmp_path):
    path = write(tmp_path / "e.aedat", OTHER, np.array([3 << 12]), np.array([7]))
    with pytest.warns(TexventWarning, match="fit the layouts davis and dvs640; read as davis"):
        assert load(path, size=(640, 480)).x.tolist() == [636]


def test_noise_that_v2e_labels_is_read_as_labelled_events(tmp_path):
    events = random_events(300, SensorSize(346, 260))
    noise = np.arange(300) % 3 == 0
    address = v2e_addresses(events) | noise.astype(np.int64) << 10
    found = load(write(tmp_path / "e.aedat", V2E + LABELLED, address, events.t), size="davis346")
    assert found.label is not None
    assert found.label.tolist() == noise.tolist()
    assert (found.x == events.x).all()


def test_a_record_that_begins_like_a_line_of_the_header_is_a_record(tmp_path):
    address = np.array([0x23 << 24, 0x23 << 24])
    events = load(write(tmp_path / "e.aedat", V2E, address, np.array([7, 10])), size="davis346")
    assert (events.t.tolist(), events.y.tolist()) == ([7, 10], [119, 119])


CHIP = b"#!AER-DAT2.0\r\n# AEChip: eu.seebetter.ini.chips.davis.DAVIS240C\r\n"
SCALES = b'# "ImuAccelScaleG8"\r\n# "GyroFullScaleDegPerSec1000"\r\n'


def imu_records(values: tuple[int, ...], t: int) -> bytes:
    """As jAER's IMUSample.writeToPacket: acceleration, temperature, rotation."""
    words = [1 << 31 | at << 28 | (one & 0xFFFF) << 12 | 3 << 10 for at, one in enumerate(values)]
    return b"".join(struct.pack(">2I", word, t) for word in words)


FIRST = (4096, -8192, 2048, -1190, 328, -656, 3280)
EVENT = struct.pack(">2I", 5 << 22 | 7 << 12, 60)


@pytest.mark.parametrize("block_bytes", [8, 24, 2**21])
def test_imu_samples_of_jaer_have_its_units_and_signs(tmp_path, monkeypatch, block_bytes):
    monkeypatch.setattr("texvent.io.byte_blocks.BLOCK_BYTES", block_bytes)
    path = tmp_path / "e.aedat"
    second = imu_records((0,) * 7, 90)
    path.write_bytes(CHIP + SCALES + imu_records(FIRST, 50) + EVENT + second[:16] + EVENT)
    path.write_bytes(path.read_bytes() + second[16:] + struct.pack(">2I", 1 << 10, 95))
    side = codec_that_reads(path).side_data(path)
    found = list(side["imu"]())
    samples = {name: np.concatenate([one[name] for one in found]) for name in found[0]}
    assert samples.pop("t").tolist() == [50, 90]
    assert {name: round(float(column[0]), 4) for name, column in samples.items()} == {
        "temperature_c": 31.5,
        **{"acceleration_x_g": -1.0, "acceleration_y_g": -2.0, "acceleration_z_g": 0.5},
        **{"rotation_x_deg_s": -10.0, "rotation_y_deg_s": -20.0, "rotation_z_deg_s": -100.0},
    }
    assert sum(len(one["t"]) for one in side["triggers"]()) == 1
    assert load(path).t.tolist() == [60, 60]


def test_what_is_assumed_and_left_out_of_an_imu_is_said(tmp_path):
    path = tmp_path / "e.aedat"
    path.write_bytes(CHIP + imu_records(FIRST, 50)[8:] + imu_records(FIRST, 70))
    with pytest.warns(TexventWarning) as caught:
        (samples,) = codec_that_reads(path).side_data(path)["imu"]()
    assert samples["t"].tolist() == [70]
    assert samples["acceleration_y_g"].tolist() == [-1]
    said = " ".join(str(one.message) for one in caught)
    assert "left out 6 values of an IMU" in said
    assert "full scales of its IMU; taken are 4 g and 500" in said
