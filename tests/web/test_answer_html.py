from __future__ import annotations

import html
import re
from pathlib import Path

import pytest

from texvent.web.answer_html import failure_html, progress_html, summary_html, viewer_html
from texvent.web.examples import examples
from texvent.web.job import Answer
from texvent.web.workspace import Workspace

HOSTILE = '"><script>alert(1)</script>'


def test_text_from_the_visitor_stays_text() -> None:
    answer = Answer(kind="done", text=f"{HOSTILE}\n{HOSTILE}")
    for text in (failure_html(HOSTILE), progress_html(answer), summary_html(answer)):
        assert "<script" not in text
        assert html.escape(HOSTILE) in text


@pytest.mark.parametrize(
    ("message", "shown"),
    [
        ("/tmp/texvent-app-x/uploads/5f3/my film.mp4 is no video", "my film.mp4 is no video"),
        ("no weights in '/home/lab/.cache/texvent/v2ce.pt'", "no weights in 'v2ce.pt'"),
        (r"C:\Users\lab\uploads\a.mp4 is damaged", "a.mp4 is damaged"),
        ("20 m/s and/or 1/2; see https://example.org/a", None),
    ],
)
def test_folders_of_the_server_are_not_shown(message: str, shown: str | None) -> None:
    assert html.unescape(failure_html(message)).endswith(f"</strong> {shown or message}</div>")


def test_a_bar_shows_how_far_the_job_is_if_somebody_knows() -> None:
    assert ' value="0.250"' in progress_html(Answer(kind="progress", share=0.25))
    assert "value" not in progress_html(Answer(kind="progress"))


def test_the_viewer_runs_its_script_in_a_sandbox_and_nothing_else(tmp_path: Path) -> None:
    page = tmp_path / "page.html"
    page.write_text('<p>"it\'s" & more</p>', encoding="utf-8")
    frame = viewer_html(page)
    assert re.findall(r'sandbox="([^"]*)"', frame) == ["allow-scripts"]
    source = re.search(r'srcdoc="([^"]*)"', frame)
    assert source is not None
    assert html.unescape(source[1]) == page.read_text("utf-8")


def test_only_the_latest_jobs_are_kept_and_nothing_remains() -> None:
    with Workspace(kept=2) as workspace:
        folders = [workspace.new_folder("me") for _ in range(4)]
        assert [folder.exists() for folder in folders] == [False, False, True, True]
        root = workspace.root
        (folders[-1] / "events.h5").write_bytes(b"x")
    assert not root.exists()


def test_every_example_has_its_image() -> None:
    assert len(examples()) >= 6
    for path, prompt in examples():
        assert path.read_bytes()[:3] == b"\xff\xd8\xff"
        assert prompt
