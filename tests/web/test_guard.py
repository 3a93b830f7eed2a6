"""The guard around a small application, called as a server calls it."""

from __future__ import annotations

import asyncio
from pathlib import Path
from typing import Any

import pytest

from texvent.web import guard
from texvent.web.guard import API, Guard, session_of

HOME = "127.0.0.1:7860"


async def echo(scope: Any, receive: Any, send: Any) -> None:
    """Answers with the length of the body."""
    total, more = 0, True
    while more:
        message = await receive()
        total += len(message.get("body", b""))
        more = message.get("more_body", False)
    await send({"type": "http.response.start", "status": 200, "headers": []})
    await send({"type": "http.response.body", "body": str(total).encode()})


def ask(
    path: str = "/",
    *,
    parts: tuple[bytes, ...] = (b"",),
    listens_on: str = "127.0.0.1",
    names: tuple[str, ...] = (),
    silence: bool = False,
    **headers: str,
) -> tuple[int, dict[str, str]]:
    """Status and headers of the answer to one request."""
    layer = Guard(
        echo, host=listens_on, allowed_hosts=names, upload_bytes=1000, public_files=Path("/public")
    )
    given = {"host": HOME} | {name.replace("_", "-"): value for name, value in headers.items()}
    sent: list[Any] = []
    rest = list(parts)

    async def receive() -> Any:
        if silence and not rest:
            await asyncio.sleep(60)
        body = rest.pop(0)
        return {"type": "http.request", "body": body, "more_body": bool(rest) or silence}

    async def send(message: Any) -> None:
        sent.append(message)

    scope = {
        "type": "http",
        "method": "GET" if parts == (b"",) else "POST",
        "path": path,
        "headers": [(name.encode(), value.encode()) for name, value in given.items()],
    }
    asyncio.run(layer(scope, receive, send))
    starts = [one for one in sent if one["type"] == "http.response.start"]
    assert len(starts) == 1
    answer = {name.decode(): value.decode() for name, value in starts[0]["headers"]}
    return starts[0]["status"], answer


@pytest.mark.parametrize("host", [HOME, "localhost:7860", "[::1]:7860", "LOCALHOST", "127.0.0.1"])
def test_names_of_this_machine_are_answered(host: str) -> None:
    assert ask(host=host)[0] == 200


@pytest.mark.parametrize(
    "host", ["evil.example", "evil.example:7860", "127.0.0.1.evil.example", "192.0.2.7", ""]
)
def test_other_names_are_refused_so_that_no_dns_answer_opens_the_page(host: str) -> None:
    status, headers = ask(host=host)
    assert status == 421
    assert headers["x-content-type-options"] == "nosniff"


def test_a_page_open_to_the_network_is_asked_for_by_address_or_by_an_allowed_name() -> None:
    assert ask(host="192.0.2.7:7860", listens_on="0.0.0.0")[0] == 200
    assert ask(host="evil.example", listens_on="0.0.0.0")[0] == 421
    assert ask(host="events.lab.example", listens_on="0.0.0.0")[0] == 421
    assert ask(host="events.lab.example", names=("events.lab.example",))[0] == 200


@pytest.mark.parametrize(
    "headers",
    [
        {"origin": "http://evil.example"},
        {"origin": "null"},
        {"origin": "http://127.0.0.1:9999"},
        {"sec_fetch_site": "cross-site", "sec_fetch_mode": "no-cors"},
    ],
)
def test_other_pages_cannot_make_requests(headers: dict[str, str]) -> None:
    assert ask(f"{API}queue/join", parts=(b"{}",), **headers)[0] == 403


def test_its_own_page_and_a_link_from_another_can() -> None:
    assert ask(f"{API}queue/join", parts=(b"{}",), origin=f"http://{HOME}")[0] == 200
    assert ask(sec_fetch_site="cross-site", sec_fetch_mode="navigate")[0] == 200


@pytest.mark.parametrize(
    ("path", "status"),
    [
        (f"{API}file=/public/car.jpg", 200),
        (f"{API}file=/public/../etc/passwd", 403),
        (f"{API}file=/tmp/uploads/x/page.html", 403),
        (f"{API}file=http://192.0.2.1/", 403),
        (f"{API}proxy=http://192.0.2.1/", 404),
        (f"{API}vibe-edit/", 404),
        ("/monitoring", 404),
        ("/results/job-1/events.h5", 200),
    ],
)
def test_only_the_routes_of_the_page_are_open(path: str, status: int) -> None:
    assert ask(path)[0] == status


def test_uploads_are_bounded_by_what_they_say_and_by_what_comes() -> None:
    upload = f"{API}upload"
    assert ask(upload, parts=(b"x" * 900,))[0] == 200
    assert ask(upload, parts=(b"x",), content_length="99999999")[0] == 413
    assert ask(upload, parts=(b"x" * 60_000, b"x" * 60_000))[0] == 413
    assert ask(f"{API}queue/join", parts=(b"x" * 600_000,) * 2)[0] == 413


def test_a_body_that_stops_coming_is_given_up(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(guard, "SILENCE_S", 0.05)
    assert ask(f"{API}upload", parts=(b"x",), silence=True)[0] == 408


def test_a_body_that_drips_is_given_up(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(guard, "GRACE_S", -1.0)
    assert ask(f"{API}upload", parts=(b"x",) * 5)[0] == 408


def test_a_visitor_gets_a_session_once() -> None:
    cookie = ask()[1]["set-cookie"]
    assert "HttpOnly" in cookie
    assert "SameSite=Lax" in cookie
    session = session_of(cookie.partition(";")[0])
    assert session is not None
    assert "set-cookie" not in ask(cookie=f"{guard.SESSION}={session}")[1]
    assert session_of(f"{guard.SESSION}=short") is None
