"""Arrangements of things that placement makes and the check of relations expects."""

from __future__ import annotations

from collections.abc import Sequence

from texvent_scenes.models.nouns import NOUNS
from texvent_scenes.models.tables import nouns_with
from texvent_scenes.spec.scene import Motion
from texvent_scenes.staging.placement.zones import zone_of
from texvent_scenes.staging.tracks.phases import PATH_KINDS


def hangs_on(noun: str, target: str) -> bool:
    """Whether what is on another thing hangs on its face, as a clock does on a wall."""
    return noun in nouns_with("hangs on a wall") and target in nouns_with("only a background")


def are_driven(*nouns: str) -> bool:
    """Whether all are vehicles of the road."""
    return all(one in NOUNS and zone_of(NOUNS[one]) == "road" for one in nouns)


def ends_at_rest(motions: Sequence[Motion]) -> bool:
    """Whether a body that goes comes to rest in the end: it brakes or stops there."""
    goes = any(one.kind in PATH_KINDS for one in motions)
    return goes and (motions[-1].end_pace == 0.0 or motions[-1].kind == "stand")
