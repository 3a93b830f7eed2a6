"""How near the camera comes to people who move their arms alone."""

from __future__ import annotations

import pytest
from tests.scenes.sentences import parse_prompt

from texvent.scenes.staging.compose import compose_scene
from texvent.sensor import SensorSize

SIZE = SensorSize(160, 120)


def _seen_height(prompt: str) -> tuple[float, float]:
    """Highest and lowest point of the first person, image heights from the middle, up."""
    scene = compose_scene(parse_prompt(prompt), seed=0, size=SIZE, duration_s=1.0)
    camera = scene.camera(0.0)
    seen = (scene.actors[0].corners(0.0) - camera.position) @ camera.rotation.T
    up = -camera.focal * seen[:, 1] / seen[:, 2] * SIZE.width / SIZE.height
    return float(up.max()), float(up.min())


@pytest.mark.parametrize("prompt", ["a man plays the guitar", "a woman claps", "a boy juggles"])
def test_the_image_ends_at_the_waist_of_who_moves_the_arms_alone(prompt: str) -> None:
    top, bottom = _seen_height(prompt)
    assert top < 0.5
    assert bottom < -0.6


@pytest.mark.parametrize(
    "prompt",
    ["a man squats", "a man in boots waves", "a man stands and waves", "a man waves, wide shot"],
)
def test_the_whole_person_is_shown_where_legs_matter_or_the_prompt_asks_for_it(
    prompt: str,
) -> None:
    top, bottom = _seen_height(prompt)
    assert -0.5 < bottom < top < 0.5
