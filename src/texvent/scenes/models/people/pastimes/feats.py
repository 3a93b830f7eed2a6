"""Feats of the whole body: tricks on boards, skating, climbing, stretching, cheering, kicking.

Postures as functions of time, and what they are done with.
"""

from __future__ import annotations

import math
from collections.abc import Mapping
from dataclasses import replace
from types import MappingProxyType

from texvent.scenes.models.materials import (
    BLUE,
    DARK,
    RED,
    STEEL,
    WHITE,
    YELLOW,
    Material,
    stone,
)
from texvent.scenes.models.people.acts.prop_shapes import Prop, still
from texvent.scenes.models.people.gestures import Movement
from texvent.scenes.models.people.posture import ANKLE, DOWN, HIP, OUT, Arm, Leg, Posture
from texvent.scenes.models.people.sports import BOARD_STANCE, SPORTS, kick
from texvent.scenes.models.people.timing import ease, pulse, swing
from texvent.scenes.models.protocol import ModelPart
from texvent.scenes.models.shapes import ball, box, compose, moved, rod, shift, turn_y

_HOP_S, _OFF_S, _DOWN_S = 1.5, 0.40, 1.20
"""Period of the hops of a trick, and when in it the board leaves the ground and lands, s."""
_GRAVITY_M_S2 = 9.81


def _hop(t: float) -> tuple[float, float, float]:
    """Height over the ground, how far the knees are bent, and the board's pitch."""
    u = t % _HOP_S
    lasts = _DOWN_S - _OFF_S
    share = min(max((u - _OFF_S) / lasts, 0.0), 1.0)
    height = 0.5 * _GRAVITY_M_S2 * lasts**2 * share * (1.0 - share)
    low = ease(u, 0.10, 0.30) - ease(u, 0.32, 0.55) + ease(u, 1.10, 1.25) - ease(u, 1.28, 1.48)
    pitch = -0.7 * math.sin(2.0 * math.pi * share)
    return height, low, pitch


def _trick(way: str) -> Movement:
    """Who rides a board bends the knees, takes off with it and lands."""

    def move(t: float) -> Posture:
        height, low, _ = _hop(t)
        riding = SPORTS[way](t)
        x, y, z = riding.hips or (0.0, 0.0, HIP)
        tuck = 0.20 * min(height / 0.5, 1.0)

        def leg(one: Leg | None) -> Leg:
            a, b, c = (one or Leg()).foot
            return Leg((a, b, c + height + 0.5 * tuck), (one or Leg()).knee)

        out = 0.25 * min(height, 0.6)
        arm = Arm((0.10, 0.44, 0.05 + out), OUT)
        return replace(
            riding, hips=(x, y, z + height - 0.14 * low), lean=riding.lean + 0.2 * low,
            left=arm, right=replace(arm, hand=(0.10, 0.44, 0.15 - out)),
            left_leg=leg(riding.left_leg), right_leg=leg(riding.right_leg),
        )  # fmt: skip

    return move


def lifted(parts: tuple[ModelPart, ...]) -> Prop:
    """A board that goes up with who does a trick on it."""

    def draw(t: float) -> list[ModelPart]:
        height, _, pitch = _hop(t)
        up = height + 0.10 * min(height / 0.5, 1.0)
        return moved(parts, compose(shift(z=up), turn_y(pitch, (0.0, 0.0, BOARD_STANCE))))

    return Prop("ground", draw)


def _ice_skate(t: float) -> Posture:
    """Glides on one skate while the other one pushes off to the side."""
    side = swing(t, 0.65)
    left, right = max(side, 0.0), max(-side, 0.0)
    foot = ANKLE + 0.05
    return Posture(
        hips=(0.0, -0.07 * side, 0.83), lean=0.55, nod=-0.35, turn=0.15 * side,
        left=Arm((0.20 - 0.46 * right, 0.16 + 0.16 * right, -0.34), OUT),
        right=Arm((0.20 - 0.46 * left, 0.16 + 0.16 * left, -0.34), OUT),
        left_leg=Leg((0.08 - 0.62 * left, 0.08 + 0.26 * left, foot + 0.12 * left),
                     pitch=0.5 * left),
        right_leg=Leg((0.08 - 0.62 * right, 0.08 + 0.26 * right, foot + 0.12 * right),
                      pitch=0.5 * right),
    )  # fmt: skip


