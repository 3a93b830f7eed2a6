"""Exercises and gymnastics: postures as functions of time, and what they are done with."""

from __future__ import annotations

import math
from collections.abc import Mapping
from itertools import pairwise
from types import MappingProxyType

from texvent.scenes.models.materials import DARK, RED, STEEL, Material
from texvent.scenes.models.people.acts.prop_shapes import Prop, still
from texvent.scenes.models.people.gestures import Movement
from texvent.scenes.models.people.posture import ANKLE, DOWN, HIP, OUT, Arm, Leg, Posture
from texvent.scenes.models.people.timing import ease, follow_keys, pulse, swing
from texvent.scenes.models.protocol import ModelPart
from texvent.scenes.models.shapes import Point, rod

_STRAIGHT = 0.84
"""From the hips to the ankle of a leg that is nearly straight, m."""
_BAR_M = 2.16
"""Height of the bar of a pull-up, m."""


def _plank(t: float) -> Posture:
    """On forearms and toes, the body straight."""
    angle = 0.16
    toes = -0.70
    hips = (toes + 0.86 * math.cos(angle), 0.0, 0.15 + 0.86 * math.sin(angle))
    left, right = (Arm((toes + 1.58, side * 0.16, 0.05), (-1.0, 0.4, -1.0), True)
                   for side in (1.0, -1.0))  # fmt: skip
    leg = Leg((toes, 0.08, 0.13), (0.0, 0.2, -1.0), 1.25)
    return Posture(hips=hips, lean=0.5 * math.pi - angle + 0.01 * swing(t, 0.4), nod=-0.35,
                   left=left, right=right, left_leg=leg, right_leg=leg)  # fmt: skip


def _pull_up(t: float) -> Posture:
    """Hangs from a bar and lifts the chin to it, once in two seconds."""
    up = pulse(t, 0.5)
    hips = (0.0, 0.0, _BAR_M - 1.04 + 0.44 * up)
    left, right = (Arm((0.06, side * 0.30, _BAR_M), (-0.2, 1.0, -0.6), True)
                   for side in (1.0, -1.0))  # fmt: skip
    leg = Leg((-0.10 - 0.10 * up, 0.08, hips[2] - 0.82 + 0.10 * up), (1.0, 0.1, 0.2), 0.8)
    return Posture(hips=hips, nod=-0.25 * up, left=left, right=right, left_leg=leg, right_leg=leg)


def _cartwheel(t: float) -> Posture:
    """Sideways over the hands to its right, a rest, and back."""
    share = ease(t % 4.0, 0.2, 1.6) - ease(t % 4.0, 2.2, 3.6)
    angle = 2.0 * math.pi * share
    c, s = math.cos(angle), math.sin(angle)
    y, z = 1.1 - 2.2 * share, 0.95 - 0.06 * (1.0 - c) + 0.10 * (0.5 - 0.5 * c)

    def turned(out: float, up: float) -> Point:
        # Clockwise from behind: the head goes to its right first.
        return (0.0, y + c * out - s * up, z + s * out + c * up)

    spread = 0.5 - 0.5 * math.cos(2.0 * angle) if share < 1.0 else 0.0
    wide, out = 0.10 + 0.40 * spread, 0.42
    reach = math.sqrt(_STRAIGHT**2 - (wide - 0.1) ** 2)
    legs = []
    for side in (1.0, -1.0):
        x, foot_y, foot_z = turned(side * wide, -reach)
        legs.append(Leg((x, side * foot_y, foot_z), (1.0, 0.2, 0.0), 0.9 * (0.5 - 0.5 * c)))
    hands = [turned(side * out, 0.86) for side in (1.0, -1.0)]
    arms = [Arm((0.10, *hand[1:]), (-0.6, 0.6, 0.0), True) for hand in hands]
    return Posture(hips=(0.0, y, z), tilt=angle, left=arms[0], right=arms[1], left_leg=legs[0],
                   right_leg=legs[1])  # fmt: skip


_HANDSTAND = (
    # Hips forward, up; lean; angle of the left and the right leg, 0 = down, pi = up; share of the
    # way of the hands to the ground.
    (0.0, (0.00, HIP, 0.00, 0.0, 0.0, 0.0)),
    (0.35, (0.10, 0.92, 1.40, 0.2, 0.2, 0.7)),
    (0.60, (0.28, 0.92, 2.30, 0.4, 0.9, 1.0)),
    (0.90, (0.52, 1.00, 2.95, 2.3, 2.8, 1.0)),
    (1.10, (0.60, 1.05, math.pi, 2.95, 3.2, 1.0)),
    (1.60, (0.60, 1.05, math.pi, math.pi, math.pi, 1.0)),
)
_REST_HAND: Point = (0.10, 0.26, 0.80)


