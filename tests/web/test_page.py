"""The local page, asked over HTTP as its script asks it, and as an attacker would."""

from __future__ import annotations

import contextlib
import http.client
import json
import os
import signal
import subprocess
import sys
import time
from pathlib import Path
from urllib.parse import urlsplit

import pytest

import texvent
from texvent.web.job_page import Job, JobServer, page_html
from texvent.web.server import CALL_BYTES

CLIP = Path(__file__).parents[1] / "clips" / "bigbuckbunny_excerpt.mp4"
SCENE = {"generator": "procedural", "duration": "0.1", "sensor": "48x36", "seed": "3"}


@pytest.fixture
def page():
    with JobServer() as server:
        yield server
    assert not server.folder.exists()


def ask(page, path="/", method="GET", body=None, **headers):
    """Status, headers and body of an answer."""
    connection = http.client.HTTPConnection(urlsplit(page.address).netloc, timeout=60)
    named = {name.replace("_", "-"): value for name, value in headers.items()}
    with contextlib.suppress(BrokenPipeError):  # refused before all of the body was sent
        connection.request(method, path, body=body, headers=named)
    answer = connection.getresponse()
    result = answer.status, dict(answer.getheaders()), answer.read()
    connection.close()
    return result


def wait(page):
    """State and text of the job once it is over."""
    while True:
        job = json.loads(ask(page, "/job")[2])
        if job["state"] != "running":
            return job["state"], job["text"]
        time.sleep(0.1)


def generate(page, prompt, **options):
    assert ask(page, "/run", "POST", json.dumps({**SCENE, **options, "prompt": prompt}))[0] == 200
    return wait(page)


def test_a_prompt_gives_a_video_a_viewer_and_downloads(page, tmp_path):
    state, text = generate(page, "a wug and a red ball bounce")
    options = {"duration": 0.1, "sensor": "48x36", "seed": 3}
    with pytest.warns(texvent.TexventWarning, match="wug"):
        whole = texvent.generate("a wug and a red ball bounce", **options)
    assert state == "done"
    assert f"\nevents   {len(whole):,} in " in text
    assert "wug" in text
    status, headers, body = ask(page, "/video")
    assert (status, headers["Content-Type"], body[4:8]) == (200, "video/mp4", b"ftyp")
    status, headers, body = ask(page, "/page")
    assert status == 200
    assert headers["Content-Security-Policy"].startswith("sandbox allow-scripts;")
    assert b"</html>" in body
    (tmp_path / "got.h5").write_bytes(ask(page, "/events")[2])
    assert texvent.load(tmp_path / "got.h5").equals(whole)


def test_the_text_of_a_scene_file_is_a_scene(page):
    text = '[[objects]]\nnoun = "ball"\nmotions = [{ kind = "bounce" }]\n'
    assert generate(page, text)[0] == "done"
    assert generate(page, text.replace("ball", "bal"))[0] == "failed"


def test_a_video_is_named_by_its_path_and_keeps_its_size(page):
    assert generate(page, "", video=str(CLIP), sensor="")[0] == "done"
    assert texvent.load(page.job.folder / "events.h5").size == (320, 180)


@pytest.mark.parametrize(
    ("prompt", "options", "message"),
    [
        ("   ", {}, "PROMPT must not be empty"),
        ("a ball", {"seed": "-1"}, "seed is -1"),
        ("a ball", {"simulator": "nosuch"}, "unknown simulator 'nosuch'"),
    ],
)
def test_mistakes_are_one_line(page, prompt, options, message):
    state, text = generate(page, prompt, **options)
    assert state == "failed"
    assert message in text


def test_stop_ends_a_job_and_a_new_job_replaces_the_one_before(page):
    values = {**SCENE, "duration": "100", "sensor": "346x260", "prompt": "a dog runs"}
    assert ask(page, "/run", "POST", json.dumps(values))[0] == 200
    first = page.job
    assert generate(page, "a ball bounces")[0] == "done"
    assert ask(page, "/run", "POST", json.dumps(values))[0] == 200
    assert ask(page, "/stop", "POST", "")[0] == 200
    assert wait(page)[0] == "stopped"
    assert not first.folder.exists()


