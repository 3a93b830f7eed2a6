"""`texvent batch`: many prompts, one run; stopped and taken up again."""

import pytest

import texvent
from texvent.cli.app import main

QUICK = (
    *("--sensor", "48x36", "--duration", "0.1", "--samples", "1"),
    *("--events-only", "--interpolate", "none", "--noise", "none"),
)


@pytest.fixture
def folder(tmp_path, monkeypatch):
    monkeypatch.chdir(tmp_path)
    return tmp_path


def run(*words: object) -> int:
    return main([str(word) for word in words])


def test_every_prompt_gets_its_own_file_with_its_own_seed(folder, capsys):
    (folder / "p.csv").write_text("prompt,name,seed\na red car drives left,,5\na dog runs,dog,\n")
    assert run("batch", "p.csv", "-o", "out", "--seed", 3, *QUICK) == 0
    names = sorted(path.name for path in (folder / "out").iterdir())
    assert names == ["0001-a-red-car-drives-left.h5", "dog.h5"]
    car, dog = (texvent.load(folder / "out" / name) for name in names)
    assert (car.metadata["prompt"], car.metadata["seed"]) == ("a red car drives left", 5)
    assert (dog.metadata["prompt"], dog.metadata["seed"]) == ("a dog runs", 3)


def test_a_batch_goes_on_where_it_was(folder, capsys):
    (folder / "p.txt").write_text("a red car drives left\n")
    assert run("batch", "p.txt", *QUICK) == 0
    done = folder / "p" / "0001-a-red-car-drives-left.h5"
    before = done.stat().st_mtime_ns
    (folder / "p.txt").write_text("a red car drives left\na dog runs\n")
    capsys.readouterr()
    assert run("batch", "p.txt", *QUICK) == 0
    assert "kept" in capsys.readouterr().err
    assert done.stat().st_mtime_ns == before
    assert len(list((folder / "p").iterdir())) == 2


def test_a_prompt_that_fails_does_not_end_the_others(folder, capsys, monkeypatch):
    from texvent.errors import InputError
    from texvent.generate.procedural import ProceduralGenerator

    whole = ProceduralGenerator.generate

    def picky(self, prompt, *, progress=None):
        if "bad" in prompt:
            raise InputError("the guardrail blocks this prompt")
        return whole(self, prompt, progress=progress)

    monkeypatch.setattr(ProceduralGenerator, "generate", picky)
    (folder / "p.txt").write_text("a bad thing\na dog runs\n")
    assert run("batch", "p.txt", *QUICK) == 1
    said = capsys.readouterr().err
    assert "failed   line 1: the guardrail blocks this prompt" in said
    assert "error: 1 of 2 prompts failed" in said
    assert [path.name for path in (folder / "p").iterdir()] == ["0002-a-dog-runs.h5"]


def test_mistakes_are_one_line(folder, capsys):
    (folder / "p.csv").write_text("prompt,name\na car,x\na dog,x\n")
    assert run("batch", "p.csv", *QUICK) == 2
    assert "line 3: the name 'x' is there twice" in capsys.readouterr().err
    (folder / "taken").write_text("")
    (folder / "p.txt").write_text("a car\n")
    assert run("batch", "p.txt", "-o", "taken") == 3
    assert run("batch", "none.txt") == 2
