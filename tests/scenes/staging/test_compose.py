"""Scenes: actors, scenery, camera and light."""

from __future__ import annotations

import math
from functools import lru_cache

import numpy as np
import pytest

from texvent.errors import InputError
from texvent.generate.scene_input import understand
from texvent.scenes import projection
from texvent.scenes.description import SceneDescription, SceneObject, Surroundings
from texvent.scenes.models.nouns import NOUNS
from texvent.scenes.scene import Camera, Float64Array, Ground
from texvent.scenes.staging.actors import Actor
from texvent.scenes.staging.acts.acts import ACTS
from texvent.scenes.staging.camera.framing import fit, look_at
from texvent.scenes.staging.compose import ComposedScene, compose_scene
from texvent.sensor import SensorSize

SIZE = SensorSize(346, 260)
PROMPTS = (
    "a red car drives left past two trees at dusk",
    "The camera follows behind a white SUV with a black roof rack as it speeds up a steep dirt "
    "road surrounded by pine trees on a steep mountain slope, dust kicks up from its tires",
    "ostriches crossing the grassland",
    "sharks in the ocean",
    "a horse gallops towards the camera",
    "a man with a dog walks to the right on the beach at sunset",
    "two small blue balls bounce on a wooden floor",
    "a helicopter orbits around a building",
    "a butterfly flies around a flower",
    "a car at 50 km/h on a highway",
    "a cow between a house and a tree, handheld camera",
    "the camera orbits around a chair and a table",
    "a boy kicks a ball",
    "a man rides a horse in the rain",
    "a flock of birds flies over the sea",
    "the camera pans right over a city street with parked cars at night",
    "a lamp flickering at 50 Hz on a table indoors, zoom in",
    "two people sit on a sofa",
    "aerial view of a city with many cars",
    "a ball swings, tilt up",
    "a train crosses a bridge in the snow",
    "a rocket launches",
    "an eagle soars over snowy mountains, the camera tracks it",
)
TIMES = (0.0, 0.4, 1.0, 1.7, 2.0)


@lru_cache(maxsize=64)
def described(prompt: str) -> SceneDescription:
    return understand(prompt, NOUNS)


@lru_cache(maxsize=64)
def staged(prompt: str, seed: int = 0, duration_s: float = 2.0) -> ComposedScene:
    return compose_scene(described(prompt), seed=seed, size=SIZE, duration_s=duration_s)


def project(camera: Camera, points: Float64Array, size: SensorSize) -> Float64Array:
    """Right and down in half image sizes from the middle (-1..1 is inside), and depth, m."""
    half = np.array([0.5 * size.width, 0.5 * size.height])
    image_points = projection.project(camera, size, points)
    return np.column_stack([image_points[:, :2] / half - 1.0, image_points[:, 2]])


def seen(scene: ComposedScene, actor: Actor, time_s: float) -> Float64Array:
    return project(scene.camera(time_s), actor.corners(time_s), SIZE)


@pytest.mark.parametrize("prompt", PROMPTS)
def test_the_subjects_are_in_the_image_throughout(prompt: str) -> None:
    scene = staged(prompt)
    movers = [actor for actor in scene.actors if actor.is_mover] or list(scene.actors)
    for actor in movers:
        for time in TIMES:
            middle = project(scene.camera(time), actor.middle(time)[None], SIZE)[0]
            if described(prompt).objects[actor.object_index].side != "far":
                assert middle[2] > 0.0
                assert np.abs(middle[:2]).max() < 0.98, (actor.noun.name, time)


@pytest.mark.parametrize("prompt", PROMPTS)
def test_the_main_subject_is_large_enough_to_name(prompt: str) -> None:
    scene = staged(prompt)
    extents = []
    for actor in scene.actors:
        points = seen(scene, actor, 1.0)
        pixels = np.ptp(points[:, :2], axis=0) * [SIZE.width / 2, SIZE.height / 2]
        extents.append(pixels.max())
    assert max(extents) > 36.0


