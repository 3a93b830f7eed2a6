"""Several colours of one body, which it has as it is drawn or which are told."""

from dataclasses import replace

import pytest
from tests.scenes.staged import SIZE, stage, stage_text, thing

from texvent.errors import ConfigError
from texvent_scenes.colours import SURFACES
from texvent_scenes.models.materials import has_colour
from texvent_scenes.models.nouns import NOUNS
from texvent_scenes.models.protocol import Pose
from texvent_scenes.procedural import ProceduralConfig, ProceduralGenerator
from texvent_scenes.rendered_scene import Texture
from texvent_scenes.scene_input import understand
from texvent_scenes.spec.scene import Scene


@pytest.mark.parametrize(
    ("prompt", "paint"),
    [
        ("A green and white tram drives along a street.", "green"),
        ("A white and green tram drives along a street.", "green"),
        ("A white and red boat floats on a lake.", "red"),
        ("A black and white football rolls.", None),
    ],
)
def test_a_body_is_painted_so_that_it_has_both_colours(prompt, paint):
    assert understand(prompt, NOUNS).objects[0].colour == paint


@pytest.mark.parametrize(
    ("prompt", "missing"),
    [
        ("A green and white tram drives along a street.", ""),
        ("A yellow and green tram drives along a street.", "green"),
        ("A red and blue ball rolls over the grass.", ""),
        ("A purple and green van drives along a street.", "green"),
    ],
)
def test_a_colour_that_nothing_on_the_body_has_is_told(prompt, missing):
    report = ProceduralGenerator(ProceduralConfig(duration=1.0), size=SIZE).report(prompt)
    shown = {*report.shown} & {"green", "white", "yellow", "red", "blue", "purple"}
    assert missing not in shown
    assert [one for one in report.not_shown if one in SURFACES] == [missing][: bool(missing)]


@pytest.mark.parametrize("noun", ["tram", "bus", "boat", "car"])
def test_panes_are_of_no_colour_that_a_body_is_painted_in(noun):
    parts = (
        NOUNS[noun]
        .build(colour=SURFACES["red"], scale=1.0, seed=0)
        .parts(Pose(0.0, 0.0, 0.0, "stand"))
    )
    assert has_colour(parts, SURFACES["red"], 0.2)
    assert not has_colour(parts, SURFACES["green"])


@pytest.mark.parametrize(
    ("prompt", "colours", "texture"),
    [("a red and blue ball rolls", ("red", "blue"), Texture.STRIPES),
     ("a boy in a blue and yellow jersey runs", ("blue", "yellow"), Texture.STRIPES),
     ("a man in a red and black checkered shirt", ("red", "black"), Texture.CHECKS),
     ("a green and white umbrella", ("green", "white"), Texture.STRIPES)],
)  # fmt: skip
def test_what_may_be_patterned_has_both_colours_in_its_pattern(prompt, colours, texture):
    (actor,) = stage_text(prompt)[1].actors
    parts = [one for one in actor.own_parts(Pose(0.0, 0.0, 0.0, "stand")) if one.texture is texture]
    assert parts
    assert all(has_colour(parts, SURFACES[one]) for one in colours)
    report = ProceduralGenerator(ProceduralConfig(duration=1.0), size=SIZE).report(prompt)
    assert {*colours} <= {*report.shown}
    assert not (*report.not_shown, *report.not_understood)


def test_a_second_colour_needs_a_pattern():
    spotted = thing("ball", colour="red", material="spotted", second_colour="blue")
    (actor,) = stage(spotted).actors
    assert actor.own_parts(Pose(0.0, 0.0, 0.0, "stand"))[0].second_colour == SURFACES["blue"]
    scene = Scene(objects=(replace(spotted, material="wood"),))
    with pytest.raises(ConfigError, match=r"second_colour .*striped"):
        ProceduralGenerator(ProceduralConfig(duration=1.0), size=SIZE).report(scene)
