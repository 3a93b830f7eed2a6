"""Of two places that set an option, the one that the documentation names later wins."""

import itertools
import warnings
from collections.abc import Iterable, Iterator, Mapping, Sequence
from pathlib import Path
from typing import Any, TypeAlias

import pytest
import tomli_w

from texvent._registry import GENERATORS, SIMULATORS
from texvent.cli.command import resolve_command
from texvent.cli.option_types import Option, declared_options, flag_of
from texvent.cli.simulation.simulate import VideoOptions
from texvent.config import CaptureConfig, InterpolateConfig
from texvent.errors import ConfigError, TexventWarning
from texvent.options.values import option_names, plain, with_options
from texvent.settings.resolution import Settings, resolve

PLACES = ("sensor", "config", "given", "flags")
"""Weakest first, after defaults and preset; the last two are keywords and a command line."""
LEFT_OUT = ("simulator", "preset", "sensor")
TRIED: Mapping[str, tuple[Any, ...]] = {
    "noise_curve": ("0:1 9:2", "0:2 9:3"),
    "constants": ("5 20 1e-4 1e-7 5e-9 1e-5", "6 20 1e-4 1e-7 5e-9 1e-5"),
    "interpolate": ("none", "blend"),
    "device": ("cpu", "cuda"),
}
NUMBERS = (1, 2, 0, 0.25, 0.5, 16, 33, 720, 768)
Case: TypeAlias = tuple[str, Any, Any]
"""Option, and two values of it: of a weaker place and of a stronger one."""


def configs_of(part: str) -> list[Any]:
    """Configs whose options a simulator or generator has; the first simulator's, all of a run."""
    if part in GENERATORS.shipped():
        return [resolve("generate", {"generator": part}).source]
    settings = resolve("simulate", {"simulator": part})
    is_first = part == next(iter(SIMULATORS.builtin))
    return [
        settings.simulate,
        *((settings.run, InterpolateConfig(), CaptureConfig()) if is_first else ()),
    ]


def values_of(config: Any, option: Option) -> list[Any]:
    """Two values that a config takes for an option, of its default and others."""
    kinds = {bool: (False, True), str: ("a", "b"), Path: ("a", "b")}
    tried = (
        option.default,
        *(option.choices.values() or TRIED.get(option.name) or kinds.get(option.hint, NUMBERS)),
    )
    found: list[Any] = []
    for value in tried:
        try:
            changed = with_options(config, {option.name: value}, where="")
        except ConfigError:
            continue
        plain_value = plain(getattr(changed, option.name))
        if plain_value is not None and plain_value not in found:
            found.append(plain_value)
    return found[:2]


def cases_of(part: str) -> Iterator[tuple[Case, Case]]:
    """Option, and two values of it, in both orders."""
    for config in configs_of(part):
        for option in declared_options(config):
            if option.name not in LEFT_OUT:
                one, other = values_of(config, option)
                yield (option.name, one, other), (option.name, other, one)


def settle(
    folder: Path, part: str, preset: str | None = None, **places: Mapping[str, Any]
) -> Settings:
    """Settings where places hold options."""
    is_prompt = part in GENERATORS.shipped()
    command = "generate" if is_prompt else "simulate"
    options: dict[str, Any] = {"generator" if is_prompt else "simulator": part}
    options |= {} if preset is None else {"preset": preset}
    config = None
    for place in ("sensor", "config"):
        if place in places:
            path = folder / f"{place}.toml"
            path.write_text(tomli_w.dumps(dict(places[place])), encoding="utf-8")
            if place == "sensor":
                options["sensor"] = str(path)
            else:
                config = path
    if "flags" not in places:
        return resolve(command, options | dict(places.get("given", {})), config=config)
    words = [word for name, value in options.items() for word in (flag_of(name), str(value))]
    for name, value in places["flags"].items():
        flag = flag_of(name)
        if isinstance(value, bool):
            words.append(flag if value else f"--no-{flag[2:]}")
        else:
            words += [flag, *(map(str, value) if isinstance(value, list) else [str(value)])]
    words += [] if config is None else ["--config", str(config)]
    subject = VideoOptions(source="clip.mp4")
    return resolve_command(command, [*words, "--", "clip.mp4"], subject, description="")[0]