def _handstand(t: float) -> Posture:
    """Bends down to the hands, kicks the legs up and balances on the hands."""
    x, z, lean, left, right, down = follow_keys(t, _HANDSTAND)
    sway = 0.10 * swing(t, 0.6) * ease(t, 1.1, 1.6)

    def leg(angle: float) -> Leg:
        angle += sway
        return Leg((x - _STRAIGHT * math.sin(angle), 0.10, z - _STRAIGHT * math.cos(angle)),
                   (1.0, 0.1, 0.2) if angle < 1.5 else (-1.0, 0.1, 0.2), 0.3 * angle)  # fmt: skip

    arms = []
    for side in (1.0, -1.0):
        a, b, c = (p + down * (q - p) for p, q in
                   zip(_REST_HAND, (0.60, 0.22, 0.05), strict=True))  # fmt: skip
        arms.append(Arm((a, side * b, c), (-0.4, 1.0, 0.0), True))
    return Posture(hips=(x, 0.0, z), lean=lean, nod=-0.5 * down, left=arms[0], right=arms[1],
                   left_leg=leg(left), right_leg=leg(right))  # fmt: skip


def _tucked(angle: float, middle: Point, tuck: float) -> Posture:
    """A body turned forward about its middle: tucked at 1, upright and stretched at 0."""
    c, s = math.cos(angle), math.sin(angle)

    def turned(ahead: float, up: float) -> tuple[float, float]:
        return middle[0] + c * ahead + s * up, middle[2] - s * ahead + c * up

    hips = turned(-0.14 * tuck, -0.10 * tuck)
    foot = turned(0.20 * tuck, -0.87 + 0.59 * tuck)
    hand = turned(0.06 + 0.24 * tuck, -0.15 - 0.05 * tuck)
    arms = [Arm((hand[0], side * (0.26 - 0.08 * tuck), hand[1]), OUT, True)
            for side in (1.0, -1.0)]  # fmt: skip
    leg = Leg((foot[0], 0.10, foot[1]), (c, 0.1, -s), angle)
    return Posture(hips=(hips[0], 0.0, hips[1]), lean=angle + 0.75 * tuck, nod=0.5 * tuck,
                   left=arms[0], right=arms[1], left_leg=leg, right_leg=leg)  # fmt: skip


def _somersault(t: float) -> Posture:
    """Crouches, rolls forward over the back, stands up; then back."""
    share = ease(t % 4.0, 0.35, 1.45) - ease(t % 4.0, 2.4, 3.5)
    bent = ease(t % 4.0, 0.0, 0.4) - ease(t % 4.0, 1.4, 1.8)
    bent += ease(t % 4.0, 2.0, 2.45) - ease(t % 4.0, 3.45, 3.95)
    z = 0.95 - 0.57 * bent - 0.06 * math.sin(math.pi * share) * bent
    return _tucked(2.0 * math.pi * share, (-0.6 + 1.2 * share, 0.0, z), bent)


def _flip(t: float) -> Posture:
    """Backward in the air, once in two seconds; crouched at take-off and landing."""
    u = t % 2.0
    air = min(max((u - 0.40) / 0.75, 0.0), 1.0)
    low = ease(u, 0.0, 0.25) - ease(u, 0.28, 0.42) + ease(u, 1.10, 1.25) - ease(u, 1.35, 1.8)
    tuck = ease(air, 0.10, 0.40) - ease(air, 0.65, 0.95)
    height = 0.95 - 0.20 * low + 4.0 * 0.78 * air * (1.0 - air)
    angle = -2.0 * math.pi * ease(air, 0.05, 0.97)
    posture = _tucked(angle, (0.0, 0.0, height), tuck)
    if 0.0 < air < 1.0:
        return posture
    leg = Leg((0.0, 0.10, ANKLE), (1.0, 0.1, 0.2))
    return Posture(hips=(-0.12 * low, 0.0, height), lean=0.35 * low, left=posture.left,
                   right=posture.right, left_leg=leg, right_leg=leg)  # fmt: skip