def _rock_climb(t: float) -> Posture:
    """Hands and feet at the holds of a rock face, above the ground."""
    step = swing(t, 0.6)
    return Posture(
        hips=(0.12, 0.06 * step, 1.34 + 0.05 * swing(t, 1.2)), lean=0.05, nod=-0.4,
        left=Arm((0.46, 0.26, 1.94 + 0.24 * step), OUT, True),
        right=Arm((0.46, -0.26, 1.94 - 0.24 * step), OUT, True),
        left_leg=Leg((0.36, 0.20, 0.72 - 0.22 * step), (1.0, 0.9, 0.3), 0.3),
        right_leg=Leg((0.36, 0.20, 0.72 + 0.22 * step), (1.0, 0.9, 0.3), 0.3),
    )  # fmt: skip


def _climb_rope(t: float) -> Posture:
    """Hand over hand, the rope between the feet."""
    step = swing(t, 0.6)
    up = 0.08 * swing(t, 1.2)
    foot = Leg((0.24, 0.03, 0.72 + 0.5 * up), (1.0, 0.7, 0.4), 0.4)
    return Posture(
        hips=(-0.06, 0.0, 1.18 + up), lean=0.10, nod=-0.5, tilt=0.06 * step,
        left=Arm((0.22, 0.02, 1.86 + 0.22 * step), OUT, True),
        right=Arm((0.22, -0.02, 1.86 - 0.22 * step), OUT, True), left_leg=foot, right_leg=foot,
    )  # fmt: skip


def _hang_m(t: float) -> float:
    """Height of the hips of who hangs head down from an elastic cord."""
    return 1.34 + 0.42 * math.cos(2.0 * math.pi * 0.5 * t)


def _bungee(t: float) -> Posture:
    z = _hang_m(t)
    wide = 0.30 + 0.12 * swing(t, 0.5, 0.25)
    leg = Leg((0.02, 0.06, z + 0.84), (1.0, 0.1, 0.2), -1.2)
    arm = Arm((0.12, wide, 0.44), (-0.4, 0.8, 0.2))
    return Posture(hips=(0.0, 0.0, z), lean=math.pi - 0.06 * swing(t, 0.5), nod=-0.3,
                   left=arm, right=arm, left_leg=leg, right_leg=leg)  # fmt: skip


def _cord(t: float) -> list[ModelPart]:
    return [rod(Material(YELLOW), (0.02, 0.0, _hang_m(t) + 0.86), (0.0, 0.0, 3.3), 0.03)]


def _skydive(t: float) -> Posture:
    """Face down, arms and legs spread, rocking in the wind."""
    rock = 0.05 * swing(t, 0.9)
    arm = Arm((-0.10, 0.34, 0.30 + rock), (0.0, 1.0, -0.2))
    right = Arm((-0.10, 0.34, 0.30 - rock), (0.0, 1.0, -0.2))
    leg = Leg((-0.62, 0.30, 1.30 + rock), (0.0, 0.3, -1.0), 1.6)
    return Posture(hips=(0.0, 0.0, 1.05 + 0.10 * swing(t, 0.4)), lean=1.42, nod=-0.8,
                   tilt=0.16 * swing(t, 0.6), left=arm, right=right, left_leg=leg,
                   right_leg=leg)  # fmt: skip


def _cheerlead(t: float) -> Posture:
    """Arms up in a V, out to the sides and at the hips, with a hop at each beat."""
    beat = pulse(t, 1.0)
    angle = -0.5 + 1.55 * pulse(t, 0.5)
    left = Arm((0.10, 0.50 * math.cos(angle), 0.56 * math.sin(angle)), OUT)
    angle = 1.05 - 1.55 * pulse(t, 0.5, 0.15)
    right = Arm((0.10, 0.50 * math.cos(angle), 0.56 * math.sin(angle)), OUT)
    leg = Leg((0.0, 0.14 + 0.08 * beat, ANKLE), (1.0, 0.4, 0.2))
    return Posture(hips=(0.0, 0.05 * swing(t, 0.5), 0.92 - 0.06 * beat), left=left, right=right,
                   tilt=0.10 * swing(t, 0.5), left_leg=leg, right_leg=leg)  # fmt: skip


