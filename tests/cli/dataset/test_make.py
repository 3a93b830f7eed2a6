"""`texvent dataset plan`, `make` and `stats`, as a user calls them."""

import os
import subprocess
import sys
import time
from pathlib import Path

import pytest
from tests.dataset.generation.small_sets import digests

from texvent.cli.app import main

SPECIFICATION = """
name = "cars"
samples_per_shard = 2
filters = { min_events = 1 }
splits = { train = 0.75, test = 0.25 }

[options]
duration = 0.1
sensor = "32x24"
interpolate = "none"

[[sources]]
template = "a {colour} {thing} drives left"
words.colour = ["red", "blue"]
words.thing = ["car", "bus"]
label = "{thing}"

[variants.paper]
seeds = 2

[variants.esim]
simulator = "esim"
"""


@pytest.fixture(scope="module")
def whole(tmp_path_factory):
    """The data set made in one go by this process: digests of its files."""
    folder = tmp_path_factory.mktemp("whole")
    (folder / "cars.toml").write_text(SPECIFICATION)
    assert run("make", folder / "cars.toml", "-o", folder / "cars", "--workers", 1, "-q") == 0
    return digests(folder / "cars")


@pytest.fixture
def folder(tmp_path, monkeypatch):
    monkeypatch.chdir(tmp_path)
    (tmp_path / "cars.toml").write_text(SPECIFICATION)
    return tmp_path


def run(*words: object) -> int:
    return main(["dataset", *map(str, words)])


def test_a_plan_says_what_there_will_be_and_leaves_nothing(folder, capsys):
    assert run("plan", "cars.toml", "--trial", 1, "--workers", 1) == 0
    said = capsys.readouterr().out
    assert "4 prompts, 4 clips, 12 samples in 6 shards" in said
    assert "train 3, test 1" in said
    assert "paper (2 seeds), esim" in said
    assert "classes  2, 2 prompts each" in said
    assert "no license" in said
    classes = {line.split()[0]: line.split()[1:] for line in said.splitlines() if line.split()}
    assert classes["class"] == ["train", "test"]
    counts = {name: [*map(int, classes[name])] for name in ("bus", "car")}
    assert [sum(column) for column in zip(*counts.values(), strict=True)] == [3, 1]
    (lacking,) = (name for name, (_, test) in counts.items() if test == 0)
    assert f"warning  test has no {lacking}" in said
    assert "prompts  4 of 4 prompts understood word for word" in said
    assert [path.name for path in folder.iterdir()] == ["cars.toml"]


WUGS = """
name = "wugs"
filters = { min_events = 1 }
[options]
duration = 0.1
sensor = "32x24"
interpolate = "none"
samples = 1
[[sources]]
prompts = ["a red ball bounces", "a wug and a dog run", "qwerty zxcv"]
"""


def test_a_trial_is_made_of_sources_that_belong_to_a_split(folder, capsys):
    text = WUGS.replace(', "a wug and a dog run", "qwerty zxcv"', "") + 'split = "train"\n'
    (folder / "wugs.toml").write_text(text)
    assert run("plan", "wugs.toml", "--trial", 1, "--workers", 1) == 0
    assert "samples  1 made" in capsys.readouterr().out


def test_prompts_that_are_not_shown_as_they_say_are_counted_and_fail_the_set(folder, capsys):
    (folder / "wugs.toml").write_text(WUGS)
    wug = "; 1 with words not understood (wug); 1 refused"
    assert run("plan", "wugs.toml", "--trial", 0) == 0
    assert f"prompts  1 of 3 prompts understood word for word{wug}" in capsys.readouterr().out
    assert run("make", "wugs.toml", "--workers", 1, "-q") == 1
    said = capsys.readouterr()
    assert "2 samples" in said.out
    assert "1 sample failed: texvent dataset stats" in said.err
    assert run("make", "wugs", "--workers", 1, "-q", "--allow-failed") == 0
    capsys.readouterr()
    assert run("stats", "wugs") == 0
    said_of_set = capsys.readouterr().out
    wug = wug.replace("; 1 refused", "; 1 with words uncertain beside them (run); 1 refused")
    assert f"prompts  1 of 3 clips shown as they say{wug}" in said_of_set
    assert "failed   1: nothing in the prompt was understood: qwerty zxcv" in said_of_set


