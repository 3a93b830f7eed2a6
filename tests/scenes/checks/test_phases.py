"""What a clip shows of several acts and of a place: each check in unrelated sentences."""

from dataclasses import replace

import numpy as np
import pytest
from tests.scenes.staged import SIZE, stage, stage_text
from tests.scenes.test_short_prompts import report

from texvent_scenes.checks.limbs import find_tiny
from texvent_scenes.checks.phases import find_unhurried
from texvent_scenes.description import SceneDescription
from texvent_scenes.spec.scene import Motion, SceneObject


def test_a_cyclist_has_one_bicycle():
    assert sum("bicycle" in line for line in report("a cyclist pushes his bicycle").scene) == 0
    said = report("a cyclist falls off his bike")
    assert "bike" in (*said.shown, *said.uncertain)


def test_what_flashes_is_hidden_by_nothing():
    text = "a square flashes at 2 Hz"
    assert "flashes" in report(text).shown
    assert not any("hidden" in note for note in report(text).notes)


@pytest.mark.parametrize(("share", "lost"), [(1.0, []), (0.01, ["wave"])])
def test_an_act_whose_limbs_hardly_move_in_the_image_is_said(share, lost):
    said, scene = stage_text("a woman waves in the street")
    times = [0.0, 0.5, 1.0]
    cameras = [replace(each, focal=share * each.focal) for each in map(scene.camera, times)]
    found = find_tiny(said, scene.actors, cameras, times, SIZE)
    assert [one.value for one in found] == lost


@pytest.mark.parametrize(("noun", "kind"), [("car", "drive"), ("dog", "run"), ("bird", "fly")])
@pytest.mark.parametrize("pace", [1.0, 1.7, 3.0])
def test_haste_is_shown_of_who_has_it(noun, kind, pace):
    actors = stage(SceneObject(noun, motions=(Motion(kind, pace=pace),)), place="plain").actors
    for said in (1.7, 3.0, 9.0):
        words = SceneDescription(objects=(SceneObject(noun, motions=(Motion(kind, pace=said),)),))
        is_slower = bool([*find_unhurried(words, actors, np.linspace(0.0, 2.0, 9))])
        assert is_slower == (pace < 0.75 * said)
