"""Games and machines that are held: postures and what they are done with."""

from __future__ import annotations

import math
from collections.abc import Mapping
from itertools import pairwise
from types import MappingProxyType

from texvent.scenes.models.materials import (
    DARK,
    ORANGE,
    RED,
    STEEL,
    WHITE,
    WOOD,
    YELLOW,
    Material,
    striped,
)
from texvent.scenes.models.people.acts.music import SEAT_M, SITTING, STOOL
from texvent.scenes.models.people.acts.prop_shapes import Prop, disc, stick, still
from texvent.scenes.models.people.gestures import Movement
from texvent.scenes.models.people.pastimes.crafts import SCREEN
from texvent.scenes.models.people.posture import ANKLE, DOWN, HIP, OUT, Arm, Leg, Posture, solve
from texvent.scenes.models.people.timing import ease, follow_keys, swing
from texvent.scenes.models.protocol import ModelPart
from texvent.scenes.models.shapes import Point, ball, blade, box, post, rod

_GRAVITY_M_S2 = 9.81
_BROWN = Material((0.30, 0.12, 0.05))
_BLUE = Material((0.05, 0.08, 0.35))


_FENCE = (
    # Hips forward; right foot forward; right hand forward, up; lean; the blade's rise.
    (0.0, (0.00, 0.22, 0.30, -0.12, 0.05, 0.35)),
    (0.45, (0.04, 0.24, 0.34, 0.10, 0.05, 0.75)),
    (0.75, (0.30, 0.66, 0.58, 0.02, 0.25, 0.02)),
    (1.00, (0.30, 0.66, 0.58, 0.02, 0.25, 0.02)),
    (1.40, (0.00, 0.22, 0.30, -0.12, 0.05, 0.35)),
)


def _fence(t: float) -> Posture:
    """On guard, a parry, a lunge."""
    hips, foot, hand, up, lean, rise = follow_keys(t, _FENCE, 1.7)
    drop = 0.5 * hips
    return Posture(
        hips=(hips, 0.0, 0.86 - 0.4 * drop), lean=lean, turn=0.5,
        right=Arm((hand, 0.0, up), DOWN), left=Arm((-0.20, 0.30, 0.06), OUT),
        right_leg=Leg((foot, 0.08, ANKLE)), left_leg=Leg((-0.34, 0.12, ANKLE), (0.6, 0.8, 0.2)),
        tool=(1.0, 0.15, rise),
    )  # fmt: skip


SHOT_S = 1.1
"""When the arrow leaves the bow, s."""


def _archery(t: float) -> Posture:
    """Draws the string to the cheek, holds it, lets go."""
    u = t % 2.6
    drawn = ease(u, 0.1, 0.8) - ease(u, SHOT_S, SHOT_S + 0.08)
    back = 0.34 * drawn
    return Posture(
        left=Arm((0.58, -0.16, 0.06), (0.0, 1.0, -0.4)), turn=-0.35 * drawn,
        right=Arm((0.46 - back, -0.26 + 0.10 * drawn, 0.08), (-0.6, 1.0, 0.2)),
        left_leg=Leg((0.14, 0.12, ANKLE)), right_leg=Leg((-0.14, 0.12, ANKLE)),
        hips=(0.0, 0.0, HIP - 0.01), tool=(1.0, -0.15, 0.0), nod=0.05,
    )  # fmt: skip


BOWLED_S, SERVED_S, DUNKED_S = 0.95, 0.95, 0.85
"""When the ball leaves the hand of a bowler, is hit by a server and goes into the basket, s."""
_BOWL = (
    # Right hand forward, up; hips forward and up; lean; left foot forward.
    (0.0, (0.30, -0.16, 0.00, 0.92, 0.10, 0.10)),
    (0.45, (-0.50, -0.36, 0.10, 0.86, 0.45, 0.20)),
    (0.95, (0.30, -0.54, 0.30, 0.66, 0.60, 0.62)),
    (1.25, (0.52, 0.10, 0.32, 0.68, 0.35, 0.62)),
    (2.00, (0.40, 0.00, 0.30, 0.72, 0.25, 0.62)),
)


