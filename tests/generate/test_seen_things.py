"""What a scene's camera never sees is found, wherever it hides."""

from __future__ import annotations

from dataclasses import replace
from functools import cache
from typing import ClassVar

import numpy as np
import pytest

from texvent.errors import InputError, warnings_to
from texvent.generate.landmarks import SKY, Landmark
from texvent.generate.procedural import ProceduralConfig, ProceduralGenerator
from texvent.generate.seen_things import find_evidence, image_points, look_for_things
from texvent.generate.sights import Glimpse, Sight
from texvent.scenes.description import SceneDescription, SceneObject
from texvent.scenes.evidence import report_on
from texvent.scenes.language.parser import parse_prompt
from texvent.scenes.models.materials import Material
from texvent.scenes.models.protocol import ModelPart
from texvent.scenes.models.shapes import rod
from texvent.scenes.report import PromptReport
from texvent.scenes.scene import Camera, Shape
from texvent.scenes.staging import compose
from texvent.scenes.staging.assemble import PlacedModel, assemble
from texvent.sensor import SensorSize

SIZE = SensorSize(173, 130)


def ball_scene(scale: float = 1.0):
    description = SceneDescription("a ball", objects=(SceneObject("ball", scale=scale),))
    return compose.compose_scene(description, seed=0, size=SIZE, duration_s=1.0)


@cache
def usual_surroundings(time_s: float):
    return ball_scene().environment(time_s)


def test_a_thing_before_the_camera_is_seen():
    assert look_for_things(ball_scene(), SIZE, 1.0).faults == {1: None}


def test_a_thing_behind_the_camera_is_not():
    scene = ball_scene()
    camera = scene.camera(0.0)

    class Turned(type(scene)):
        def camera(self, time_s):
            axes = np.asarray(camera.rotation)
            return replace(camera, rotation=np.stack([-axes[0], axes[1], -axes[2]]))

    turned = Turned(**vars(scene))
    assert look_for_things(turned, SIZE, 1.0).faults == {1: "out of view"}


def test_one_of_several_is_counted():
    description = parse_prompt("3 balls")
    scene = compose.compose_scene(description, seed=0, size=SIZE, duration_s=1.0)
    assert look_for_things(scene, SIZE, 1.0).faults == dict.fromkeys((1, 2, 3))
    fewer = replace(scene, actors=scene.actors[1:])
    assert look_for_things(fewer, SIZE, 1.0).faults == {1: "out of view", 2: None, 3: None}
    evidence = find_evidence(fewer, description, SIZE, 1.0)
    assert report_on(description, evidence).not_shown == (
        "1 of 3 balls (out of view)", "3 (not all balls in view)"
    )  # fmt: skip


def test_a_thing_behind_a_wall_is_hidden_and_a_sky_behind_it_out_of_view():
    scene = ball_scene()
    camera = scene.camera(0.0)
    ahead = camera.position + 0.3 * camera.rotation[2]

    class Walled(type(scene)):
        def primitives(self, time_s):
            shapes = super().primitives(time_s)
            wall = np.column_stack([9.0 * np.eye(3) * [1.0, 1e-4, 1.0], ahead])
            to_world = np.concatenate([shapes.to_world[:-1], wall[None]])
            shape, instance = shapes.shape.copy(), shapes.instance.copy()
            shape[-1], instance[-1] = Shape.BOX, 0  # the last piece of scenery becomes the wall
            return replace(shapes, to_world=to_world, shape=shape, instance=instance)

    walled = Walled(**vars(scene))
    sky = [Landmark("starry sky", frozenset({SKY}))]
    assert look_for_things(walled, SIZE, 1.0).faults == {1: "hidden"}
    found = look_for_things(walled, SIZE, 1.0, landmarks=sky)
    assert found.places == {"starry sky": "out of view"}
    assert look_for_things(scene, SIZE, 1.0, landmarks=sky).places == {}


class Discs:
    """Flat discs before a camera at the origin that looks north, 10 m away: 10 m fill the width."""

    class_names: ClassVar = {1: "plate", 2: "lid"}

    def __init__(self, *discs: tuple[int, float, float, float]) -> None:
        self.discs = discs
        """Instance, metres to the right, radius, distance."""

    def primitives(self, time_s):
        parts = []
        for _, x, radius, distance in self.discs:
            upright = np.diag([radius, 1e-3, radius])
            to_body = np.column_stack([upright, [x, distance, 0.0]])
            parts.append(ModelPart(Shape.ELLIPSOID, to_body, (0.5, 0.5, 0.5)))
        still = np.eye(4)[:3]
        return assemble(
            [
                PlacedModel([part], still, disc[0])
                for part, disc in zip(parts, self.discs, strict=True)
            ]
        )

    def camera(self, time_s):
        axes = np.array([[1.0, 0.0, 0.0], [0.0, 0.0, -1.0], [0.0, 1.0, 0.0]])
        return Camera(np.zeros(3), axes, 1.0)

    def environment(self, time_s):
        return usual_surroundings(time_s)


