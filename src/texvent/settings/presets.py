"""Presets by name: each is one of a simulator's, and finds it where no simulator is named."""

from __future__ import annotations

from texvent._registry import SIMULATORS, suggest
from texvent.config import RunConfig
from texvent.errors import ConfigError, shown


def presets_by_simulator() -> dict[str, tuple[str, ...]]:
    """Names of the presets of every simulator that ships with texvent; its default is the first."""
    return {name: tuple(SIMULATORS.load(name).presets) for name in SIMULATORS.builtin}


def frame_bound_presets() -> set[tuple[str, str]]:
    """(simulator, preset) whose published definition makes events depend on the frame rate."""
    return {
        (name, preset)
        for name in SIMULATORS.builtin
        for preset in getattr(SIMULATORS.load(name), "frame_bound_presets", ())
    }


def preset_help() -> dict[str, tuple[str, ...]]:
    """Rows of `--help`: simulator → presets, `*` behind those that depend on the frame rate."""
    bound = frame_bound_presets()
    rows = {
        name: tuple(one + "*" * ((name, one) in bound) for one in presets)
        for name, presets in presets_by_simulator().items()
    }
    *_, last = (name for name, presets in rows.items() if any("*" in one for one in presets))
    rows[last] += ("where * depends on the frame rate, by definition",)
    return rows


def find_preset(simulator: str | None, preset: str | None) -> tuple[str, str]:
    """The simulator and the preset of a run.

    Args:
        simulator: as the user names it; None: the default one, or that which alone has the preset.
        preset: as the user names it; None: the simulator's first.

    Raises:
        ConfigError: there is no such simulator or preset, or it is that of others.

    Example:
        >>> find_preset(None, "evk4"), find_preset("esim", None)
        (('physical', 'evk4'), ('esim', 'default'))
    """
    chosen = RunConfig.simulator if simulator is None else simulator
    own = tuple(SIMULATORS.load(chosen).presets)
    if preset is None:
        return chosen, own[0]
    if preset in own:
        return chosen, preset
    others = presets_by_simulator()
    owners = [name for name, presets in others.items() if preset in presets]
    if simulator is None and len(owners) == 1:
        return owners[0], preset
    if owners:
        whose = f"simulator {shown(chosen)} has no preset {shown(preset)}"
        if simulator is None:
            whose = f"several simulators have a preset {shown(preset)}"
        named = " or ".join(f"simulator='{name}'" for name in owners)
        whole = f", preset='{preset}'" if len(owners) == 1 else ""
        raise ConfigError(f"{whose}; give {named}{whole}")
    if simulator is None:
        allowed = tuple(dict.fromkeys(name for presets in others.values() for name in presets))
        raise ConfigError(f"no simulator has a preset {shown(preset)}; {suggest(preset, allowed)}")
    raise ConfigError(
        f"simulator {shown(chosen)} has no preset {shown(preset)}; {suggest(preset, own)}"
    )
