"""Postures of a body: channels of its activity, of the steps below it, and of limbs that are held.

A posture is the value of every channel that a skeleton follows. People, hands and animals have
theirs from the rows of a table of activities.
"""

from __future__ import annotations

from dataclasses import dataclass, replace
from functools import cache, cached_property

from texvent_scenes.models.activities import USUAL, motion_of
from texvent_scenes.models.channel_track import (
    ChannelTrack,
    Values,
    blend,
    ease,
    flattened,
    read_track,
)
from texvent_scenes.models.gait import Steps, Walk
from texvent_scenes.models.limbs import Limb
from texvent_scenes.models.protocol import Pose
from texvent_scenes.models.tables import read_table

_OWN_TIME = frozenset({"is_hop", "is_timed"})
"""Keys of a row that follows the time since it began."""


@dataclass(frozen=True)
class Postures:
    """Postures of bodies that follow the rows of a table; lengths in m, angles in rad."""

    table: str
    """File of `data`: `activities`, `hand_gestures` or `animal_activities`."""
    limbs: tuple[Limb, ...] = ()
    walk: Walk | None = None

    @cached_property
    def standing(self) -> Values:
        """Channels of a body that stands: the usual row."""
        return self._complete(find_track(self.table, USUAL).at(0.0))

    def at(self, pose: Pose, seed: int) -> Values:
        """All channels at an instant: of an activity, or between two."""
        found = self._hold(self._act(pose, seed), pose)
        if pose.before is None:
            return found
        earlier = replace(pose, activity=pose.before)
        return blend(self._hold(self._act(earlier, seed), pose), found, pose.share)

    def find_channels(self, pose: Pose, seed: int) -> dict[str, float]:
        """All channels at an instant, one number each."""
        return flattened(self.at(pose, seed))

    def _hold(self, posture: Values, pose: Pose) -> Values:
        """The posture with the places where the pose holds the body."""
        ends = {limb.name: limb for limb in self.limbs} if pose.grips else {}
        for name, (x, y, z) in pose.grips:
            limb = ends.get(name)
            if limb is None:
                posture = {**posture, name: (x, y, z)}
            else:
                bend = posture[f"{limb.channels}.bend"]
                posture = {**posture, **limb.at((x, limb.side * y, z), bend)}
        return posture

    def _act(self, pose: Pose, seed: int) -> Values:
        activity = pose.activity
        steps = self.walk.steps(pose, seed) if self.walk is not None else None
        base = self._step(steps)
        row = read_table(self.table).get(activity)
        act_s = pose.act_s if row and "contact_s" in row else None
        if row is None and " and " in activity:  # "sit on ground and read"
            seat, _, activity = activity.partition(" and ")
            base = {**_fill(self._follow(seat, pose.time_s), base), "look": (0.0,)}
        time_s = (pose.act_s or 0.0) if row and (row.keys() & _OWN_TIME) else pose.time_s
        posture = _fill(self._follow(activity, time_s, act_s), base)
        if act_s is not None and steps is not None and steps.amount > 0.0:
            posture = blend(base, posture, ease(act_s, -0.50, -0.20))
        return posture

    def _step(self, steps: Steps | None) -> Values:
        """Standing, or stepping as far as the gait has it."""
        if steps is None or steps.gait.motion is None or not steps.amount:
            return self.standing
        values, moving = find_track(self.table, USUAL).at(0.0), steps.gait.motion.at(steps.strides)
        both = [name for name in moving if name in values]
        here: Values = {name: values[name] for name in both}
        there: Values = {name: moving[name] for name in both}
        return self._complete({**values, **moving, **blend(here, there, steps.amount)}, steps)

    def _follow(self, activity: str, time_s: float, act_s: float | None = None) -> Values:
        """Channels that a row decides, of limbs all or none.

        Args:
            activity: name of the row.
            time_s: time since it began, s.
            act_s: time since its instant of contact, if it happens once, s.
        """
        track = find_track(self.table, activity)
        if act_s is not None:
            return self._complete(track.at(act_s, once=True))
        contact_s = read_table(self.table).get(activity, {}).get("contact_s", 0.0)
        return self._complete(track.at(time_s - contact_s))

    def _complete(self, values: Values, steps: Steps | None = None) -> Values:
        """Channels with those of limbs as `limbs.Limb` has them."""
        if not (self.limbs and values):
            return values
        found = {n: numbers for n, numbers in values.items() if "." not in n or n.endswith("tool")}
        for limb in self.limbs:
            found |= limb.posture(values, steps)
        return found


def _fill(posture: Values, base: Values) -> Values:
    """A posture whose open channels are those of `base`; leans add up where its hips are open."""
    if "lean" not in base:
        return {**base, **posture}
    below = 0.0 if "hips" in posture else base["lean"][0]
    return {**base, **posture, "lean": (posture.get("lean", (0.0,))[0] + below,)}


@cache
def find_track(table: str, activity: str) -> ChannelTrack:
    """Track of the channels of a row."""
    return read_track(motion_of(table, activity))


@cache
def list_channels(table: str) -> frozenset[str]:
    """All channels of a table of activities."""
    tracks = (find_track(table, activity) for activity in read_table(table))
    return frozenset(name for track in tracks for name in flattened(track.at(0.0)))