@pytest.mark.parametrize("host", ["evil.example", "127.0.0.1.evil.example", "192.0.2.7", ""])
def test_other_host_names_are_refused_so_that_no_dns_answer_opens_the_page(page, host):
    assert ask(page, host=host)[0] == 421
    assert ask(page, "/run", "POST", "{}", host=host)[0] == 421


def test_localhost_is_a_name_of_the_page(page):
    port = urlsplit(page.address).port
    assert ask(page, host=f"localhost:{port}")[0] == 200
    assert ask(page, "/stop", "POST", "", origin=f"http://127.0.0.1:{port}")[0] == 200


@pytest.mark.parametrize(
    "headers",
    [
        {"origin": "http://evil.example"},
        {"origin": "null"},
        {"origin": "http://127.0.0.1:1"},
        {"sec_fetch_site": "cross-site", "sec_fetch_mode": "no-cors"},
        {"sec_fetch_site": "same-site", "sec_fetch_mode": "navigate"},
    ],
)
def test_other_pages_cannot_start_a_job(page, headers):
    assert ask(page, "/run", "POST", json.dumps({"prompt": "a ball"}), **headers)[0] == 403
    assert page.job is None


def test_a_link_from_another_page_opens_the_page(page):
    assert ask(page, sec_fetch_site="cross-site", sec_fetch_mode="navigate")[0] == 200
    assert ask(page, "/job", sec_fetch_site="cross-site", sec_fetch_mode="no-cors")[0] == 403
    assert ask(page, "/events", sec_fetch_site="cross-site", sec_fetch_mode="navigate")[0] == 403


def test_no_other_file_is_served(page):
    (page.folder / "job-1").mkdir()
    (page.folder / "job-1" / "events.h5").write_bytes(b"x")
    page.job = Job(page.folder / "job-1", "generate", [], " ")  # refused
    for path in ("/../etc/passwd", "/..%2f..%2fetc/passwd", "/video/../../x", "/job-1/events.h5"):
        assert ask(page, path)[0] == 404


def test_bodies_are_bounded_before_they_are_read(page):
    assert ask(page, "/run", "POST", b"", content_length=str(CALL_BYTES + 1))[0] == 413
    assert ask(page, "/run", "POST", transfer_encoding="chunked")[0] == 411
    assert ask(page, "/run", "POST", b"[]")[0] == 400
    assert ask(page, "/run", "POST", b"[" * 60_000)[0] == 400
    assert not list(page.folder.iterdir())


def test_every_answer_forbids_foreign_content(page):
    for path in ("/", "/job", "/nosuch"):
        headers = ask(page, path)[1]
        assert "default-src" in headers["Content-Security-Policy"]
        assert headers["X-Content-Type-Options"] == "nosniff"
        assert headers["Cross-Origin-Resource-Policy"] == "same-origin"
    assert "http://" not in page_html()
    assert "https://" not in page_html()


def test_the_command_serves_the_page_and_leaves_nothing(tmp_path):
    words = [sys.executable, "-m", "texvent.cli.app", "app", "--no-browser"]
    environment = {**os.environ, "TMPDIR": str(tmp_path)}
    server = subprocess.Popen(words, stdout=subprocess.PIPE, text=True, env=environment)
    address = server.stdout.readline().strip()
    connection = http.client.HTTPConnection(urlsplit(address).netloc, timeout=60)
    connection.request("GET", "/")
    assert b"Make events" in connection.getresponse().read()
    connection.close()
    assert list(tmp_path.glob("texvent-app-*"))
    server.send_signal(signal.SIGTERM)
    assert server.wait(timeout=60) == 0
    server.stdout.close()
    assert not list(tmp_path.glob("texvent-app-*"))
