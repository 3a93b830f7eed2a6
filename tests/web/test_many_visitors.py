"""Twenty visitors at once over plain HTTP, one of them hostile."""

from __future__ import annotations

import contextlib
import http.client
import http.cookiejar
import io
import itertools
import json
import secrets
import socket
import time
import urllib.error
import urllib.request
import zipfile
from collections.abc import Iterator
from concurrent.futures import ThreadPoolExecutor
from pathlib import Path
from typing import Any

import pytest
from tests.web.served import served

pytest.importorskip("gradio", reason="gradio is an extra; make test-app")
pytestmark = pytest.mark.app

VISITORS = 19
JOBS = 6
"""How many of them make events; the others only look."""
SHOWN = 7
"""Parts of the page that a job's handlers fill."""


@pytest.fixture(scope="module")
def temporary(tmp_path_factory: pytest.TempPathFactory) -> Path:
    return tmp_path_factory.mktemp("temporary")


@pytest.fixture(scope="module")
def address(temporary: Path) -> Iterator[str]:
    with served(temporary) as line:
        yield line


class Visitor:
    """A browser's requests without the browser."""

    def __init__(self, address: str) -> None:
        self._address = address
        self._session = secrets.token_hex(5)
        jar = http.cookiejar.CookieJar()
        self._opener = urllib.request.build_opener(urllib.request.HTTPCookieProcessor(jar))
        self.get("")
        self._handlers = json.loads(self.get("config"))["dependencies"]

    def get(self, path: str) -> bytes:
        with self._opener.open(self._address + path, timeout=120) as answer:
            return bytes(answer.read())

    def post(self, path: str, values: dict[str, Any]) -> Any:
        request = urllib.request.Request(
            self._address + path, json.dumps(values).encode(), {"Content-Type": "application/json"}
        )
        with self._opener.open(request, timeout=120) as answer:
            return json.loads(answer.read())

    def upload(self, name: str, content: bytes) -> str:
        mark = secrets.token_hex(8)
        head = (
            f'--{mark}\r\nContent-Disposition: form-data; name="files"; filename="{name}"\r\n\r\n'
        )
        body = head.encode() + content + f"\r\n--{mark}--\r\n".encode()
        kind = {"Content-Type": f"multipart/form-data; boundary={mark}"}
        request = urllib.request.Request(self._address + "gradio_api/upload", body, kind)
        with self._opener.open(request, timeout=120) as answer:
            return str(json.loads(answer.read())[0])

    def make_events(self, source: Any, *, video: bool = False) -> str:
        """What the page says in the end."""
        scene = [] if video else ["procedural", 0.1]
        said = self.call(source, *scene, "texvent", "paper", "dvs128", 0)
        while "<progress" in said:
            time.sleep(0.5)
            said = self.call()
        return said

    def call(self, *values: Any) -> str:
        """The status after the first handler that takes so many values besides the tab."""
        handler = next(
            one["id"]
            for one in self._handlers
            if len(one["inputs"]) == 1 + len(values) and len(one["outputs"]) == SHOWN
        )
        call = {"data": ["tab", *values], "fn_index": handler, "session_hash": self._session}
        return str(self.post("gradio_api/run/predict", call)["data"][0])

    def open_scene(self, text: str) -> str:
        """The text in the prompt's field once a scene file was opened."""
        handler = next(one["id"] for one in self._handlers if one["targets"][0][1] == "upload")
        file = {"path": self.upload("ball.toml", text.encode()), "orig_name": "ball.toml",
                "meta": {"_type": "gradio.FileData"}}  # fmt: skip
        call = {"data": [file], "fn_index": handler, "session_hash": self._session}
        return str(self.post("gradio_api/run/predict", call)["data"][0])


def refused(act: Any, *values: Any) -> int:
    """The status with which a request is refused."""
    with pytest.raises(urllib.error.HTTPError) as caught:
        act(*values)
    with caught.value as answer:
        return int(answer.code)


def test_an_uploaded_page_is_never_shown_from_here(address: str) -> None:
    visitor = Visitor(address)
    page = visitor.upload("page.html", b"<script>alert(1)</script>")
    assert refused(visitor.get, f"gradio_api/file={page}") == 403
    image = visitor.upload(
        "image.svg", b"<svg onload='alert(1)' xmlns='http://www.w3.org/2000/svg'/>"
    )
    assert refused(visitor.get, f"gradio_api/file={image}") == 403


def test_a_scene_file_is_opened_and_made(address: str) -> None:
    visitor = Visitor(address)
    text = '[[objects]]\nnoun = "ball"\nmotions = [{ kind = "bounce" }]\n'
    assert visitor.open_scene(text) == text
    assert "1 ball, bounces" in visitor.make_events(text)


def test_a_foreign_host_name_is_refused(address: str) -> None:
    request = urllib.request.Request(address, headers={"Host": "evil.example"})
    assert refused(urllib.request.urlopen, request) == 421


def test_one_hostile_visitor_of_twenty_harms_none(address: str, temporary: Path) -> None:
    host, port = address.removeprefix("http://").rstrip("/").split(":")
    half_open = [socket.create_connection((host, int(port))) for _ in range(100)]
    for one in half_open:
        one.sendall(b"GET / HTTP/1.1\r\nHost: 127.0.0.1\r\nX-Slow: ")

    def visit(number: int) -> str:
        visitor = Visitor(address)
        return visitor.make_events("a ball bounces") if number < JOBS else "events on"

    def attack() -> list[str]:
        hostile = Visitor(address)
        statuses = [refused(hostile.upload, "large.mp4", bytes(2 * 2**20))]
        endless = http.client.HTTPConnection(host, int(port), timeout=60)
        with contextlib.closing(endless), contextlib.suppress(OSError):
            kind = {
                "Content-Type": "multipart/form-data; boundary=x",
                "Transfer-Encoding": "chunked",
            }
            head = b'--x\r\nContent-Disposition: form-data; name="files"; filename="large"\r\n\r\n'
            chunks = itertools.chain([head], itertools.repeat(b"y" * 2**16, 1000))
            endless.request("POST", "/gradio_api/upload", chunks, kind, encode_chunked=True)
            statuses.append(endless.getresponse().status)
        assert set(statuses) <= {413}
        bomb = io.BytesIO()
        with zipfile.ZipFile(bomb, "w", zipfile.ZIP_DEFLATED) as archive:
            archive.writestr("frames.npy", bytes(300_000_000))
        said = []
        for name, content in (("broken.mp4", b"no video" * 99), ("bomb.zip", bomb.getvalue())):
            path = hostile.upload(name, content)
            file = {"path": path, "meta": {"_type": "gradio.FileData"}}
            said.append(hostile.make_events(file, video=True))
        return said

    with ThreadPoolExecutor(VISITORS + 1) as pool:
        attacked = pool.submit(attack)
        said = list(pool.map(visit, range(VISITORS)))
        assert all("events on" in one for one in said), said
        assert all("did not work" in one for one in attacked.result()), attacked.result()
    # By now the connections without a request are ended.
    deadline = time.monotonic() + 30
    for one in half_open:
        one.settimeout(max(0.1, deadline - time.monotonic()))
        with contextlib.suppress(ConnectionError):
            assert one.recv(1) == b""
        one.close()
    assert not [path for path in temporary.rglob("*large*") if path.is_file()]