def test_a_strict_data_set_is_refused_before_any_work(folder, capsys):
    (folder / "wugs.toml").write_text(WUGS.replace("[options]", "[options]\nstrict = true"))
    assert run("make", "wugs.toml", "--workers", 1, "-q") == 2
    said = capsys.readouterr().err
    assert "2 of 3 prompts are refused, such as 'a wug and a dog run': strict: " in said
    assert not (folder / "wugs").exists()


def test_a_class_that_is_not_shown_is_planned_as_refused_and_made_if_allowed(folder, capsys):
    (folder / "wugs.toml").write_text(WUGS.replace("qwerty zxcv", "a wug rolls") + 'label = "wug"')
    assert run("plan", "wugs.toml", "--trial", 0) == 0
    assert "make refuses" not in capsys.readouterr().out  # one of its prompts goes without the word
    head, _, _ = WUGS.partition("prompts =")
    text = f'{head}template = "a {{class}} runs"\nclasses = ["dog", "wuggy dog"]\n'
    (folder / "wugs.toml").write_text(text)
    assert run("plan", "wugs.toml", "--trial", 0) == 0
    assert "make refuses class 'wuggy dog': not understood: wuggy" in capsys.readouterr().out
    assert run("make", "wugs.toml", "--workers", 1, "-q") == 2
    assert "1 of 2 classes would not be shown" in capsys.readouterr().err
    assert not (folder / "wugs").exists()
    (folder / "wugs.toml").write_text('allow_classes = ["wug dig"]\n' + text)
    assert run("make", "wugs.toml", "--workers", 1, "-q") == 2
    assert "did you mean 'wuggy dog'" in capsys.readouterr().err
    (folder / "wugs.toml").write_text('allow_classes = ["wuggy dog"]\n' + text)
    assert run("make", "wugs.toml", "--workers", 1, "-q") == 0
    (folder / "wugs.toml").write_text(text)  # what was begun goes on
    assert run("make", "wugs.toml", "--workers", 1, "-q") == 0


def test_going_on_needs_the_folder_alone(folder, whole):
    assert run("make", "cars.toml", "--shards", "1/2", "--workers", 1, "-q") == 0
    (folder / "cars.toml").unlink()
    assert run("make", "cars", "--workers", 1, "-q") == 0
    assert digests(folder / "cars") == whole


def test_a_killed_data_set_goes_on_without_loss(folder, whole, spawn):
    words = [sys.executable, "-m", "texvent.cli.app", "dataset", "make", "cars.toml",
             "--workers", "2"]  # fmt: skip
    process = spawn([*words, "-o", "killed"], stderr=subprocess.PIPE)
    while process.poll() is None and not list(Path("killed").rglob("*.tar")):
        time.sleep(0.02)
    process.kill()  # to the one that leads: its workers must end by themselves
    process.communicate(timeout=300)
    assert run("make", "cars.toml", "-o", "killed", "--workers", 1, "-q") == 0
    assert digests(folder / "killed") == whole
    hidden = [path for path in Path("killed").rglob(".texvent-*") if not is_locked(path)]
    assert hidden == []


def is_locked(path: Path) -> bool:
    """Whether a process still writes a part; workers of a killed one take a moment to end."""
    import fcntl

    descriptor = os.open(path, os.O_RDONLY)
    try:
        fcntl.flock(descriptor, fcntl.LOCK_EX | fcntl.LOCK_NB)
    except BlockingIOError:
        return True
    finally:
        os.close(descriptor)
    return False
