"""The blocks of docs/datasets-load.md that need torch or other loaders; the others always run."""

from __future__ import annotations

import re
import subprocess
import sys
from pathlib import Path

import pytest

from texvent.cli.app import main

PAGE = Path(__file__).parents[3] / "docs" / "datasets-load.md"
BLOCK = re.compile(r"^```(python|text)\n(.*?)^```", re.MULTILINE | re.DOTALL)


def blocks(language: str, package: str) -> list[str]:
    found = BLOCK.findall(PAGE.read_text(encoding="utf-8"))
    return [text for kind, text in found if kind == language and f"import {package}\n" in text]


@pytest.fixture(scope="module")
def folder(tmp_path_factory):
    """Where the data set of the page lies."""
    folder = tmp_path_factory.mktemp("page")
    with pytest.MonkeyPatch.context() as patch:
        patch.chdir(folder)
        (specification,) = blocks("python", "Path")
        exec(specification)
        assert main(["dataset", "make", "cars.toml", "-o", "cars", "--workers", "1"]) == 0
    return folder


def run(text: str, folder: Path) -> str:
    (folder / "script.py").write_text(text, encoding="utf-8")
    command = [sys.executable, "script.py"]
    done = subprocess.run(command, cwd=folder, capture_output=True, text=True, check=False)
    assert done.returncode == 0, done.stderr
    return done.stdout


@pytest.mark.torch
def test_the_training_loop_and_the_batch_of_events_run(folder):
    torch = pytest.importorskip("torch")
    train, represent = blocks("text", "torch")
    run(train, folder)
    saved = torch.load(folder / "run.pt")
    assert saved["loader"]["epoch"] == 3
    assert saved["net"]["1.weight"].shape == (2, 5 * 48 * 64)
    assert run(represent, folder).startswith("torch.Size([4, 5, 48, 64]) tensor(")


@pytest.mark.dataset
@pytest.mark.parametrize("package", ["webdataset", "datasets"])
def test_other_libraries_read_the_shards(folder, package, monkeypatch):
    pytest.importorskip(package)
    pytest.importorskip("PIL")  # datasets decodes the previews
    monkeypatch.setenv("HF_HOME", str(folder / "cache"))
    monkeypatch.setenv("HF_HUB_OFFLINE", "1")
    (text,) = blocks("text", package)
    assert "drives left" in run(text, folder)
