"""Triggers and IMU samples beside events: by hand, by a slow decoder, from other programs."""

import json
import struct
from collections.abc import Callable
from pathlib import Path

import h5py
import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st
from tests.io.ros.test_bags import EVENTS, array_message, types_of, write_bag

from texvent.cli.app import main
from texvent.io.files import codec_that_reads, save
from texvent.io.prophesee.evt import EVT2, EVT3, EVT21, TriggerCoding, read_triggers
from texvent.io.ros.messages import EVENT_ARRAY


def rows(blocks: list[bytes], coding: TriggerCoding) -> list[tuple[int, int, int]]:
    found = list(read_triggers(blocks, coding))
    columns = [np.concatenate([one[name] for one in found]) for name in ("t", "channel", "value")]
    return list(zip(*(column.tolist() for column in columns), strict=True))


def test_triggers_by_hand():
    evt2 = struct.pack(
        "<4I", 10 << 28 | 5 << 22, 8 << 28 | 3, 1 << 28, 10 << 28 | 7 << 22 | 6 << 8 | 1
    )
    assert rows([evt2], EVT2) == [(3 << 6 | 7, 6, 1)], "without a high time there is none"
    evt21 = struct.pack("<4I", 8 << 28 | 3, 0, 10 << 28 | 7 << 22 | 6 << 8, 0)
    assert rows([evt21], EVT21) == [(3 << 6 | 7, 6, 0)]
    evt3 = struct.pack("<6H", 0x8FFF, 0x6010, 0xA201, 0x8000, 0xA200, 0x0000)
    assert rows([evt3], EVT3) == [(0xFFF << 12 | 0x10, 2, 1), (1 << 24, 2, 0)], "the counter wraps"


def slow_evt3(words: list[int]) -> list[tuple[int, int, int]]:
    turns, high, low, found = 0, -1, 0, []
    for word in words:
        kind, value = word >> 12, word & 0xFFF
        if kind == 8:
            turns += high - value >= 3840
            low = low if value == high else 0
            high = value
        elif kind == 6:
            low = value
        elif kind == 10 and high >= 0:
            found.append((turns << 24 | high << 12 | low, value >> 8, value & 1))
    return found


@given(
    words=st.lists(
        st.builds(
            lambda kind, value: kind << 12 | value,
            st.sampled_from([0, 2, 6, 8, 10]),
            st.integers(0, 0xFFF),
        )
    ),
    cut=st.integers(0, 20),
)
def test_triggers_of_any_words_in_any_blocks_are_those_of_the_slow_decoder(words, cut):
    data = np.array(words, "<u2").tobytes()
    blocks = [data[: 2 * cut], data[2 * cut :]]
    assert rows(blocks, EVT3) == slow_evt3(words)


def bag_with_imu(path: Path) -> None:
    sent = [array_message(types_of(1), EVENT_ARRAY, 1, 3)]
    write_bag(path, 1, {"/e": (EVENT_ARRAY, sent), "/imu": ("sensor_msgs/msg/Imu", [b""])})


def raw_with_trigger(path: Path) -> None:
    save(path, EVENTS)
    path.write_bytes(path.read_bytes() + struct.pack("<H", 0xA201))


def davis_with(path: Path) -> None:
    records = [(259 << 22 | 345 << 12, 5), (1 << 10 | 1 << 22, 6), (1 << 31 | 1 << 10, 7)]
    chip = b"#!AER-DAT2.0\r\n# AEChip: davis.Davis346B\r\n"
    path.write_bytes(chip + b"".join(struct.pack(">II", *one) for one in records))


def hdf5_with(name: str) -> Callable[[Path], None]:
    def write(path: Path) -> None:
        columns = zip("xytp", (EVENTS.x, EVENTS.y, EVENTS.t, EVENTS.p), strict=True)
        with h5py.File(path, "w") as file:
            if name.startswith("EXT"):
                kinds = [("x", "u2"), ("y", "u2"), ("p", "i2"), ("t", "i8")]
                file["CD/events"] = np.array([(1, 2, 1, 3)], kinds)
            else:
                file.update({f"events/{one}": values for one, values in columns})
            file[name] = np.zeros((2, 3))
            file["empty_images"] = np.zeros((0, 3))

    return write


HOLDERS: dict[str, tuple[Callable[[Path], None], str]] = {
    "evt3.raw": (raw_with_trigger, "triggers"),
    "davis.aedat": (davis_with, "triggers"),
    "utils.h5": (hdf5_with("images/image0"), "images/image0"),
    "metavision.hdf5": (hdf5_with("EXT_TRIGGER/events"), "EXT_TRIGGER/events"),
    "both.bag": (bag_with_imu, "/imu"),
}


