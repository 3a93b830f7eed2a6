"""Sentences with what they say, and readings in the same form."""

from __future__ import annotations

from pathlib import Path

from texvent.scenes.read import Reading
from texvent.scenes.spec.data import scene_to_data

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
    noun = data.pop("noun")
    parts = [" ".join([*(str(data.pop("colour", "")).split()), noun])]
    if "count" in data:
        parts[0] = f"{data.pop('count')} {parts[0]}"
    parts += [f"{field} {value}" for field, value in data.items()]
    for motion in motions:
        parts.append(" ".join(str(one) for one in motion.values()))
    for one in relations:
        parts.append(" ".join([one["kind"], *one["to"]]))
    return ", ".join(parts)
