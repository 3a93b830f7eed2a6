"""A preset finds its simulator, or the message names the two together."""

import pytest

import texvent
from texvent.cli.app import main
from texvent.errors import ConfigError
from texvent.settings.presets import find_preset, preset_help, presets_by_simulator
from texvent.settings.resolution import resolve


def test_a_preset_of_one_simulator_alone_finds_it(tmp_path):
    run = resolve("simulate", {"preset": "evk4"}).run
    assert (run.simulator, run.preset) == ("physical", "evk4")
    config = tmp_path / "run.toml"
    config.write_text("preset = 'noisy'", encoding="utf-8")
    assert resolve("generate", {}, config=config).run.simulator == "v2e"


def test_a_preset_of_the_default_simulator_is_its_own():
    default, *_ = presets_by_simulator()
    for preset in texvent.presets(default):
        assert find_preset(None, preset) == (default, preset)


@pytest.mark.parametrize(
    ("options", "said"),
    [
        (
            {"simulator": "esim", "preset": "evk4"},
            "simulator 'esim' has no preset 'evk4'; give simulator='physical', preset='evk4'",
        ),
        (
            {"preset": "davis346"},
            "several simulators have a preset 'davis346'; "
            "give simulator='physical' or simulator='voltmeter'",
        ),
        ({"preset": "evk5"}, "no simulator has a preset 'evk5'; .*did you mean 'evk4'"),
        ({"preset": "clena", "simulator": "physical"}, "'clena'; .*did you mean 'clean'"),
        ({"preset": "EVK4"}, "did you mean 'evk4'"),
        ({"preset": 3}, "no simulator has a preset 3"),
    ],
)
def test_a_preset_that_is_not_found_names_what_is(options, said):
    with pytest.raises(ConfigError, match=said):
        resolve("simulate", options)


def test_commands_say_the_model_and_name_options(tmp_path, monkeypatch, capsys):
    monkeypatch.chdir(tmp_path)
    words = ["generate", "a red ball bounces", "--sensor", "32x24", "--duration", "0.1"]
    words += ["--previews", "none", "-o", "a.h5"]
    assert main([*words, "--preset", "evk4", "--simulator", "texvent"]) == 2
    assert "; give --simulator physical, --preset evk4\n" in capsys.readouterr().err
    assert main([*words, "--preset", "evk4", "--print-config"]) == 0
    assert 'simulator = "physical"\n' in capsys.readouterr().out


@pytest.mark.parametrize("page", [("all",), ("run",)])
def test_help_lists_the_presets_of_each_simulator(page, capsys, monkeypatch):
    monkeypatch.setenv("COLUMNS", "80")
    assert main(["simulate", "--help", *page]) == 0
    said = " ".join(capsys.readouterr().out.split())
    for simulator, presets in preset_help().items():
        assert f" {simulator}: {', '.join(presets)}" in said
    assert " senpi: default*, peer-common*, where * depends" in said