ROPE_HZ, HOOP_HZ = 1.05, 1.05
"""Turns per second of a skipping rope and of a hula hoop."""


def _skip(t: float) -> Posture:
    """Hops when the rope is below the feet."""
    hop = 0.17 * max(math.cos(2.0 * math.pi * ROPE_HZ * t), 0.0)
    turn = 2.0 * math.pi * ROPE_HZ * t
    leg = Leg((0.0, 0.07, ANKLE + hop), (1.0, 0.2, 0.2), 3.0 * hop)
    arm = Arm((0.12 + 0.04 * math.sin(turn), 0.24, -0.40 - 0.04 * math.cos(turn)), DOWN)
    return Posture(hips=(0.0, 0.0, HIP - 0.04 + hop), left=arm, right=arm, left_leg=leg,
                   right_leg=leg)  # fmt: skip


def _rope(t: float) -> list[ModelPart]:
    """From hand to hand, turning backward over the head and forward below the feet."""
    turn = 2.0 * math.pi * ROPE_HZ * t
    # Lowest at the top of the hop.
    c, s = math.cos(turn), math.sin(turn)
    points = []
    for k in range(13):
        along = -1.0 + k / 6.0
        bulge = 1.02 * (1.0 - along**2)
        points.append((0.12 + bulge * s, 0.48 * along, 0.98 - bulge * c))
    return [rod(Material(RED), a, b, 0.014) for a, b in pairwise(points)]


def _hoop(t: float) -> Posture:
    turn = 2.0 * math.pi * HOOP_HZ * t
    x, y = 0.10 * math.cos(turn), 0.10 * math.sin(turn)
    leg = Leg((0.0, 0.16, ANKLE), (1.0, 0.4, 0.2))
    arm = Arm((0.10, 0.42, 0.10 + 0.05 * swing(t, HOOP_HZ)), OUT)
    return Posture(hips=(x, y, 0.90), tilt=0.10 * math.sin(turn), lean=-0.06 * math.cos(turn),
                   left=arm, right=arm, left_leg=leg, right_leg=leg)  # fmt: skip


def _ring(t: float) -> list[ModelPart]:
    """Touches the waist at one side, which goes round; a little tilted."""
    turn = 2.0 * math.pi * HOOP_HZ * t
    x, y, radius = 0.30 * math.cos(turn), 0.30 * math.sin(turn), 0.46
    points = []
    for k in range(21):
        a = 2.0 * math.pi * k / 20.0
        tip = 0.10 * math.cos(a - turn)
        points.append((x + radius * math.cos(a), y + radius * math.sin(a), 1.02 + tip))
    return [rod(Material((0.9, 0.1, 0.4)), a, b, 0.022) for a, b in
            pairwise(points)]  # fmt: skip


def _run_in_place(t: float) -> Posture:
    """Knees up in turn, arms in step."""

    def leg(phase: float) -> Leg:
        up = max(swing(t, 1.3, phase), 0.0)
        return Leg((0.12 * up, 0.08, ANKLE + 0.46 * up), (1.0, 0.1, 0.35), 0.5 * up)

    def arm(phase: float) -> Arm:
        fore = swing(t, 1.3, phase)
        return Arm((0.20 + 0.16 * fore, 0.02, -0.26 + 0.10 * fore), (-1.0, 0.2, -0.3))

    bob = 0.04 * abs(swing(t, 1.3))
    return Posture(hips=(0.0, 0.0, HIP - 0.03 + bob), lean=0.08, left=arm(0.5), right=arm(0.0),
                   left_leg=leg(0.0), right_leg=leg(0.5))  # fmt: skip


def _deadlift(t: float) -> Posture:
    """A barbell from the ground up to the thighs."""
    down = pulse(t, 0.5, 0.5)
    arm = Arm((0.30, 0.24, 0.82 - 0.55 * down), OUT, True)
    right = Arm((0.30, -0.24, 0.82 - 0.55 * down), OUT, True)
    leg = Leg((0.04, 0.14, ANKLE), (1.0, 0.35, 0.2))
    return Posture(hips=(-0.30 * down, 0.0, 0.93 - 0.34 * down), lean=0.10 + 0.95 * down,
                   nod=-0.4 * down, left=arm, right=right, left_leg=leg, right_leg=leg,
                   tool=(0.0, 1.0, 0.0))  # fmt: skip


