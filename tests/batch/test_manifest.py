"""What is done of a batch survives power failures, and options do not change silently."""

from __future__ import annotations

import json
from pathlib import Path

import pytest

from texvent.batch.manifest import OPTIONS_FILE, SAMPLES_FILE, Manifest
from texvent.batch.samples import Sample
from texvent.errors import ConfigError, FileFormatError

OPTIONS = {"settings": {"run": {"seed": 0}, "simulate": {"threshold": 0.2}}, "previews": ["png"]}
CAR = Sample("k1", "car", 7, "p.txt line 1", "a red car")
DOG = Sample("k2", "dog", 8, "p.txt line 2", "a dog")


def with_car(folder: Path) -> Manifest:
    manifest = Manifest(folder)
    manifest.begin(OPTIONS, overwrite=False)
    (folder / "car.h5").write_bytes(b"events")
    (folder / "car.png").write_bytes(b"image")
    manifest.add(CAR, [folder / "car.h5", folder / "car.png"], events=5)
    return manifest


def test_a_sample_is_done_when_all_its_files_are_there(tmp_path: Path) -> None:
    with_car(tmp_path)
    again = Manifest(tmp_path)
    assert again.is_done(CAR)
    assert not again.is_done(DOG)
    (tmp_path / "car.png").unlink()
    assert not again.is_done(CAR)
    assert again.is_known(CAR)
    (tmp_path / "car.png").write_bytes(b"imag")
    assert not Manifest(tmp_path).is_done(CAR)


def test_a_line_states_the_sample_and_the_sizes_of_its_files(tmp_path: Path) -> None:
    manifest = with_car(tmp_path)
    folder = tmp_path / "dog.frames"
    folder.mkdir()
    (folder / "0").write_bytes(b"one")
    (folder / "1").write_bytes(b"other")
    manifest.add(DOG, [folder], events=1)
    car, dog = map(json.loads, (tmp_path / SAMPLES_FILE).read_text().splitlines())
    assert car["files"] == {"car.h5": 6, "car.png": 5}
    assert (car["prompt"], car["seed"], car["events"]) == ("a red car", 7, 5)
    assert dog["files"] == {"dog.frames": 8}


def test_a_line_cut_off_by_a_power_failure_is_not_done_and_goes(tmp_path: Path) -> None:
    manifest = with_car(tmp_path)
    (tmp_path / "dog.h5").write_bytes(b"more")
    manifest.add(DOG, [tmp_path / "dog.h5"], events=1)
    path = tmp_path / SAMPLES_FILE
    path.write_bytes(path.read_bytes()[:-9])
    again = Manifest(tmp_path)
    assert again.is_done(CAR)
    assert not again.is_done(DOG)
    again.begin(OPTIONS, overwrite=False)
    again.add(DOG, [tmp_path / "dog.h5"], events=1)
    assert Manifest(tmp_path).is_done(DOG)


def test_damage_before_the_last_line_is_named(tmp_path: Path) -> None:
    with_car(tmp_path)
    path = tmp_path / SAMPLES_FILE
    path.write_bytes(b'{"key": 3}\n' + path.read_bytes())
    with pytest.raises(FileFormatError, match=r"samples\.jsonl line 1 is damaged"):
        Manifest(tmp_path)
    (tmp_path / OPTIONS_FILE).write_text("{")
    with pytest.raises(FileFormatError, match=r"batch\.json is damaged"):
        Manifest(tmp_path)


def test_other_options_are_refused_with_the_difference(tmp_path: Path) -> None:
    with_car(tmp_path)
    other = {"settings": {"run": {"seed": 0}, "simulate": {"threshold": 0.3}}, "previews": []}
    with pytest.raises(ConfigError, match=r"threshold was 0\.2, is 0\.3; --previews was png"):
        Manifest(tmp_path).begin(other, overwrite=False)
    assert Manifest(tmp_path).is_done(CAR)
