"""A ball of a stated colour is mainly of that colour in the picture."""

import itertools

import numpy as np
from tests.scenes.every_row import for_every

from texvent.sensor import SensorSize
from texvent_scenes.models.nouns import NOUNS
from texvent_scenes.procedural import ProceduralConfig, ProceduralGenerator
from texvent_scenes.spec.scene import Motion, Place, Scene, SceneObject

TWO_COLOURED = ("beach ball", "football")
"""Half of a beach ball is white, a third of a football black."""
ROUND = [name for name, noun in NOUNS.items() if noun.motion == "roll" and "ball" in name]
BALLS = [one for one in (*ROUND, "sphere", "marble", "balloon") if one not in TWO_COLOURED]
CHANNELS = {"red": 0, "green": 1, "blue": 2}


@for_every(itertools.product(BALLS, CHANNELS))
def test_four_fifths_of_the_pixels_of_a_coloured_ball_are_of_its_colour(row):
    noun, colour = row
    ball = SceneObject(noun, colour=colour, position_m=(0, 0), motions=(Motion("stand"),))
    config = ProceduralConfig(duration=0.2, samples=1)
    generator = ProceduralGenerator(config, size=SensorSize(96, 72))
    video = generator.generate(Scene(objects=(ball,), place=Place("plain")))
    own = video.at(0).pixels[video.ground_truth(0, 1000).instance == 1]
    others = np.delete(own, CHANNELS[colour], axis=1).max(axis=1)
    assert np.mean(own[:, CHANNELS[colour]] > 1.02 * others) > 0.8
