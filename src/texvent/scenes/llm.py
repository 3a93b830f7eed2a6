"""Scenes written by a language model behind an OpenAI-compatible endpoint, without inventions.

A chat completion is constrained to a JSON Schema; what the prompt does not say is left out.
"""

from __future__ import annotations

import dataclasses
import http.client
import json
import os
import re
import urllib.error
import urllib.request
from collections.abc import Iterator, Mapping
from dataclasses import dataclass
from typing import Any, Literal, get_args, get_origin

from texvent.errors import ConfigError, InputError, TexventError, one_line, shown
from texvent.options.fields import option_help
from texvent.scenes.read.lexicon import Sense, lexicon_of
from texvent.scenes.report import PromptReport
from texvent.scenes.spec import scene as spec
from texvent.scenes.spec.data import (
    field_types,
    inner_type,
    plain_type,
    required_fields,
    scene_from_data,
)

KEY_VARIABLE = "TEXVENT_CHAT_KEY"
"""Environment variable with the server's key, if it wants one; never stored."""
TIMEOUT_S = 300.0
MOST_TOKENS = 2000


@dataclass(frozen=True, kw_only=True)
class Endpoint:
    """A server, and which of its models answers."""

    url: str
    """Address up to and with the version, such as http://localhost:8080/v1."""
    model: str = "default"
    """Name of the model; servers of one model take any."""
    timeout_s: float = TIMEOUT_S
    """Longest wait for an answer, s."""

    def __post_init__(self) -> None:
        if not self.url.startswith(("http://", "https://")):
            raise ConfigError(
                f"llm_url is {shown(self.url)}; give an address such as http://localhost:8080/v1"
            )


def ask(endpoint: Endpoint, instruction: str, prompt: str, schema: Mapping[str, Any]) -> Any:
    """The values of an answer.

    Raises:
        TexventError: no server, no answer in time, or an answer that is no JSON.
    """
    question = {
        "model": endpoint.model,
        "messages": [
            {"role": "system", "content": instruction},
            {"role": "user", "content": prompt},
        ],
        "temperature": 0,
        "seed": 0,
        "max_tokens": MOST_TOKENS,
        "response_format": {
            "type": "json_schema",
            "json_schema": {"name": "scene", "strict": True, "schema": schema},
        },
    }
    reply = _post(endpoint, question)
    try:
        choice = json.loads(reply)["choices"][0]
        text, reason = str(choice["message"]["content"]), choice.get("finish_reason")
    except (ValueError, LookupError, TypeError, AttributeError) as error:
        raise TexventError(
            f"the model server {endpoint.url} does not speak the OpenAI chat protocol: "
            f"{shown(reply[:200])}"
        ) from error
    try:
        return json.loads(text)
    except ValueError as error:
        cut = f", cut off at {MOST_TOKENS} tokens" if reason == "length" else ""
        raise TexventError(
            f"the answer of {endpoint.url} is no JSON{cut}: {shown(text)}; its server must support "
            "response_format json_schema"
        ) from error


def _post(endpoint: Endpoint, question: Mapping[str, Any]) -> str:
    """The text of the server's reply."""
    address, key = f"{endpoint.url.rstrip('/')}/chat/completions", os.environ.get(KEY_VARIABLE)
    headers = {"Content-Type": "application/json"}
    if key:
        headers["Authorization"] = f"Bearer {key}"
    request = urllib.request.Request(address, json.dumps(question).encode(), headers)
    try:
        with urllib.request.urlopen(request, timeout=endpoint.timeout_s) as reply:
            return str(reply.read().decode("utf-8", errors="replace"))
    except urllib.error.HTTPError as error:
        hint = f"; set {KEY_VARIABLE} to its key" if error.code in (401, 403) else ""
        with error:
            said = " ".join(error.read(400).decode("utf-8", errors="replace").split())
        raise TexventError(
            f"the model server {address} answers {error.code}: {said}{hint}"
        ) from error
    except TimeoutError as error:
        raise TexventError(
            f"the model server {address} gave no answer in {endpoint.timeout_s:g} s; take a "
            "smaller model or a shorter prompt"
        ) from error
    except (OSError, http.client.HTTPException, ValueError) as error:
        raise TexventError(
            f"the model server {address} cannot be reached ({one_line(error)}); check llm_url"
        ) from error


