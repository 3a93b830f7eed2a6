"""One node per pixel model, with its options: made from the models' dataclasses."""

from __future__ import annotations

from typing import Any

from texvent._registry import SIMULATORS, suggest
from texvent.errors import ConfigError, shown

from .widgets import widgets, with_values

CATEGORY = "texvent"
MODEL = "TEXVENT_MODEL"


class PixelModelNode:
    """Base of the nodes: gives the name of a model, its preset and its options.

    There is no `VALIDATE_INPUTS`: ComfyUI checks types and ranges of single inputs, and would
    repeat the message of one that sees all of them for every input. What is left is refused when
    the node runs, which is before the simulation.
    """

    CATEGORY = f"{CATEGORY}/pixel models"
    RETURN_TYPES = (MODEL,)
    RETURN_NAMES = ("model",)
    FUNCTION = "choose"
    simulator: str

    @classmethod
    def presets(cls) -> Any:
        """Name → config; the first is the default."""
        return SIMULATORS.load(cls.simulator).presets

    @classmethod
    def INPUT_TYPES(cls) -> dict[str, Any]:  # noqa: N802  (ComfyUI's name)
        """A preset, and every option with the first preset's value."""
        presets = cls.presets()
        text = "Options that stay as they are shown at first take their values from the preset."
        preset = (list(presets), {"default": next(iter(presets)), "tooltip": text})
        return {"required": {"preset": preset, **widgets(next(iter(presets.values())))}}

    def choose(self, **values: Any) -> tuple[dict[str, Any]]:
        """The options for `texvent.simulate`."""
        return (self.options(**values),)

    @classmethod
    def options(cls, preset: str | None = None, **values: Any) -> dict[str, Any]:
        """Simulator, preset and the options that were changed.

        Raises:
            ConfigError: a value of the wrong type, or out of range.
        """
        presets = cls.presets()
        preset = preset or next(iter(presets))
        if preset not in presets:
            raise ConfigError(f"preset is {shown(preset)}; {suggest(preset, tuple(presets))}")
        first = {name: one[1]["default"] for name, one in cls.INPUT_TYPES()["required"].items()}
        changed = {name: value for name, value in values.items() if value != first[name]}
        config = with_values(presets[preset], changed, where=f"pixel model {cls.simulator}")
        options = {name: getattr(config, name) for name in changed}
        given = {name: value for name, value in options.items() if value is not None}
        return {"simulator": cls.simulator, "preset": preset, **given}


def model_nodes() -> list[type[PixelModelNode]]:
    """A node class per pixel model that texvent brings."""
    return [
        type(
            f"TexventModel{name.capitalize()}",
            (PixelModelNode,),
            {
                "simulator": name,
                "TITLE": f"Pixel model: {name}",
                "DESCRIPTION": f"Options of texvent's pixel model {name}.",
                "__doc__": f"Options of the pixel model {name}.",
            },
        )
        for name in SIMULATORS.builtin
    ]
