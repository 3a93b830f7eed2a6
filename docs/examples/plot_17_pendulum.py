"""
A pendulum kept upright by events
=================================

The controller sees nothing but events. The embedded renderer draws the rod as it stands,
:class:`texvent.EventCamera` takes a picture every 5 ms, and the events correct a prediction of the
angle. The rod gets a kick every half second. Without its events the controller lets it fall.
"""

from dataclasses import dataclass, replace
from typing import Any

import matplotlib.pyplot as plt
import numpy as np

import texvent
from texvent.camera import project
from texvent_scenes import Camera, Place, Scene, SceneObject

STEP_S, STEPS = 0.005, 400
LENGTH_M, RADIUS_M = 1.0, 0.03
FALL = 1.5 * 9.81 / LENGTH_M  # of a rod: angle'' = FALL sin(angle) + torque / inertia


@dataclass
class PosedScene:
    """A scene whose one object is a rod on its foot, tilted as `angle` says (rad)."""

    scene: Any
    angle: float = 0.0

    def primitives(self, time_s):
        shapes = self.scene.primitives(0.0)
        cos, sin = np.cos(self.angle), np.sin(self.angle)
        tilt = np.array([[cos, 0, sin], [0, 1, 0], [-sin, 0, cos]])
        half = LENGTH_M / 2
        pose = np.c_[tilt @ np.diag([RADIUS_M, RADIUS_M, half]), tilt @ [0, 0, half]]
        is_rod = (shapes.instance == 1)[:, None, None]
        return replace(shapes, to_world=np.where(is_rod, pose, shapes.to_world))

    def camera(self, time_s):
        return self.scene.camera(0.0)

    def environment(self, time_s):
        return self.scene.environment(0.0)


class Controller:
    """Torque from events: an observer of angle and angular velocity, and a PD law."""

    def __init__(self, foot):
        self.foot, self.angle, self.velocity, self.torque = foot, 0.0, 0.0, 0.0

    def act(self, events):
        self.velocity += (FALL * np.sin(self.angle) + self.torque) * STEP_S
        self.angle += self.velocity * STEP_S
        seen = np.arctan2(events.x + 0.5 - self.foot[0], self.foot[1] - events.y - 0.5)
        near = np.abs(seen - self.angle) < 0.2
        # One edge of the rod gets brighter as the other gets darker: it is between them.
        edges = [seen[near & (events.p == p)] for p in (0, 1)]
        if min(map(len, edges)) >= 5:
            error = np.mean([np.mean(edge) for edge in edges]) - self.angle
            self.angle += 0.3 * error
            self.velocity += 8.0 * error
        self.torque = -60.0 * self.angle - 12.0 * self.velocity
        return self.torque


def balance(*, sees):
    """Angles of the rod, rad, and all events, with or without events for the controller."""
    rod.angle, velocity, angles, all_events = 0.0, 0.0, [], []
    controller = Controller(foot)
    nothing = texvent.EventStream.empty(picture.size)
    with texvent.EventCamera(picture.size, seed=1) as camera:
        for step in range(STEPS):
            t_us = round(step * STEP_S * 1e6)
            events = camera.step(picture.at(t_us).pixels, t_us)
            torque = controller.act(events if sees else nothing)
            velocity += (FALL * np.sin(rod.angle) + torque) * STEP_S
            velocity += (0.8, -1.2)[step // 100 % 2] if step % 100 == 50 else 0.0
            rod.angle += velocity * STEP_S
            angles.append(rod.angle)
            all_events.append(events)
            if abs(rod.angle) > np.pi / 2:
                break
    return np.array(angles), texvent.EventStream.concat(all_events)


view = Camera(position_m=(0, -2, 0.55), look_at_m=(0, 0, 0.55))
cylinder = SceneObject(noun="cylinder", position_m=(0, 0))
scene = Scene(objects=(cylinder,), camera=view, place=Place(is_empty=True))
video = texvent.video(scene, sensor="128x96", shadows=False, point_spread=0)
rod = PosedScene(video.scene)
picture = replace(video, scene=rod)
foot = project(rod.camera(0), video.size, np.zeros(3))

upright, events = balance(sees=True)
fallen, _ = balance(sees=False)

figure, (left, right) = plt.subplots(1, 2, figsize=(7, 3), layout="constrained")
for angles, name in ((upright, "with events"), (fallen, "without")):
    left.plot(np.arange(len(angles)) * STEP_S, np.degrees(angles), label=name)
left.set(xlabel="s", ylabel="angle, degrees", ylim=(-30, 90))
left.legend()
events.between(250_000, 400_000).plot(ax=right)