INSTRUCTION = """You turn a description of a video into a scene, as JSON.
Say only what the description says; null and empty lists stand for what it leaves open.
One object for each kind of thing, with its count. Colours and motions in the description's words.
A relation names the noun of another object of the scene.
Example: "two white dogs run right past a tree in the park" gives
{"place":{"name":"park","weather":null},"light":{"kind":null},"camera":{"view":null,"moves":[]},
"objects":[{"noun":"dog","count":2,"colour":"white","material":null,
"motions":[{"kind":"run","direction":"right"}],"relations":[{"to":["tree"],"kind":"past"}]},
{"noun":"tree","count":1,"colour":null,"material":null,"motions":[],"relations":[]}],
"effects":[]}"""
FIELDS: dict[type, dict[str, str]] = {
    spec.Scene: dict.fromkeys(("place", "light", "camera", "objects", "effects"), ""),
    spec.SceneObject: {"noun": "noun", "count": "count", "colour": "colour",
                       "material": "material", "motions": "", "relations": ""},
    spec.Motion: {"kind": "motion", "direction": "direction"},
    spec.Relation: {"to": "object", "kind": "relation"},
    spec.Effect: {"kind": "effect", "source": "object"},
    spec.Camera: {"view": "view", "moves": ""},
    spec.CameraMove: {"kind": "move", "direction": "direction"},
    spec.Light: {"kind": "light"},
    spec.Place: {"name": "place", "weather": "weather"},
}  # fmt: skip
"""Class of `spec.scene` → its fields that a model fills, each with the kind of its words. An object
is called by its noun."""
MOST_ITEMS = {"objects": 8, "motions": 2, "relations": 2, "to": 3, "moves": 2, "effects": 2}
LONGEST_WORD = 40
"""Characters of a free text."""
LONGEST_PHRASE = 4
MOST_COUNT = 20
_PLAIN = ("articles", "pronouns", "conjunctions", "small")
"""Kinds of words without a meaning of their own."""


def write_scene(prompt: str, endpoint: Endpoint) -> tuple[spec.Scene, PromptReport]:
    """The scene that a model writes, and what became of the prompt's words.

    Notes of the report name what the model added and what was left out for it.

    Raises:
        InputError: the prompt is empty, or nothing of the answer is named in it.
        TexventError: the server does not answer as it should.
    """
    if not prompt.strip():
        raise InputError("the prompt is empty; say what to show")
    answer = ask(endpoint, INSTRUCTION, prompt, model_schema())
    if not isinstance(answer, Mapping):
        raise TexventError(f"the answer of {endpoint.url} is no scene: {shown(answer)}")
    return ground(prompt, answer)


def model_schema(hint: Any = spec.Scene, name: str = "") -> dict[str, Any]:
    """The schema of an answer, or of a field of that type and name.

    Every field is required, so that none is forgotten, and null says that the prompt leaves it
    open. Nouns, places, colours and motions are free texts: a closed list would force a word that
    it lacks to the one that begins alike.
    """
    is_open = inner_type(hint) is not hint
    plain: Any = plain_type(hint)
    if plain in FIELDS:
        types, texts, names = field_types(plain), option_help(plain), FIELDS[plain]
        return {
            "type": "object",
            "properties": {
                one: {**model_schema(types[one], one), "description": texts[one]} for one in names
            },
            "required": list(names),
            "additionalProperties": False,
        }
    if get_origin(plain) is Literal:
        return {"enum": [*get_args(plain), *([None] if is_open else [])]}
    if get_origin(plain) is tuple:
        items = model_schema(get_args(plain)[0])
        return {"type": "array", "items": items, "maxItems": MOST_ITEMS[name]}
    if plain is int:
        return {"type": "integer", "minimum": 1, "maximum": MOST_COUNT}
    return {"type": ["string", "null"] if is_open else "string", "maxLength": LONGEST_WORD}


def ground(prompt: str, answer: Mapping[str, Any]) -> tuple[spec.Scene, PromptReport]:
    """The scene of an answer without inventions; errors as `write_scene`."""
    prompt = " ".join(prompt.split())
    check = _Grounding(prompt, answer)
    data = check.table(spec.Scene, answer) or {}
    objects = {one["noun"]: one for one in reversed(data["objects"])}
    data["objects"] = list(reversed(objects.values()))
    for noun, one in objects.items():
        one["relations"] = [each for each in one["relations"] if noun not in each["to"]]
    if not check.used:
        raise InputError(f"nothing of {shown(prompt)} is in the scene that the model wrote")
    added = ", ".join(dict.fromkeys(check.invented))
    notes = (f"words do not say, so it is left out: {added}",) if added else ()
    shows = {word for key in check.used for word in check.said[key]}
    words = [one for one in dict.fromkeys(_split(prompt)) if not _is_plain(one)]
    report = PromptReport(
        shown=tuple(one for one in words if one in shows),
        not_understood=tuple(one for one in words if one not in shows),
        notes=notes,
    )
    return scene_from_data({"prompt": prompt, **data}), report


