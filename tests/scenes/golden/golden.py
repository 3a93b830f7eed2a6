"""Frozen scenes: what sentences mean to the embedded generator, and what some of them look like.

    python -m tests.scenes.golden.golden scenes    # writes the scenes anew; CHANGELOG.md says why
    python -m tests.scenes.golden.golden films     # writes the pictures anew, from the scenes
    python -m tests.scenes.golden.golden compare   # names each one that differs, to the last bit

`sentences.txt` holds sentences of docs, configs (templates filled in), benchmarks and tests, one of
each kind, under the file that they come from. `scenes.json.gz` holds the scene of each of them, as
plain values; `filmed.npz` holds the pictures and the truth of those in `filmed.txt`, made from
these scenes: a change of reading changes no picture.
"""

import gzip
import hashlib
import json
import sys
from dataclasses import replace
from functools import cache
from pathlib import Path
from typing import Any

import numpy as np
from numpy.typing import NDArray

from texvent.errors import ConfigError, InputError
from texvent.sensor import SensorSize
from texvent_scenes.description import SceneDescription
from texvent_scenes.raycast.ground_truth import ground_truth
from texvent_scenes.raycast.render import render
from texvent_scenes.rendered_scene import Float64Array
from texvent_scenes.scene_input import describe_scene, list_nouns, read
from texvent_scenes.spec.data import scene_from_data, scene_to_data
from texvent_scenes.staging.compose import ComposedScene, compose_scene

FOLDER = Path(__file__).parent
SCENES = FOLDER / "scenes.json.gz"
FILMED = FOLDER / "filmed.npz"
SIZE, SEED, DURATION_S = SensorSize(96, 72), 5, 1.0
INSTANTS_S = (0.0, 0.45, 0.9)
STEP_S = 0.05
"""From an instant to the one that optical flow goes to."""
BLOCK = 24
"""Side of a block of pixels whose mean is kept: processors differ in the last bit of a light, which
may move a pixel's edge, and never the mean of many."""
CHANNELS = ("red", "green", "blue", "instance", "1 / depth", "flow x", "flow y", "occluded")
WITHIN = np.array((1.0, 1.0, 1.0, 0.1, 0.01, 0.2, 0.2, 0.05))
"""What a block's mean may differ by between processors: a pixel of 576 may fall to a neighbour."""
MOSTLY = 0.02, 0.02
"""Share of blocks that may differ by more than so much of it."""


def read_lines(name: str) -> list[str]:
    """Sentences of a file, without its remarks."""
    lines = (FOLDER / name).read_text(encoding="utf-8").splitlines()
    return [line for line in lines if line and not line.startswith("#")]


@cache
def read_scene(sentence: str) -> dict[str, Any]:
    """The scene of a sentence, as plain values; empty if nothing in it is understood."""
    try:
        data = scene_to_data(read(sentence).scene)
    except InputError:
        return {}
    # Through JSON, as the stored ones: tuples become lists.
    scene: dict[str, Any] = json.loads(json.dumps(data))
    return scene


def decided(data: dict[str, Any]) -> SceneDescription | None:
    """A scene with all that it leaves open decided, which makes its picture; None: refused."""
    try:
        found = describe_scene(scene_from_data(data), list_nouns())
    except (ConfigError, InputError):
        return None
    return replace(found, prompt="", notes=())


@cache
def stored_scenes() -> dict[str, Any]:
    """Sentence → its frozen scene, as `read_scene` gave it."""
    found: dict[str, Any] = json.loads(gzip.decompress(SCENES.read_bytes()))
    return found


def see(scene: ComposedScene, time_s: float, size: SensorSize) -> Float64Array:
    """A picture and its truth, [H, W, `CHANNELS`]."""
    truth = ground_truth(scene, time_s, time_s + STEP_S, size)
    flow = np.nan_to_num(np.clip(truth.flow, -size.width, size.width))
    image = render(scene, time_s, size)
    return np.dstack([image, truth.instance, 1.0 / truth.depth, flow, truth.occluded])


def block_means(pixels: Float64Array, block: int) -> Float64Array:
    """Means over square blocks of an image, [rows, columns, channels]."""
    rows, columns = (side // block for side in pixels.shape[:2])
    return pixels.reshape(rows, block, columns, block, -1).mean(axis=(1, 3))


def film(sentence: str) -> tuple[NDArray[np.float32], str]:
    """Pictures and truth of a frozen scene.

    Returns:
        Means over blocks, [instants, rows, columns, `CHANNELS`], and a digest of every pixel.
    """
    description = describe_scene(scene_from_data(stored_scenes()[sentence]), list_nouns())
    scene = compose_scene(description, seed=SEED, size=SIZE, duration_s=DURATION_S)
    seen = [see(scene, time_s, SIZE) for time_s in INSTANTS_S]
    digest = hashlib.sha256(np.array(seen).tobytes()).hexdigest()[:24]
    return np.array([block_means(one, BLOCK) for one in seen], dtype=np.float32), digest


def differing(means: Float64Array, stored: Float64Array) -> set[str]:
    """The channels that are not as they were, but for what may differ between processors."""
    off = np.abs(means - stored).reshape(-1, len(CHANNELS)) / WITHIN
    share, little = MOSTLY
    is_other = (off > 1.0).any(axis=0) | ((off > little).mean(axis=0) > share)
    return set(np.array(CHANNELS)[is_other])


def stored_films() -> dict[str, tuple[NDArray[np.float32], str]]:
    """Sentence → what `film` gave."""
    with np.load(FILMED) as stored:
        rows = zip(stored["sentences"], stored["means"], stored["digests"], strict=True)
        return {str(sentence): (means, str(digest)) for sentence, means, digest in rows}


def write_scenes() -> None:
    """Write the scenes anew."""
    scenes = {sentence: read_scene(sentence) for sentence in read_lines("sentences.txt")}
    text = json.dumps(scenes, separators=(",", ":"))
    SCENES.write_bytes(gzip.compress(text.encode(), mtime=0))


def write_films() -> None:
    """Write the pictures anew."""
    filmed = read_lines("filmed.txt")
    films = [film(sentence) for sentence in filmed]
    np.savez_compressed(
        FILMED,
        sentences=np.array(filmed),
        means=np.array([means for means, _ in films]),
        digests=np.array([digest for _, digest in films]),
    )


def compare() -> int:
    """Name each sentence whose scene or picture is not the stored one; returns how many."""
    stored, films = stored_scenes(), stored_films()
    other = [one for one in stored if decided(read_scene(one)) != decided(stored[one])]
    other += [f"{one} (picture)" for one in films if film(one)[1] != films[one][1]]
    sys.stdout.write("".join(f"{one}\n" for one in other))
    return len(other)


if __name__ == "__main__":
    actions = {"scenes": write_scenes, "films": write_films, "compare": compare}
    sys.exit(actions[sys.argv[1]]())
