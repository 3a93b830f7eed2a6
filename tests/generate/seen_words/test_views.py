"""Words of the camera count as shown where the staged camera does as they say."""

from __future__ import annotations

import pytest

from texvent.generate.procedural import ProceduralConfig, ProceduralGenerator
from texvent.sensor import SensorSize


def _report(prompt: str):
    generator = ProceduralGenerator(ProceduralConfig(), size=SensorSize(96, 72))
    return generator.report(prompt)


@pytest.mark.parametrize(
    ("prompt", "word"),
    [
        ("A close-up of a red apple on a table.", "close up of"),
        ("A dog runs, filmed from the side.", "from the side"),
        ("A dog runs, filmed from the front.", "from the front"),
        ("A dog runs, filmed from behind.", "from behind"),
        ("A low-angle shot of a horse that walks.", "low angle shot"),
        ("A medium shot of a man who waves.", "medium shot of"),
        ("The camera drives forward through a forest.", "forward"),
        ("A static shot of a car that drives left.", "static shot"),
        ("A knife on the left of a spoon, front view.", "front view"),
        ("A truck left past a row of trees.", "truck"),
        ("A pedestal down from the top of a tower.", "down"),
    ],
)
def test_what_the_camera_does_is_shown(prompt, word) -> None:
    assert word in _report(prompt).shown


@pytest.mark.parametrize(
    ("prompt", "words"),
    [
        ("Close-up of a man's hands typing on a laptop.", "close up of (shows more than hands)"),
        ("A macro shot of a dog's eyes.", "macro shot of (shows more than eyes)"),
        ("First-person view: hands type on a laptop.",
         "first person view (the person is seen from outside)"),
        ("A drone flies over a city.", "over (not above what stands there)"),
        ("A woman stands in a wheat field.", "wheat field (no stalks)"),
        ("Two balls lie on the grass, seen from the stands.",
         "stands (the camera is not up there)"),
        ("A runner runs. The camera falls behind.",
         "falls (the camera does not stay behind)"),
        ("A woman walks, lens flare.", "lens flare (the lens flares nowhere)"),
        ("A cat sits, shallow depth of field.", "shallow depth of field (the lens blurs nothing)"),
        ("A dog sits. The camera follows the dog.",
         "follows (what it follows stays where it is)"),
    ],
)  # fmt: skip
def test_what_it_does_not_do_is_reported(prompt, words) -> None:
    assert words in _report(prompt).not_shown
