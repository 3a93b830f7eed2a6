"""The local page, asked over HTTP as its script asks it, and as strangers would."""

import contextlib
import http.client
import json
import os
import select
import signal
import socket
import subprocess
import sys
import time
from pathlib import Path
from urllib.parse import urlencode, urlsplit

import pytest
from tests.cli.running import refused, run
from tests.web.opened import open_entry

import texvent
from texvent.cli.app import OF_THE_PAGE
from texvent.generation.subjects import scenes
from texvent.web import server as server_module
from texvent.web.job_page import Job, JobServer, flags_of, list_examples, list_generators, page_html
from texvent.web.server import CALL_BYTES, FILE_BYTES, MOST_CONNECTIONS
from texvent_scenes.models.nouns import NOUNS
from texvent_scenes.models.places import PLACES

CLIP = Path(__file__).parents[1] / "clips" / "bigbuckbunny_excerpt.mp4"
SCENE = {"generator": "procedural", "duration": "0.1", "sensor": "48x36", "seed": "3",
         "simulator": "esim"}  # fmt: skip


@pytest.fixture
def page():
    with JobServer(CLIP.parent) as server:
        yield server
    assert not server.folder.exists()


def ask(page, path="/", method="GET", body=None, **headers):
    """Status, headers and body of an answer; with the server's cookie, if no other is given."""
    connection = http.client.HTTPConnection(urlsplit(page.address).netloc, timeout=60)
    headers = {"cookie": f"{page.cookie}={page.token}", **headers}
    named = {name.replace("_", "-"): value for name, value in headers.items() if value is not None}
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


@pytest.mark.long
def test_a_prompt_gives_a_video_a_viewer_and_downloads(page, tmp_path):
    state, text = generate(page, "a wug and a red ball bounce", palette="paper-dark")
    options = {"duration": 0.1, "sensor": "48x36", "seed": 3, "simulator": "esim"}
    with pytest.warns(texvent.TexventWarning, match="wug|uncertain beside them: bounce"):
        whole = texvent.generate("a wug and a red ball bounce", **options)
    assert state == "done"
    assert f"\nevents   {len(whole):,} in " in text
    assert text.count("wug") == 1  # the stills and the run say it
    job = json.loads(ask(page, "/job")[2])
    assert job["name"] == "a-wug-and-a-red-ball-bounce"
    assert job["step"] == {"stage": "frames", "done": 3, "total": 3, "left_s": 0}
    assert ask(page, "/stills")[2].startswith(b"\x89PNG")
    status, headers, body = ask(page, "/video")
    assert (status, headers["Content-Type"], body[4:8]) == (200, "video/mp4", b"ftyp")
    status, headers, body = ask(page, "/page")
    assert status == 200
    assert headers["Content-Security-Policy"].startswith("sandbox allow-scripts;")
    assert b"</html>" in body
    (tmp_path / "got.h5").write_bytes(ask(page, "/events")[2])
    assert texvent.load(tmp_path / "got.h5").equals(whole)


@pytest.mark.long
def test_the_text_of_a_scene_file_is_a_scene(page):
    text = '[[objects]]\nnoun = "ball"\nmotions = [{ kind = "bounce" }]\n'
    assert generate(page, text)[0] == "done"
    assert generate(page, text.replace("ball", "bal"))[0] == "failed"


@pytest.mark.parametrize("video", ["", "clip.mp4"])
def test_every_field_of_the_form_reaches_its_command(video):
    both = ["simulator", "preset", "sensor", "seed", "palette"]
    of_prompts = ["generator", "duration", "frames", "fps"]
    texts = {name: f"{name}-1" for name in (*both, *of_prompts)} | {"video": video, "prompt": "a"}
    expected = both if video else both + of_prompts
    assert sorted(flags_of(texts)) == sorted(f"--{name}={name}-1" for name in expected)
    assert flags_of({"simulator": "", "video": video}) == []


def test_the_flags_of_every_generator_are_its_own(capsys):
    for name, one in list_generators().items():
        length = {one["length"]: str(one["default"])}
        flags = flags_of({"generator": name, "seed": "1", "palette": "paper-dark", **length})
        assert run("generate", *flags, "--print-config", "a ball") == 0, name
        assert f"{one['length']} = {one['default']}\n" in capsys.readouterr().out


def test_every_example_is_understood_and_has_a_picture(tmp_path):
    for one in list_examples():
        if "title" in one:
            (tmp_path / "scene.toml").write_text(one["text"])
            scenes().check_words(scenes().load_scene(tmp_path / "scene.toml"))
        else:
            assert scenes().read(one["text"]).not_understood == ()
        assert len(one["picture"]) > 300