@pytest.mark.parametrize("prompt", PROMPTS)
def test_shapes_keep_their_number_and_order(prompt: str) -> None:
    scene = staged(prompt)
    first = scene.primitives(0.0)
    for time in (0.013, 0.9, 2.0):
        later = scene.primitives(time)
        np.testing.assert_array_equal(first.shape, later.shape)
        np.testing.assert_array_equal(first.instance, later.instance)
        np.testing.assert_array_equal(first.colour, later.colour)
        assert np.isfinite(later.to_world).all()


@pytest.mark.parametrize("prompt", PROMPTS)
def test_something_moves_and_nothing_jumps(prompt: str) -> None:
    scene = staged(prompt)
    start, later = scene.primitives(0.0), scene.primitives(0.7)
    moved = np.abs(start.to_world - later.to_world).max() > 0.01
    turned = np.abs(scene.camera(0.0).rotation - scene.camera(0.7).rotation).max() > 1e-3
    zoomed = abs(scene.camera(0.0).focal - scene.camera(0.7).focal) > 1e-3
    assert moved or turned or zoomed
    for time in np.linspace(0.0, 2.0, 9):
        before, after = scene.camera(float(time)), scene.camera(float(time) + 1e-3)
        assert np.abs(before.position - after.position).max() < 0.1
        assert np.abs(before.rotation - after.rotation).max() < 0.01
        np.testing.assert_allclose(before.rotation @ before.rotation.T, np.eye(3), atol=1e-9)
        assert before.position[2] > 0.0 or scene.environment(0.0).ground is Ground.NONE


def test_the_same_seed_gives_the_same_scene_and_another_seed_another_layout() -> None:
    description = described(PROMPTS[0])
    layouts = [
        compose_scene(description, seed=seed, size=SIZE, duration_s=2.0) for seed in (0, 0, 1)
    ]
    maps = [scene.primitives(0.5).to_world for scene in layouts]
    np.testing.assert_array_equal(maps[0], maps[1])
    assert maps[0].shape != maps[2].shape or np.abs(maps[0] - maps[2]).max() > 0.1
    for scene in layouts:
        names = list(scene.class_names.values())
        assert (names.count("car"), names.count("tree")) == (1, 2)


@pytest.mark.parametrize("prompt", PROMPTS)
def test_every_instance_has_a_class_name(prompt: str) -> None:
    scene = staged(prompt)
    ids = set(scene.primitives(0.0).instance.tolist()) - {0}
    assert ids == set(scene.class_names)
    assert set(scene.class_names.values()) <= set(NOUNS)


def test_counts_become_that_many_instances() -> None:
    scene = staged("three dogs, a cat and 5 balloons")
    names = list(scene.class_names.values())
    assert [names.count(noun) for noun in ("dog", "cat", "balloon")] == [3, 1, 5]


def test_excluded_nouns_are_no_scenery() -> None:
    scene = staged("a dog runs in a forest without trees, pines or bushes")
    assert "tree" not in scene.class_names.values()
    wooded = staged("a dog runs in a forest")
    assert len(scene.still.shape) < len(wooded.still.shape)


@pytest.mark.parametrize("hertz", [1.0, 50.0, 120.0])
def test_flicker_has_exactly_the_stated_frequency(hertz: float) -> None:
    scene = staged(f"a lamp on a table, the light flickers at {hertz:g} Hz")
    times = np.arange(4000) / 4000.0
    light = np.array([scene.environment(float(t)).ambient[0] for t in times])
    spectrum = np.abs(np.fft.rfft(light - light.mean()))
    assert np.argmax(spectrum) == hertz
    assert light.min() > 0.0
    assert light[0] == light.max()
    steady = staged("a lamp on a table")
    assert steady.environment(0.0).ambient[0] == steady.environment(0.0037).ambient[0]


def test_flicker_dims_lamps_and_glowing_parts_too() -> None:
    scene = staged("a street lamp at night in the city, the light flickers at 10 Hz")
    bright, dim = 0.0, 0.05
    glow = scene.primitives(bright).emission
    np.testing.assert_allclose(scene.primitives(dim).emission, 0.2 * glow, rtol=1e-5)
    lamps = scene.environment(bright).lamps
    np.testing.assert_allclose(scene.environment(dim).lamps[:, 3:6], 0.2 * lamps[:, 3:6])
    np.testing.assert_array_equal(scene.environment(dim).lamps[:, :3], lamps[:, :3])