def _yoga(t: float) -> Posture:
    """From the mountain to the tree: a foot at the other knee, palms together above the head."""
    share = ease(t, 0.0, 1.1)
    sway = 0.05 * swing(t, 0.5) * share
    arm = Arm((0.06, -0.16 + 0.30 * share * (1.0 - share), -0.10 + 0.70 * share), (-0.2, 1.0, 0.2))
    right = Leg((0.02 * share, 0.08 - 0.08 * share, ANKLE + 0.50 * share), (0.6, 1.0, 0.0), 0.8
                * share)  # fmt: skip
    return Posture(hips=(0.0, 0.04 * share, HIP), tilt=sway, left=arm, right=arm,
                   left_leg=Leg((0.0, 0.06, ANKLE)), right_leg=right)  # fmt: skip


def _ballet(t: float) -> Posture:
    """Turns on one foot, the other leg out behind, arms round above the head."""
    up = ease(t, 0.0, 0.5)
    arm = Arm((0.14, 0.02, 0.46 * up + 0.02), (0.0, 1.0, 0.2))
    return Posture(
        hips=(0.0, 0.0, HIP + 0.04 * up), heading=2.0 * math.pi * 0.42 * t, lean=0.06 * up,
        left=arm, right=Arm((0.14, 0.30, 0.10 + 0.06 * swing(t, 0.6)), OUT),
        left_leg=Leg((0.0, 0.02, ANKLE + 0.06 * up), pitch=0.8 * up),
        right_leg=Leg((-0.52 * up, 0.20, ANKLE + 0.50 * up), (0.6, 0.6, -0.4), 1.0 * up),
    )  # fmt: skip


_KARATE = (
    # Right foot forward, up; left hand forward; right hand forward; lean; turn.
    (0.0, (-0.24, ANKLE, 0.24, 0.16, 0.12, 0.0)),
    (0.35, (-0.24, ANKLE, 0.20, 0.62, 0.16, 0.4)),
    (0.70, (0.10, 0.60, 0.26, 0.20, -0.10, 0.0)),
    (0.95, (0.66, 1.05, 0.26, 0.14, -0.40, 0.2)),
    (1.20, (0.20, 0.50, 0.26, 0.16, -0.10, 0.0)),
    (1.45, (-0.24, ANKLE, 0.62, 0.16, 0.14, -0.4)),
)


def _karate(t: float) -> Posture:
    """A punch, a high kick, a punch with the other hand."""
    forward, up, left, right, lean, turn = follow_keys(t, _KARATE, 1.9)
    return Posture(
        hips=(0.0, 0.0, 0.88), lean=lean, turn=turn, left=Arm((left, -0.06, 0.0), DOWN),
        right=Arm((right, -0.06, -0.02), DOWN), left_leg=Leg((0.22, 0.10, ANKLE)),
        right_leg=Leg((forward, 0.10, up), (1.0, 0.1, 0.5), 0.2),
    )  # fmt: skip


EXERCISE_MOVEMENTS: Mapping[str, Movement] = MappingProxyType(
    {
        "plank": _plank, "pull-up": _pull_up, "cartwheel": _cartwheel, "handstand": _handstand,
        "somersault": _somersault, "flip": _flip, "skip rope": _skip, "hula hoop": _hoop,
        "run in place": _run_in_place, "deadlift": _deadlift, "yoga": _yoga, "ballet": _ballet,
        "karate": _karate,
    }
)  # fmt: skip
"""Exercise → posture of the whole body over time."""

_FRAME = still(
    rod(STEEL, (0.06, -0.75, _BAR_M), (0.06, 0.75, _BAR_M), 0.022),
    *(rod(DARK, (0.06, y, 0.0), (0.06, y, _BAR_M + 0.05), 0.035) for y in (0.75, -0.75)),
)
_BARBELL = still(
    rod(STEEL, (0.0, -0.80, 0.0), (0.0, 0.80, 0.0), 0.016),
    *(rod(DARK, (0.0, y, 0.0), (0.0, y + 0.10, 0.0), 0.21) for y in (0.60, -0.70)),
)

EXERCISE_PROPS: Mapping[str, tuple[Prop, ...]] = MappingProxyType(
    {
        "pull-up": (Prop("ground", _FRAME),),
        "skip rope": (Prop("ground", _rope, ("rope",)),),
        "hula hoop": (Prop("ground", _ring, ("hula hoop",)),),
        "deadlift": (Prop("hands", _BARBELL, ("barbell",)),),
    }
)
"""Exercise → what is drawn with it."""
