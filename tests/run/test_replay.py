from __future__ import annotations

from pathlib import Path

import numpy as np
import pytest

from texvent.errors import InputError
from texvent.events import EventStream
from texvent.pipeline import text_to_events
from texvent.run.replay import COMPARED, describe_differences, prepare_replay, render_again
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
    with pytest.raises(InputError, match="the file was cut in time after its run"):
        prepare_replay(events.between(0, 150_000).metadata, path=Path("events.h5"))
    with pytest.raises(InputError, match="the file was edited after its run"):
        prepare_replay(turned.metadata, path=Path("events.h5"))


def test_whatever_decides_the_bytes_is_compared(simulation) -> None:
    stored = {**simulation.provenance, "weights": {"simulator": {"sha256": "1"}}}
    assert describe_differences(stored, stored) == []
    for name, other in {
        "texvent_version": "0.0.9",
        "weights": {"simulator": {"sha256": "2"}},
        "source": {**stored["source"], "prompt": "a dog"},
        "settings": {**stored["settings"], "run": {}},
        "seed": 5,
    }.items():
        (said,) = describe_differences(stored, {**stored, name: other})
        assert said.startswith(COMPARED[name])
    (said,) = describe_differences(stored, simulation.provenance)
    assert said.startswith("weights: was")


def test_a_changed_asset_refuses_the_run(tmp_path) -> None:
    path = tmp_path / "chair.glb"
    path.write_bytes(b"as it is now")
    facts = {"prompt": "a chair", "files": [{"file": str(path), "sha256": "as it was"}]}
    metadata = {
        "prompt": "a chair",
        "source": facts,
        "settings": {"run": {}, "generate": {"assets": str(tmp_path)}},
    }
    with pytest.raises(InputError, match=r"chair\.glb was changed since"):
        prepare_replay(metadata, path=tmp_path / "events.h5")