def _bowl(t: float) -> Posture:
    """Swings the ball back and rolls it out of a lunge."""
    forward, up, x, z, lean, foot = follow_keys(t, _BOWL)
    return Posture(
        hips=(x, 0.0, z), lean=lean, right=Arm((forward, 0.02, up), DOWN),
        left=Arm((0.14, 0.40, -0.30), OUT), left_leg=Leg((foot, 0.06, ANKLE)),
        right_leg=Leg((-0.30, 0.14, ANKLE + 0.04), (1.0, 0.1, 0.0), 0.5), nod=-0.3,
    )  # fmt: skip


def _bowling_ball(t: float) -> list[ModelPart]:
    """In the hand, then along the ground."""
    gone = max(t - BOWLED_S, 0.0)
    x, y, z = solve(_bowl(min(t, BOWLED_S))).hands[1]
    x, z = x + 0.04 + 2.2 * gone, z - 0.10
    return [ball(_BLUE, (x, y, max(z - 1.2 * gone, 0.11) if gone else z), (0.22,) * 3)]


_SERVE = (
    # Left hand forward, up; right hand forward, outward, up; the racket's direction; hips up.
    (0.0, (0.30, -0.20, 0.22, 0.02, -0.25, 0.8, 0.0, 0.5, 0.90)),
    (0.40, (0.30, 0.50, -0.24, 0.22, 0.10, -0.2, 0.2, 1.0, 0.84)),
    (0.70, (0.18, 0.44, -0.24, 0.24, 0.30, -0.7, -0.2, -0.7, 0.86)),
    (0.95, (0.14, 0.00, 0.24, 0.02, 0.58, 0.25, 0.0, 1.0, 1.00)),
    (1.20, (0.10, -0.30, 0.48, -0.26, -0.20, 0.6, -0.5, -0.6, 0.90)),
    (1.90, (0.14, -0.40, 0.30, -0.10, -0.25, 0.8, 0.0, 0.5, 0.90)),
)


def _serve(t: float) -> Posture:
    """The left hand tosses the ball, the racket meets it above the head."""
    left, rise, x, out, up, *tool, z = follow_keys(t, _SERVE)
    lean = 0.30 * (ease(t, 0.9, 1.25) - ease(t, 1.5, 1.9)) - 0.12 * (
        ease(t, 0.2, 0.5) - ease(t, 0.75, 0.95))  # fmt: skip
    return Posture(
        hips=(0.0, 0.0, z), lean=lean, left=Arm((left, -0.06, rise), DOWN),
        right=Arm((x, out, up), OUT), left_leg=Leg((0.22, 0.10, ANKLE)),
        right_leg=Leg((-0.20, 0.12, ANKLE + 0.02), pitch=0.3), tool=(tool[0], tool[1], tool[2]),
        nod=-0.35 * (ease(t, 0.2, 0.5) - ease(t, 1.0, 1.3)),
    )  # fmt: skip


_TOSSED_S = 0.40


def _served(t: float) -> list[ModelPart]:
    """Up from the left hand, hit, and away."""
    if t < _TOSSED_S:
        up = (t / _TOSSED_S) ** 2
        place = (0.36, 0.14, 1.20 + 0.66 * up)
    elif t < SERVED_S:
        u = (t - _TOSSED_S) / (SERVED_S - _TOSSED_S)
        place = (0.36 - 0.02 * u, 0.14 - 0.32 * u, 1.86 + 0.50 * u + 1.2 * u * (1.0 - u))
    else:
        gone = t - SERVED_S
        place = (0.34 + 5.0 * gone, -0.18, max(2.36 - 0.8 * gone - 2.0 * gone**2, 0.06))
    return [ball(Material((0.75, 0.9, 0.12)), place, (0.13,) * 3)]


_RIM: Point = (0.62, 0.0, 2.52)


def _dunk(t: float) -> Posture:
    """Crouches, jumps with the ball above the head, slams it down."""
    low = ease(t, 0.05, 0.30) - ease(t, 0.32, 0.46) + ease(t, 1.20, 1.32) - ease(t, 1.4, 1.8)
    u = min(max((t - 0.42) / 0.80, 0.0), 1.0)
    air = 4.0 * 0.60 * u * (1.0 - u)
    x = -0.25 + 0.30 * u
    raised = ease(t, 0.20, 0.60)
    slam = ease(t, 0.78, 0.95)
    hand = (0.30 + 0.18 * raised - 0.02 * slam, -0.12 + 0.04 * raised,
            -0.30 + 0.90 * raised - 0.35 * slam)  # fmt: skip
    z = HIP - 0.02 - 0.24 * low + air
    return Posture(
        hips=(x - 0.12 * low, 0.0, z), lean=0.40 * low + 0.15 * slam, right=Arm(hand, OUT),
        left=Arm((0.24, 0.12, -0.20 + 0.30 * raised * (1.0 - slam)), OUT),
        left_leg=Leg((x + 0.10 * air, 0.10, ANKLE + air), (1.0, 0.1, 0.3), 0.8 * min(air, 0.6)),
        right_leg=Leg((x - 0.16 * air, 0.10, ANKLE + air + 0.12 * air), (1.0, 0.1, 0.3),
                      1.0 * min(air, 0.6)),
    )  # fmt: skip


