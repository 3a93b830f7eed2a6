"""The Python API as a user meets it: frames, events, files and scores in a few calls."""

import subprocess
import sys
from functools import partial
from inspect import signature

import numpy as np
import pytest
import tomli_w

import texvent
from texvent.api.functions import compare
from texvent.errors import ConfigError, InputError, TexventError
from texvent_scenes import load_scene

PROMPT = "a red ball bounces"
SMALL = {"sensor": "48x36", "duration": 0.2, "seed": 3}


@pytest.fixture(scope="module")
def events():
    return texvent.generate(PROMPT, **SMALL)


@pytest.fixture(scope="module")
def path(events, tmp_path_factory):
    return events.save(tmp_path_factory.mktemp("api") / "events.h5")


WITH_CONFIG = {
    "generate": partial(texvent.generate, PROMPT),
    "simulate": partial(texvent.simulate, np.zeros((3, 4, 5), np.uint8), fps=10),
    "video": partial(texvent.video, PROMPT),
    "EventCamera": partial(texvent.EventCamera, (5, 4)),
    "rig.record": partial(texvent.rig.record, PROMPT, "out"),
}


def test_every_public_function_that_reads_a_config_file_is_tried_below():
    public = {name: getattr(texvent, name) for name in texvent.__all__}
    public["rig.record"] = texvent.rig.record
    hints = {
        name: signature(one).parameters.get("config")
        for name, one in public.items()
        if callable(one) and not (isinstance(one, type) and issubclass(one, Exception))
    }
    assert {name for name, one in hints.items() if "Path" in str(one)} == {*WITH_CONFIG}


@pytest.mark.parametrize("name", WITH_CONFIG)
@pytest.mark.parametrize(
    ("wrong", "message"),
    [({"contrast_threshold": 99.0}, "contrast_threshold is 99"),
     ({"interpolate": "none!"}, "unknown interpolator 'none!'"),
     ({"max_intermediat": 3}, "'max_intermediat'")],
)  # fmt: skip
def test_a_config_file_counts_wherever_it_is_given_as_do_options_beside_it(
    tmp_path, monkeypatch, name, wrong, message
):
    monkeypatch.chdir(tmp_path)
    for said, given in ((wrong, {}), (wrong, {"seed": 3}), ({"seed": 3}, wrong)):
        (tmp_path / "c.toml").write_text(tomli_w.dumps(said))
        with pytest.raises(ConfigError, match=message) as caught:
            WITH_CONFIG[name](config="c.toml", **given)
        assert ("c.toml" in str(caught.value)) == (said is wrong)
    assert [one.name for one in tmp_path.iterdir()] == ["c.toml"]


def test_the_name_of_a_scene_file_goes_where_a_prompt_goes(tmp_path, events):
    path = tmp_path / "ball.toml"
    path.write_text('prompt = "a red ball bounces"\n[[objects]]\nnoun = "ball"\n', encoding="utf-8")
    assert texvent.generate(str(path), **SMALL) == texvent.generate(load_scene(path), **SMALL)
    assert len(list(texvent.video(str(path), **SMALL))) == 5
    for call in (texvent.generate, texvent.video):
        with pytest.raises(InputError, match=r"cannot read scene file mug\.toml: No such file"):
            call("mug.toml", **SMALL)


def test_the_frames_alone_give_the_events_of_the_prompt():
    frames = texvent.video(PROMPT, **SMALL, interpolate="blend")
    assert frames.size == (48, 36)
    first = next(iter(frames))
    assert first.pixels.shape == (36, 48, 3)
    from_frames = texvent.simulate(frames, interpolate="blend", seed=3)
    assert from_frames.equals(texvent.generate(PROMPT, **SMALL, interpolate="blend"))


def test_an_opened_file_is_cut_by_time_and_read_lazily(events, path):
    opened = texvent.open(path)
    assert opened.size == events.size
    assert opened.metadata["prompt"] == PROMPT
    assert opened.time_range == events.time_range
    assert opened.between(50_000, 80_000).collect().equals(events.between(50_000, 80_000))
    assert opened.collect().equals(events)
    with pytest.raises(InputError, match=r"nope\.h5"):
        texvent.open("nope.h5")


def test_files_packets_and_streams_are_compared(events, path):
    names = ["count_ratio", "stpp"]
    want = {"count_ratio": 1.0, "stpp": 1.0}
    assert compare(events, path, names) == want
    assert texvent.compare(str(path), texvent.open(path), names) == want


def of_a_generator():
    frames = np.random.default_rng(1).integers(0, 256, (12, 8, 10), dtype=np.uint8)
    return texvent.simulate((frame for frame in frames), fps=60, as_packets=True)


def test_a_generator_gives_its_events_once_and_never_others(tmp_path):
    """A pass that was broken off took frames along; the next one began in the middle."""
    broken_off = of_a_generator()
    next(iter(broken_off))
    with pytest.raises(InputError, match=r"can be read once, and was.*collect\(\)"):
        broken_off.save(tmp_path / "g.h5")
    assert list(tmp_path.iterdir()) == []
    part = of_a_generator()
    assert len(part.between(50_000, 80_000).collect()) > 0
    with pytest.raises(InputError, match="can be read once, and was"):
        part.collect()


def test_pixel_models_are_there_by_class_and_load_when_named():
    code = (
        "import sys, texvent;"
        "models = texvent.pixel_models;"
        "assert not {'torch', 'numba'} & set(sys.modules);"
        "assert models.EsimSimulator(models.EsimConfig()).contrast_threshold > 0;"
        "from texvent.pixel_models import V2eConfig, V2eSimulator;"
        "assert V2eSimulator.config_type is V2eConfig;"
        "assert all(getattr(models, name).__name__ == name for name in models.__all__);"
        "assert not {'torch', 'numba'} & set(sys.modules)"
    )
    subprocess.run([sys.executable, "-c", code], check=True)


@pytest.mark.parametrize(
    ("mistake", "said"),
    [
        (lambda events: texvent.generate(5), "the prompt is a int; give a text"),
        (lambda events: texvent.video(None), "the prompt is a NoneType; give a text"),
        (lambda events: events[0], "take a column, such as events.t[0]"),
        (lambda events: events["x"], "take a column"),
        (lambda events: compare(events, events, "stp"), "did you mean 'stpp'?"),
        (lambda events: texvent.generate(PROMPT, contrast_treshold=1), "'contrast_threshold'?"),
        (lambda events: texvent.generate(PROMPT, qwertyuiop=1), " in all)"),
        (lambda events: events.save("a.h5", format="hdf"), "did you mean 'hdf5'?"),
        (lambda events: texvent.load("a.csv", size="davis24"), "did you mean 'davis240c'"),
    ],
)
def test_mistakes_are_one_short_line(events, mistake, said):
    with pytest.raises(TexventError) as caught:
        mistake(events)
    message = str(caught.value)
    assert said in message
    assert len(message) < 300
    assert "\n" not in message


def test_only_pixels_within_one_of_zero_are_taken_for_those_of_a_model():
    for lowest, highest, words in ((-255.0, 0.0, "add what makes black 0"), (-1.0, 1.0, "-1..1")):
        frames = np.linspace(lowest, highest, 240).reshape(5, 6, 8)
        with pytest.raises(InputError, match=words) as caught:
            texvent.simulate(frames, fps=20)
        assert ("-1..1" in str(caught.value)) is (highest == 1.0)
