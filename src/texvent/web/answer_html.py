"""What the page shows of a job, as HTML that user text cannot break out of."""

from __future__ import annotations

import html
import re
from pathlib import Path

from texvent.web.job import Answer

PAGE_HEIGHT_PX = 900
FOLDERS = re.compile(r"(?<![\w/\\])(?:[A-Za-z]:)?[/\\](?:[^\s/\\]+[/\\]+)+")
"""What a path has before the name of its file."""


def _text(text: str) -> str:
    """The text without folders of this machine, which are not the visitor's to know."""
    return html.escape(FOLDERS.sub("", text))


def status_html(text: str) -> str:
    """One line."""
    return f'<div class="texvent-status" role="status">{_text(text)}</div>'


def progress_html(answer: Answer) -> str:
    """A bar and one line."""
    value = "" if answer.share is None else f' value="{answer.share:.3f}"'
    return (
        f'<div class="texvent-status" role="status"><progress max="1"{value}></progress> '
        f"{_text(answer.text)}</div>"
    )


def summary_html(answer: Answer) -> str:
    """What a finished job made and understood, one line each."""
    first, *rest = answer.text.splitlines() or [""]
    items = "".join(f"<li>{_text(line)}</li>" for line in rest)
    return (
        f'<div class="texvent-status" role="status"><strong id="texvent-done">'
        f"{html.escape(first)}</strong><ul>{items}</ul></div>"
    )


def failure_html(message: str) -> str:
    """One clear error."""
    return (
        '<div class="texvent-status texvent-error" role="alert"><strong>This did not work.'
        f"</strong> {_text(message)}</div>"
    )


def download_html(answer: Answer, address: str) -> str:
    """The link to a download."""
    name = html.escape(address.rpartition("/")[2])
    return (
        f'<div class="texvent-status" role="status">{html.escape(answer.text)}: '
        f'<a id="download-link" href="{html.escape(address)}" download>{name}</a></div>'
    )


def video_html(address: str) -> str:
    """The preview video; its controls lie below the image, so nothing covers the legend."""
    return (
        f'<video id="preview" src="{html.escape(address)}" autoplay loop muted playsinline '
        'controls aria-label="Video and events side by side"></video>'
    )


def viewer_html(page: str | Path) -> str:
    """The viewer's page in a frame of its own, which may run its script and nothing else."""
    text = html.escape(Path(page).read_text(encoding="utf-8"), quote=True)
    return (
        f'<iframe id="texvent-viewer" title="Events in space and time" sandbox="allow-scripts" '
        f'style="width:100%;height:{PAGE_HEIGHT_PX}px;border:0" srcdoc="{text}"></iframe>'
    )
