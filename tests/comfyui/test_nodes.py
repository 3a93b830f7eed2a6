"""The nodes, loaded and run by ComfyUI's published interface (comfy_interface.py)."""

import dataclasses
import re
import sys
import typing
from fractions import Fraction
from types import SimpleNamespace

import numpy as np
import pytest
from tests.comfyui import comfy_interface as comfy

import texvent
from texvent._registry import SIMULATORS
from texvent.errors import TexventError

CLASSES, TITLES = comfy.load()
IMAGES = np.random.default_rng(2).random((4, 12, 16, 3), dtype=np.float32)


class Images:
    """A node that gives the images, as Load Image does."""

    RETURN_TYPES = ("IMAGE",)
    FUNCTION = "give"
    value = IMAGES

    @classmethod
    def INPUT_TYPES(cls):
        return {"required": {}}

    def give(self):
        return (self.value,)


class Video(Images):
    """A node that gives a video at 30000/1001 frames per second, as Load Video does."""

    RETURN_TYPES = ("VIDEO",)
    value = SimpleNamespace(
        get_components=lambda: SimpleNamespace(images=IMAGES, frame_rate=Fraction(30000, 1001))
    )


ALL = {**CLASSES, "Images": Images, "Video": Video}


@pytest.fixture
def output(tmp_path, monkeypatch):
    folder = tmp_path / "output"
    folder.mkdir()
    monkeypatch.setitem(sys.modules, "folder_paths", comfy.folder_paths(folder))
    return folder


def test_every_node_follows_the_interface():
    assert TITLES.keys() == CLASSES.keys()
    assert len(set(TITLES.values())) == len(TITLES) == 5 + len(SIMULATORS.builtin)
    for name, cls in CLASSES.items():
        assert re.fullmatch(r"Texvent\w+", name)
        assert cls.CATEGORY.startswith("texvent")
        assert callable(getattr(cls, cls.FUNCTION))
        assert all(isinstance(kind, str) for kind in cls.RETURN_TYPES)
        assert len(cls.RETURN_NAMES) == len(cls.RETURN_TYPES)
        for key, info in cls.INPUT_TYPES()["required"].items():
            assert isinstance(info, tuple), key
            if info[0] in ("INT", "FLOAT"):
                assert info[1]["min"] <= info[1]["default"] <= info[1]["max"], (name, key)
            if isinstance(info[0], list):
                assert info[1]["default"] in info[0], (name, key)


@pytest.mark.parametrize("simulator", SIMULATORS.builtin)
def test_options_of_a_pixel_model_are_those_of_its_dataclass(simulator):
    cls = CLASSES[f"TexventModel{simulator.capitalize()}"]
    presets = SIMULATORS.load(simulator).presets
    config = next(iter(presets.values()))
    inputs = cls.INPUT_TYPES()["required"]
    assert list(inputs) == ["preset", *(field.name for field in dataclasses.fields(config))]
    assert inputs["preset"][0] == list(presets)
    assert all(info[1]["tooltip"] for info in inputs.values())
    graph = {"model": comfy.defaults(cls)}
    (options,) = comfy.run(graph, ALL)["model"]["result"]
    assert options == {"simulator": simulator, "preset": next(iter(presets))}


@pytest.mark.parametrize("simulator", SIMULATORS.builtin)
def test_optional_numbers_are_read_as_they_are_written(simulator):
    config = next(iter(SIMULATORS.load(simulator).presets.values()))
    widgets = comfy.part("widgets")
    hints = typing.get_type_hints(type(config))
    for name in (one for one in hints if hints[one] in (float | None, int | None)):
        for text, value in (("3", 3), ("0.75", 0.75), ("", getattr(config, name))):
            try:
                found = getattr(widgets.with_values(config, {name: text}, where="node"), name)
            except TexventError as error:  # out of range, or no whole number
                found = value if f"{name} is {value}" in str(error) else str(error)
            assert found == value


def test_images_become_the_events_of_texvent(output):
    graph = {
        "images": {"class_type": "Images", "inputs": {}},
        "model": comfy.defaults(CLASSES["TexventModelEsim"], contrast_threshold_on=0.3),
        "events": comfy.defaults(
            CLASSES["TexventImagesToEvents"], images=["images", 0], model=["model", 0], seed=4,
            fps=50.0, interpolate="blend",
        ),
        "save": comfy.defaults(
            CLASSES["TexventSaveEvents"], events=["events", 0], filename_prefix="a/b", format="npz"
        ),
    }  # fmt: skip
    done = comfy.run(graph, ALL)
    truth = texvent.simulate(
        IMAGES * np.float32(255), fps=50, interpolate="blend", simulator="esim", seed=4,
        contrast_threshold_on=0.3, progress=False,
    )  # fmt: skip
    assert len(truth)
    assert done["events"]["result"][0].equals(truth)
    (path,) = done["save"]["result"]
    assert path == str(output / "a" / "b_00001_.npz")
    assert texvent.load(path).equals(truth)
    assert done["save"]["ui"] == {"text": [f"b_00001_.npz: {len(truth):,} events, 16x12"]}
    assert comfy.run(graph, ALL)["save"]["result"] == (str(output / "a" / "b_00002_.npz"),)