_LEATHER = striped(ORANGE, (0.05, 0.03, 0.02), 2.0)


def _dunked(t: float) -> list[ModelPart]:
    """In the hand, then through the ring; it bounces below it."""
    gone = t - DUNKED_S
    if gone < 0.0:
        x, y, z = solve(_dunk(t)).hands[1]
        near = ease(t, DUNKED_S - 0.15, DUNKED_S)
        start = (x + 0.08, y, z + 0.06)
        at = [a + near * (b - a) for a, b in zip(start, (_RIM[0], 0.0, _RIM[2]), strict=True)]
        return [ball(_LEATHER, (at[0], at[1], at[2]), (0.24,) * 3)]
    start_m, floor = _RIM[2], 0.12
    fall_s = math.sqrt(2.0 * (start_m - floor) / _GRAVITY_M_S2)
    if gone < fall_s:
        height = start_m - 0.5 * _GRAVITY_M_S2 * gone**2
    else:
        share = min(gone - fall_s, 1.0)
        height = floor + 4.0 * 0.8 * share * (1.0 - share)
    return [ball(_LEATHER, (_RIM[0], 0.0, height), (0.24,) * 3)]


def _basket() -> tuple[ModelPart, ...]:
    x, _, z = _RIM
    ring = [(x + 0.23 * math.cos(a), 0.23 * math.sin(a), z)
            for a in (0.393 * k for k in range(17))]  # fmt: skip
    net = [rod(Material(WHITE), a, (x + 0.6 * (a[0] - x), 0.6 * a[1], z - 0.36), 0.010)
           for a in ring[::2]]  # fmt: skip
    return (
        *(rod(Material(RED), a, b, 0.022) for a, b in pairwise(ring)), *net,
        box(Material(WHITE), (x + 0.34, 0.0, z + 0.30), (0.04, 1.10, 0.80)),
        box(Material(RED), (x + 0.315, 0.0, z + 0.22), (0.02, 0.46, 0.34)),
        rod(STEEL, (x + 0.75, 0.0, 0.0), (x + 0.75, 0.0, z + 0.2), 0.06),
        rod(STEEL, (x + 0.75, 0.0, z + 0.2), (x + 0.36, 0.0, z + 0.2), 0.05),
    )  # fmt: skip


def build_basket() -> tuple[Point, tuple[ModelPart, ...]]:
    """Where the rim of a basket is, and the basket."""
    return _RIM, _basket()


def _flip_pan(t: float) -> Posture:
    """A jerk of the pan, and it comes down to meet the pancake."""
    u = t % FLIP_S
    up = ease(u, 0.15, 0.35) - ease(u, 0.45, 0.85)
    return Posture(
        right=Arm((0.40, -0.08, -0.24 + 0.16 * up), DOWN), lean=0.08, nod=0.20 - 0.45 * up,
        left=Arm((0.16, 0.10, -0.40), DOWN), tool=(1.0, -0.1, 0.10 + 0.35 * up),
    )  # fmt: skip


FLIP_S = 1.3
"""Period of a flipped pancake, s."""


def _pancake(t: float) -> list[ModelPart]:
    """In the pan, then turning over in the air."""
    u = t % FLIP_S
    share = min(max((u - 0.28) / 0.80, 0.0), 1.0)
    z = 1.11 + 4.0 * 0.66 * share * (1.0 - share)
    angle = 2.0 * math.pi * share
    half = (0.15 * math.cos(angle), 0.0, 0.15 * math.sin(angle))
    x = 0.82
    return [blade(Material((0.85, 0.55, 0.15)), (x - half[0], -0.30, z - half[2]),
                  (x + half[0], -0.30, z + half[2]), chord=(0.0, 0.30, 0.0),
                  thickness=(-0.03 * math.sin(angle), 0.0, 0.03 * math.cos(angle)))]  # fmt: skip


