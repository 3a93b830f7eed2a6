"""The table of models against the pinned diffusers."""

import dataclasses
import inspect

import pytest

pytestmark = pytest.mark.torch
pytest.importorskip("torch")
diffusers = pytest.importorskip("diffusers")

from texvent.generation.diffusers_models.modular import find_class  # noqa: E402
from texvent.generation.diffusers_models.pipeline_call import ARGUMENTS  # noqa: E402
from texvent.generation.video_models.known_models import MODELS  # noqa: E402

COMPARED = ("frames", "width", "height", "steps", "guidance")
ABSENT = inspect.Parameter.empty


def call_of(pipeline):
    return inspect.signature(find_class(pipeline).__call__).parameters


def default(call, option):
    """What the pipeline's call takes for an option; None where it is left to the weights."""
    name = next((name for name in ARGUMENTS[option] if name in call), None)
    value = None if name is None else call[name].default
    return sum(value) if isinstance(value, list) else value


ROWS = [dataclasses.asdict(model) for model in MODELS.values()]


def test_diffusers_has_every_pipeline_of_the_list_and_each_takes_a_prompt():
    for row in ROWS:
        for pipeline in filter(None, (row["pipeline"], row["image_pipeline"])):
            assert hasattr(diffusers, pipeline), f"{row['name']}: {pipeline}"
            assert "prompt" in call_of(pipeline), f"{row['name']}: {pipeline}"


def test_frames_size_steps_and_guidance_are_the_calls_own_or_the_row_says_why_not():
    for row in ROWS:
        call = call_of(row["pipeline"])
        differing = [
            option
            for option in COMPARED
            if row[option] != default(call, option)
            and not (option == "guidance" and row[option] is None)
        ]
        assert bool(differing) == bool(row["differs"]), f"{row['name']}: {differing}"


def test_pipelines_that_start_from_an_image_take_one():
    for row in ROWS:
        image = call_of(row["pipeline"]).get("image")
        assert row["needs_image"] == (image is not None and image.default is ABSENT), row["name"]
        if row["image_pipeline"]:
            assert "image" in call_of(row["image_pipeline"]), row["name"]
            assert row["image_pipeline"] != row["pipeline"], row["name"]


def test_the_arguments_and_schedules_of_rows_are_known_to_diffusers():
    for row in ROWS:
        for pipeline in filter(None, (row["pipeline"], row["image_pipeline"])):
            call = call_of(pipeline)
            assert set(row["call"]) <= set(call), f"{row['name']}: {pipeline}"
        schedule = dict(row["scheduler"])
        is_h3 = row["pipeline"].startswith("MiniMaxH3")
        kind = "MiniMaxH3Scheduler" if is_h3 else "UniPCMultistepScheduler"
        assert set(schedule) <= set(inspect.signature(getattr(diffusers, kind)).parameters)
        if row["sigmas"]:
            assert len(row["sigmas"]) == row["steps"]
            assert sorted(row["sigmas"], reverse=True) == list(row["sigmas"])
            assert "sigmas" in call


def test_rows_that_take_the_frame_rate_do_not_say_that_they_ignore_it():
    for row in ROWS:
        if {"fps", "frame_rate"} & set(call_of(row["pipeline"])):
            assert not row["ignores_fps"], row["name"]
