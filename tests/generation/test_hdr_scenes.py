"""Scenes rendered as linear light, with what is brighter than white."""

import numpy as np
import pytest

import texvent
from texvent.frames import transfer_of
from texvent.pipeline import text_to_video
from texvent.settings.resolution import resolve
from texvent.transfer import Transfer, decode_srgb
from texvent.view.drawing.event_image import frame_image

PROMPT = "a car with headlights drives towards the camera at night"
SMALL = {"sensor": "64x48", "duration": 0.25, "seed": 2}


def video_of(**options):
    return text_to_video(PROMPT, resolve("generate", {**SMALL, **options}))


@pytest.mark.long
def test_lamps_are_brighter_than_white_and_the_rest_is_as_before():
    ordinary, linear = video_of(), video_of(hdr=True)
    assert (transfer_of(ordinary), transfer_of(linear)) == (Transfer.GAMMA, Transfer.LINEAR)
    coded, light = next(iter(ordinary)), next(iter(linear))
    assert coded.pixels.max() <= 255 < 2000 < light.pixels.max()
    assert light.transfer is Transfer.LINEAR
    # Light below 3/4 of white, where nothing is compressed; far from the lamps.
    is_plain = light.pixels.max(axis=2) < 0.5 * 255
    before = 255 * decode_srgb(coded.pixels / 255)
    assert is_plain.mean() > 0.3
    close = np.isclose(light.pixels[is_plain], before[is_plain], rtol=0.02, atol=0.5)
    assert close.mean() > 0.9
    # In a preview both look alike.
    shown = frame_image(coded).astype(int) - frame_image(light)
    assert np.abs(shown)[is_plain].mean() < 2


@pytest.mark.long
@pytest.mark.parametrize("simulator", ["texvent", "physical"])
def test_highlights_give_events(simulator):
    options = {**SMALL, "simulator": simulator, "max_intermediate": 4}
    plain, hdr = (texvent.generate(PROMPT, hdr=one, **options) for one in (False, True))
    assert len(hdr) > len(plain) > 0
    stored = hdr.metadata["source"]
    assert stored["options"]["hdr"] is True
    assert stored.get("transfer") == ("linear" if simulator == "physical" else None)
