"""EQS: the event quality score, which is LFS with RVT's trained backbone."""

from __future__ import annotations

from dataclasses import dataclass
from pathlib import Path

from texvent.errors import ConfigError
from texvent.events import EventStream
from texvent.metrics.protocol import Metric
from texvent.metrics.rvt.latent_similarity import LatentSimilarity
from texvent.metrics.rvt.network import RvtBackbone
from texvent.metrics.rvt.weights import WHERE_FROM, read_rvt_weights


@dataclass(frozen=True, kw_only=True)
class EventQualityScore(Metric):
    """Mean cosine of 3×3 patches of RVT's features, over stages 1-3 and windows of 50 ms.

    Never read it without the scores of its controls (`metrics.controls`): it barely sees
    time, and rewards noise.

    Source: K. Chanda et al., "Event quality score (EQS): assessing the realism of simulated event
        camera streams via distances in latent space" (CVPR workshops 2025).
    Deviation: the paper publishes neither code nor which RVT it used, does not say how patches lie,
        and pads images without saying what becomes of the padding. Here patches do not overlap,
        and the padding's features are left out.
    """

    name = "eqs"
    better = "higher"
    range = (-1.0, 1.0)
    blind_to = "small time errors; added noise can improve it: see its controls"

    backbone: RvtBackbone | None = None
    """RVT's backbone with published weights; see `load_eqs`."""

    def missing(self) -> str | None:
        """As `Metric.missing`."""
        if self.backbone is not None:
            return None
        return f"it needs RVT's weights, pass --rvt-weights FILE; {WHERE_FROM}"

    def _score(self, predicted: EventStream, reference: EventStream) -> float:
        if self.backbone is None:
            raise ConfigError(f"metric eqs cannot be computed: {self.missing()}")
        return LatentSimilarity(backbone=self.backbone)(predicted, reference)


def load_eqs(path: Path) -> EventQualityScore:
    """EQS with the weights of a published checkpoint.

    Raises:
        InputError: there is no such file.
        FileFormatError: it does not hold RVT's backbone.
        MissingDependencyError: torch is not installed.
    """
    return EventQualityScore(backbone=RvtBackbone(read_rvt_weights(path)))
