"""Recorded layouts, boxes, detector and the whole command, on a stand-in of the recordings."""

import json
import shutil
from pathlib import Path

import numpy as np
import pytest

from texvent.errors import ConfigError, FileFormatError, InputError
from texvent_lab.bench.objects.recorded import (
    SIDE,
    Frames,
    in_cells,
    read_table,
    read_turntables,
)
from texvent_lab.commands.bench.bench import run

from .stand_in import POSES, write_frames, write_specifications, write_turntables


def test_cells_count_on_and_off_pixels():
    image = np.array([[1, 1, 0, -1], [0, -1, 0, 0]], np.int8)
    assert in_cells(image[None]).tolist() == [[[[2, 0]], [[1, 1]]]]


def test_an_object_is_visible_by_the_events_above_the_density_of_its_frame():
    images = np.zeros((3, 128, 128), np.int8)
    images[0, 10:14, 10:15] = 1  # 20 events, less 100 pixels of a density of 20 / 16384
    images[1, 10:14, 10:16] = -1  # 24
    images[2] = 1  # as dense everywhere
    boxes = np.tile(np.array([10, 10, 10, 10], np.float32), (3, 1))
    frames = Frames(images, np.zeros(3, int), boxes, np.zeros(3, int))
    assert frames.is_visible.tolist() == [False, True, False]


def test_frames_are_read_by_pose_from_a_folder_and_a_zip(tmp_path):
    write_frames(tmp_path / "a")
    frames = read_table(tmp_path / "a")
    assert frames.classes.tolist() == list(range(7)) * POSES
    assert frames.boxes[7].tolist() == [15, 50, 40, 30]  # the banana of the second pose
    assert set(np.unique(frames.images[0, 60:70, 20:40])) == {-1}
    shutil.make_archive(str(tmp_path / "b"), "zip", tmp_path / "a")
    for one, other in zip(
        vars(frames).values(), vars(read_table(tmp_path / "b.zip")).values(), strict=True
    ):
        assert np.array_equal(one, other)


def test_a_damaged_zip_is_refused(tmp_path):
    write_frames(tmp_path / "a")
    path = Path(shutil.make_archive(str(tmp_path / "b"), "zip", tmp_path / "a"))
    content = bytearray(path.read_bytes())
    content[300 : len(content) // 2 : 50] = bytes(len(content[300 : len(content) // 2 : 50]))
    path.write_bytes(content)
    with pytest.raises(FileFormatError, match="is damaged"):
        read_table(path)


def test_turntables_give_a_window_every_100_ms(tmp_path):
    write_turntables(tmp_path / "t")
    frames = read_turntables(tmp_path / "t")
    assert np.bincount(frames.classes).tolist() == [9] * 6
    columns = np.flatnonzero((frames.images[-9:] != 0).any(axis=(0, 1)))
    assert (columns[0], columns[-1]) == (20, 89)


def test_what_is_no_recording_is_refused_in_one_line(tmp_path):
    write_frames(tmp_path / "a")
    label = tmp_path / "a" / "labels" / "cup_1.txt"
    label.write_text("7 .5 .5 .1 .1")
    with pytest.raises(FileFormatError, match=r"with a class of 0 to 6: banana, cup"):
        read_table(tmp_path / "a")
    label.unlink()
    with pytest.raises(InputError, match="cup_1 has no label"):
        read_table(tmp_path / "a")
    shutil.rmtree(tmp_path / "a" / "images")
    with pytest.raises(FileFormatError, match=r"has no images/NAME_POSE\.png"):
        read_table(tmp_path / "a")
    with pytest.raises(InputError, match=r"DataSet2_Caixa\.aedat; give the folder"):
        read_turntables(tmp_path)


@pytest.mark.torch
def test_a_locator_finds_what_it_was_trained_on():
    pytest.importorskip("torch")
    from texvent_lab.bench.detection.precision import ALL, average_precision
    from texvent_lab.bench.objects.locator import locate, train_locator
    from texvent_lab.bench.objects.plan import SCHEDULE
    from texvent_lab.bench.objects.results import as_truth

    images, boxes = np.zeros((8, SIDE, SIDE), np.int8), np.zeros((8, 4), np.float32)
    for number in range(8):
        x, y, width = 20 + 6 * number, 40 + 4 * number, (24, 48)[number % 2]
        images[number, y : y + 24, x : x + width] = 1
        boxes[number] = x, y, width, 24
    frames = Frames(images, np.arange(8) % 2, boxes, np.arange(8))
    network = train_locator(frames, 2, steps=120, schedule=SCHEDULE, seed=0)
    truth = as_truth(frames, is_visible_only=False)
    found = locate(network, images, 2)
    score = average_precision(found, truth, classes=("short", "long"), iou=(0.5,))[ALL]
    assert score > 0.9
    assert average_precision(found, truth, classes=("short", "long"), iou=(0.75,))[ALL] > 0.5


def test_the_command_scores_every_arm_and_goes_on(networks, tmp_path, capsys):
    write_specifications(tmp_path / "configs")
    write_frames(tmp_path / "frames")
    write_turntables(tmp_path / "turntables")
    words = ["objects", str(tmp_path / "configs"), "--frames", str(tmp_path / "frames")]
    words += ["--turntables", str(tmp_path / "turntables"), "--work", str(tmp_path / "work")]
    words += ["--steps", "2", "--seeds", "1", "--quiet"]
    run([*words, "-o", str(tmp_path / "one.json")])
    document = json.loads((tmp_path / "one.json").read_text())
    arms = ["texvent", "difference", "recorded"]
    assert [one["arm"] for one in document["table"]] == arms
    assert [one["arm"] for one in document["turntable"]] == [*arms, "number of events alone"]
    assert document["table"][0]["difference"] is None
    assert len(document["table"][1]["difference"]) == 3
    for path in (tmp_path / "work").glob("predicted-*"):
        with np.load(path) as file:
            found, numbers = file["found"], file["numbers"]
            if found.dtype.names:  # boxes of windows, those that were not learned alone
                assert {*found["t"].tolist()} <= {*numbers.tolist()}
            else:
                assert len(found) == len(numbers)
    for images, labels in networks.of_windows if networks else ():
        one, other = np.split(images, 2)  # as they are, and mirrored left to right
        assert np.array_equal(one, other[..., ::-1])
        assert np.array_equal(*np.split(labels, 2))
    times = {one: one.stat().st_mtime_ns for one in (tmp_path / "work").iterdir()}
    run([*words, "-o", str(tmp_path / "two.json")])
    assert times == {one: one.stat().st_mtime_ns for one in (tmp_path / "work").iterdir()}
    assert json.loads((tmp_path / "two.json").read_text())["table"] == document["table"]
    assert "| less texvent |" in capsys.readouterr().out
    with pytest.raises(ConfigError, match="unknown arm 'rvt'"):
        run([*words, "--arms", "rvt"])
    turntable = tmp_path / "configs" / "turntable.toml"
    turntable.write_text(turntable.read_text().replace("variants.difference", "variants.turned"))
    run([*words, "--arms", "turned,texvent", "-o", str(tmp_path / "three.json")])
    document = json.loads((tmp_path / "three.json").read_text())
    assert [one["arm"] for one in document["table"]] == ["texvent", "recorded"]
    assert [one["arm"] for one in document["turntable"]][:2] == ["turned", "texvent"]
    assert {*document["protocol"]["arms"]} == {"texvent", "turned"}
    table = tmp_path / "configs" / "table.toml"
    table.write_text(table.read_text().replace('"orange"', '"car"'))
    with pytest.raises(ConfigError, match=r"other classes than the recordings: car; label clips"):
        run(words)
