"""Folders of streams of different scenes, compared by their statistics."""

import json

import numpy as np
import pytest

from texvent.cli.app import main
from texvent.errors import InputError
from texvent_lab.bench.oracle.pixel import IDEAL, NOISY
from texvent_lab.bench.oracle.recording import oracle_scene, record
from texvent_lab.bench.unpaired import compare_folders


@pytest.fixture(scope="module")
def folders(tmp_path_factory):
    """Recordings of three textures by noisy pixels, and of another by noisy and ideal ones."""
    root = tmp_path_factory.mktemp("streams")
    for name in ("recorded", "alike", "ideal"):
        (root / name / "class").mkdir(parents=True)
    for seed in (7, 21, 33):
        events = record(oracle_scene("translate", seed), {"a": (NOISY, 1)})["a"]
        events.between(0, 200_000).save(root / "recorded" / "class" / f"{seed}.npz")
    both = record(oracle_scene("translate", 54), {"alike": (NOISY, 1), "ideal": (IDEAL, 1)})
    for name, events in both.items():
        events.between(0, 200_000).save(root / name / "class" / "a.npz")
    return root


def test_streams_of_the_same_sensor_are_near_and_ideal_ones_far(folders):
    alike = compare_folders(folders / "alike", folders / "recorded")
    ideal = compare_folders(folders / "ideal", folders / "recorded")
    assert (alike.simulated_files, alike.recorded_files) == (1, 3)
    assert alike.floor == ideal.floor < alike.null
    assert alike.simulated < ideal.simulated
    assert alike.normalised > ideal.normalised


def test_a_limit_takes_evenly_spaced_files(folders):
    seen = []
    report = compare_folders(folders / "alike", folders / "recorded", limit=2, progress=seen.append)
    assert report.recorded_files == 2
    names = {line.rsplit("/", 1)[-1] for line in seen}
    assert names == {"a.npz", "21.npz", "33.npz"}


def test_the_command_prints_floor_and_null_and_keeps_the_result(folders, tmp_path, capsys):
    words = [str(folders / "alike"), str(folders / "recorded"), "-q"]
    assert main(["bench", "unpaired", *words, "-o", str(tmp_path / "r.json")]) == 0
    assert "(floor " in capsys.readouterr().out
    document = json.loads((tmp_path / "r.json").read_text())
    assert document["schema"] == "texvent-unpaired-1"
    assert np.isfinite(document["simulated"])


def test_folders_without_enough_files_are_refused(folders, tmp_path):
    with pytest.raises(InputError, match="its floor needs two"):
        compare_folders(folders / "recorded", folders / "alike")
    with pytest.raises(InputError, match="no event file"):
        compare_folders(tmp_path, folders / "recorded")
    with pytest.raises(InputError, match="no folder"):
        compare_folders(tmp_path / "none", folders / "recorded")