def test_the_words_of_the_page_are_all_that_can_be_said(page):
    said = {
        name
        for words in json.loads(ask(page, "/words")[2]).values()
        for names in words
        for name in names
    }
    assert said >= {*NOUNS, *PLACES, "juggle", "dusk", "clockwise", "orbit"}


@pytest.mark.long
def test_a_video_is_named_by_its_path_and_keeps_its_size(page):
    assert generate(page, "", video=CLIP.name, sensor="")[0] == "done"
    assert texvent.load(page.job.folder / "events.h5").size == (320, 180)


@pytest.mark.parametrize(
    ("name", "kept"),
    [("a (1).mp4", "a-1-.mp4"), ("../../x.mp4", "x.mp4"), ("..", "-"), ("", "file"), (".a", "-a"),
     ("c:\\x\0.mp4", "c-x-.mp4"), ("/" + "n" * 300 + ".mp4", "n" * 56 + ".mp4")],
)  # fmt: skip
def test_a_file_that_is_sent_has_a_clean_name_and_may_be_used(page, name, kept):
    for content in (b"one", bytes(3_000_000)):
        place = f"/file?{urlencode({'name': name})}"
        status, _, answer = ask(page, place, "POST", content)
        path = Path(json.loads(answer)["path"])
        assert (status, path.parent, path.name) == (200, page.folder / "sent", kept)
        assert path.read_bytes() == content
    assert [*path.parent.iterdir()] == [path]
    assert ask(page, "/run", "POST", json.dumps({"video": str(path)}))[0] == 200


def test_files_that_are_too_large_or_break_off_are_not_kept(page):
    status, _, answer = ask(page, "/file?name=a", "POST", b"", content_length=str(FILE_BYTES + 1))
    assert (status, answer) == (413, b"the request is larger than 4,294,967,296 bytes")
    assert ask(page, "/file?name=a", "POST", transfer_encoding="chunked")[0] == 411
    place = urlsplit(page.address)
    with socket.create_connection((place.hostname, place.port), 60) as connection:
        head = f"POST /file?name=a HTTP/1.1\r\nHost: {place.netloc}\r\nContent-Length: 9\r\n"
        connection.sendall(f"{head}Cookie: {page.cookie}={page.token}\r\n\r\nabc".encode())
        connection.shutdown(socket.SHUT_WR)
        assert b"did not arrive whole; send it again" in connection.makefile("rb").read()
    assert not [*page.folder.rglob("sent/*")]


PICTURE = '[[objects]]\nnoun = "billboard"\npicture = { kind = "file", value = "/etc/a.png" }\n'


@pytest.mark.parametrize(
    "values",
    [{"video": "/etc/passwd"}, {"video": "../a.mp4"}, {"video": "link/a.mp4"}, {"prompt": PICTURE},
     {"prompt": "/etc/a.toml"}, {"prompt": "a poster of /etc/a.png"},
     {"prompt": "a poster of ../a.png"}, {"prompt": "a ball", "generator": "/etc/model"},
     {"prompt": "a ball", "generator": "~/model"}, {"prompt": "a ball", "generator": "~root"}],
)  # fmt: skip
def test_files_elsewhere_are_refused_with_what_to_do(tmp_path, values):
    (tmp_path / "in").mkdir()
    (tmp_path / "in" / "link").symlink_to("/etc")
    with JobServer(tmp_path / "in") as page:
        status, _, answer = ask(page, "/run", "POST", json.dumps(values))
        assert status == 400
        assert b"is outside of" in answer
        assert b"start texvent app --folder" in answer
        assert page.job is None


@pytest.mark.parametrize("word", OF_THE_PAGE)
def test_words_for_the_page_lead_to_its_command(word, capsys):
    assert "did you mean 'app'?" in refused(capsys, word)
    assert "is no folder" in refused(capsys, "app", "--folder", "nosuch")


@pytest.mark.parametrize(
    ("prompt", "options", "message"),
    [
        ("   ", {}, "PROMPT must not be empty"),
        ("a ball", {"simulator": "nosuch"}, "unknown simulator 'nosuch'"),
    ],
)
def test_mistakes_are_one_line(page, prompt, options, message):
    state, text = generate(page, prompt, **options)
    assert state == "failed"
    assert message in text


@pytest.mark.long
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


