"""Frozen scenes: what sentences mean to the embedded generator, and what some of them look like.

    python -m tests.scenes.golden.golden           # writes both files anew; CHANGELOG.md says why
    python -m tests.scenes.golden.golden compare   # names each scene that differs, to the last bit

`sentences.txt` holds the sentences of docs, configs (templates filled in), benchmarks and tests,
under the file that they come from. `descriptions.json.gz` holds what each of them means, without
the report of its words; `filmed.npz` holds the pictures and the truth of those in `filmed.txt`.
"""

from __future__ import annotations

import dataclasses
import gzip
import hashlib
import json
import sys
from functools import cache
from pathlib import Path
from typing import Any

import numpy as np
from numpy.typing import NDArray

from texvent.scenes.description import SceneDescription
from texvent.scenes.language.parser import parse_prompt
from texvent.sensor import SensorSize

FOLDER = Path(__file__).parent
DESCRIPTIONS = FOLDER / "descriptions.json.gz"
FILMED = FOLDER / "filmed.npz"
REPORT = ("shown", "substituted", "not_understood", "claims", "notes")
"""Fields of a description that say what became of words; no scene depends on them for long."""
SIZE, SEED, DURATION_S = SensorSize(96, 72), 5, 1.0
INSTANTS_S = (0.0, 0.45, 0.9)
STEP_S = 0.05
"""From an instant to the one that optical flow goes to."""
BLOCK = 24
"""Side of a block of pixels whose mean is kept: processors differ in the last bit of a light, which
may move a pixel's edge, and never the mean of many."""
CHANNELS = ("red", "green", "blue", "instance", "1 / depth", "flow x", "flow y")


def read_lines(name: str) -> list[str]:
    """Sentences of a file, without its remarks."""
    lines = (FOLDER / name).read_text(encoding="utf-8").splitlines()
    return [line for line in lines if line and not line.startswith("#")]


@cache
def describe(sentence: str) -> SceneDescription:
    """What a sentence means, without the report of its words."""
    return dataclasses.replace(parse_prompt(sentence), **dict.fromkeys(REPORT, ()))


def plain(value: Any) -> Any:
    """A description as JSON holds it: what is not as usual, by name."""
    if dataclasses.is_dataclass(value):
        usual = {one.name: one.default for one in dataclasses.fields(value)}
        found = {name: getattr(value, name) for name in usual}
        return {name: plain(one) for name, one in found.items() if one not in (usual[name], ())}
    if isinstance(value, tuple):
        return [plain(one) for one in value]
    return round(value, 9) if isinstance(value, float) else value


def read_descriptions() -> dict[str, Any]:
    """Sentence → what it meant, as `plain` gives it."""
    found: dict[str, Any] = json.loads(gzip.decompress(DESCRIPTIONS.read_bytes()))
    return found


def film(sentence: str) -> tuple[NDArray[np.float32], str]:
    """Means over blocks, [instants, rows, columns, `CHANNELS`], and a digest of every pixel."""
    from texvent.scenes.raycast.ground_truth import ground_truth
    from texvent.scenes.raycast.render import render
    from texvent.scenes.staging.compose import compose_scene

    scene = compose_scene(describe(sentence), seed=SEED, size=SIZE, duration_s=DURATION_S)
    means, digest = [], hashlib.sha256()
    for time_s in INSTANTS_S:
        truth = ground_truth(scene, time_s, time_s + STEP_S, SIZE)
        image = render(scene, time_s, SIZE)
        for array in (image, truth.instance, truth.depth, truth.flow):
            digest.update(np.ascontiguousarray(array).tobytes())
        near = 1.0 / truth.depth
        flow = np.nan_to_num(np.clip(truth.flow, -SIZE.width, SIZE.width))
        pixels = np.dstack([image, truth.instance, near, flow])
        rows, columns = SIZE.height // BLOCK, SIZE.width // BLOCK
        blocks = pixels.reshape(rows, BLOCK, columns, BLOCK, len(CHANNELS))
        means.append(blocks.mean(axis=(1, 3)))
    return np.array(means, dtype=np.float32), digest.hexdigest()[:24]


def read_films() -> dict[str, tuple[NDArray[np.float32], str]]:
    """Sentence → what `film` gave."""
    with np.load(FILMED) as stored:
        rows = zip(stored["sentences"], stored["means"], stored["digests"], strict=True)
        return {str(sentence): (means, str(digest)) for sentence, means, digest in rows}


def write() -> None:
    """Write both files anew."""
    meanings = {sentence: plain(describe(sentence)) for sentence in read_lines("sentences.txt")}
    text = json.dumps(meanings, separators=(",", ":"))
    DESCRIPTIONS.write_bytes(gzip.compress(text.encode(), mtime=0))
    filmed = read_lines("filmed.txt")
    films = [film(sentence) for sentence in filmed]
    np.savez_compressed(
        FILMED,
        sentences=np.array(filmed),
        means=np.array([means for means, _ in films]),
        digests=np.array([digest for _, digest in films]),
    )


def compare() -> int:
    """Name each sentence whose description or picture is not the stored one; returns how many."""
    stored, films = read_descriptions(), read_films()
    other = [one for one in stored if plain(describe(one)) != stored[one]]
    other += [f"{one} (picture)" for one in films if film(one)[1] != films[one][1]]
    sys.stdout.write("".join(f"{one}\n" for one in other))
    return len(other)


if __name__ == "__main__":
    sys.exit(compare() > 0) if sys.argv[1:] == ["compare"] else write()
