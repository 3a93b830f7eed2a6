"""Every way into a run: what is impossible is refused before any work, and options are honoured."""

from fractions import Fraction

import cv2
import numpy as np
import pytest

import texvent
from texvent.cli.app import main
from texvent.dataset.simulated_samples import SimulatedSamples
from texvent.errors import ConfigError, InputError, MissingDependencyError
from texvent.generation.videos.stored_video import write_video
from texvent.run.prepare import (
    make_video,
    open_subject,
    prepare_prompt,
    prepare_source,
    prepare_video,
    report_prompt,
)
from texvent.settings.resolution import resolve
from texvent_lab.bench.fidelity.entries import simulate_video
from texvent_scenes.procedural import ProceduralGenerator

PROMPT = "a red ball bounces"
SMALL = {"sensor": "48x36", "duration": 0.2}


@pytest.fixture
def prompts(monkeypatch):
    """The prompts that the generator was called with."""
    called = []

    def record(self, prompt, *, progress=None):
        called.append(prompt)
        raise InputError("a generator was started")

    monkeypatch.setattr(ProceduralGenerator, "generate", record)
    return called


def of_api(folder, options):
    texvent.generate(PROMPT, **options)


def of_samples(folder, options):
    SimulatedSamples(prompts=[PROMPT], simulation=options).make(0)


def test_missing_weights_are_named_before_a_generator_starts(tmp_path, prompts):
    options = {**SMALL, "interpolate": "rife"}
    options["interpolator_weights"] = str(tmp_path / "none.pt")
    with pytest.raises((InputError, MissingDependencyError), match=r"none\.pt|torch"):
        prepare_prompt(PROMPT, resolve("generate", options))
    assert prompts == []


def test_weights_that_nothing_reads_are_a_warning(capsys, tmp_path):
    unread = ["--interpolate", "blend", "--interpolator-weights", "rife.pkl"]
    words = [
        "generate",
        PROMPT,
        *unread,
        "--sensor",
        "48x36",
        "--duration",
        "0.2",
        "--previews",
        "none",
    ]
    assert main([*words, "-o", str(tmp_path / "a.h5")]) == 0
    said = capsys.readouterr().err
    assert said.count("warning  --interpolator-weights has no effect: interpolate is blend") == 1


def test_a_prompt_a_source_and_a_video_make_the_same_run():
    settings = resolve("generate", {**SMALL, "interpolate": "blend"})
    video = make_video(PROMPT, settings)
    runs = [
        prepare_prompt(PROMPT, settings),
        prepare_source(video, resolve("simulate", {"interpolate": "blend"}), prompt=PROMPT),
        prepare_video(video, settings, prompt=PROMPT),
    ]
    first, *others = [run.packets.collect() for run in runs]
    assert all(one.equals(first) for one in others)
    assert [run.prompt for run in runs] == [PROMPT] * 3
    assert simulate_video(video, settings, None).equals(first)


@pytest.mark.parametrize("video_seed", [None, 3, 8])
def test_a_camera_shakes_by_the_seed_of_the_video_or_else_that_of_the_run(tmp_path, video_seed):
    image = str(tmp_path / "a.png")
    cv2.imwrite(image, np.random.default_rng(1).integers(0, 255, (36, 48), np.uint8))
    options = {"camera": "shake", "duration": 0.1, "sensor": "32x24"}

    def film(seed, own=None):
        run = prepare_source(image, resolve("simulate", {**options, "seed": seed}), video_seed=own)
        return np.stack([frame.luma for frame in run.video])

    of_seed = film(8 if video_seed is None else video_seed)
    assert np.array_equal(film(8, video_seed), of_seed)
    assert np.array_equal(film(3), of_seed) is (video_seed == 3)


@pytest.mark.parametrize("prompt", [None, PROMPT])
def test_a_stored_video_keeps_its_rate_unless_a_rate_is_given(tmp_path, prompt):
    path = tmp_path / "v.avi"
    levels = np.random.default_rng(1).random((4, 12, 16, 3), dtype=np.float32)
    write_video(levels, path, Fraction(25), {"prompt": PROMPT}, overwrite=False)
    own = {"t_us": [7_000 * number for number in range(4)]}
    for options, step_us in (
        *(({}, 40_000), ({"fps": 10}, 100_000), ({"fps": "50"}, 20_000)),
        (own, 7_000),
    ):
        settings = resolve("simulate", {} if options is own else options)
        given = own if options is own else {}
        run = prepare_source(path, settings, prompt=prompt, **given)
        assert [frame.t_us for frame in run.video] == [step_us * number for number in range(4)]


@pytest.mark.parametrize("options", [{}, {"white_level": 4.0}, {"transfer": "linear"}])
def test_a_prompt_changes_no_level_of_a_stored_video(tmp_path, options):
    light = np.random.default_rng(1).uniform(0, 8, (4, 12, 16, 3)).astype(np.float32)
    facts = {"transfer": "linear", "prompt": PROMPT}
    path = tmp_path / "light.avi"
    write_video(light, path, Fraction(25), facts, overwrite=False)
    settings = resolve("simulate", {"simulator": "esim", **options})
    named, unnamed = (
        prepare_source(path, settings, prompt=prompt).packets.collect() for prompt in (PROMPT, None)
    )
    assert len(unnamed) > 0
    assert named.equals(unnamed)


def test_a_field_of_a_scene_file_without_effect_is_refused_with_the_name_of_the_file(tmp_path):
    path = tmp_path / "a.toml"
    path.write_text('[[objects]]\nnoun = "car"\n[[objects.motions]]\nkind = "drive"\nrate_hz = 3\n')
    with pytest.raises(ConfigError) as caught:
        open_subject(str(path))
    where = f"{path}: objects[0].motions[0].rate_hz has no effect: 'drive' of a car"
    assert str(caught.value).startswith(where)


@pytest.mark.parametrize("seed", [0, 2])
@pytest.mark.parametrize("options", [{}, {"duration": 1.0}, {"sensor": "346x260"}])
@pytest.mark.filterwarnings("ignore")
def test_the_report_of_a_prompt_is_that_of_its_video(seed, options):
    settings = resolve("generate", {**SMALL, "seed": seed, **options})
    prompt = "an ant crawls on a table"
    report = report_prompt(prompt, settings)
    assert report.to_json() == make_video(prompt, settings).metadata["prompt_report"]
