"""What a scene's camera never sees is found, wherever it hides."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
import pytest

from texvent.errors import InputError, TexventWarning
from texvent.generate.procedural import ProceduralConfig, ProceduralGenerator
from texvent.generate.seen_things import image_points, list_unseen
from texvent.scenes.description import SceneDescription, SceneObject
from texvent.scenes.report import PromptReport
from texvent.scenes.staging import compose
from texvent.sensor import SensorSize

SIZE = SensorSize(173, 130)


def ball_scene(scale: float = 1.0):
    description = SceneDescription("a ball", objects=(SceneObject("ball", scale=scale),))
    return compose.compose_scene(description, seed=0, size=SIZE, duration_s=1.0)


def test_a_thing_before_the_camera_is_seen():
    assert list_unseen(ball_scene(), SIZE, 1.0) == ()


def test_a_thing_behind_the_camera_is_not():
    scene = ball_scene()
    camera = scene.camera(0.0)

    class Turned(type(scene)):
        def camera(self, time_s):
            axes = np.asarray(camera.rotation)
            return replace(camera, rotation=np.stack([-axes[0], axes[1], -axes[2]]))

    turned = Turned(**vars(scene))
    assert list_unseen(turned, SIZE, 1.0) == ("ball",)


def test_one_of_several_is_counted():
    description = SceneDescription("3 balls", objects=(SceneObject("ball", count=3),))
    scene = compose.compose_scene(description, seed=0, size=SIZE, duration_s=1.0)
    assert list_unseen(scene, SIZE, 1.0) == ()
    fewer = replace(scene, actors=scene.actors[1:])
    assert list_unseen(fewer, SIZE, 1.0) == ("1 of 3 balls",)


@pytest.mark.parametrize("size", [(346, 260), (1280, 720), (32, 24)])
def test_points_lie_in_the_image_and_meet_what_is_narrow(size):
    points = image_points(SensorSize(*size))
    assert len(points) <= 4100
    assert np.all(points > 0)
    assert np.all(points < size)
    step = np.ceil(np.sqrt(size[0] * size[1] / 4000))
    # A pole of two pixels, as high as the image, anywhere but at its border.
    for left in range(int(step), size[0] - int(step) - 2):
        assert np.any((points[:, 0] > left) & (points[:, 0] < left + 2))


def test_what_is_never_in_view_is_reported_and_refused_by_strict(monkeypatch):
    whole = compose.compose_scene

    def without_ball(description, **options):
        scene = whole(description, **options)
        return replace(scene, actors=scene.actors[1:])  # the ball has a name, but no body

    monkeypatch.setattr(compose, "compose_scene", without_ball)
    config = ProceduralConfig(duration=0.5)
    prompt = "a red ball bounces and a dog runs"
    with pytest.warns(TexventWarning, match="prompt words not shown: ball .out of view"):
        video = ProceduralGenerator(config, size=SIZE).generate(prompt)
    report = PromptReport.of_metadata(video.metadata)
    assert report.not_shown == ("ball (out of view, hidden or too small)",)
    assert "ball" not in report.shown
    with pytest.raises(InputError, match=r"strict: .* not shown: ball"):
        ProceduralGenerator(replace(config, strict=True), size=SIZE).generate(prompt)
