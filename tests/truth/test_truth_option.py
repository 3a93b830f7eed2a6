"""`--truth` on the command line."""

import json

import h5py
import numpy as np
import pytest

import texvent
from texvent.cli.app import main

QUICK = (
    *("--sensor", "48x36", "--duration", "0.1", "--samples", "1", "--seed", "3"),
    *("--previews", "none", "--interpolate", "none"),
)


@pytest.fixture(autouse=True)
def folder(tmp_path, monkeypatch):
    monkeypatch.chdir(tmp_path)
    return tmp_path


def run(*words: object) -> int:
    return main([str(word) for word in words])


def test_all_of_it_beside_the_events(folder, capsys):
    assert run("generate", "a red ball bounces", "-o", "b.raw", "--truth", "all", *QUICK) == 0
    written = capsys.readouterr()
    assert written.out.split() == ["b.raw", "b.truth"]
    assert "\\u000a" not in written.err
    truth = texvent.load_truth("b.truth")
    assert len(truth.event_instance) == len(texvent.load("b.raw"))
    assert set(np.unique(truth.event_instance)) <= {0, *truth.instances}
    assert (truth.metadata["prompt"], truth.metadata["seed"]) == ("a red ball bounces", 3)


def test_the_ids_of_a_scene_are_found_in_its_truth(folder):
    (folder / "s.toml").write_text(
        '[[objects]]\nnoun = "ball"\nid = "left one"\ncount = 2\n[[objects]]\nnoun = "box"\n'
        '[[objects]]\nnoun = "ball"\n'
    )
    assert run("generate", "s.toml", "-o", "b.h5", "--truth", "boxes", *QUICK) == 0
    named = {1: "left one", 2: "left one", 3: "box", 4: "ball 2"}
    truth = texvent.load_truth("b.truth")
    assert truth.objects == named
    assert set(truth.instances.values()) == {"ball", "box"}
    boxes = json.loads((folder / "b.truth/boxes/coco.json").read_text())["annotations"]
    assert boxes
    assert all(one.get("object", "box") == named[one["track_id"]] for one in boxes)


def test_ids_have_16_bits_in_hdf5(folder, capsys):
    assert run("generate", "a red ball bounces", "-o", "b.h5", "--truth", "events", *QUICK) == 0
    assert "left out" not in capsys.readouterr().err
    with h5py.File("b.h5") as file:
        assert file["events/instance"].dtype == file["events/class_id"].dtype == np.uint16
        assert file["events/instance"][:].max() == 1


def test_ids_go_with_their_events_and_what_cannot_hold_them_says_so(folder, capsys):
    assert run("generate", "a red ball bounces", "-o", "b.h5", "--truth", "events", *QUICK) == 0
    whole = texvent.load("b.h5")
    assert run("convert", "b.h5", "cut.npz", "--crop", "10,0,30,36") == 0
    inside = (whole.x >= 10) & (whole.x < 40)
    np.testing.assert_array_equal(texvent.load("cut.npz").instance, whole.instance[inside])
    assert run("convert", "b.h5", "b.raw") == 0
    assert "no place for the instance and class of events" in capsys.readouterr().err
    assert texvent.load("b.raw").instance is None


def test_a_dry_run_writes_no_truth(folder):
    words = ("-o", "b.h5", "--truth", "all", "--dry-run")
    assert run("generate", "a red ball bounces", *words, *QUICK) == 0
    assert not list(folder.iterdir())


@pytest.mark.parametrize(
    ("words", "message"),
    [
        (("--truth", "flwo"), "no part 'flwo' of truth"),
        (("--truth", "flow", "--generator", "wan-1.3b"), "does not know the scene"),
    ],
)
def test_what_cannot_be_is_one_line_before_any_work(folder, capsys, words, message):
    assert run("generate", "a ball", "-o", "b.h5", *words) != 0
    written = capsys.readouterr()
    assert message in written.err
    assert len(written.err.splitlines()) == 1
    assert not list(folder.iterdir())


def test_each_sample_of_a_batch_has_its_truth(folder, capsys):
    (folder / "p.txt").write_text("a red ball bounces\na dog runs\n")
    words = ("batch", "p.txt", "-o", "out", "--truth", "boxes,events", *QUICK)
    assert run(*words) == 0
    folders = sorted((folder / "out").glob("*.truth"))
    assert len(folders) == 2
    for one in folders:
        events = texvent.load(one.with_suffix(".h5"))
        assert len(texvent.load_truth(one).event_instance) == len(events)
    assert run(*words) == 0
    assert run("batch", "p.txt", "-o", "out", *QUICK) != 0
    assert "was made with other options" in capsys.readouterr().err