@pytest.mark.parametrize(
    ("discs", "reported"),
    [
        # A disc of 1 m fills 20 % of the width, one of 10 cm 2 %, one of 40 cm 8 % and 0.67 % of
        # the points, one of 20 cm 4 % and 0.17 %.
        (((1, 0.0, 1.0, 10.0),), None),
        (((1, 0.0, 0.4, 10.0),), None),
        (((1, 0.0, 0.2, 10.0),), "too small"),
        (((1, 0.0, 0.1, 10.0),), "too small"),
        # The lid before the middle hides 0.9² = 81 % of it, a smaller one 0.7² = 49 %.
        (((1, 0.0, 1.0, 10.0), (2, 0.0, 0.9, 9.99)), "mostly hidden"),
        (((1, 0.0, 1.0, 10.0), (2, 0.0, 0.7, 9.99)), None),
        # The picture's edge is 5 m to the right: 0.5 m of 4 m are inside, or 2.5 m.
        (((1, 6.5, 2.0, 10.0),), "cut off"),
        (((1, 4.5, 2.0, 10.0),), None),
        (((1, 8.0, 2.0, 10.0),), "out of view"),
    ],
)
def test_a_thing_that_is_hardly_seen_is_named_with_the_reason(discs, reported):
    scene = Discs(*discs)
    scene.class_names = {disc[0]: Discs.class_names[disc[0]] for disc in discs}
    assert look_for_things(scene, SIZE, 0.0).faults[1] == reported


def test_what_flits_by_is_in_view_too_briefly():
    told, out = Glimpse(200, 200, 0.3, 1.0), Glimpse(0, 0, 0.0, 0.0)
    for count, reported in ((1, "in view too briefly"), (2, None)):
        sight = Sight([*[told] * count, *[out] * (9 - count)])
        assert sight.fault(4000, 90_000) == reported


def test_a_string_counts_as_little_as_it_covers():
    """A rod of 3 cm across that goes 12 m up, and a plate of 2 m at its end, above the image."""
    scene = Discs((1, 0.0, 1.0, 10.0))
    scene.class_names = {1: "plate"}
    plain = scene.primitives

    def flown(time_s):
        at = np.array([0.0, 10.0, 4.6])
        plate = ModelPart(
            Shape.ELLIPSOID, np.column_stack([np.diag([1.0, 0.01, 1.0]), at]), (0.5, 0.5, 0.5)
        )
        parts = [plate, rod(Material((0.5, 0.5, 0.5)), (-8.0, 10.0, -4.4), tuple(at), 0.015)]
        return assemble([PlacedModel(parts, np.eye(4)[:3], 1)])

    scene.primitives = flown
    assert look_for_things(scene, SIZE, 0.0).faults == {1: "cut off"}
    scene.primitives = plain
    assert look_for_things(scene, SIZE, 0.0).faults == {1: None}


@pytest.mark.parametrize(
    ("lowered", "reported"), [(0.0, None), (0.45, "head out of view"), (-0.3, None)]
)
def test_a_person_without_a_head_is_not_told(lowered, reported):
    """The camera goes down by a share of the man's height."""
    description = SceneDescription("a man", objects=(SceneObject("man"),))
    scene = compose.compose_scene(description, seed=0, size=SIZE, duration_s=1.0)
    camera, height = scene.camera(0.0), scene.actors[0].model.height
    place = camera.position + lowered * height * np.asarray(camera.rotation)[1]

    class Moved(type(scene)):
        def camera(self, time_s):
            return replace(camera, position=np.asarray(place))

    evidence = find_evidence(Moved(**vars(scene)), description, SIZE, 1.0)
    assert evidence.faults[0] == [reported]


@pytest.mark.parametrize(("share", "reported"), [(0.35, None), (0.8, "cut off")])
def test_a_portrait_is_told_by_its_head_and_half_a_body_afar_is_not(share, reported):
    """The camera goes near the head, or to the side until the body is half out of the picture."""
    description = SceneDescription("a man", objects=(SceneObject("man"),))
    scene = compose.compose_scene(description, seed=0, size=SIZE, duration_s=1.0)
    camera, man = scene.camera(0.0), scene.actors[0]
    axes = np.asarray(camera.rotation)
    head = man.anchor("head", 0.0)[:, 3]
    away = share * float((head - camera.position) @ axes[2])
    place = head - away * axes[2] + (0.0 if reported is None else 0.43 * away * axes[0])

    class Moved(type(scene)):
        def camera(self, time_s):
            return replace(camera, position=np.asarray(place))

    evidence = find_evidence(Moved(**vars(scene)), description, SIZE, 1.0)
    assert evidence.faults[0] in ([reported], ["head out of view"] if reported else [None])


