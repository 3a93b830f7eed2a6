"""Scenes written by a language model behind an OpenAI-compatible endpoint, without inventions.

A chat completion is constrained to a JSON Schema; what the prompt does not say is left out.
"""

from __future__ import annotations

import dataclasses
import http.client
import json
import os
import urllib.error
import urllib.request
from collections.abc import Iterable, Mapping, Sequence
from typing import Any, Literal, get_args, get_origin

from texvent.errors import ConfigError, InputError, TexventError, one_line, shown
from texvent.prompt_report import PromptReport
from texvent_scenes.meanings import list_meanings, meanings_of
from texvent_scenes.models.nouns import NOUNS
from texvent_scenes.read.parsing.lexicon import lexicon_of
from texvent_scenes.read.parsing.tokens import Token, split_prompt
from texvent_scenes.sentence_defaults import settle_words
from texvent_scenes.spec import scene as spec
from texvent_scenes.spec.data import scene_from_data
from texvent_scenes.spec.tables import field_types, inner_type, plain_type, required_fields

KEY_VARIABLE = "TEXVENT_CHAT_KEY"
"""Environment variable with the server's key, if it wants one; never stored."""
TIMEOUT_S = 300.0
MOST_TOKENS = 2000


def ask(url: str, model: str, prompt: str, timeout_s: float = TIMEOUT_S) -> Any:
    """The values of the answer of a model, `url` up to and with the version.

    Raises:
        ConfigError: the address is none.
        TexventError: no server, no answer in time, or an answer that is no JSON.
    """
    if not url.startswith(("http://", "https://")):
        raise ConfigError(
            f"llm_url is {shown(url)}; give an address such as http://localhost:8080/v1"
        )
    form = {"name": "scene", "strict": True, "schema": model_schema()}
    question = {
        "model": model,
        "messages": [
            {"role": "system", "content": INSTRUCTION},
            {"role": "user", "content": prompt},
        ],
        "temperature": 0,
        "seed": 0,
        "max_tokens": MOST_TOKENS,
        "response_format": {"type": "json_schema", "json_schema": form},
    }
    key, headers = os.environ.get(KEY_VARIABLE), {"Content-Type": "application/json"}
    headers |= {"Authorization": f"Bearer {key}"} if key else {}
    address = f"{url.rstrip('/')}/chat/completions"
    request = urllib.request.Request(address, json.dumps(question).encode(), headers)
    try:
        with urllib.request.urlopen(request, timeout=timeout_s) as stream:
            reply = stream.read().decode("utf-8", errors="replace")
    except (OSError, http.client.HTTPException, ValueError) as error:
        if isinstance(error, urllib.error.HTTPError):
            error.close()
        raise TexventError(
            f"the model server {url} gave no answer ({one_line(error)}); check llm_url, and "
            f"{KEY_VARIABLE} if it wants a key"
        ) from error
    try:
        return json.loads(json.loads(reply)["choices"][0]["message"]["content"])
    except (ValueError, LookupError, TypeError) as error:
        raise TexventError(
            f"the answer of {url} is no JSON: {shown(reply[:200])}; its server must speak the "
            "OpenAI chat protocol and support response_format json_schema"
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
MOST_COUNT = 20


def write_scene(
    prompt: str, url: str, model: str = "default", timeout_s: float = TIMEOUT_S
) -> tuple[spec.Scene, PromptReport]:
    """The scene that a model writes, and what became of the prompt's words.

    Notes of the report name what the model added and what was left out for it; servers of one model
    take any name of it.

    Raises:
        InputError: the prompt is empty, or nothing of the answer is named in it.
        TexventError: the server does not answer as it should.
    """
    if not prompt.strip():
        raise InputError("the prompt is empty; say what to show")
    answer = ask(url, model, prompt, timeout_s)
    if not isinstance(answer, Mapping):
        raise TexventError(f"the answer of {url} is no scene: {shown(answer)}")
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
        types, names = field_types(plain), list(FIELDS[plain])
        fields = {one: model_schema(types[one], one) for one in names}
        return {"type": "object", "properties": fields, "required": names,
                "additionalProperties": False}  # fmt: skip
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
    tokens = split_prompt(prompt, lexicon_of(None))
    check = _Grounding(tokens, answer)
    data = check.table(spec.Scene, answer) or {}
    objects = {one["noun"]: one for one in reversed(data["objects"])}
    data["objects"] = list(reversed(objects.values()))
    for noun, one in objects.items():
        one["relations"] = [each for each in one["relations"] if noun not in each["to"]]
    if not check.used:
        raise InputError(f"nothing of {shown(prompt)} is in the scene that the model wrote")
    added = ", ".join(dict.fromkeys(check.invented))
    words = {one.text: check.used.isdisjoint(meanings_of(one.senses)) for one in tokens
             if not (one.is_sign or one.is_grammar or one.has("relation", "small", "negations"))
             }  # fmt: skip
    report = PromptReport(
        shown=tuple(word for word, is_lost in words.items() if not is_lost),
        not_understood=tuple(word for word, is_lost in words.items() if is_lost),
        notes=(f"words do not say, so it is left out: {added}",) if added else (),
    )
    scene = scene_from_data({"prompt": prompt, **data})
    return settle_words(scene, report, NOUNS), report


class _Grounding:
    """Meanings of the words of a prompt, and those that an answer uses."""

    def __init__(self, tokens: Sequence[Token], answer: Mapping[str, Any]) -> None:
        self._said = {key: one for one in tokens for key in meanings_of(one.senses)}
        """Kind and meaning → the word or phrase that has it."""
        self.used: set[tuple[str, object]] = set()
        self.invented: list[str] = []
        self._objects = {self._meaning(one.get("noun"), "noun")
                         for one in _tables(answer, "objects")}  # fmt: skip

    def table(self, owner: Any, answer: Mapping[str, Any]) -> dict[str, Any] | None:
        """Fields of a class that the prompt says; None without one that must be there."""
        types, found = field_types(owner), dict[str, Any]()
        for name, kind in FIELDS[owner].items():
            plain, value = plain_type(types[name]), answer.get(name)
            if kind == "count":
                found[name] = self._count(str(found["noun"]), value)
            elif kind and name in MOST_ITEMS:
                items = value if isinstance(value, list) else ()
                found[name] = [one for each in items if (one := self._keep(each, kind))]
            elif kind:
                found[name] = self._keep(value, kind)
            elif dataclasses.is_dataclass(plain):
                found[name] = self.table(plain, value if isinstance(value, Mapping) else {})
            else:
                item = get_args(plain)[0]
                tables = (self.table(item, one) for one in _tables(answer, name))
                found[name] = [one for one in tables if one is not None]
            if name in required_fields(owner) and not found[name]:
                return None
        return found

    def _keep(self, value: Any, kind: str) -> str | None:
        """Meaning of a word of the answer, if the prompt says it."""
        meaning = self._meaning(value, "noun" if kind == "object" else kind)
        if kind == "object":
            return meaning if meaning in self._objects else None
        if meaning is not None:
            self.used.add((kind, meaning))
        elif isinstance(value, str) and value.strip():
            self.invented.append(f"{kind} {shown(value)}")
        return meaning

    def _meaning(self, value: Any, kind: str) -> str | None:
        """Meaning of the longest end of a text that the prompt says too: "big automobile"."""
        words = value.split() if isinstance(value, str) else []
        ends = (" ".join(words[first:]) for first in range(len(words)))
        keys = (key for end in ends for key in list_meanings(end))
        return next((str(key[1]) for key in keys if key[0] == kind and key in self._said), None)

    def _count(self, noun: str, value: Any) -> int:
        """Copies of an object: several only where its word is a plural or the number is said."""
        number = ("count", float(value) if isinstance(value, int) else 0.0)
        nouns = (one.value for one in self._said["noun", noun].all("noun"))
        is_plural = any(one.noun == noun and one.is_plural for one in nouns)
        self.used |= {number} & self._said.keys()
        return min(max(int(value or 1), 1), MOST_COUNT) if number in self._said or is_plural else 1


def _tables(answer: Mapping[str, Any], name: str) -> Iterable[Mapping[str, Any]]:
    items = answer.get(name)
    return (one for one in items if isinstance(one, Mapping)) if isinstance(items, list) else ()