def values_in(settings: Settings, names: Iterable[str]) -> dict[str, Any]:
    groups = settings.groups().values()
    owners = {
        name: next(one for one in groups if name in option_names(type(one))) for name in names
    }
    return {name: plain(getattr(owner, name)) for name, owner in owners.items()}


def apart(folder: Path, part: str, cases: Sequence[Case]) -> Iterator[Sequence[Case]]:
    """Groups of options that can be given at once, with either of their values."""
    try:
        for rank in (1, 2):
            settle(folder, part, given={case[0]: case[rank] for case in cases})
    except ConfigError:
        assert len(cases) > 1, cases
        half = len(cases) // 2
        yield from (*apart(folder, part, cases[:half]), *apart(folder, part, cases[half:]))
    else:
        yield cases


@pytest.fixture(autouse=True)
def _quiet():
    with warnings.catch_warnings():
        warnings.simplefilter("ignore", TexventWarning)  # of options that others switch off
        yield


@pytest.mark.parametrize("part", [*SIMULATORS.builtin, *GENERATORS.shipped()])
def test_of_two_places_the_stronger_wins_and_the_weaker_beats_defaults(tmp_path, part):
    for both in zip(*cases_of(part), strict=True):
        for tried in apart(tmp_path, part, both):
            weaker, stronger = ({case[0]: case[rank] for case in tried} for rank in (1, 2))
            for weak, strong in itertools.combinations(PLACES, 2):
                if (weak, strong) != ("given", "flags"):
                    found = settle(tmp_path, part, **{weak: weaker, strong: stronger})
                    assert values_in(found, stronger) == stronger, (weak, strong)
            for place in PLACES:
                found = settle(tmp_path, part, **{place: weaker})
                assert values_in(found, weaker) == weaker, place


@pytest.mark.parametrize(
    ("simulator", "preset"),
    [(one, name) for one in SIMULATORS.builtin for name in SIMULATORS.load(one).presets],
)
def test_every_place_beats_the_preset_and_leaves_its_other_options(tmp_path, simulator, preset):
    chosen = SIMULATORS.load(simulator).presets[preset]
    assert settle(tmp_path, simulator, preset).simulate == chosen
    for option in declared_options(chosen):
        others = [one for one in values_of(chosen, option) if one != plain(option.default)]
        for value, place in itertools.product(others[:1], PLACES):
            found = settle(tmp_path, simulator, preset, **{place: {option.name: value}}).simulate
            expected = with_options(chosen, {option.name: value}, where="")
            assert found == expected, (option.name, place)


def test_none_as_a_word_beats_the_config_file_and_none_in_python_is_not_given(tmp_path):
    path = tmp_path / "c.toml"
    path.write_text("stop = 0.5", encoding="utf-8")
    words = ["--config", str(path), "--stop", "none", "--", "clip.mp4"]
    subject = VideoOptions(source="clip.mp4")
    said = resolve_command("simulate", words, subject, description="")[0]
    assert values_in(said, ["stop"]) == {"stop": None}
    assert values_in(resolve("simulate", {"stop": None}, config=path), ["stop"]) == {"stop": 0.5}


@pytest.mark.parametrize("place", ["nowhere", "config", "given"])
def test_vectors_beside_the_frames_are_followed_where_no_others_are_named(tmp_path, place):
    path, given = tmp_path / "run.toml", {"motion": "named.npy"} if place == "given" else {}
    path.write_text('motion = "named.npy"\n' if place == "config" else "")
    settings = resolve("simulate", given, config=path, motion_beside=Path("beside.npy"))
    assert settings.source.motion == Path("beside.npy" if place == "nowhere" else "named.npy")
    assert settings.interpolate.interpolate == "motion"
