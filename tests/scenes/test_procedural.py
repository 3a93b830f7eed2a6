"""The embedded generator as the pipeline sees it: a stream that renders any instant."""

import json
from contextlib import nullcontext
from fractions import Fraction
from functools import partial

import numpy as np
import pytest

import texvent
from texvent.errors import InputError, warnings_to
from texvent.generation.kept_frames import KeptFrames
from texvent.options.values import plain
from texvent.prompt_report import PromptReport
from texvent.sensor import SensorSize
from texvent_scenes.procedural import ProceduralConfig, ProceduralGenerator, ProceduralVideo

from ..scenes.hand_scenes import showcase

SMALL = SensorSize(48, 36)


def film(**options: object) -> ProceduralVideo:
    return ProceduralVideo(showcase(), SMALL, ProceduralConfig(**options))  # type: ignore[arg-type]


def test_frames_are_float_rgb_at_times_that_never_drift() -> None:
    video = film(fps=Fraction(30_000, 1001), duration=0.2)
    frames = list(video)
    assert [frame.t_us for frame in frames] == [0, 33_367, 66_733, 100_100, 133_467, 166_833]
    assert len(frames) == video.frame_count == 6
    for frame in frames:
        assert frame.is_source
        assert frame.pixels.dtype == np.float32
        assert frame.pixels.shape == (36, 48, 3)


def test_frames_cover_the_duration_from_first_to_last() -> None:
    assert film(fps=Fraction(24), duration=2.0).frame_count == 49
    assert film(fps=Fraction(10), duration=0.3).frame_count == 4  # 0.3 · 10 is 3, not 2.99...
    assert film(fps=Fraction(10), duration=0.35).frame_count == 4


def test_the_frame_rate_does_not_change_a_frame_at_the_same_instant() -> None:
    slow, fast = list(film(fps=Fraction(10), duration=0.2)), film(fps=Fraction(1000), duration=0.2)
    for frame in slow:
        between = fast.at(frame.t_us)
        assert not between.is_source
        assert between.t_us == frame.t_us
        np.testing.assert_array_equal(between.pixels, frame.pixels)


def test_a_prompt_becomes_a_moving_video_that_says_what_was_understood() -> None:
    generator = ProceduralGenerator(ProceduralConfig(duration=1.0), seed=3, size=SMALL)
    said: list[str] = []
    # Not pytest.warns, which loses warnings where another thread compiles a kernel meanwhile.
    with warnings_to(said.append):
        video = generator.generate("a red car drives left past two trees. Xylophonically.")
    assert any("not understood: xylophonically" in one for one in said)
    assert json.loads(json.dumps(video.metadata)) == video.metadata
    assert video.metadata["generator"] == "procedural"
    assert video.metadata["seed"] == 3
    report = PromptReport.of_metadata(video.metadata)
    assert any("car" in line for line in report.scene)
    assert report.not_understood == ("xylophonically",)
    first, last = video.at(0).pixels, video.at(1_000_000).pixels
    assert np.abs(first - last).max() > 30.0
    again = ProceduralGenerator(ProceduralConfig(duration=1.0), seed=3, size=SMALL)
    same = again.generate("a red car drives left past two trees")
    np.testing.assert_array_equal(same.at(400_000).pixels, video.at(400_000).pixels)


def test_a_flicker_faster_than_the_frames_fires_events_everywhere() -> None:
    prompt = "in a room, the light flickers at 48 Hz"
    events = texvent.generate(
        prompt, duration=0.125, fps=24, sensor="32x24", noise="none", multi_event=False
    )
    pans = "in a room, the camera pans right"
    steady = texvent.generate(pans, duration=0.125, fps=24, sensor="32x24", noise="none")
    assert len(events) > 4 * 2 * 32 * 24
    assert len(steady) < len(events) / 10
    assert 0.4 < events.p.mean() < 0.6


def test_what_is_kept_of_a_scene_is_what_would_be_rendered() -> None:
    """One store for all sizes and codes of a scene, asked twice."""
    kept, videos = KeptFrames(), []
    for size in (SMALL, SensorSize(36, 48)):
        config = ProceduralConfig(duration=0.2, fps=Fraction(10), hdr=True)
        video = ProceduralGenerator(config, size=size).generate("a red ball bounces")
        videos += [video, video.gamma_coded()]
    for video in (one.with_motion() for one in (*videos, *videos)):
        seen = []
        for stream in (video, video.keeping(kept)):
            frames = list(stream)
            between = list(stream.between(frames[0], frames[1], (30_000, 70_000)))
            truth = stream.ground_truth(0, 100_000)
            motions = [one for frame in frames for one in vars(frame.motion).values()]
            seen.append([*(one.pixels for one in (*frames, *between, stream.at(50_000))),
                         truth.depth, truth.flow, *motions])  # fmt: skip
        for fresh, stored in zip(*seen, strict=True):
            np.testing.assert_array_equal(fresh, stored)
    kinds = [key[0] for key in kept.values]
    assert {kind: kinds.count(kind) for kind in kinds} == {
        "frame": 4 * 4, "motion": 4 * 3, "between": 4, "truth": 4
    }  # fmt: skip


def test_frames_from_one_on_are_those_of_the_whole_video() -> None:
    generator = ProceduralGenerator(ProceduralConfig(duration=0.2), size=SMALL)
    video = generator.generate("a ball bounces").with_motion()
    whole, late = list(video), list(video.from_frame(3))
    assert len(late) == len(whole) - 3
    for expected, frame in zip(whole[3:], late, strict=True):
        assert frame.t_us == expected.t_us
        np.testing.assert_array_equal(frame.pixels, expected.pixels)
        assert (frame.motion.forward is None) == (expected.motion.forward is None)


@pytest.mark.parametrize(
    "prompt", ["a red ball bounces", "a wug and a red ball", "an ant crawls on a table", "a wug"]
)
@pytest.mark.parametrize("is_staged", [True, False])
def test_strict_refuses_what_the_report_would_refuse_and_nothing_else(prompt, is_staged) -> None:
    options = {"duration": 0.3, "samples": 1}
    usual, strict = (
        ProceduralGenerator(ProceduralConfig(strict=one, **options), seed=1, size=SMALL)
        for one in (False, True)
    )
    refusal = "nothing in the prompt was understood" if prompt == "a wug" else None
    if refusal is None:
        refusal = usual.report(prompt, is_staged=is_staged).refusal()
    calls = [partial(strict.report, prompt, is_staged=is_staged)]
    calls += [partial(strict.generate, prompt)] if is_staged else []
    for call in calls:
        with pytest.raises(InputError) if refusal else nullcontext() as caught:
            call()
        assert refusal is None or refusal in str(caught.value)


@pytest.mark.parametrize("given", [
    {}, {"fps": Fraction(50), "duration": 0.1}, {"samples": 3, "shadows": False, "hdr": True},
    {"point_spread": 0.0, "vignetting": False, "duration": 0.2},
])  # fmt: skip
def test_a_video_says_with_what_it_was_made(given) -> None:
    config = ProceduralConfig(**given)
    video = ProceduralGenerator(config, seed=7, size=SMALL).generate("a red ball bounces")
    made = dict(video.metadata["options"])
    assert {name: made[name] for name in given} == plain(given)
    assert made == plain(config)
    again = texvent.video("a red ball bounces", sensor=str(SMALL), seed=video.metadata["seed"], **{
        name: value for name, value in made.items() if value is not None
    })  # fmt: skip
    assert np.array_equal(next(iter(again)).pixels, next(iter(video)).pixels)
