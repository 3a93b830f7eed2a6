"""Another take is used where it shows more of what the prompt names, and loses none of it."""

from __future__ import annotations

import warnings

import pytest

from texvent.errors import TexventWarning
from texvent.generate import takes
from texvent.generate.procedural import ProceduralConfig, ProceduralGenerator
from texvent.scenes.description import CameraMove, SceneDescription, SceneObject, Shot
from texvent.scenes.evidence import Evidence
from texvent.scenes.report import PromptReport
from texvent.scenes.staging.compose import compose_scene
from texvent.scenes.staging.take import USUAL, Take
from texvent.sensor import SensorSize

SIZE = SensorSize(173, 130)


def filmed(not_shown=(), faults=(), in_doubt=()):
    report = PromptReport(not_shown=tuple(not_shown), in_doubt=tuple(in_doubt))
    return takes.Filmed(None, None, Evidence(faults=dict(faults)), report)


def test_a_take_that_shows_another_copy_shows_more():
    usual = filmed(["dogs (hidden)"], {0: ["hidden"] * 3})
    other = filmed(["2 of 3 dogs (hidden)"], {0: ["hidden", "hidden", None]})
    assert takes.shows_more(other, usual)
    assert not takes.shows_more(usual, other)
    assert not takes.shows_more(usual, usual)


@pytest.mark.parametrize(
    "other",
    [
        filmed(["sky (out of view)"], {0: [None], 1: [None]}),
        filmed([], {0: [None], 1: ["cut off"]}),
        filmed([], {0: [None], 1: [None]}, ["runs (without away)"]),
    ],
)
def test_a_take_that_loses_a_word_or_a_copy_or_puts_one_in_doubt_does_not(other):
    usual = filmed(["dog (hidden)", "red (of the dog)"], {0: ["hidden"], 1: [None]})
    assert not takes.shows_more(other, usual)


@pytest.mark.parametrize(
    ("shot", "fault", "expected"),
    [
        (Shot(), "too small", [Take(), Take(distance=takes.NEARER)]),
        (Shot(framing="close"), "too small", [Take()]),
        (Shot(framing="wide"), "cut off", []),
        (Shot(), "cut off", [Take(distance=takes.FURTHER), Take(is_whole=True),
                             Take(distance=takes.FURTHEST)]),
        (Shot(view="aerial"), "hidden", []),
        (Shot((CameraMove("follow"),)), "hidden", [Take(rise_rad=takes.RISE_RAD)]),
        (Shot((CameraMove("travel"),)), "too small", []),
        (Shot(), None, []),
    ],
)  # fmt: skip
def test_what_is_lost_says_what_is_tried_as_far_as_the_prompt_leaves_it_open(shot, fault, expected):
    description = SceneDescription("a dog", objects=(SceneObject("dog"),), shot=shot)
    found = takes.list_takes(description, Evidence(faults={0: [fault]}), frozenset({0}))
    assert [one for one in found if one.larger] == found
    assert [one._replace(larger=frozenset()) for one in found] == expected


def test_a_take_is_higher_nearer_and_larger():
    description = SceneDescription("a cup", objects=(SceneObject("cup"),))
    take = Take(rise_rad=0.3, distance=0.5, larger=frozenset({0}))
    usual, other = (
        compose_scene(description, seed=0, size=SIZE, duration_s=1.0, take=one)
        for one in (USUAL, take)
    )
    assert other.actors[0].model.height == pytest.approx(1.6 * usual.actors[0].model.height)
    one, two = usual.camera_path.framing, other.camera_path.framing
    assert two.elevation == pytest.approx(one.elevation + 0.3)
    assert two.distance_m < one.distance_m


def test_more_words_are_shown_and_none_is_lost(monkeypatch):
    prompt = "a drone flies through a gate"
    generator = ProceduralGenerator(ProceduralConfig(duration=1.0), size=SIZE)
    shown = set(generator.report(prompt).shown)
    monkeypatch.setattr(takes, "MOST", 0)
    assert shown > set(generator.report(prompt).shown)


def test_a_camera_sways_before_what_hardly_changes_the_picture_unless_it_is_said_to_rest():
    generator = ProceduralGenerator(ProceduralConfig(duration=2.0), size=SIZE)
    moves, said = {}, "a snail crawls in front of a castle"
    for prompt in (said, f"{said}, static camera"):
        with warnings.catch_warnings():
            warnings.simplefilter("ignore", TexventWarning)
            moves[prompt] = generator.generate(prompt).scene.camera_path.moves
    swaying, resting = moves.values()
    assert [move.kind for move in swaying] == ["handheld"]
    assert not resting
    running = generator.generate("a dog runs left").scene.camera_path.moves
    assert "handheld" not in [move.kind for move in running]
    notes = generator.report("a snail crawls in front of a castle").notes
    assert any("so the camera sways" in note for note in notes)
