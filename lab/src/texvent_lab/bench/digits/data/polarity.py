"""Do recorded events have the sign of the brightness change that their digit makes?"""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np

from texvent.capture.camera_path.saccades import DURATION_US
from texvent.events import EventStream
from texvent_lab.bench.digits.data.sheet import DigitSheet

STEP_US = 5_000
CLEAR = 5.0
"""Levels of 0..255 per step from which a change is clear."""


def polarity_agreement(sheet: DigitSheet, recorded: Sequence[EventStream]) -> float:
    """Share of events that are ON where their digit brightens, or OFF where it darkens.

    Args:
        sheet: digits with the measured motion.
        recorded: their recordings, in the same order; events where the digit changes little do
            not count.

    Returns:
        0..1, NaN without an event that counts. About 0.5 means that recordings do not show these
        digits, less that their polarity is the opposite one.
    """
    events = sheet.lay_out(recorded)
    times = range(0, DURATION_US + 1, STEP_US)
    frames = np.stack([sheet.at(t_us).pixels for t_us in times])
    change = np.diff(frames, axis=0)
    step = events.t // STEP_US
    is_inside = (step >= 0) & (step < len(change))
    events, step = events[is_inside], step[is_inside]
    seen = change[step, events.y, events.x]
    is_clear = np.abs(seen) > CLEAR
    return float(((seen > 0) == (events.p == 1))[is_clear].mean()) if is_clear.any() else np.nan
