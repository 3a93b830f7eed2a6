"""Gaits: cycles of steps in which a foot on the ground does not slide."""

from __future__ import annotations

import math
from collections.abc import Mapping
from dataclasses import dataclass
from typing import Any

from texvent_scenes.models.channel_track import ChannelTrack, read_track
from texvent_scenes.models.protocol import Pose, fraction
from texvent_scenes.models.tables import read_table

TROT_FROUDE = 2.5
"""Froude number, speed² / (g · height of the hips), up to which four-footed animals trot, and from
which on they gallop (R. McN. Alexander and A. S. Jayes 1983, Journal of Zoology 201)."""


@dataclass(frozen=True)
class Gait:
    """A cycle of steps as a function of the distance travelled."""

    stride: float
    """Distance of one whole cycle, m."""
    duty: float
    """Share of the cycle that a foot stays on the ground."""
    lift: float
    """Height of a foot in mid-swing, m."""
    full_share: float = 0.35
    """Strides a second, in strides of the walk, from which on steps are full; 0 = they always are.
    """
    motion: ChannelTrack | None = None
    """Channels of a body whose steps are full, over strides in place of time."""


@dataclass(frozen=True)
class Steps:
    """Phase of a body in its cycle of steps at one instant."""

    gait: Gait
    strides: float
    amount: float
    """Amplitude of its steps, 0 to 1."""
    name: str = "walk"
    """Activity whose gait it is, such as "run"."""


def foot_path(steps: Steps, lead: float) -> tuple[float, float]:
    """Place of a foot, relative to the point on the ground below its hip.

    On the ground the foot moves back exactly as fast as the body moves forward, so it does not
    slide; then it swings forward in an arc.

    Args:
        steps: gait and phase of the body.
        lead: share of a cycle by which this foot is ahead.

    Returns:
        Its x and its height, m.
    """
    gait, amount = steps.gait, steps.amount
    phase = (steps.strides + lead) % 1.0
    half_step = 0.5 * gait.duty * gait.stride
    if phase < gait.duty:
        return amount * (half_step - phase * gait.stride), 0.0
    swing = (phase - gait.duty) / (1.0 - gait.duty)
    eased = swing * swing * (3.0 - 2.0 * swing)
    rise = math.sin(math.pi * swing)
    return amount * half_step * (2.0 * eased - 1.0), amount * gait.lift * rise * rise


def step_amount(activity: str, speed: float, full_speed: float) -> float:
    """Amplitude of steps: 0 while a body stands or sits, 1 from `full_speed` (m/s) on."""
    if activity in ("stand", "sit", "lie"):
        return 0.0
    share = min(1.0, max(0.0, speed / full_speed)) if full_speed else 1.0
    return share * share * (3.0 - 2.0 * share)


@dataclass(frozen=True)
class Walk:
    """Gaits of a body."""

    gaits: Mapping[str, Gait]
    """Activity → gait; the first is that of all others."""
    full_m_s: float
    """Speed from which on steps are full, except those that always are, m/s."""
    usual: str = ""
    """Gait in which it moves unless told otherwise; "" = the first."""
    starts_by_seed: bool = True
    """Whether the seed chooses where its first stride begins."""

    def steps(self, pose: Pose, seed: int) -> Steps:
        """Its steps at that pose."""
        goes = pose.activity.partition(" and ")[0]  # "walk and wave"
        name = self.usual if self.usual and goes == "move" else goes
        name = "run" if name == "trot" and name not in self.gaits else name
        name = name if name in self.gaits else next(iter(self.gaits))
        gait = self.gaits[name]
        begun = fraction(seed, "step") if self.starts_by_seed else 0.0
        full_m_s = self.full_m_s if gait.full_share else 0.0
        amount = step_amount(goes, pose.speed_m_s, full_m_s)
        return Steps(gait, pose.distance_m / gait.stride + begun, amount, name)


def read_walk(table: Mapping[str, Any]) -> Walk | None:
    """The gaits of a noun's table, if it walks: `gait`, and `run` and `trot` where those differ.

    One that `runs` does so whatever it does.
    """
    if "gait" not in table:
        return None
    walk = Gait(**table["gait"])
    run = Gait(**table["run"]) if "run" in table else walk
    gaits = {"run": run} if table.get("runs", False) else {"walk": walk, "run": run}
    gaits |= {"trot": Gait(**table["trot"])} if "trot" in table else {}
    return Walk(gaits, walk.full_share * walk.stride)


def read_gaits(table: str, usual: str) -> Walk:
    """The gaits of a table of activities: rows with `gait`, and their channels in `steps`."""
    gaits = {
        activity: Gait(**row["gait"], motion=read_track(row["steps"]))
        for activity, row in read_table(table).items()
        if "gait" in row
    }
    first = next(iter(gaits.values()))
    return Walk(gaits, first.full_share * first.stride, usual, starts_by_seed=False)