def test_what_fills_a_few_pixels_of_a_coarse_sensor_is_too_small():
    scene = Discs((1, 0.0, 0.4, 10.0))  # 8 % of the width: 150 pixels of one sensor, 5 of another
    scene.class_names = {1: "plate"}
    assert look_for_things(scene, SIZE, 0.0).faults == {1: None}
    assert look_for_things(scene, SensorSize(32, 24), 0.0).faults == {1: "too small"}


def test_motion_is_what_moves_in_the_image():
    """A disc 10 m away that goes 40 cm moves 7 pixels; 4 mm are none, nor does a camera move it."""

    class Moving(Discs):
        class_names: ClassVar = {1: "plate"}
        way = 0.0
        turn = 0.0

        def primitives(self, time_s):
            shapes = super().primitives(time_s)
            shapes.to_world[:, 0, 3] += self.way * time_s
            return shapes

        def camera(self, time_s):
            angle = self.turn * time_s
            cosine, sine = np.cos(angle), np.sin(angle)
            axes = [[cosine, sine, 0.0], [0.0, 0.0, -1.0], [-sine, cosine, 0.0]]
            return replace(super().camera(time_s), rotation=np.array(axes))

    scene = Moving((1, 0.0, 1.0, 10.0))
    for way, turn, still in ((0.4, 0.0, set()), (0.004, 0.0, {1}), (0.0, 0.2, {1})):
        scene.way, scene.turn = way, turn
        assert look_for_things(scene, SIZE, 1.0).still == still


def test_a_place_is_in_view_if_its_scenery_is():
    scene = ball_scene()
    nouns = scene.list_scenery()
    assert len(nouns) <= len(scene.primitives(0.0).shape)
    assert set(nouns) > {"", "bush"}
    seen, unseen = Landmark("shrubs", frozenset({"bush"})), Landmark("forest", frozenset({"pine"}))
    found = look_for_things(scene, SIZE, 1.0, landmarks=[seen, unseen], scenery=nouns)
    assert found.places == {"forest": "out of view"}


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


def test_what_is_part_of_another_model_is_seen_with_it():
    generator = ProceduralGenerator(ProceduralConfig(duration=0.5), size=SIZE)
    for prompt, word in (("a person types on a laptop", "laptop"),
                         ("a man in a white shirt waves", "shirt")):  # fmt: skip
        assert word in generator.report(prompt).shown


def test_what_is_never_in_view_is_reported_and_refused_by_strict(monkeypatch):
    whole = compose.compose_scene

    def without_ball(description, **options):
        scene = whole(description, **options)
        return replace(scene, actors=scene.actors[1:])  # the ball has a name, but no body

    monkeypatch.setattr(compose, "compose_scene", without_ball)
    config = ProceduralConfig(duration=0.5)
    prompt = "a red ball bounces and a dog runs"
    said: list[str] = []
    # Not pytest.warns, which loses warnings where another thread compiles a kernel meanwhile.
    with warnings_to(said.append):
        video = ProceduralGenerator(config, size=SIZE).generate(prompt)
    assert any("prompt words not shown: ball (out of view" in one for one in said)
    report = PromptReport.of_metadata(video.metadata)
    assert report.not_shown == (
        "ball (out of view)", "red (ball out of view)", "bounces (ball out of view)",
    )  # fmt: skip
    assert report.shown == ("dog", "runs")
    with pytest.raises(InputError, match=r"strict: .* not shown: ball"):
        ProceduralGenerator(replace(config, strict=True), size=SIZE).generate(prompt)


def test_a_large_thing_of_which_a_corner_fills_the_picture_is_cut_off() -> None:
    corner = Glimpse(points=60, alone=60, extent=1.0, inside=0.1)
    assert corner.fault(100, 22_490) == "cut off"
    assert corner._replace(inside=0.35).fault(100, 22_490) is None


@pytest.mark.parametrize("prompt", ["a pink bicycle", "a red motorcycle"])
def test_a_bicycle_has_the_colour_of_its_frame(prompt: str) -> None:
    report = ProceduralGenerator(ProceduralConfig(duration=0.5), size=SIZE).report(prompt)
    assert prompt.split()[1] in report.shown


def test_what_is_as_thin_as_a_line_is_too_small() -> None:
    line = Glimpse(points=8, alone=8, extent=0.5, inside=1.0)
    assert line.fault(1000, 22_490) == "too small"
    assert line._replace(points=14, alone=14).fault(1000, 22_490) is None
