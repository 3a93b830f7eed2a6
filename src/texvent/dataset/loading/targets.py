"""Targets of training: the ground truth of a sample as arrays, whole or slice by slice."""

from __future__ import annotations

from collections.abc import Sequence
from typing import Any

import numpy as np
from numpy.typing import NDArray

from texvent._registry import suggest
from texvent.dataset.loading.index import MEMBERS, Index
from texvent.errors import ConfigError, InputError, shown
from texvent.truth.boxes import detection_target
from texvent.truth.clip import ClipTruth
from texvent.truth.layout import CLIP_FILES

TARGETS = ("boxes", "flow", "depth")


def check_targets(targets: Sequence[str], index: Index, *, has_augment: bool) -> None:
    """Refuse targets that samples do not store, or that an augmentation would leave behind.

    Raises:
        ConfigError, InputError: see above.
    """
    for target in targets:
        if target not in TARGETS:
            raise ConfigError(f"unknown target {shown(target)}; {suggest(target, TARGETS)}")
        places = index.members[:, MEMBERS.index(CLIP_FILES[target][0]), 0]
        lacking = int((places < 0).sum())
        if lacking:
            raise InputError(
                f"{lacking:,} of {len(index):,} samples store no {target}; name {target} in "
                "`truth` of the specification, and make the data set again"
            )
    if targets and has_augment:
        raise ConfigError(
            "augment changes the events, and targets stay where they are; leave one of them out, "
            "and change both in the training loop"
        )


def targets_of(
    truth: ClipTruth, targets: Sequence[str], windows: Sequence[tuple[int, int]] | None
) -> dict[str, Any]:
    """The targets of a sample by name; `StoredSamples.make` describes them.

    Args:
        truth: of the sample.
        targets: names of `TARGETS`.
        windows: of its slices, µs; None: it is one piece.
    """
    found: dict[str, Any] = {}
    for name in targets:
        times, values = _timed(truth, name)
        if windows is None:
            found[name] = detection_target(values) if name == "boxes" else values
            continue
        parts = [values[(times > start) & (times <= stop)] for start, stop in windows]
        found[name] = tuple(map(detection_target, parts) if name == "boxes" else parts)
    return found


def _timed(truth: ClipTruth, target: str) -> tuple[NDArray[np.int64], NDArray[Any]]:
    """Times of the values of a target, µs, those of its end for flow, and the values."""
    if target == "boxes":
        return truth.boxes["t"], truth.boxes
    if target == "flow":
        return truth.times_us[1:], np.moveaxis(truth.flow(), -1, 1)
    return truth.times_us, truth.depth()