def _tai_chi(t: float) -> Posture:
    """Low in the knees, the weight from leg to leg, the hands in slow circles."""
    go, up = swing(t, 0.38), swing(t, 0.38, 0.25)
    return Posture(
        hips=(0.0, 0.16 * go, 0.78), turn=0.55 * go, lean=0.06,
        left=Arm((0.42, 0.06 + 0.20 * go, 0.04 + 0.22 * up), OUT),
        right=Arm((0.40, 0.06 - 0.20 * go, -0.16 - 0.22 * up), OUT),
        left_leg=Leg((0.06, 0.34, ANKLE), (1.0, 0.6, 0.2)),
        right_leg=Leg((-0.06, 0.34, ANKLE), (1.0, 0.6, 0.2)),
    )  # fmt: skip


def _stretch_leg(t: float) -> Posture:
    """One leg straight ahead on its heel, both hands down to its toes."""
    down = 0.75 + 0.25 * swing(t, 0.5)
    z = 0.62 - 0.36 * down
    return Posture(
        hips=(-0.26, 0.0, 0.78), lean=0.55 + 0.55 * down, nod=-0.2,
        left=Arm((0.46 + 0.06 * down, 0.14, z), OUT, True),
        right=Arm((0.46 + 0.06 * down, -0.02, z), OUT, True),
        left_leg=Leg((0.48, 0.09, ANKLE), (0.2, 0.1, 1.0), -0.6),
        right_leg=Leg((-0.22, 0.12, ANKLE), (1.0, 0.4, 0.2)),
    )  # fmt: skip


def _bend_back(t: float) -> Posture:
    """The hips go forward, torso and arms over backwards."""
    back = pulse(t, 0.42)
    arm = Arm((0.02, 0.02, 0.60), (-0.2, 1.0, 0.2))
    leg = Leg((0.06, 0.12, ANKLE), (1.0, 0.3, 0.2))
    return Posture(hips=(0.22 * back, 0.0, 0.92 - 0.06 * back), lean=-1.15 * back, nod=-0.5 * back,
                   left=arm, right=arm, left_leg=leg, right_leg=leg)  # fmt: skip


_SHOT_S, _GOAL_M, _NET_M = 0.8, 3.0, 3.7
"""When a ball is kicked, s, how far ahead the line of the goal is and its net, m."""


def _scored(t: float) -> list[ModelPart]:
    """At rest before the foot, then into the net, where it drops."""
    gone = max(t - _SHOT_S, 0.0)
    x = min(0.46 + 5.5 * gone, _NET_M)
    at_net = gone - (_NET_M - 0.46) / 5.5
    high = 0.15 + 1.5 * gone
    z = high if at_net <= 0.0 else max(0.15 + 1.5 * (gone - at_net) - 4.9 * at_net**2, 0.15)
    return [ball(Material(WHITE), (x, -0.09, z), (0.30,) * 3),
            *(ball(DARK, (x + a, -0.09 + b, z + c), (0.11,) * 3)
              for a, b, c in ((0.11, 0.04, 0.02), (-0.08, 0.07, 0.05), (-0.03, -0.10, 0.05),
                              (0.0, 0.06, -0.11), (0.02, 0.02, 0.12)))]  # fmt: skip


