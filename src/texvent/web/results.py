"""Results of jobs at /results/, for the session that made them."""

from __future__ import annotations

from pathlib import Path
from typing import Any

from texvent._require import require
from texvent.web.guard import SESSION
from texvent.web.workspace import Workspace

SHOWN = {".mp4": "video/mp4"}
"""What a browser may show in place; all else is only saved."""
HEADERS = {
    "Cache-Control": "private, no-store",
    "Content-Security-Policy": "default-src 'none'; sandbox",
}


def address_of(path: str | Path) -> str:
    """Where the page finds the file of a job, relative to the page."""
    path = Path(path)
    return f"results/{path.parent.name}/{path.name}"


def add_results(application: Any, workspace: Workspace) -> None:
    """Let a FastAPI application serve the workspace's results, each to its own session."""
    responses = require("starlette.responses", extra="app")
    request_type = require("starlette.requests", extra="app").Request

    def result(request: Any, folder: str, name: str) -> Any:
        path = workspace.result(request.cookies.get(SESSION), folder, name)
        if path is None:
            return responses.PlainTextResponse("there is no such result", status_code=404)
        kind = SHOWN.get(path.suffix)
        return responses.FileResponse(
            path,
            media_type=kind or "application/octet-stream",
            filename=path.name,
            content_disposition_type="inline" if kind else "attachment",
            headers=HEADERS,
        )

    result.__annotations__["request"] = request_type
    application.get("/results/{folder}/{name}")(result)
