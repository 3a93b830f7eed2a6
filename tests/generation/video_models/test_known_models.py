"""The table of learned models, the names that lead to them, and their options."""

from fractions import Fraction
from pathlib import Path

import pytest

from texvent._registry import GENERATORS
from texvent.errors import ConfigError, TexventWarning
from texvent.generation.video_models import known_models, named_models
from texvent.settings.resolution import resolve


def test_few_frames_per_second_are_warned_about_and_24_are_not():
    with pytest.warns(TexventWarning, match="cogvideox-5b makes 8 frames per second"):
        named_models.warn_low_fps("cogvideox-5b")
    with pytest.warns(TexventWarning, match="makes 16 frames per second"):
        named_models.warn_low_fps("./models/Wan2.1-T2V-1.3B-Diffusers")
    for name in ("wan2.2-5b", "procedural", "opensora", "./my-model"):
        named_models.warn_low_fps(name)


def test_a_row_gives_its_own_defaults_to_the_options():
    settings = resolve("generate", {"generator": "wan-1.3b"})
    assert settings.source.fps == 16
    assert (settings.source.frames, settings.source.height, settings.source.width) == (81, 480, 832)
    assert settings.source.steps == 50
    assert settings.interpolate.interpolate == "flow"


def test_a_model_avoids_what_its_publishers_program_avoids_unless_told_otherwise():
    for name, row in known_models.MODELS.items():
        assert bool(row.negative_prompt) == (
            name.startswith(("wan", "cogvideox-fun")) or name == "ltx"
        ), name
    assert "过曝" in resolve("generate", {"generator": "wan-14b"}).source.negative_prompt
    told = resolve("generate", {"generator": "wan-14b", "negative_prompt": ""})
    assert told.source.negative_prompt == ""


def test_events_of_a_learned_model_have_the_size_of_its_video_unless_a_sensor_is_named():
    assert resolve("generate", {"generator": "wan-1.3b"}).size is None
    assert resolve("generate", {}).size == (346, 260)
    named = resolve("generate", {"generator": "wan-1.3b", "sensor": "davis240c"})
    assert named.size == (240, 180)


def test_hub_repositories_and_folders_are_generators(tmp_path, monkeypatch):
    part = GENERATORS.load("hub:someone/their-model@v2")
    assert (part.model.repo, part.model.revision, part.model.fps) == (
        "someone/their-model",
        "v2",
        None,
    )
    folder = GENERATORS.load("./my-model")
    assert folder.model.folder == Path("my-model")
    assert not folder.model.repo
    with pytest.raises(ConfigError, match=r"generator '\./my-model' is no folder"):
        _ = folder(folder.config_type(), seed=0, size=None).fps
    monkeypatch.chdir(tmp_path)
    (tmp_path / "plain").mkdir()
    with pytest.raises(ConfigError, match="unknown generator 'plain'"):
        GENERATORS.load("plain")
    (tmp_path / "plain/model_index.json").touch()
    assert GENERATORS.load("plain").model.folder == Path("plain")


@pytest.mark.parametrize("name", ["hub:name", "hub:../x", "hub:a/b--c"])
def test_what_is_no_repository_is_refused(name):
    with pytest.raises(ConfigError, match="write hub:organisation/name"):
        GENERATORS.load(name)


def test_a_copy_of_a_known_model_keeps_its_facts():
    part = GENERATORS.load("./models/Wan2.1-T2V-1.3B-Diffusers")
    assert part.config_type().fps == Fraction(16)
    mirror = GENERATORS.load("hub:mirror/CogVideoX-2b")
    assert mirror.config_type().fps == 8
    assert mirror.model.repo == "mirror/CogVideoX-2b"


def test_a_model_that_is_steered_takes_its_own_first_control_if_none_is_named():
    models = {name: GENERATORS.load(name) for name in GENERATORS.names()}
    steered = {
        name: one for name, one in models.items() if hasattr(one, "model") and one.model.steering
    }
    firsts = {name: one.model.steering.controls[0] for name, one in steered.items()}
    assert {name: one.config_type().control for name, one in steered.items()} == firsts != {}


def test_minutes_and_downloads_of_a_row_have_a_source_and_are_told():
    for row in known_models.MODELS.values():
        known = bool(row.minutes) or row.download_gb is not None or row.lora_gb is not None
        assert known == bool(row.cost_source), row.name
        assert ("not known" in row.cost) == (not row.minutes or row.download_gb is None)
    assert "time about 4 min on RTX 4090" in known_models.MODELS["wan-1.3b"].cost