def _mow(t: float) -> Posture:
    """Leans to the handle of a mower; the legs walk."""
    left, right = (Arm((0.50, side * 0.22, 1.00), OUT, True) for side in (1.0, -1.0))
    return Posture(lean=0.16 + 0.02 * swing(t, 0.9), nod=0.15, left=left, right=right)


def _mower() -> tuple[ModelPart, ...]:
    wheels = [rod(DARK, (x, y, 0.11), (x, y + 0.06, 0.11), 0.11)
              for x in (0.82, 1.36) for y in (0.24, -0.30)]  # fmt: skip
    return (
        *wheels,
        box(Material(RED), (1.09, 0.0, 0.24), (0.66, 0.48, 0.20)),
        post(DARK, (1.16, 0.0, 0.40), (0.26, 0.26, 0.16)),
        *(rod(STEEL, (0.84, y, 0.28), (0.50, y, 1.00), 0.020) for y in (0.20, -0.20)),
        rod(DARK, (0.50, -0.24, 1.00), (0.50, 0.24, 1.00), 0.026),
    )


def _jackhammer(t: float) -> Posture:
    shake = 0.075 * swing(t, 3.1)
    arm, right = (Arm((0.38, side * 0.20, 1.04 + shake), OUT, True) for side in (1.0, -1.0))
    return Posture(hips=(-0.06, 0.0, 0.88 + 0.3 * shake), lean=0.30, nod=0.30 + shake, left=arm,
                   right=right, left_leg=Leg((0.04, 0.22, ANKLE)),
                   right_leg=Leg((-0.04, 0.22, ANKLE)))  # fmt: skip


def _hammer(t: float) -> list[ModelPart]:
    z = 0.075 * swing(t, 3.1)
    return [
        rod(Material(YELLOW), (0.38, 0.0, 0.55 + z), (0.38, 0.0, 1.02 + z), 0.09),
        rod(DARK, (0.38, -0.24, 1.04 + z), (0.38, 0.24, 1.04 + z), 0.025),
        rod(STEEL, (0.38, 0.0, 0.02 + 0.5 * z), (0.38, 0.0, 0.56 + z), 0.035),
        *(ball(Material((0.5, 0.5, 0.48)), (0.38 + a, b, 0.05), (0.13, 0.12, 0.10))
          for a, b in ((0.12, 0.06), (-0.11, 0.08), (0.05, -0.14), (-0.06, -0.10))),
    ]  # fmt: skip


def _chess(t: float) -> Posture:
    """Seated at a board; the right hand lifts a piece and sets it further on."""
    u = t % 2.4
    far, up = ease(u, 0.4, 1.1) - ease(u, 1.6, 2.2), math.sin(math.pi * ease(u, 0.3, 1.2))
    return Posture(
        hips=(0.0, 0.0, SEAT_M), lean=0.22 + 0.10 * far, nod=0.30,
        left=Arm((0.34, -0.02, -0.28), DOWN),
        right=Arm((0.36 + 0.20 * far, -0.12, -0.24 + 0.10 * up), DOWN),
        left_leg=SITTING, right_leg=SITTING,
    )  # fmt: skip


def _video_games(t: float) -> Posture:
    lean = 0.20 * swing(t, 0.7)
    lift = -0.10 + 0.12 * swing(t, 0.9)
    arm = Arm((0.40, -0.12, lift), DOWN)
    return Posture(hips=(0.0, 0.0, SEAT_M), tilt=lean, lean=0.14 + 0.12 * swing(t, 0.5), left=arm,
                   right=arm,
                   left_leg=SITTING, right_leg=SITTING, tool=(1.0, 0.0, 0.2))  # fmt: skip


PLAY_MOVEMENTS: Mapping[str, Movement] = MappingProxyType(
    {
        "fence": _fence, "archery": _archery, "bowl": _bowl, "serve": _serve, "dunk": _dunk,
        "flip pan": _flip_pan, "jackhammer": _jackhammer, "mow": _mow, "play chess": _chess,
        "play video games": _video_games,
    }
)  # fmt: skip
"""Activity → posture of the whole body over time."""

