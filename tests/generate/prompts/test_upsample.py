"""Prompts made detailed by a chat server; the server here speaks the protocol and nothing else."""

import json
import threading
from http.server import BaseHTTPRequestHandler, HTTPServer

import pytest

import texvent
from texvent.cli.app import main
from texvent.errors import ConfigError, InputError, TexventError
from texvent.generate.prompts.upsample import upsample_prompt
from texvent.generate.prompts.upsample_config import UpsampleConfig

LONG = "A red car drives left past two trees at dusk."


class Chat(BaseHTTPRequestHandler):
    """Answers what the test put into `server.answer`, and remembers what it was asked."""

    def do_POST(self):
        asked = json.loads(self.rfile.read(int(self.headers["Content-Length"])))
        self.server.asked.append((self.path, asked, self.headers.get("Authorization")))
        code, body = self.server.answer
        payload = body.encode()
        self.send_response(code)
        self.send_header("Content-Length", str(len(payload)))
        self.end_headers()
        self.wfile.write(payload)

    def log_message(self, *_):
        pass


def says(text: str) -> str:
    return json.dumps({"choices": [{"message": {"role": "assistant", "content": text}}]})


@pytest.fixture
def server(monkeypatch, tmp_path):
    monkeypatch.setenv("TEXVENT_CACHE", str(tmp_path / "cache"))
    monkeypatch.setenv("NO_PROXY", "127.0.0.1")
    monkeypatch.delenv("TEXVENT_CHAT_KEY", raising=False)
    with HTTPServer(("127.0.0.1", 0), Chat) as running:
        running.asked, running.answer = [], (200, says(f"  {LONG}\n"))
        thread = threading.Thread(target=running.serve_forever, kwargs={"poll_interval": 0.01})
        thread.start()
        running.address = f"http://127.0.0.1:{running.server_port}/v1"
        yield running
        running.shutdown()
        thread.join()


def test_the_answer_replaces_the_prompt_and_is_kept(server, monkeypatch):
    monkeypatch.setenv("TEXVENT_CHAT_KEY", "secret")
    config = UpsampleConfig(upsample=server.address, upsample_model="small-chat")
    assert upsample_prompt("red car", config) == LONG
    assert upsample_prompt("red car", config) == LONG
    assert len(server.asked) == 1, "the second answer comes from the cache"
    path, question, key = server.asked[0]
    assert path == "/v1/chat/completions"
    assert question["model"] == "small-chat"
    assert question["temperature"] == 0
    assert question["messages"][-1] == {"role": "user", "content": "red car"}
    assert key == "Bearer secret"
    assert upsample_prompt("blue car", config) == LONG
    assert len(server.asked) == 2


def test_without_a_model_the_prompt_stays_as_it_is():
    assert upsample_prompt("red car", UpsampleConfig()) == "red car"


def test_events_know_both_prompts(server, tmp_path, monkeypatch):
    monkeypatch.chdir(tmp_path)
    words = ["--duration", "0.1", "--samples", "1", "--sensor", "48x36", "--events-only"]
    assert main(["generate", "red car", "--upsample", server.address, *words, "-o", "a.h5"]) == 0
    events = texvent.load("a.h5")
    assert events.metadata["prompt"] == "red car"
    assert events.metadata["source"]["prompt"] == LONG
    (tmp_path / "p.txt").write_text("red car\n")
    assert main(["batch", "p.txt", "--upsample", server.address, *words]) == 0
    (made,) = (tmp_path / "p").glob("red-car-*.h5")
    batch = texvent.load(made)
    assert batch.metadata["source"]["prompt"] == LONG


def test_a_server_or_model_that_is_not_there_is_named(server, tmp_path):
    with pytest.raises(TexventError, match="cannot be reached"):
        upsample_prompt("red car", UpsampleConfig(upsample="http://127.0.0.1:1/v1"))
    with pytest.raises(InputError, match="there is no chat model in"):
        upsample_prompt("red car", UpsampleConfig(upsample=str(tmp_path)))
    with pytest.raises(ConfigError, match="upsample_model is set"):
        UpsampleConfig(upsample_model="x")