@pytest.mark.parametrize("name", HOLDERS)
def test_convert_says_which_data_beside_the_events_it_leaves_out(tmp_path, name, capfd):
    make, held = HOLDERS[name]
    make(tmp_path / name)
    make(merged := tmp_path / f"merged {name}")
    for more in ([], ["--triggers", str(tmp_path / "t.csv")])[: 1 + (held == "triggers")]:
        sensor = [] if name.endswith(("raw", "aedat", "bag")) else ["--sensor", "9x7"]
        words = ["convert", str(tmp_path / name), str(tmp_path / "o.npz"), "--overwrite", *sensor]
        assert main([*words, *more]) == 0
        said = capfd.readouterr().err
        assert (f"holds {held}, which" in said) == (not more), said
        assert ("--triggers PATH" in said) == (held == "triggers" and not more)
        assert main([*words, *more, "--merge", str(merged)]) == 0
        both, alone = capfd.readouterr().err, f"{merged} also holds {held}, which"
        assert both.startswith(said), "of the first file the same is said as without the other"
        assert alone in both[len(said) :]
        assert "PATH" not in both[len(said) :]
    assert main(["convert", str(tmp_path / "o.npz"), str(tmp_path / "o.raw")]) == 0
    assert "holds" not in capfd.readouterr().err


@pytest.mark.parametrize(
    ("format", "held"), [(None, True), ("aedat2", True), ("cifar10-dvs", False)]
)
def test_data_beside_the_events_are_those_of_the_format_that_is_stated(
    tmp_path, format, held, capfd
):
    path = tmp_path / "e.aedat"  # a signal of a DAVIS, or an event of a DVS128
    path.write_bytes(b"#!AER-DAT2.0\r\n" + struct.pack(">II", 1 << 10, 6))
    facts = [str(path), *(() if format == "cifar10-dvs" else ("--sensor", "346x260"))]
    stated = (lambda option: [option, format]) if format else lambda _: []
    assert main(["info", *facts, *stated("--format"), "--json"]) == 0
    assert ("triggers" in json.loads(capfd.readouterr().out)) == held
    words = ["convert", *facts, "-o", str(tmp_path / "o.npz"), *stated("--from-format")]
    assert main(words) == 0
    assert ("holds triggers, which" in capfd.readouterr().err) == held
    out = tmp_path / "t.csv"
    assert main([*words, "--overwrite", "--triggers", str(out)]) == (0 if held else 2)
    assert (out.exists() and out.read_text().split() == ["t_us", "6"]) == held


def test_triggers_and_imu_of_dv_processing_are_read(tmp_path):
    dv = pytest.importorskip("dv_processing", reason="dv-processing is not installed")
    path = tmp_path / "e.aedat4"
    config = dv.io.MonoCameraWriter.Config("DAVIS346_1")
    config.addEventStream((64, 48))
    config.addImuStream()
    config.addTriggerStream()
    writer = dv.io.MonoCameraWriter(str(path), config)
    store = dv.EventStore()
    store.push_back(100, 3, 5, True)
    writer.writeEvents(store)
    writer.writeImu(dv.IMU(150, 30.5, 1.5, 0.0, -1.0, 0.0, 2.5, -2.0, 0.0, 0.0, 0.0))
    writer.writeTrigger(dv.Trigger(160, dv.TriggerType.EXTERNAL_SIGNAL_RISING_EDGE))
    del writer
    side = codec_that_reads(path).side_data(path)
    (triggers,), (imu,) = side["triggers"](), side["imu"]()
    assert {name: column.tolist() for name, column in triggers.items()} == {"t": [160], "type": [1]}
    assert {name: column.tolist() for name, column in imu.items()} == {
        "t": [150],
        "temperature_c": [30.5],
        **{"acceleration_x_g": [1.5], "acceleration_y_g": [0.0], "acceleration_z_g": [-1.0]},
        **{"rotation_x_deg_s": [0.0], "rotation_y_deg_s": [2.5], "rotation_z_deg_s": [-2.0]},
    }


def test_signals_and_imu_samples_of_older_files_are_read(tmp_path, capfd):
    path = tmp_path / "e.aedat"
    davis_with(path)
    side = codec_that_reads(path).side_data(path)
    assert [one["t"].tolist() for one in side["triggers"]()] == [[6]]
    path.write_bytes(path.read_bytes() + b"cut")
    assert (main(["info", str(path)]), main(["info", str(path), "--repair"])) == (2, 0)
    header = b"#!AER-DAT3.1\r\n#Source 1: DAVIS346\r\n#!END-HEADER\r\n"
    special = struct.pack("<2h6i", 0, 1, 8, 4, 1, 128, 128, 128)  # one of every type
    special += b"".join(struct.pack("<2I", kind << 1 | 1, 9) for kind in range(128))
    imu = struct.pack("<2h6i", 3, 1, 36, 4, 0, 1, 1, 1)
    imu += struct.pack("<2I7f", 1, 11, 0.5, 0, -1, 0, 2.5, 0, 30)
    path.write_bytes(header + special + imu)
    side = codec_that_reads(path).side_data(path)
    (signals,), (samples,) = side["triggers"](), side["imu"]()
    assert (signals["t"].tolist(), signals["type"].tolist()) == ([2**31 + 9] * 3, [2, 3, 4])
    assert samples["t"].tolist() == [11]
    assert samples["acceleration_x_g"].tolist() == [0.5]
    assert samples["rotation_y_deg_s"].tolist() == [2.5]
    assert samples["temperature_c"].tolist() == [30]
    path.write_bytes(header + 3 * (special + imu))  # packets
    capfd.readouterr()
    assert main(["info", str(path), "--json"]) == 0
    facts = json.loads(capfd.readouterr().out)
    assert (facts["triggers"], facts["imu"]) == (9, 3)
