"""Names of parts: found, suggested, and added by other packages."""

import pytest

import texvent
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


def test_another_package_adds_a_part_but_cannot_replace_one(install):
    points = (
        "[texvent.interpolators]\nhold = extra_parts:Hold\nblend = extra_parts:Blend\n"
        "[texvent.event_formats]\nmine = extra_parts:Codec\n"
    )
    install("extra-parts", points, extra_parts="class Hold: ...\nclass Codec: ...\n")
    assert INTERPOLATORS.load("hold").__name__ == "Hold"
    assert INTERPOLATORS.load("blend").__module__ == "texvent.interpolate.simple"
    assert "mine" in CODECS.names()


def test_a_missing_package_of_texvents_own_is_left_out_of_lists_and_named(install, monkeypatch):
    install("texvent", "[texvent.interpolators]\nhold = gone.parts:Hold\n")
    monkeypatch.setitem(texvent._HOME_OF, "hold", "gone.parts")
    said = "the package gone, a part of texvent, is missing; install it anew: .*pip install"
    assert "hold" not in INTERPOLATORS.names()
    with pytest.raises(MissingDependencyError, match=f"interpolator 'hold': {said}"):
        INTERPOLATORS.load("hold")
    with pytest.raises(MissingDependencyError, match=rf"texvent\.hold: {said}"):
        texvent.__getattr__("hold")