def test_a_following_camera_keeps_its_subject_in_place() -> None:
    scene = staged(PROMPTS[1])
    suv = scene.actors[0]
    spots = [project(scene.camera(t), suv.middle(t)[None], SIZE)[0, :2] for t in TIMES]
    np.testing.assert_allclose(spots, np.tile(spots[0], (len(TIMES), 1)), atol=1e-9)
    assert np.linalg.norm(suv.middle(2.0) - suv.middle(0.0)) > 5.0


@pytest.mark.parametrize(
    ("direction", "axis", "sign"),
    [("left", 0, -1), ("right", 0, 1), ("towards the camera", 1, -1), ("away", 1, 1)],
)
def test_directions_are_as_the_viewer_sees_them(direction: str, axis: int, sign: int) -> None:
    scene = staged(f"a car drives {direction}")
    step = scene.actors[0].middle(2.0) - scene.actors[0].middle(0.0)
    assert sign * step[axis] > 3.0
    if axis == 0:
        start, end = (
            project(scene.camera(t), scene.actors[0].middle(t)[None], SIZE)[0] for t in (0.0, 2.0)
        )
        assert sign * (end[0] - start[0]) > 0.3


@pytest.mark.parametrize("duration_s", [1.0, 2.0, 4.0])
@pytest.mark.parametrize(
    ("prompt", "sign"),
    [
        ("a car drives toward the camera", -1),
        ("a dog runs toward the camera", -1),
        ("a bus drives away from the camera", 1),
    ],
)
def test_what_comes_or_goes_is_not_followed(prompt: str, sign: int, duration_s: float) -> None:
    scene = staged(prompt, duration_s=duration_s)
    assert not scene.not_shown
    start, end = (
        np.linalg.norm(scene.actors[0].middle(t) - scene.camera(t).position)
        for t in (0.0, duration_s)
    )
    assert sign * (end - start) > 0.25 * start


@pytest.mark.parametrize(
    ("prompt", "check"),
    [
        ("a cup on a table", lambda a, b: a[2] > 0.7 and abs(a[0] - b[0]) < 0.5),
        ("a dog behind a house", lambda a, b: a[1] > b[1]),
        ("a dog in front of a house", lambda a, b: a[1] < b[1]),
        ("a drone hovers above a house", lambda a, b: a[2] > b[2] + 3.0),
        ("a cat to the left of a chair", lambda a, b: a[0] < b[0]),
        ("a cat to the right of a chair", lambda a, b: a[0] > b[0]),
        ("a car drives right past a house", lambda a, b: abs(a[0] - b[0]) < 2.0 < b[1] - a[1]),
        ("a dog next to a ball", lambda a, b: 0.3 < np.hypot(*(a - b)[:2]) < 4.0),
    ],
)
def test_relations_become_positions(prompt: str, check: object) -> None:
    scene = staged(prompt)
    subject, target = scene.actors[0].middle(1.0), scene.actors[1].middle(1.0)
    assert callable(check)
    assert check(subject, target)


@pytest.mark.parametrize("prompt", PROMPTS)
def test_actors_do_not_stand_in_one_another(prompt: str) -> None:
    scene = staged(prompt)
    touching = {"on", *ACTS}
    if any(relation.kind in touching for relation in described(prompt).relations):
        return
    for time in (0.0, 1.0, 2.0):
        boxes = [actor.corners(time) for actor in scene.actors]
        for one in range(len(boxes)):
            for two in range(one):
                low = np.maximum(boxes[one].min(axis=0), boxes[two].min(axis=0))
                high = np.minimum(boxes[one].max(axis=0), boxes[two].max(axis=0))
                shared = float(np.prod(np.maximum(high - low, 0.0)))
                smaller = min(
                    float(np.prod(np.ptp(box, axis=0))) for box in (boxes[one], boxes[two])
                )
                names = scene.actors[one].noun.name, scene.actors[two].noun.name
                assert shared < 0.15 * smaller, (names, time)


