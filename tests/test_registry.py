"""Names of parts: found, suggested, and added by other packages."""

import pytest

from texvent import _registry
from texvent._registry import CODECS, INTERPOLATORS, REGISTRIES, SIMULATORS, load_object
from texvent.errors import ConfigError


@pytest.mark.parametrize("kind", REGISTRIES)
def test_every_name_that_ships_leads_to_something(kind):
    for target in REGISTRIES[kind].shipped().values():
        assert load_object(target) is not None


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
