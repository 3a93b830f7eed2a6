"""A prompt → the scene that a language model writes, without what no word of the prompt names."""

from __future__ import annotations

import re
from collections.abc import Iterable, Iterator, Mapping
from dataclasses import dataclass, field
from typing import Any

from texvent.errors import InputError, TexventError, shown
from texvent.scenes.llm.endpoint import Endpoint, ask
from texvent.scenes.llm.schema import MOST_COUNT, MOST_ITEMS, model_schema
from texvent.scenes.llm.words import is_plain, list_meanings, resolve
from texvent.scenes.report import PromptReport
from texvent.scenes.spec.data import scene_from_data
from texvent.scenes.spec.scene import Scene

INSTRUCTION = """You turn a description of a video into a scene, as JSON.
Say only what the description says; null and empty lists stand for what it leaves open.
One object for each kind of thing, with its count. Colours and motions in the description's words.
A relation names the noun of another object of the scene.
Example: "two white dogs run right past a tree in the park" gives
{"place":{"name":"park","weather":null},"light":{"kind":null},"camera":{"view":null,"moves":[]},
"objects":[{"noun":"dog","count":2,"colour":"white","material":null,
"motions":[{"kind":"run","direction":"right"}],"relations":[{"kind":"past","to":["tree"]}]},
{"noun":"tree","count":1,"colour":null,"material":null,"motions":[],"relations":[]}],
"effects":[]}"""
LONGEST_PHRASE = 4


def write_scene(prompt: str, endpoint: Endpoint) -> tuple[Scene, PromptReport]:
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


def ground(prompt: str, answer: Mapping[str, Any]) -> tuple[Scene, PromptReport]:
    """The scene of an answer without inventions; errors as `write_scene`."""
    prompt = " ".join(prompt.split())
    check = _Check(_said(prompt))
    objects = _objects(check, _tables(answer.get("objects"), "objects"))
    camera, light, place = (_table(answer.get(name)) for name in ("camera", "light", "place"))
    moves = [_motion(check, one, "move") for one in _tables(camera.get("moves"), "moves")]
    effects = [
        {"kind": kind, **_source(one, objects)}
        for one in _tables(answer.get("effects"), "effects")
        if (kind := check.keep(one.get("kind"), "effect"))
    ]
    data = {
        "prompt": prompt,
        "objects": list(objects.values()),
        "effects": effects,
        "camera": {
            "view": check.keep(camera.get("view"), "view"),
            "moves": [one for one in moves if one],
        },
        "light": {"kind": check.keep(light.get("kind"), "light")},
        "place": {
            "name": check.keep(place.get("name"), "place"),
            "weather": check.keep(place.get("weather"), "weather"),
        },
    }
    if not check.used:
        raise InputError(f"nothing of {shown(prompt)} is in the scene that the model wrote")
    added = ", ".join(dict.fromkeys(check.invented))
    notes = (f"words do not say, so it is left out: {added}",) if added else ()
    shown_words, lost = check.account(prompt)
    report = PromptReport(shown=shown_words, not_understood=lost, notes=notes)
    return scene_from_data(data), report


@dataclass
class _Check:
    """What the words of a prompt stand for, and what an answer uses of it."""

    said: Mapping[tuple[str, str], frozenset[str]]
    """Kind and meaning → the words of the phrases that have it."""
    used: set[tuple[str, str]] = field(default_factory=set)
    invented: list[str] = field(default_factory=list)

    def keep(self, text: Any, kind: str) -> str | None:
        """What a word of the answer stands for, if the prompt says it."""
        if not isinstance(text, str) or not text.strip():
            return None
        words = text.split()
        for first in range(len(words)):
            meaning = resolve(" ".join(words[first:]), kind)
            if meaning is not None and (kind, meaning) in self.said:
                self.used.add((kind, meaning))
                return meaning
        self.invented.append(f"{kind} {shown(text)}")
        return None

    def account(self, prompt: str) -> tuple[tuple[str, ...], tuple[str, ...]]:
        """Words that the scene shows, and words that nothing stands for, each once."""
        shows = {word for key in self.used for word in self.said[key]}
        words = [one for one in dict.fromkeys(_split(prompt)) if not is_plain(one)]
        lost = (one for one in words if one not in shows)
        return tuple(one for one in words if one in shows), tuple(lost)


def _objects(check: _Check, answers: Iterable[Mapping[str, Any]]) -> dict[str, dict[str, Any]]:
    """Noun → its object, in the order of the answer; the first of a noun counts."""
    kept: dict[str, tuple[dict[str, Any], Mapping[str, Any]]] = {}
    for one in answers:
        noun = check.keep(one.get("noun"), "noun")
        if noun is None or noun in kept:
            continue
        motions = (
            _motion(check, each, "motion") for each in _tables(one.get("motions"), "motions")
        )
        made = {
            "noun": noun,
            "count": _count(check, noun, one.get("count")),
            "colour": check.keep(one.get("colour"), "colour"),
            "material": check.keep(one.get("material"), "material"),
            "motions": [each for each in motions if each],
        }
        kept[noun] = (made, one)
    for noun, (made, one) in kept.items():
        relations = []
        for each in _tables(one.get("relations"), "relations"):
            to = [resolve(str(name), "noun") for name in _list(each.get("to"), "to")]
            found = [name for name in to if name in kept and name != noun]
            kind = check.keep(each.get("kind"), "relation") if found else None
            if kind is not None:
                relations.append({"kind": kind, "to": found})
        made["relations"] = relations
    return {noun: made for noun, (made, _) in kept.items()}


def _count(check: _Check, noun: str, value: Any) -> int:
    """Copies of an object: more than one only where its word is a plural or a number is said."""
    if not isinstance(value, int) or isinstance(value, bool) or not 1 < value <= MOST_COUNT:
        return 1
    number = ("count", str(float(value)))
    if number in check.said:
        check.used.add(number)
        return value
    if any(one.endswith("s") and one != noun for one in check.said["noun", noun]):
        return value
    check.invented.append(f"count {value}")
    return 1


def _motion(check: _Check, one: Mapping[str, Any], word: str) -> dict[str, Any] | None:
    """A motion, or a move of the camera as `word` says."""
    kind = check.keep(one.get("kind"), word)
    if kind is None:
        return None
    return {"kind": kind, "direction": check.keep(one.get("direction"), "direction")}


def _source(one: Mapping[str, Any], objects: Mapping[str, Any]) -> dict[str, str]:
    source = resolve(str(one.get("source")), "noun")
    return {"source": source} if source is not None and source in objects else {}


def _said(prompt: str) -> dict[tuple[str, str], frozenset[str]]:
    """What each phrase of a prompt stands for, of each kind."""
    words = _split(prompt)
    found: dict[tuple[str, str], frozenset[str]] = {}
    for length in range(1, LONGEST_PHRASE + 1):
        for first in range(len(words) - length + 1):
            phrase = words[first : first + length]
            for key in list_meanings(" ".join(phrase)):
                found[key] = found.get(key, frozenset()) | frozenset(phrase)
    return found


def _split(text: str) -> list[str]:
    return re.findall(r"[a-z0-9]+(?:[-'][a-z0-9]+)*", text.casefold())


def _table(value: Any) -> Mapping[str, Any]:
    return value if isinstance(value, Mapping) else {}


def _list(value: Any, name: str) -> list[Any]:
    return value[: MOST_ITEMS[name]] if isinstance(value, list) else []


def _tables(value: Any, name: str) -> Iterator[Mapping[str, Any]]:
    return (one for one in _list(value, name) if isinstance(one, Mapping))