def _goal() -> tuple[ModelPart, ...]:
    white, wide, high = Material(WHITE), 1.1, 1.6
    corners = [(_GOAL_M, wide), (_GOAL_M, -wide)]
    frame = [rod(white, (x, y, 0.0), (x, y, high), 0.045) for x, y in corners]
    frame += [rod(white, (_GOAL_M, -wide, high), (_GOAL_M, wide, high), 0.045)]
    back = _NET_M + 0.25
    for y in (wide, -wide):
        frame.append(rod(white, (_GOAL_M, y, high), (back, y, 0.0), 0.02))
        frame += [rod(white, (_GOAL_M, y, high * k / 6.0), (back - (back - _GOAL_M) * k / 6.0, y,
                                                            high * k / 6.0), 0.008)
                  for k in range(6)]  # fmt: skip
    frame += [rod(white, (_GOAL_M, -wide + 0.22 * k, high), (back, -wide + 0.22 * k, 0.0), 0.008)
              for k in range(11)]  # fmt: skip
    return tuple(frame)


def _robot_dance(t: float) -> Posture:
    """Stiff arms bent at right angles jerk from pose to pose."""
    first, second = (math.tanh(5.0 * swing(t, 0.8, phase)) for phase in (0.0, 0.25))
    return Posture(
        hips=(0.0, 0.0, 0.93), turn=0.5 * second, look=-0.6 * second, tilt=0.10 * first,
        left=Arm((0.16, 0.26, 0.26 * first), (0.0, 1.0, 0.0)),
        right=Arm((0.16, 0.26, -0.26 * first), (0.0, 1.0, 0.0)),
        left_leg=Leg((0.04, 0.14, ANKLE)), right_leg=Leg((-0.04, 0.14, ANKLE)),
    )  # fmt: skip


def _stand_on_skis(t: float) -> Posture:
    """Upright on two skis, a pole in each hand."""
    foot = ANKLE + 0.03
    return Posture(
        hips=(0.0, 0.0, 0.92), lean=0.05 + 0.02 * swing(t, 0.3), look=0.3 * swing(t, 0.25),
        left=Arm((0.26, 0.14, -0.32), DOWN), right=Arm((0.26, 0.14, -0.32), DOWN),
        left_leg=Leg((0.0, 0.12, foot)), right_leg=Leg((0.0, 0.12, foot)), tool=(0.10, 0.10, -1.0),
    )  # fmt: skip


def _lean(t: float) -> Posture:
    """The back against something upright, arms crossed, one foot over the other."""
    breath = 0.02 * swing(t, 0.35)
    return Posture(
        hips=(-0.10, 0.0, 0.90), lean=-0.20 + breath, look=0.35 * swing(t, 0.25), nod=0.12,
        left=Arm((0.24, -0.26, -0.18), DOWN), right=Arm((0.28, -0.24, -0.13), DOWN),
        left_leg=Leg((0.24, 0.06, ANKLE)), right_leg=Leg((0.34, -0.06, ANKLE), (1.0, 0.2, 0.3)),
    )  # fmt: skip


FEAT_MOVEMENTS: Mapping[str, Movement] = MappingProxyType(
    {
        "skateboard trick": _trick("skate"), "snowboard trick": _trick("snowboard"),
        "ski trick": _trick("ski"), "ice skate": _ice_skate, "roller skate": _ice_skate,
        "rock climb": _rock_climb, "climb rope": _climb_rope, "bungee jump": _bungee,
        "skydive": _skydive, "cheerlead": _cheerlead, "tai chi": _tai_chi,
        "stretch leg": _stretch_leg, "bend back": _bend_back,
        "shoot goal": lambda t: kick(t - _SHOT_S), "robot dance": _robot_dance, "lean": _lean,
        "stand on skis": _stand_on_skis,
    }
)  # fmt: skip
"""Feat → posture of the whole body over time."""

