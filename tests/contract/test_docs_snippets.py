"""Every snippet in README.md and docs/ runs: Python blocks, and `$ texvent` lines of consoles.

A page's blocks run in order, in one namespace, in an empty folder; then once more, as a reader who
pastes them again runs them. A block that needs one of `LIBRARIES` runs where that is installed; one
that cannot run in a test (it needs a camera, a download or minutes) is fenced as `text`.
"""

import re
import shlex
from importlib.util import find_spec
from pathlib import Path

import pytest

from texvent.cli.app import main

ROOT = Path(__file__).parents[2]
PAGES = [ROOT / "README.md", *sorted((ROOT / "docs").rglob("*.md"))]
KEEPS_NOTHING = ("dataset plan",)
"""Commands that simulate and keep nothing: the second time, they would be as the first time."""

LIBRARIES = ("torch", "tonic", "snntorch", "norse", "spikingjelly")
"""Packages that texvent does not need; torch is there in `make test-torch`."""
IMPORTS = re.compile(rf"^\s*(?:import|from) ({'|'.join(LIBRARIES)})\b", re.MULTILINE)
FENCE = re.compile(r"^```(\w+)\n(.*?)^```", re.MULTILINE | re.DOTALL)


def blocks(page: Path) -> list[tuple[str, str]]:
    return [
        (match[1], match[2])
        for match in FENCE.finditer(page.read_text(encoding="utf-8"))
        if match[1] in ("python", "console")
    ]


@pytest.mark.docs
@pytest.mark.parametrize(
    "page", [page for page in PAGES if blocks(page)], ids=lambda page: str(page.relative_to(ROOT))
)
def test_snippets_run_twice(page, tmp_path, monkeypatch, capsys):
    monkeypatch.chdir(tmp_path)
    run_page(page, capsys)
    run_page(page, capsys, left_out=KEEPS_NOTHING)


@pytest.mark.torch
@pytest.mark.filterwarnings("ignore:.torch.jit.script")  # Norse compiles so when it is imported
@pytest.mark.parametrize(
    "page",
    [page for page in PAGES if any(IMPORTS.search(text) for _, text in blocks(page))],
    ids=lambda page: str(page.relative_to(ROOT)),
)
def test_snippets_that_need_torch_run_twice(page, tmp_path, monkeypatch, capsys):
    pytest.importorskip("torch", reason="make test-torch runs the tests that need torch")
    test_snippets_run_twice(page, tmp_path, monkeypatch, capsys)


def run_page(
    page: Path, capsys: pytest.CaptureFixture[str], *, left_out: tuple[str, ...] = ()
) -> None:
    namespace: dict[str, object] = {"__name__": "snippet"}
    for language, text in blocks(page):
        if language == "python":
            if not all(map(find_spec, IMPORTS.findall(text))):
                continue
            exec(compile(text, f"{page.name} snippet", "exec"), namespace)
            continue
        for line in text.splitlines():
            if line.startswith("$ texvent "):
                words = shlex.split(line, comments=True)[2:]
                if " ".join(words).startswith(left_out):
                    continue
                assert main(words) == 0, f"{line}\n{capsys.readouterr().err}"