@pytest.mark.parametrize("method", ["GET", "POST", "HEAD", "OPTIONS", "PUT"])
def test_nobody_without_the_token_learns_or_does_anything(page, method):
    paths = [*page.gets, *page.posts, *page.uploads, "/nosuch"]
    with JobServer() as other:
        cookies = [None, "", f"{page.cookie}=", f"{page.cookie}={page.token[:-1]}", "=;;\xff=\xe9"]
        cookies += [f"{page.cookie}={other.token}", f"{other.cookie}={page.token}"]
        for cookie in cookies:
            for path in [
                *paths,
                f"/?token={other.token}",
                "/?token=%ff%00",
                f"/job?token={page.token}",
            ]:
                status, headers, body = ask(page, path, method, "{}", cookie=cookie)
                assert status == (403 if method in ("GET", "POST") else 501)
                assert "Set-Cookie" not in headers
                assert page.token.encode() not in body
                if status == 403:
                    assert b"open the address that texvent printed when it started" in body
    assert page.job is None


def test_the_printed_address_leaves_a_cookie_and_leads_on(page):
    status, headers, body = ask(page, "/?" + urlsplit(page.entry).query, cookie=None)
    assert (status, headers["Location"], body) == (303, "/", b"")
    cookie, *limits = headers["Set-Cookie"].split("; ")
    assert limits == ["Path=/", "HttpOnly", "SameSite=Strict"]
    assert headers["Referrer-Policy"] == "no-referrer"
    foreign = f"a=b; {page.cookie}=old; {cookie}"  # of other servers of this machine
    for _ in range(2):
        assert b"Make events" in ask(page, cookie=foreign)[2]


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
    entry = "/?" + urlsplit(page.entry).query
    link = {"sec_fetch_site": "cross-site", "sec_fetch_mode": "navigate"}
    status, headers, _ = ask(page, entry, cookie=None, **link)
    assert (status, headers["Refresh"]) == (200, "0; url=/")  # a redirection would lose the cookie
    assert ask(page, entry, cookie=None, **{**link, "sec_fetch_mode": "no-cors"})[0] == 403
    assert ask(page, **link)[0] == 200
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


@pytest.mark.long
@pytest.mark.parametrize("prompt", ["a\0b\ud800", "--help"])
def test_odd_prompts_are_prompts(page, prompt):
    assert "usage:" not in generate(page, prompt)[1]


@pytest.mark.parametrize("body", [b'{"prompt": 1e999}', b"\xff", b'{"video": {"a": []}}', b"null"])
def test_odd_values_get_an_answer(page, body):
    assert ask(page, "/run", "POST", body)[0] in (200, 400)
    assert ask(page, "/stop", "POST", "")[0] == 200


def test_connections_that_send_nothing_or_slowly_do_not_keep_the_page_from_its_user(
    page, monkeypatch
):
    monkeypatch.setattr(server_module, "READ_S", 0.3)
    place = urlsplit(page.address)
    with contextlib.ExitStack() as stack:
        silent = [
            stack.enter_context(socket.create_connection((place.hostname, place.port), 60))
            for _ in range(3 * MOST_CONNECTIONS)
        ]
        assert ask(page, "/job")[0] == 200
        for _ in range(500):  # each byte comes soon, the whole never
            if select.select(silent[-1:], [], [], 0.02)[0]:
                break
            silent[-1].send(b"A")
        else:
            pytest.fail("the server waits for ever")
        for one in silent:
            with contextlib.suppress(ConnectionError):
                assert one.recv(1) == b""


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
    assert b"Make events" in open_entry(address)("").read()
    (folder,) = tmp_path.iterdir()
    assert folder.stat().st_mode & 0o077 == 0
    server.send_signal(signal.SIGTERM)
    assert server.wait(timeout=60) == 0
    server.stdout.close()
    assert not list(tmp_path.iterdir())


def test_a_killed_server_takes_its_job_along_and_the_next_removes_its_files(tmp_path, spawn):
    words = [sys.executable, "-m", "texvent.cli.app", "app", "--no-browser"]
    environment = {**os.environ, "TMPDIR": str(tmp_path)}
    killed = spawn(words, stdout=-1, text=True, env=environment)
    address = killed.stdout.readline().strip()
    values = {**SCENE, "duration": "100", "prompt": "a secret dog runs"}
    open_entry(address)("run", json.dumps(values).encode())
    (job,) = children(killed.pid)
    commands = b" ".join(Path(f"/proc/{one}/cmdline").read_bytes() for one in (job, killed.pid))
    assert b"secret" not in commands
    assert urlsplit(address).query.removeprefix("token=").encode() not in commands
    killed.kill()
    killed.wait()
    while is_alive(job):
        time.sleep(0.05)
    spawn(words, stdout=-1, text=True, env=environment).stdout.readline()
    assert len(list(tmp_path.iterdir())) == 1


def children(process):
    """Processes that a process has started."""
    threads = Path(f"/proc/{process}/task").glob("*/children")
    return [int(one) for thread in threads for one in thread.read_text().split()]


def is_alive(process):
    try:
        return b") Z" not in Path(f"/proc/{process}/stat").read_bytes()
    except OSError:
        return False
