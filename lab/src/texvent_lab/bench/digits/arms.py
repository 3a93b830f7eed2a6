"""What is compared: pixel models, two ways of giving them frames, three choices of a threshold."""

from __future__ import annotations

import dataclasses
import hashlib
import json
from collections.abc import Mapping
from dataclasses import dataclass
from pathlib import Path
from types import MappingProxyType
from typing import Any, Literal, TypeAlias, get_args

from texvent import __version__
from texvent.errors import ConfigError, shown
from texvent.extending import full_version, suggest
from texvent.runtime.cache_folder import make_folder
from texvent.settings.resolution import Settings, resolve
from texvent.simulate.model_options import with_contrast_threshold
from texvent_lab.bench.document import read_document, write_document

Way: TypeAlias = Literal["exact", "flow", "frames"]
"""What a model is given: true frames, 1,020 per second; 60 frames per second and what the pipeline
interpolates between them; or those alone."""
Choice: TypeAlias = Literal["matched", "default", "random"]
"""How its threshold is chosen: as many events as real recordings have; as the preset has it; drawn
for every sheet of digits, with its noise."""
CHOICES: tuple[Choice, ...] = get_args(Choice)
WAYS: tuple[Way, ...] = ("exact", "flow")
"""Those that can be left out."""
BETWEEN = 16
"""True frames between two of the display."""
WAY_OPTIONS: Mapping[Way, Mapping[str, Any]] = {
    "exact": {"interpolate": "exact", "fixed_count": BETWEEN},
    "flow": {"interpolate": "flow"},
    "frames": {"interpolate": "none"},
}


@dataclass(frozen=True)
class Arm:
    """A pixel model with options."""

    name: str
    options: Mapping[str, Any]
    ways: tuple[Way, ...] = ("exact", "flow")
    choices: tuple[Choice, ...] = CHOICES
    is_fitted: bool = False
    """Whether options are fitted to the pairs; see `pair_fit`."""

    def settings(
        self,
        way: Way,
        *,
        threshold: float | None = None,
        fitted: Mapping[str, float] = MappingProxyType({}),
    ) -> Settings:
        """Options of a run.

        Args:
            way: what the model is given.
            threshold: contrast threshold, log units; None leaves the one of the options.
            fitted: options that replace the arm's.
        """
        settings = resolve("simulate", {**self.options, **WAY_OPTIONS[way], **fitted})
        if threshold is None:
            return settings
        simulate = with_contrast_threshold(settings.simulate, threshold)
        return dataclasses.replace(settings, simulate=simulate)


_PAPER = {"simulator": "texvent", "preset": "paper"}
ARMS: tuple[Arm, ...] = (
    Arm("texvent accurate", {"simulator": "texvent", "preset": "accurate"}),
    Arm("texvent paper", _PAPER),
    Arm("physical", {"simulator": "physical"}),
    Arm("esim", {"simulator": "esim"}),
    Arm("v2e", {"simulator": "v2e"}),
    Arm("v2e noisy", {"simulator": "v2e", "preset": "noisy"}),
    Arm("voltmeter", {"simulator": "voltmeter"}),
    Arm("senpi", {"simulator": "senpi"}),
    Arm(
        "physical fitted",
        {"simulator": "physical"},
        ways=("exact",),
        choices=("matched",),
        is_fitted=True,
    ),
    Arm("E1: no balance", {**_PAPER, "balance": 0.001}, choices=("matched",)),
    Arm("E4: no cache", {**_PAPER, "cache": "none"}, choices=("matched",)),
    Arm("E9: no noise", {**_PAPER, "noise": "none"}, choices=("matched",)),
    Arm(
        "physical, no noise",
        {"simulator": "physical", "noise_scale": 0.0, "leak_rate_hz": 0.0},
        ways=("exact",),
        choices=("matched",),
    ),
    Arm("E12: random times", {**_PAPER, "timestamp_rule": "random"}, choices=("matched",)),
    Arm("E6: no interpolation", _PAPER, ways=("frames",), choices=("matched",)),
    Arm(
        "frame difference",
        {**_PAPER, "cache": "none", "noise": "none", "timestamp_rule": "end"},
        ways=("frames",),
    ),
)
"""E1 .. E12 are the paper's ablations (docs/ablations.md). The frame difference is the simplest
model: an event where ln(30 + I) of two frames differs by the threshold, at the later frame."""


def find_arm(name: str) -> Arm:
    """The arm called `name`.

    Raises:
        ConfigError: none is.
    """
    for arm in ARMS:
        if arm.name == name:
            return arm
    names = tuple(arm.name for arm in ARMS)
    raise ConfigError(f"unknown arm {shown(name)}; {suggest(name, names, longest=400)}")


@dataclass(frozen=True)
class Cell:
    """One set of simulated recordings."""

    arm: str
    way: Way
    choice: Choice

    @property
    def name(self) -> str:
        """How progress calls it."""
        return f"{self.arm}, {self.way}, {self.choice}"


PROTOCOL = 2
"""Part of every digest: raise it when a step computes something else from the same config."""
DIGITS = 20
"""Of a digest, hexadecimal."""


def digest_of(*values: Any) -> str:
    """A name for plain values and bytes."""
    found = hashlib.sha256()
    for value in values:
        content = value if isinstance(value, bytes) else json.dumps(value, sort_keys=True).encode()
        found.update(hashlib.sha256(content).digest())
    return found.hexdigest()[:DIGITS]


@dataclass(frozen=True)
class Step:
    """A result, made or to be made."""

    folder: Path
    kind: str
    """What it is, such as "sets"; a folder of that name holds it."""
    config: Mapping[str, Any]
    """All that it depends on, beside the release of texvent and `PROTOCOL`."""

    @property
    def digest(self) -> str:
        """Its name."""
        return digest_of(__version__, PROTOCOL, self.kind, self.config)

    def path(self, extension: str) -> Path:
        """Its file."""
        return self.folder / self.kind / f"{self.digest}{extension}"

    @property
    def is_done(self) -> bool:
        """Whether its values were written, which comes last."""
        return self.path(".json").is_file()

    def write(self, values: Mapping[str, Any]) -> None:
        """Write its values."""
        make_folder(self.path("").parent)
        document = {"version": full_version(), "config": self.config, **values}
        write_document(self.path(".json"), document, overwrite=True)

    def read(self) -> dict[str, Any]:
        """Its values."""
        return read_document(self.path(".json"))
