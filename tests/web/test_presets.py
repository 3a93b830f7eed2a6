"""What the web page chooses unless the visitor does."""

import pytest

import texvent
from texvent.config import RunConfig
from texvent.errors import ConfigError
from texvent.settings.resolution import resolve
from texvent.web.gradio_page import NO_SENSOR, _options, _presets

FIRST = (RunConfig.simulator, _presets(RunConfig.simulator)[0], NO_SENSOR)


def test_the_first_choices_are_the_defaults_of_the_command_line():
    assert resolve("simulate", _options(*FIRST, 0)) == resolve("simulate", {})
    scene = {"generator": "procedural", "duration": 1.0}
    assert resolve("generate", _options(*FIRST, 0, **scene)) == resolve("generate", scene)
    for simulator in texvent.simulators():
        assert _presets(simulator) == list(texvent.presets(simulator))


@pytest.mark.parametrize(("seconds", "seed", "name"), [(None, 0, "duration"), (1.0, None, "seed")])
def test_an_empty_field_is_refused_by_name(seconds, seed, name):
    with pytest.raises(ConfigError, match=f"{name} is empty"):
        _options(*FIRST, seed, duration=seconds)
