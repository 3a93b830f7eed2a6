"""A board that moves before still ground, whose truth can be computed by hand.

The camera stands at (0, -8, 1.5) m and looks north, level; its focal length is the image's width.
The board's front is 7.5 m away, 2 m wide and 2 m high, and moves 3 m/s to the right.
"""

from fractions import Fraction

from texvent.camera import PosedCamera
from texvent.sensor import SensorSize
from texvent_scenes.procedural import ProceduralConfig, ProceduralVideo
from texvent_scenes.rendered_scene import Ground, Shape

from ..scenes.hand_scenes import HandScene, MovingShape, day, look_at, moving

SIZE = SensorSize(80, 60)
FPS = Fraction(25)
SPEED_MS = 3.0
DEPTH_M = 7.5
SPEED_PX_PER_FRAME = SPEED_MS * 80.0 / DEPTH_M / 25.0


def level(time_s: float) -> PosedCamera:
    return look_at((0.0, -8.0, 1.5), (0.0, 0.0, 1.5))


def board_video(camera_at=level, duration: float = 0.2) -> ProceduralVideo:
    board = MovingShape(
        Shape.BOX, (1.0, 0.5, 1.0), moving((-1.0, 0.0, 1.5), (SPEED_MS, 0.0, 0.0)), instance=3
    )
    scene = HandScene((board,), camera_at, day(Ground.PLAIN), class_names={3: "box"})
    return ProceduralVideo(
        scene,
        SIZE,
        ProceduralConfig(fps=FPS, duration=duration, samples=1, shadows=False, point_spread=0.0),
    )
