"""Motions of things and moves of the camera, as fields."""

from __future__ import annotations

from collections.abc import Mapping
from typing import Any, get_args

from texvent_scenes.models.effects import LAMPS
from texvent_scenes.read.draft.abilities import MEANS
from texvent_scenes.read.parsing.lexicon import VerbSense
from texvent_scenes.spec.scene import MoveDirection

_UNTURNED = ("handheld", "static")
_TURNING = ("spin", "roll", "slide")
BLINK_HZ = 2.0
"""Frequency of a lamp of which only is said that it blinks."""


def split_move(phrase: str) -> dict[str, Any]:
    """A move of words.toml, such as "zoom in", as fields of `CameraMove`."""
    kind, _, direction = phrase.partition(" ")
    direction, _, means = direction.partition(" ") if kind == "travel" else (direction, "", "")
    is_turned = direction in (get_args(MoveDirection) if kind not in _UNTURNED else ("all axes",))
    return {
        "kind": kind,
        **({"direction": direction} if is_turned else {}),
        **({"means": means} if means else {}),
    }


def turn_by(move: Mapping[str, Any], name: str, value: Any) -> dict[str, Any]:
    """A move of the camera with a speed, a rate or an angle, if it reads one."""
    turns = move["kind"] in ("pan", "tilt", "roll", "orbit")
    if name == "turns_hz" and turns:
        return {**move, "rate_deg_s": round(360.0 * float(value), 6)}
    if name == "angle_deg" and turns:
        return {**move, "rate_deg_s": float(value), "start_s": 0.0, "duration_s": 1.0}
    return {**move, name: value} if name == "speed_m_s" and move["kind"] == "travel" else {**move}


def set_field(thing: dict[str, Any], kind: str, field: str, value: Any) -> None:
    """Set a field of an object, or an adverb of its last motion."""
    is_lamp = thing["noun"] in LAMPS and not thing["motions"]
    if field == "rate_hz" and ("blink_hz" in thing or is_lamp):
        field, kind = "blink_hz", "field"
    if kind == "field" or field in ("placement", "height_m"):
        thing[field] = int(value) if field == "count" else value
        return
    motions = thing["motions"]
    if field == "start_s" and "switch_s" in thing:
        thing["switch_s"] = value
        return
    if not motions or (field == "start_s" and [one["kind"] for one in motions] == ["stand"]):
        # "at 900 rpm"; "stops after 1 second": until then it goes
        motions.insert(0, {"kind": "spin" if field == "turns_hz" else "move"})
    if field == "start_s" and len(motions) == 1 and motions[0].get("end_pace") == 0.0:
        motions.insert(0, {"kind": motions[0]["kind"]})  # "brakes after 1 second"
    motion = motions[-1]
    field = "rate_hz" if field == "turns_hz" else field
    motion[field] = round(motion.get("pace", 1.0) * value, 6) if field == "pace" else value


def add_motion(thing: dict[str, Any], act: VerbSense, *, goes_on: bool = False) -> None:
    """Add a motion; it takes the place of one of which only the pace is said.

    What goes on moves as before: "a truck driving at 20 m/s passes".
    """
    motions, pace = thing["motions"], act.pace
    last = motions[-1] if motions else {"kind": ""}
    if not act.kind:
        return
    if goes_on and act.kind == "move" and (last["kind"] in MEANS or "speed_m_s" in last):
        last |= {"direction": act.direction} if act.direction else {}
        return
    if act.kind == "move" and act.end_pace == 0.0 and last["kind"] in _TURNING:
        last["end_pace"] = 0.0  # "a spinning coin comes to rest"
        return
    is_posture = act.kind not in (*MEANS, "move")
    if goes_on and is_posture and (last["kind"] == "stand" or last == {"kind": act.kind}):
        motions.pop()  # "stands reading"; "a roundabout with cars circling" on it
    end_pace = None if act.kind == "stand" else act.end_pace
    said = {"kind": act.kind, "direction": act.direction, "end_pace": end_pace}
    motion = {name: value for name, value in said.items() if value is not None}
    if motions and set(motions[-1]) <= {"kind", "pace"} and motions[-1]["kind"] == "move":
        pace *= motions.pop().get("pace", 1.0)
    motions.append(motion | ({"pace": pace} if pace != 1.0 else {}))
