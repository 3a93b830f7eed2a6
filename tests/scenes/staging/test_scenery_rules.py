"""What stands around where snow lies."""

from __future__ import annotations

from tests.scenes.sentences import parse_prompt

from texvent.scenes.staging.compose import compose_scene
from texvent.sensor import SensorSize


def test_nothing_blooms_where_snow_lies() -> None:
    for prompt in ("a man walks in a snowy park", "a fox runs over a snowy hill"):
        description = parse_prompt(prompt)
        scene = compose_scene(description, seed=0, size=SensorSize(64, 48), duration_s=1.0)
        assert not {"flower", "tree", "bush"} & set(scene.list_scenery())