_FOIL = still(stick(DARK, -0.06, 0.08, 0.020), disc(STEEL, (0.0, 0.0, 0.09), (0.14, 0.05), 0.14),
              stick(STEEL, 0.08, 1.02, 0.013))  # fmt: skip
_BOW = still(
    *(
        rod(_BROWN, (0.10 - 0.30 * a * a, 0.0, 0.62 * a), (0.10 - 0.30 * b * b, 0.0, 0.62 * b),
            0.016)
        for a, b in ((-1.0, -0.66), (-0.66, -0.33), (-0.33, 0.0), (0.0, 0.33), (0.33, 0.66),
                     (0.66, 1.0))
    ),
    rod(Material(WHITE), (-0.20, 0.0, -0.62), (-0.20, 0.0, 0.62), 0.006),
)  # fmt: skip


def _arrow(t: float) -> list[ModelPart]:
    """On the string, then on its way, as far as the picture shows it."""
    away = min(5.0 * max(t % 2.6 - SHOT_S, 0.0), 1.3)
    return [stick(WOOD, away - 0.04, away + 0.74, 0.020),
            stick(Material(RED), away - 0.04, away + 0.10, 0.036),
            stick(DARK, away + 0.70, away + 0.82, 0.034)]  # fmt: skip


_RACKET_FACE = 0.48
_RACKET = still(
    stick(DARK, -0.08, 0.26, 0.016),
    disc(Material(RED), (0.0, 0.0, _RACKET_FACE), (0.27, 0.36), 0.024),
    disc(Material((0.7, 0.7, 0.62)), (0.0, 0.0, _RACKET_FACE), (0.22, 0.30), 0.030),
)
_FRYING_PAN = still(
    disc(DARK, (0.0, 0.0, 0.44), (0.34, 0.34), 0.04), stick(DARK, -0.06, 0.30, 0.016)
)
_BOARD = still(
    STOOL,
    box(WOOD, (0.66, 0.0, 0.66), (0.62, 0.90, 0.04)),
    *(rod(WOOD, (x, y, 0.0), (x, y, 0.64), 0.025) for x in (0.40, 0.92) for y in (0.40, -0.40)),
    *(box(DARK if (a + b) % 2 else Material(WHITE), (0.56 + 0.075 * a, -0.19 + 0.075 * b, 0.69),
          (0.075, 0.075, 0.02)) for a in range(5) for b in range(6)),
    *(post(Material(WHITE) if k % 2 else DARK, (0.56 + 0.075 * (k % 5), -0.19 + 0.075 * (k * 3 % 6),
                                                0.75), (0.04, 0.04, 0.11)) for k in range(9)),
)  # fmt: skip
_CONTROLLER = still(
    box(DARK, (0.04, 0.0, 0.0), (0.10, 0.20, 0.05)),
    *(ball(DARK, (0.00, y, -0.01), (0.12, 0.07, 0.06)) for y in (0.09, -0.09)),
)

PLAY_PROPS: Mapping[str, tuple[Prop, ...]] = MappingProxyType(
    {
        "fence": (Prop("right hand", _FOIL, ("sword",)),),
        "archery": (
            Prop("left hand", _BOW, ("bow",)),
            Prop("right hand", _arrow, ("arrow",), is_own=True),
        ),
        "bowl": (Prop("ground", _bowling_ball, ("bowling ball", "ball")),),
        "serve": (
            Prop("right hand", _RACKET, ("tennis racket", "badminton racket")),
            Prop("ground", _served, ("tennis ball", "ball")),
        ),
        "dunk": (
            Prop("ground", _dunked, ("basketball", "ball")),
            Prop("ground", still(*_basket()), ("basketball hoop",)),
        ),
        "flip pan": (
            Prop("right hand", _FRYING_PAN, ("frying pan",)),
            Prop("ground", _pancake, ("pancake",)),
        ),
        "mow": (Prop("ground", still(*_mower()), ("lawn mower",)),),
        "jackhammer": (Prop("ground", _hammer, ("jackhammer", "drill")),),
        "play chess": (Prop("ground", _BOARD, ("chessboard", "chess", "playing card", "table")),),
        "play video games": (
            Prop("ground", still(STOOL)),
            Prop("hands", _CONTROLLER, ("game controller",)),
            Prop("ground", SCREEN, ("tv",), is_own=True, is_shared=True),
        ),
    }
)
"""Activity → what is drawn with it."""
