import json
from dataclasses import replace
from pathlib import Path
from typing import Any

import cv2
import numpy as np
import pytest
from tests.cli.running import run

import texvent
from texvent.cli.event_files.convert import ConvertOptions, edit
from texvent.event_packets import EventPackets
from texvent.events import EventStream
from texvent.generation.subjects import describe_subject, stored_subject
from texvent.pipeline import text_to_events
from texvent.run.regeneration import render_again
from texvent.settings.resolution import resolve
from texvent_scenes.procedural import ProceduralVideo
from texvent_scenes.spec.files import load_scene
from texvent_scenes.spec.scene import Scene, SceneObject

OPTIONS = {"duration": 0.2, "fps": 10, "sensor": "48x36", "seed": 4, "samples": 1}


@pytest.fixture
def simulation():
    return text_to_events("a red ball bounces", resolve("generate", OPTIONS))


@pytest.mark.parametrize(("seed", "seed_of_events"), [(4, 4), (4, 5), (0, 5)])
def test_a_generated_recording_is_filmed_again_from_its_provenance(seed, seed_of_events):
    simulation = text_to_events(
        "a red ball bounces", resolve("generate", {**OPTIONS, "seed": seed})
    )
    facts = json.loads(json.dumps(simulation.provenance))
    facts["settings"]["run"]["seed"] = seed_of_events  # data sets simulate a video several times
    again = render_again(facts)
    assert again is not None
    assert again.size == (48, 36)
    for first, second in zip(simulation.video, again, strict=True):
        assert first.t_us == second.t_us
        np.testing.assert_array_equal(first.pixels, second.pixels)


@pytest.mark.parametrize("prompt", ["", "a blue cube falls"])
def test_a_stored_scene_stands_for_itself_whatever_its_prompt_says(prompt):
    scene = Scene(prompt=prompt, objects=(SceneObject("ball", colour="red"),))
    facts = json.loads(json.dumps(describe_subject(scene)))
    assert stored_subject(facts) == scene
    assert stored_subject({"prompt": prompt or "a cube"}) == (prompt or "a cube")
    assert stored_subject({}) is None


@pytest.mark.parametrize(
    "changed",
    [
        {"generator": None},
        {"generator": "somebody-elses"},
        {"prompt": None},
        {"settings": None},
        {"texvent_version": "0.0.0"},
        {"rig": {"camera": 1}},
        {"settings": {"run": {"seed": "x"}, "generate": {}}},
        {"settings": {"run": {}, "generate": {"no_such_option": 3}}},
        {"prompt": " "},
    ],
)
def test_other_recordings_cannot_be_filmed_again(simulation, changed):
    assert render_again({**simulation.provenance, **changed}) is None


EDITS: dict[str, Any] = {
    "crop": "0,0,8,8",
    "resize": "24x18",
    "rotate": 180,
    "flip": "x",
    "from_zero": True,
    "filter": ("refractory:period_us=9",),
}


@pytest.mark.parametrize("names", [(), *((one,) for one in EDITS), tuple(EDITS)], ids="+".join)
def test_parts_in_time_fit_their_video_and_edited_ones_do_not(simulation, names):
    events = EventStream.from_columns(
        [1], [1], [60_000], [1], size=(48, 36), metadata=simulation.provenance
    )
    whole = EventPackets([events], events.size, events.metadata)
    only = ConvertOptions(path=Path(), **{name: EDITS[name] for name in names})
    with_time = edit(whole, replace(only, time="0,0.15"))  # one entry
    first, last = edit(whole.between(0, 150_000), only), edit(whole, only).between(0, 150_000)
    for edited in (with_time, first, last, edit(whole, only)):
        assert (render_again(edited.metadata) is None) == bool(names)


@pytest.fixture
def board(tmp_path: Path) -> dict[str, Any]:
    """Provenance of a scene that shows a picture."""
    cv2.imwrite(str(tmp_path / "photo.png"), np.full((8, 8, 3), 200, np.uint8))
    scene = tmp_path / "board.toml"
    scene.write_text(
        '[[objects]]\nnoun = "billboard"\npicture = {kind = "file", value = "photo.png"}\n'
    )
    run_of = text_to_events(load_scene(scene), resolve("generate", OPTIONS))
    facts: dict[str, Any] = json.loads(json.dumps(run_of.provenance))
    return facts


def test_a_scene_that_shows_files_is_drawn_for_who_asks_and_if_they_are_listed(board, tmp_path):
    with pytest.warns(texvent.TexventWarning, match=r"shows .*png' of this machine"):
        assert render_again(board) is None
    assert render_again(board, with_files=True) is not None
    for files in (None, [], [{"file": board["source"]["files"][0]["file"], "sha256": "0"}]):
        changed = {**board, "source": {**board["source"], "files": files}}
        assert render_again(changed, with_files=True) is None
    cv2.imwrite(str(tmp_path / "photo.png"), np.zeros((8, 8, 3), np.uint8))
    assert render_again(board, with_files=True) is None


def test_a_folder_of_models_is_a_file_too_and_a_sensor_file_is_not_read(simulation, tmp_path):
    facts = json.loads(json.dumps(simulation.provenance))
    facts["settings"]["run"]["sensor"] = str(tmp_path / "no.toml")
    assert render_again(facts) is not None
    facts["settings"]["generate"]["assets"] = str(tmp_path)
    with pytest.warns(texvent.TexventWarning, match="of this machine"):
        assert render_again(facts) is None


@pytest.mark.long
@pytest.mark.parametrize("kind", ["png", "html", "mp4"])
def test_a_file_cannot_ask_for_more_frames_than_are_shown(simulation, tmp_path, monkeypatch, kind):
    facts = json.loads(json.dumps(simulation.provenance))
    facts["settings"]["generate"].update(duration=86400.0, fps="1000000")
    times = np.arange(1000, 100_000, 999)
    EventStream.from_columns(
        times % 48, times % 36, times, times % 2, size=(48, 36), metadata=facts
    ).save(tmp_path / "long.h5")
    drawn = []
    at = ProceduralVideo.at
    monkeypatch.setattr(ProceduralVideo, "at", lambda self, t: drawn.append(t) or at(self, t))
    assert run("render", str(tmp_path / "long.h5"), "-o", str(tmp_path / f"long.{kind}")) == 0
    assert 0 < len(drawn) <= 140
    assert all(1000 <= t_us < 100_000 for t_us in drawn)