def test_a_video_keeps_its_frame_rate_and_alpha_is_left_out():
    graph = {
        "video": {"class_type": "Video", "inputs": {}},
        "events": comfy.defaults(CLASSES["TexventVideoToEvents"], video=["video", 0]),
    }
    events = comfy.run(graph, ALL)["events"]["result"][0]
    truth = texvent.simulate(IMAGES * np.float32(255), fps="30000/1001", progress=False)
    assert events.equals(truth)
    with_alpha = np.concatenate([IMAGES, np.ones((4, 12, 16, 1), np.float32)], axis=3)
    tensors = comfy.part("tensors")
    assert (tensors.frames_of(with_alpha) == tensors.frames_of(IMAGES)).all()
    assert tensors.frames_of(IMAGES[..., :1]).shape == (4, 12, 16)
    for beyond in (IMAGES * 2 - 1, IMAGES * 255):
        with pytest.raises(TexventError, match=r"far beyond the 0..1 .*\(images \+ 1\) / 2"):
            tensors.frames_of(beyond)


def test_a_prompt_gives_events_and_a_report():
    cls = CLASSES["TexventPromptToEvents"]
    graph = {
        "events": comfy.defaults(
            cls, prompt="a red ball bounces", duration=0.1, fps=20.0, sensor="32x24", seed=1
        )
    }
    events, report = comfy.run(graph, ALL)["events"]["result"]
    truth = texvent.generate(
        "a red ball bounces", duration=0.1, fps=20, sensor="32x24", seed=1, progress=False
    )
    assert events.equals(truth)
    assert "ball" in report


@pytest.mark.parametrize(
    "prefix", ["../x", "a/../../x", "/etc/x", "", ".", "..", "a\\..\\..\\x", "link/x", "a\0b"]
)
def test_names_stay_inside_the_output_folder(output, tmp_path, prefix):
    (tmp_path / "outside").mkdir()
    (output / "link").symlink_to(tmp_path / "outside")
    events = texvent.simulate(IMAGES * np.float32(255), fps=50, progress=False)
    with pytest.raises(TexventError, match="no name inside the output folder"):
        CLASSES["TexventSaveEvents"]().save(events, prefix, "hdf5")
    assert list((tmp_path / "outside").iterdir()) == []
    assert [one.name for one in output.iterdir()] == ["link"]


def test_an_option_that_was_changed_overrides_the_preset():
    cls = CLASSES["TexventModelV2e"]
    graph = {"n": comfy.defaults(cls, preset="noisy", cutoff_hz=60.0, leak_rate_hz=0.01)}
    (options,) = comfy.run(graph, ALL)["n"]["result"]
    assert options == {"simulator": "v2e", "preset": "noisy", "cutoff_hz": 60.0}


def test_images_of_events_have_the_colours_of_the_palette():
    draw = comfy.part("output_nodes").event_images
    events = texvent.EventStream.from_columns(
        [0, 1, 2], [0, 0, 1], [0, 1000, 25_000], [1, 0, 1], size=(3, 2)
    )
    images = draw(events, fps=50.0, window_ms=0.0, palette="paper", max_images=9)
    assert images.shape == (2, 2, 3, 3)
    assert images[0, 0].tolist() == [[0, 0, 255], [255, 0, 0], [255, 255, 255]]
    assert images[1, 1, 2].tolist() == [0, 0, 255]
    assert len(draw(events, fps=50.0, window_ms=0.0, palette="v2e", max_images=1)) == 1
    for window_ms in (0.5, 1.5, 30.0):  # what begins every 20 ms and lasts as long as is asked for
        images = draw(events, fps=50.0, window_ms=window_ms, palette="paper", max_images=9)
        for number, image in enumerate(images):
            inside = (events.t >= 20_000 * number) & (events.t - 20_000 * number < 1000 * window_ms)
            drawn = np.argwhere((image < 255).any(axis=-1))
            assert {(x, y) for y, x in drawn.tolist()} == {
                *zip(events.x[inside].tolist(), events.y[inside].tolist(), strict=True)
            }
    empty = texvent.EventStream.empty((3, 2))
    assert (draw(empty, fps=50.0, window_ms=1.0, palette="paper", max_images=9) == 255).all()


def test_progress_reaches_comfyui_and_its_cancel_button_stops_a_run(monkeypatch):
    class Cancelled(Exception):  # noqa: N818
        pass

    steps, limit = [], 2

    def throw():
        if len(steps) >= limit:
            raise Cancelled

    def bar(total):
        return SimpleNamespace(update_absolute=lambda done, total: steps.append((done, total)))

    monkeypatch.setitem(sys.modules, "comfy", SimpleNamespace())
    monkeypatch.setitem(sys.modules, "comfy.utils", SimpleNamespace(ProgressBar=bar))
    monkeypatch.setitem(
        sys.modules,
        "comfy.model_management",
        SimpleNamespace(throw_exception_if_processing_interrupted=throw),
    )
    with pytest.raises(Cancelled):
        CLASSES["TexventImagesToEvents"]().simulate(IMAGES, 24.0)
    assert len(steps) == 2
    assert {total for _, total in steps} == {4}


@pytest.mark.torch
def test_tensors_go_in_and_come_out():
    torch = pytest.importorskip("torch")
    images = torch.from_numpy(IMAGES).half()
    events = CLASSES["TexventImagesToEvents"]().simulate(images, 24.0)[0]
    assert len(events)
    preview = CLASSES["TexventPreviewEvents"]
    graph = comfy.defaults(preview)["inputs"]
    (drawn,) = preview().draw(events, **graph)
    assert drawn.dtype == torch.float32
    assert drawn.shape[1:] == (12, 16, 3)
    assert 0.0 <= float(drawn.min()) <= float(drawn.max()) == 1.0
