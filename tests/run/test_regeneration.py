from __future__ import annotations

import numpy as np
import pytest

from texvent.events import EventStream
from texvent.pipeline import text_to_events
from texvent.run.regeneration import render_again
from texvent.settings.resolution import resolve

OPTIONS = {"duration": 0.2, "fps": 10, "sensor": "48x36", "seed": 4, "samples": 1}


@pytest.fixture
def simulation():
    return text_to_events("a red ball bounces", resolve("generate", OPTIONS))


def test_a_generated_recording_is_filmed_again_from_its_provenance(simulation) -> None:
    again = render_again(simulation.provenance)
    assert again is not None
    assert again.size == (48, 36)
    for first, second in zip(simulation.video, again, strict=True):
        assert first.t_us == second.t_us
        np.testing.assert_array_equal(first.pixels, second.pixels)


@pytest.mark.parametrize(
    "changed",
    [
        {"generator": None},
        {"generator": "somebody-elses"},
        {"prompt": None},
        {"settings": None},
        {"texvent_version": "0.0.0"},
        {"edits": [{"crop": "0,0,8,8"}]},
        {"settings": {"run": {"seed": "x"}, "generate": {}}},
        {"settings": {"run": {}, "generate": {"no_such_option": 3}}},
        {"prompt": " "},
    ],
)
def test_other_recordings_cannot_be_filmed_again(simulation, changed: dict[str, object]) -> None:
    assert render_again({**simulation.provenance, **changed}) is None


def test_a_part_in_time_fits_its_video_and_an_edited_one_does_not(simulation) -> None:
    events = EventStream.from_columns(
        [1], [1], [60_000], [1], size=(48, 36), metadata=simulation.provenance
    )
    assert render_again(events.between(50_000, 150_000).metadata) is not None
    turned = events.between(50_000, 150_000).rotate(180)
    assert render_again(turned.metadata) is None
