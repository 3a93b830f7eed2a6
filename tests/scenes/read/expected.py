"""What prompts are expected to say, as facts and in a line, what a scene says, and kept claims.

    python -m tests.scenes.read.expected    # writes the claims anew; CHANGELOG.md says why

`claims.json.gz` has for each sentence of `sentences.txt`, of `checks/words.txt` and of
`golden/reported.txt` a checksum of its words and of what they depend on, then what the staged scene
must hold for them to be shown. Scenes alone, which `sentences.txt` has, do not tell it.
"""

import gzip
import json
import re
import tomllib
from collections.abc import Callable, Mapping
from functools import cache
from pathlib import Path
from typing import Any
from zlib import crc32

from tests.scenes.golden.golden import read_lines

from texvent.errors import InputError
from texvent_scenes.description import SEEN, Claim, SceneDescription
from texvent_scenes.models.nouns import NOUNS
from texvent_scenes.read import Reading, read
from texvent_scenes.scene_input import list_nouns, understand
from texvent_scenes.spec.data import scene_to_data

FACTS = Path(__file__).parent / "facts.toml"
PROMPTS: list[dict[str, Any]] = tomllib.loads(FACTS.read_text(encoding="utf-8"))["prompt"]

_VALUES: Mapping[str, Callable[[SceneDescription], set[str]]] = {
    "place": lambda scene: {scene.place.name or ""},
    "relation": lambda scene: {one.kind for one in scene.relations},
    "colour": lambda scene: {one.colour for one in scene.objects if one.colour},
    "count": lambda scene: {str(one.count) for one in scene.objects},
    "light": lambda scene: {scene.light.kind or ""},
    "weather": lambda scene: {scene.place.weather or ""},
    "direction": lambda scene: {
        motion.direction or "" for one in scene.objects for motion in one.motions
    },
    "camera": lambda scene: {
        name for move in scene.camera.moves for name in (move.kind, f"{move.kind} {move.direction}")
    },
    "blink": lambda scene: {f"{one.blink_hz:g}" for one in scene.objects if one.blink_hz},
    "flicker": lambda scene: {str(one) for one in (scene.light.flicker_hz,) if one},
    "effect": lambda scene: {one.kind for one in scene.effects},
    "picture": lambda scene: {one.picture.value for one in scene.objects if one.picture},
}  # fmt: skip


def has_fact(scene: SceneDescription, fact: str) -> bool:
    """Whether a scene has a fact of `facts.toml`."""
    noun, does, motions = fact.partition(" does ")
    if does:
        done = {
            motion.kind
            for one in scene.objects
            if one.noun.removeprefix("parked ") in noun.split("|")
            for motion in one.motions
        }
        return bool(done & set(motions.split("|")))
    field, _, values = fact.partition(" ")
    if field in _VALUES and values:
        found = _VALUES[field](scene) - {""}
        return bool(found) if values == "any" else bool(found & set(values.split("|")))
    names = {one.noun.removeprefix("parked ") for one in scene.objects}
    return bool(names & set(fact.split("|")))


def grade(prompt: Mapping[str, Any]) -> tuple[list[str], bool]:
    """Facts that are wrong, and whether the report says that some word is not shown."""
    try:
        scene = understand(prompt["text"], list_nouns())
    except InputError:
        return list(prompt["facts"]), True
    wrong = [fact for fact in prompt["facts"] if not has_fact(scene, fact)]
    return wrong, bool(scene.words.not_understood or scene.words.substituted)


SENTENCES = Path(__file__).parent / "sentences.txt"


def sentences() -> list[tuple[str, str]]:
    """Sentences of the file, and what each says."""
    lines = SENTENCES.read_text(encoding="utf-8").splitlines()
    pairs = [line.split(" => ") for line in lines if line and not line.startswith("#")]
    return [(prompt, expected) for prompt, expected in pairs]


def say(reading: Reading) -> str:
    """A reading in a line: objects, effects, camera, light and place, and words that are lost."""
    data = scene_to_data(reading.scene)
    parts = [_say_object(one) for one in data.get("objects", ())]
    parts += [f"effect {' '.join(map(str, one.values()))}" for one in data.get("effects", ())]
    camera = data.get("camera", {})
    parts += [f"camera {' '.join(map(str, one.values()))}" for one in camera.pop("moves", ())]
    parts += [f"{field} {value}" for field, value in camera.items()]
    for name in ("light", "place"):
        parts += [f"{name} {field} {value}" for field, value in data.get(name, {}).items()]
    parts += [f"no {one}" for one in data.get("absent", ())]
    parts += [f"as {one.said}: {one.shown}" for one in reading.substituted]
    parts += [f"lost {one}" for one in reading.not_understood]
    return "; ".join(parts)


def _say_object(data: dict) -> str:
    """Such as "red car, drive left, past tree"."""
    motions, relations = data.pop("motions", ()), data.pop("relations", ())
    noun, own = data.pop("noun"), data.pop("parts", ())
    parts = [" ".join([*(str(data.pop("colour", "")).split()), noun])]
    if "count" in data:
        parts[0] = f"{data.pop('count')} {parts[0]}"
    parts += [f"{field} {value}" for field, value in data.items()]
    for motion in motions:
        parts.append(" ".join(str(one) for one in motion.values()))
    for one in relations:
        parts.append(" ".join([one["kind"], *one["to"]]))
    for one in own:
        said = (one[name] for name in ("count", "colour", "name") if name in one)
        parts.append(f"has {' '.join(map(str, said))}")
    return ", ".join(parts)


CLAIMS = Path(__file__).with_name("claims.json.gz")
WORDS = Path(__file__).parents[1] / "checks" / "words.txt"

read_once = cache(lambda sentence: read(sentence, NOUNS))


def list_sentences() -> list[str]:
    """All sentences, each once."""
    checked = re.findall(r"^([^#\n].*) => ", WORDS.read_text("utf-8"), re.MULTILINE)
    said = [prompt for prompt, _ in sentences()]
    return [*dict.fromkeys([*said, *checked, *read_lines("reported.txt")])]


def _say_claim(one: Claim) -> str:
    about = [*([] if one.subject is None else [one.subject]), *one.targets]
    return " ".join([f"{one.word}:", one.kind, *([str(one.value)] * (one.value != "")),
                     *map(str, about)])  # fmt: skip


def say_claims(reading: Reading) -> str:
    """A checksum of words and of what they depend on, then all claims but that bodies are seen."""
    words = reading.shown, reading.open_words, reading.dependences, [
        one for one in reading.claims if one.kind == SEEN]  # fmt: skip
    claims = dict.fromkeys(_say_claim(one) for one in reading.claims if one.kind != SEEN)
    return "; ".join([f"{crc32(repr(words).encode()):08x}", *claims])


def list_claims() -> Mapping[str, str]:
    """Sentence → what it claims."""
    found = {}
    for sentence in list_sentences():
        try:
            found[sentence] = say_claims(read_once(sentence))
        except InputError:
            found[sentence] = "refused"
    return found


def stored_claims() -> Mapping[str, str]:
    """Sentence → what it claimed."""
    found: dict[str, str] = json.loads(gzip.decompress(CLAIMS.read_bytes()))
    return found


if __name__ == "__main__":
    text = json.dumps(list_claims(), indent=0)
    CLAIMS.write_bytes(gzip.compress(text.encode(), mtime=0))