_BOOT = (
    ball(Material(WHITE), (-0.10, 0.0, 0.03), (0.33, 0.14, 0.13)),
    rod(Material(WHITE), (-0.20, 0.0, 0.03), (-0.20, 0.0, 0.17), 0.072),
)
_BLADE = still(
    *_BOOT,
    *(box(DARK, (x, 0.0, -0.035), (0.05, 0.03, 0.05)) for x in (-0.02, -0.20)),
    box(STEEL, (-0.11, 0.0, -0.075), (0.36, 0.016, 0.04)),
)
_WHEELS = still(
    *_BOOT,
    *(rod(Material(RED), (x, y - 0.02, -0.06), (x, y + 0.02, -0.06), 0.035)
      for x in (-0.20, -0.02) for y in (-0.04, 0.04)),
)  # fmt: skip
_HOLD_COLOURS = (RED, YELLOW, BLUE, (0.05, 0.45, 0.15))
_ROCK = still(
    box(stone((0.42, 0.38, 0.33)), (1.30, 0.0, 1.40), (1.60, 0.9, 2.8)),
    ball(stone((0.42, 0.38, 0.33)), (1.35, 0.0, 2.75), (1.70, 1.0, 0.70)),
    *(ball(Material(_HOLD_COLOURS[n % 4]),
           (0.50, -0.36 + 0.07 * ((7 * n) % 11), 0.25 + 0.15 * n), (0.10, 0.15, 0.11))
      for n in range(17)),
)  # fmt: skip
_HUNG_ROPE = still(rod(Material((0.62, 0.48, 0.28)), (0.22, 0.0, 0.02), (0.22, 0.0, 2.85), 0.026))
_POMPOM = still(
    *(ball(Material(RED if k % 2 else WHITE), (0.05 + 0.06 * math.cos(2.1 * k),
                                                0.07 * math.sin(2.1 * k), 0.02 * (k - 3)),
           (0.17,) * 3) for k in range(7))
)  # fmt: skip
_CHUTE = still(box(Material(RED), (-0.10, 0.0, 0.06), (0.20, 0.34, 0.44)))
_BROWN = Material((0.10, 0.035, 0.02))
_SKATEBOARD = (
    box(_BROWN, (0.0, 0.0, BOARD_STANCE - 0.015), (0.86, 0.22, 0.03)),
    *(rod(Material(WHITE), (x, y, 0.03), (x, y + 0.05, 0.03), 0.035)
      for x in (0.24, -0.24) for y in (0.06, -0.11)),
)  # fmt: skip
_SNOWBOARD = (
    box(Material(BLUE), (0.0, 0.0, BOARD_STANCE - 0.02), (1.2, 0.28, 0.04)),
    *(ball(Material(BLUE), (x, 0.0, BOARD_STANCE - 0.01), (0.40, 0.28, 0.05))
      for x in (0.6, -0.6)),
)  # fmt: skip
_SKIS = tuple(
    box(Material(RED), (0.10, y, 0.02), (1.70, 0.09, 0.03)) for y in (0.12, -0.12)
)  # fmt: skip
_POLE = still(rod(STEEL, (0.0, 0.0, -0.04), (0.0, 0.0, 0.85), 0.012))


def _board(parts: tuple[ModelPart, ...], *nouns: str) -> Prop:
    return replace(lifted(parts), nouns=nouns, is_own=True)


FEAT_PROPS: Mapping[str, tuple[Prop, ...]] = MappingProxyType(
    {
        "skateboard trick": (_board(_SKATEBOARD, "skateboard"),),
        "snowboard trick": (_board(_SNOWBOARD, "snowboard"),),
        "ski trick": (_board(_SKIS, "ski", "skis"), Prop("right hand", _POLE)),
        "stand on skis": (
            Prop("ground", still(*_SKIS), ("ski",), is_own=True),
            Prop("right hand", _POLE),
            Prop("left hand", still(rod(STEEL, (0.0, 0.0, 0.04), (0.06, 0.02, -0.84), 0.012))),
        ),
        "ice skate": (Prop("left foot", _BLADE), Prop("right foot", _BLADE)),
        "roller skate": (Prop("left foot", _WHEELS), Prop("right foot", _WHEELS)),
        "rock climb": (Prop("ground", _ROCK),),
        "climb rope": (Prop("ground", _HUNG_ROPE, ("rope",), is_own=True),),
        "bungee jump": (Prop("ground", _cord),),
        "skydive": (Prop("back", _CHUTE),),
        "cheerlead": (Prop("right hand", _POMPOM), Prop("left hand", _POMPOM)),
        "shoot goal": (
            Prop("ground", _scored, ("football", "ball")),
            Prop("ground", still(*_goal()), ("goal",), is_own=True),
        ),
    }
)
"""Feat → what is drawn with it."""