def test_a_noun_alone_is_large_in_the_image() -> None:
    for name in list(NOUNS)[::7]:
        thing = SceneDescription("", (SceneObject(name),), surroundings=Surroundings("grass"))
        scene = compose_scene(thing, seed=0, size=SIZE, duration_s=2.0)
        for time in (0.0, 2.0):
            points = seen(scene, scene.actors[0], time)
            assert points[:, 2].min() > 0.0, name
            pixels = np.ptp(points[:, :2], axis=0) * [SIZE.width / 2, SIZE.height / 2]
            assert pixels.max() > 40.0, name
            assert np.abs(points[:, :2].mean(axis=0)).max() < 0.9, name


@pytest.mark.parametrize("duration_s", [0.1, 0.5, 8.0])
def test_short_and_long_clips_keep_the_subject_in_view(duration_s: float) -> None:
    scene = staged("a dog runs left past a bench", duration_s=duration_s)
    for time in np.linspace(0.0, duration_s, 5):
        middle = project(scene.camera(float(time)), scene.actors[0].middle(float(time))[None], SIZE)
        assert np.abs(middle[0, :2]).max() < 0.98


@pytest.mark.parametrize("duration_s", [0.0, -1.0, math.inf, math.nan])
def test_a_clip_without_a_length_is_an_error(duration_s: float) -> None:
    with pytest.raises(InputError, match="it must be a positive number of seconds"):
        compose_scene(described("a dog"), seed=0, size=SIZE, duration_s=duration_s)


@pytest.mark.parametrize("size", [(64, 64), (1280, 720), (120, 400)])
def test_the_framing_suits_the_shape_of_the_image(size: tuple[int, int]) -> None:
    width, height = size
    scene = compose_scene(
        described(PROMPTS[0]), seed=0, size=SensorSize(width, height), duration_s=2.0
    )
    for time in TIMES:
        points = project(
            scene.camera(time), scene.actors[0].corners(time), SensorSize(width, height)
        )
        assert np.abs(points[:, :2]).max() < 1.0


def test_fit_gives_the_nearest_station_that_holds_all_points() -> None:
    points = np.array([[-2.0, 0.0, 0.0], [2.0, 0.0, 0.0], [0.0, 0.0, 1.0]])
    framing = fit(points, azimuth=0.0, elevation=0.0, aspect=0.75, fill=0.8, focal=1.0)
    assert framing.distance_m == pytest.approx(2.0 * 2.0 / 0.8)
    camera = look_at(framing.position, framing.target, framing.focal)
    assert np.abs(project(camera, points, SensorSize(4, 3))[:, 0]).max() == pytest.approx(0.8)


def test_project_follows_the_camera_conventions() -> None:
    camera = look_at(np.array([0.0, -10.0, 1.0]), np.array([0.0, 0.0, 1.0]), 1.0)
    right_up = project(camera, np.array([[5.0, 0.0, 1.0], [0.0, 0.0, 3.0]]), SensorSize(2, 2))
    np.testing.assert_allclose(right_up, [[1.0, 0.0, 10.0], [0.0, -0.4, 10.0]], atol=1e-12)


def test_unknown_words_do_not_change_the_scene() -> None:
    plain, noisy = staged("a red car drives left"), staged("a red car drives left blorp")
    np.testing.assert_array_equal(plain.primitives(0.3).to_world, noisy.primitives(0.3).to_world)


@pytest.mark.parametrize("nouns", [("house", "tree"), ("ball", "cube"), ("man", "bus")])
def test_left_and_right_are_so_in_the_picture(nouns: tuple[str, str]) -> None:
    objects = tuple(
        SceneObject(noun, side=side) for noun, side in zip(nouns, ("left", "right"), strict=True)
    )
    description = SceneDescription("", objects, surroundings=Surroundings("grass"))
    scene = compose_scene(description, seed=0, size=SIZE, duration_s=2.0)
    for time in TIMES:
        left, right = (float(seen(scene, one, time)[:, 0].mean()) for one in scene.actors)
        assert left < 0.0 < right
