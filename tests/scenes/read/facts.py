"""Facts that people expect of short prompts, and which of them a scene has."""

from __future__ import annotations

import tomllib
from collections.abc import Callable, Mapping
from pathlib import Path
from typing import Any

from texvent.errors import InputError
from texvent.generate.scene_input import list_nouns, understand
from texvent.scenes.description import SceneDescription

FACTS = Path(__file__).parent / "facts.toml"
PROMPTS: list[dict[str, Any]] = tomllib.loads(FACTS.read_text(encoding="utf-8"))["prompt"]

_VALUES: Mapping[str, Callable[[SceneDescription], set[str]]] = {
    "place": lambda scene: {scene.surroundings.name or ""},
    "relation": lambda scene: {one.kind for one in scene.relations},
    "colour": lambda scene: {one.colour for one in scene.objects if one.colour},
    "count": lambda scene: {str(one.count) for one in scene.objects},
    "light": lambda scene: {scene.light.kind or "", scene.light.brightness or ""},
    "weather": lambda scene: {scene.surroundings.weather or ""},
    "direction": lambda scene: {
        motion.direction or "" for one in scene.objects for motion in (one.motion, *one.then)
        if motion is not None
    },
    "camera": lambda scene: {
        name for move in scene.shot.moves for name in (move.kind, f"{move.kind} {move.direction}")
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
            for motion in (one.motion, *one.then)
            if motion is not None
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
