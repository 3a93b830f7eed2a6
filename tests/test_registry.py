"""Names of parts: found, suggested, and added by other packages."""

import pytest

import texvent
from texvent import _registry
from texvent._registry import CODECS, INTERPOLATORS, REGISTRIES, SIMULATORS, load_object
from texvent.errors import ConfigError, MissingDependencyError
from texvent.event_methods import METHODS


@pytest.mark.parametrize("kind", REGISTRIES)
def test_every_name_that_ships_leads_to_something(kind):
    for target in REGISTRIES[kind].shipped().values():
        assert load_object(target) is not None


@pytest.mark.parametrize("target", METHODS.values())
def test_every_method_of_events_leads_to_a_function(target):
    assert callable(load_object(target))


def test_an_unknown_name_is_refused_with_the_known_ones():
    with pytest.raises(
        ConfigError, match=r"unknown simulator 'v3e'; allowed: .*did you mean 'v2e'"
    ):
        SIMULATORS.load("v3e")


def test_another_package_adds_a_part_but_cannot_replace_one(tmp_path, monkeypatch):
    info = tmp_path / "extra_parts-1.0.dist-info"
    info.mkdir()
    (info / "METADATA").write_text("Metadata-Version: 2.1\nName: extra-parts\nVersion: 1.0\n")
    (info / "entry_points.txt").write_text(
        "[texvent.interpolators]\nhold = extra_parts:Hold\nblend = extra_parts:Blend\n"
        "[texvent.event_formats]\nmine = extra_parts:Codec\n"
    )
    (tmp_path / "extra_parts.py").write_text("class Hold: ...\nclass Codec: ...\n")
    monkeypatch.syspath_prepend(tmp_path)
    _registry._plugged_in.cache_clear()
    try:
        assert INTERPOLATORS.load("hold").__name__ == "Hold"
        assert INTERPOLATORS.load("blend").__module__ == "texvent.interpolate.simple"
        assert "mine" in CODECS.names()
    finally:
        _registry._plugged_in.cache_clear()


def test_a_missing_package_of_texvents_own_is_left_out_of_lists_and_named(tmp_path, monkeypatch):
    info = tmp_path / "texvent-1.0.dist-info"
    info.mkdir()
    (info / "METADATA").write_text("Metadata-Version: 2.1\nName: texvent\nVersion: 1.0\n")
    (info / "entry_points.txt").write_text("[texvent.interpolators]\nhold = gone.parts:Hold\n")
    monkeypatch.syspath_prepend(tmp_path)
    monkeypatch.setitem(texvent._HOME_OF, "hold", "gone.parts")
    _registry._plugged_in.cache_clear()
    said = "the package gone, a part of texvent, is missing; install it anew: .*pip install"
    try:
        assert "hold" not in INTERPOLATORS.names()
        with pytest.raises(MissingDependencyError, match=f"interpolator 'hold': {said}"):
            INTERPOLATORS.load("hold")
        with pytest.raises(MissingDependencyError, match=rf"texvent\.hold: {said}"):
            texvent.__getattr__("hold")
    finally:
        _registry._plugged_in.cache_clear()