class _Grounding:
    """What the words of a prompt stand for, and what an answer uses of it."""

    def __init__(self, prompt: str, answer: Mapping[str, Any]) -> None:
        self.said: dict[tuple[str, str], frozenset[str]] = {}
        """Kind and meaning → the words of the phrases that have it."""
        self.used: set[tuple[str, str]] = set()
        self.invented: list[str] = []
        words = _split(prompt)
        for length in range(1, LONGEST_PHRASE + 1):
            for first in range(len(words) - length + 1):
                phrase = words[first : first + length]
                for key in list_meanings(" ".join(phrase)):
                    self.said[key] = self.said.get(key, frozenset()) | frozenset(phrase)
        nouns = (self._meaning(one.get("noun"), "noun") for one in _tables(answer, "objects"))
        self._objects = {noun for noun in nouns if noun}

    def table(self, owner: Any, answer: Mapping[str, Any]) -> dict[str, Any] | None:
        """Fields of a class that the prompt says; None without one that must be there."""
        types, found = field_types(owner), dict[str, Any]()
        for name, kind in FIELDS[owner].items():
            plain, value = plain_type(types[name]), answer.get(name)
            if kind == "count":
                found[name] = self._count(str(found["noun"]), value)
            elif kind:
                found[name] = self._keep(value, kind, name)
            elif dataclasses.is_dataclass(plain):
                found[name] = self.table(plain, value if isinstance(value, Mapping) else {})
            else:
                item = get_args(plain)[0]
                items = (self.table(item, one) for one in _tables(answer, name))
                found[name] = [one for one in items if one is not None]
            if name in required_fields(owner) and not found[name]:
                return None
        return found

    def _keep(self, value: Any, kind: str, name: str) -> Any:
        """What a word of the answer stands for, if the prompt says it, or a list of such words."""
        if name in MOST_ITEMS:
            items = value[: MOST_ITEMS[name]] if isinstance(value, list) else ()
            return [one for each in items if (one := self._keep(each, kind, ""))]
        if kind == "object":
            noun = resolve(str(value), "noun")
            return noun if noun in self._objects else None
        meaning = self._meaning(value, kind)
        if meaning is not None:
            self.used.add((kind, meaning))
        elif isinstance(value, str) and value.strip():
            self.invented.append(f"{kind} {shown(value)}")
        return meaning

    def _meaning(self, value: Any, kind: str) -> str | None:
        """What the longest end of a text stands for that the prompt says too: "big automobile"."""
        words = value.split() if isinstance(value, str) else []
        ends = (resolve(" ".join(words[first:]), kind) for first in range(len(words)))
        return next((one for one in ends if one and (kind, one) in self.said), None)

    def _count(self, noun: str, value: Any) -> int:
        """Copies of an object: several only where its word is a plural or a number is said."""
        if not isinstance(value, int) or isinstance(value, bool) or not 1 < value <= MOST_COUNT:
            return 1
        number = ("count", str(float(value)))
        is_plural = any(one.endswith("s") and one != noun for one in self.said["noun", noun])
        self.used |= {number} & self.said.keys()
        if number not in self.said and not is_plural:
            self.invented.append(f"count {value}")
            return 1
        return value


def resolve(word: str, kind: str) -> str | None:
    """What a word or phrase stands for; None where scenes have nothing for it.

    Args:
        word: as a model or a prompt has it.
        kind: as of `FIELDS`.

    Example:
        >>> resolve("Automobiles", "noun"), resolve("driving", "motion"), resolve("wug", "noun")
        ('car', 'drive', None)
    """
    return next((meaning for one, meaning in list_meanings(word) if one == kind), None)


def list_meanings(word: str) -> Iterator[tuple[str, str]]:
    """Kinds of a word or phrase, and what it stands for as each."""
    if word.isdigit():
        yield "count", str(float(word))
    words = word.casefold().replace("_", " ").replace("-", " ").split()
    phrase = tuple(one for one in words if one not in ("a", "an", "the"))
    senses = lexicon_of(None).get(phrase, ())
    for sense in sorted(senses, key=lambda one: one.kind == "verb" and one.value.who == "hand"):
        yield from ((kind, str(one)) for kind, one in _meanings(sense) if one)


def _meanings(sense: Sense) -> Iterator[tuple[str, object]]:
    value = sense.value
    match sense.kind:
        case "noun":
            yield "noun", value.noun
        case "place" | "effect" | "relation":
            yield sense.kind, value
        case "pose":
            yield "motion", value[1]
        case "field" | "adverb":
            yield value
        case "verb":
            yield {"camera": "move", "source": "effect"}.get(value.who, "motion"), value.kind
            yield from (("direction", value.direction), ("relation", value.relation))
        case "scene":  # such as ("light", "kind", "dusk"), ("place", "weather", "fog")
            part, field, each = value
            yield part if field in ("kind", "name") else field, each


def _is_plain(word: str) -> bool:
    return any(sense.kind in _PLAIN for sense in lexicon_of(None).get((word,), ()))


def _split(text: str) -> list[str]:
    return re.findall(r"[a-z0-9]+(?:[-'][a-z0-9]+)*", text.casefold())


def _tables(answer: Mapping[str, Any], name: str) -> Iterator[Mapping[str, Any]]:
    items = answer.get(name)
    items = items[: MOST_ITEMS[name]] if isinstance(items, list) else ()
    return (one for one in items if isinstance(one, Mapping))
