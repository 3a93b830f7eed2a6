"""What breaks, what comes down into something, and places that one moves through."""

import itertools

import numpy as np
import pytest
from tests.scenes.test_short_prompts import staged

from texvent_scenes.models.anchors import find_rim

CLIP_S = 2.0


def faults(text):
    said = staged(text)[1]
    return [*said.not_understood, *said.not_shown, *said.out_of_view, *said.substituted]


def actor_of(text, noun):
    return next(one for one in staged(text)[0].actors if one.noun.name == noun)


def pieces(scene, time_s):
    """[n, 3] places of the pieces at an instant, those that are not there left out."""
    places = [one.at(time_s).to_world for one in scene.particles.effects]
    found = np.concatenate(places)
    is_there = np.linalg.norm(found[:, :, :3], axis=(1, 2)) > 1e-4
    return found[is_there][:, :, 3]


@pytest.mark.parametrize(
    ("text", "noun", "is_on_floor"),
    [("a green balloon bursts", "balloon", False), ("a mug falls and breaks", "mug", True),
     ("a bottle falls off the table and shatters", "bottle", True),
     ("a girl drops a plate and it smashes", "plate", True)],
)  # fmt: skip
def test_pieces_of_what_breaks_fly_from_where_it_was_and_come_to_rest(text, noun, is_on_floor):
    scene, one = staged(text)[0], actor_of(text, noun)
    at = one.breaks_s
    assert not faults(text)
    assert 0.1 < at < 0.9 * CLIP_S
    assert not len(pieces(scene, at - 1e-3))
    corners, born = one.corners(at), pieces(scene, at + 1e-4)
    room = 0.1 * one.size_m
    assert len(born) >= 10
    assert (born > corners.min(axis=0) - room).all()
    assert (born < corners.max(axis=0) + room).all()
    assert np.linalg.det(one.place(at + 1e-3).to_world[:, :3]) < 1e-9
    assert (one.lowest_m(at - 1e-3) < 0.15 * one.size_m) == is_on_floor
    last, before = pieces(scene, CLIP_S), pieces(scene, CLIP_S - 0.05)
    assert last[:, 2].min() > -1e-3
    assert (np.abs(last - before).max() < 1e-9) == is_on_floor


@pytest.mark.parametrize(
    ("text", "noun", "target"),
    [("a basketball flies through the hoop", "basketball", "basketball hoop"),
     ("a golf ball rolls into the hole", "golf ball", "golf hole"),
     ("a woman throws a ball into a bin", "ball", "dustbin"),
     ("a boy throws a basketball into the hoop", "basketball", "basketball hoop")],
)  # fmt: skip
def test_what_goes_into_something_comes_down_through_its_rim(text, noun, target):
    ball, goal = actor_of(text, noun), actor_of(text, target)
    rim = find_rim(goal.noun.name, goal.model)
    to_world = goal.track.at(0.0).to_world()
    middle = to_world @ [rim.x, 0.0, rim.height, 1.0]
    places = np.array([ball.track.at(at).position for at in np.linspace(0.0, CLIP_S, 2001)])
    places[:, 2] += 0.5 * ball.lift_m
    below = np.flatnonzero((places[:-1, 2] > middle[2]) & (places[1:, 2] <= middle[2]))
    aside = np.linalg.norm(places[below, :2] - middle[:2], axis=1)
    assert not faults(text)
    assert aside.min() < rim.radius
    assert np.linalg.norm(places[-1, :2] - middle[:2]) < 0.5 * max(goal.size_m, 0.15)


def test_a_ball_that_is_kicked_into_a_net_stays_there():
    text = "a girl kicks a football into the net"
    ball, goal = actor_of(text, "football"), actor_of(text, "goal")
    place = ball.middle(CLIP_S) - goal.track.at(0.0).to_world()[:, 3]
    x, y, _ = place @ goal.track.at(0.0).to_world()[:, :3]
    assert not faults(text)
    assert -1.2 < x < 0.0
    assert abs(y) < 2.5


@pytest.mark.parametrize(
    "text",
    [
        "walking down a hallway",
        "a woman walks along a corridor",
        "a dog runs down a hotel corridor",
    ],
)
def test_a_corridor_is_narrow_and_leads_ahead(text):
    scene, *_ = staged(text)
    around = scene.environment(0.0)
    camera = scene.camera(0.0)
    assert not faults(text)
    assert around.corridor_half_width < 2.5 < 0.3 * around.room_half_size
    assert abs(camera.rotation[2][1]) > 0.9
    assert abs(camera.position[0]) < around.corridor_half_width


@pytest.mark.parametrize(
    ("text", "goes_in"),
    [("driving out of a tunnel", False), ("driving out of a tunnel at dusk", False),
     ("dashcam view leaving a tunnel", False), ("a car exits a tunnel, dashcam view", False),
     ("driving into a tunnel", True), ("dashcam view entering a tunnel", True),
     ("a truck enters a tunnel, dashcam view", True), ("pov driving into a tunnel at night", True)],
)  # fmt: skip
def test_a_camera_begins_or_ends_in_the_tunnel_that_it_leaves_or_enters(text, goes_in):
    scene, tunnel = staged(text)[0], actor_of(text, "tunnel")
    ends = [scene.camera(at).position[1] for at in (0.0, CLIP_S)]
    low, high = tunnel.corners(0.0)[:, 1].min(), tunnel.corners(0.0)[:, 1].max()
    assert not faults(text)
    assert [low < one < high for one in ends] == [not goes_in, goes_in]


@pytest.mark.parametrize(
    ("text", "noun", "target"),
    [("goldfish swimming in a bowl", "goldfish", "fish bowl"),
     ("a clownfish swims around an aquarium", "clownfish", "aquarium")],
)  # fmt: skip
def test_fish_swim_round_in_their_bowl_and_apart(text, noun, target):
    scene, bowl = staged(text)[0], actor_of(text, target)
    fish = [one for one in scene.actors if one.noun.name == noun]
    ways = np.array([[one.middle(at) for at in np.linspace(0.0, CLIP_S, 25)] for one in fish])
    corners = bowl.corners(0.0)
    assert not faults(text)
    assert (ways > corners.min(axis=0)).all()
    assert (ways < corners.max(axis=0)).all()
    assert np.ptp(ways, axis=1).max() > 0.5 * fish[0].model.length
    for one, other in itertools.pairwise(ways):
        assert np.linalg.norm(one - other, axis=1).min() > 0.3 * fish[0].model.length


@pytest.mark.parametrize(
    ("text", "held"),
    [("a skateboarder jumps", ["soles"]), ("a skateboarder jumps over a bench", ["soles"]),
     ("a skier jumps", ["left sole", "right sole", "right hand", "left hand"]),
     ("a figure skater jumps", ["left sole", "right sole"]), ("a surfer jumps", []),
     ("a skateboarder waves", []), ("a surfer walks", ["torso"])],
)  # fmt: skip
def test_who_jumps_is_on_what_is_usual_and_has_nothing_under_a_raised_arm(text, held):
    assert [one.anchor for one in staged(text)[0].actors[0].props] == held


@pytest.mark.parametrize("text", ["a man on a skateboard jumps", "a boy on a scooter jumps"])
def test_a_board_jumps_with_who_is_on_it(text):
    body = next(one for one in staged(text)[0].actors if one.noun.name in ("skateboard", "scooter"))
    heights = [body.middle(at)[2] for at in np.linspace(0.0, CLIP_S, 25)]
    assert np.ptp(heights) > 0.1
    assert not faults(text)


@pytest.mark.parametrize(
    ("text", "turns"),
    [("a skateboarder does a kickflip", True), ("a boy doing an ollie", False)],
)
def test_a_board_leaves_the_ground_and_turns_over_in_a_kickflip(text, turns):
    person, times = staged(text)[0].actors[0], np.linspace(0.0, CLIP_S, 61)
    boards = [person.props[0].draw(at)[0].to_body for at in times]
    height = np.array([one[2, 3] for one in boards])
    tops = np.array([one[2, 2] for one in boards])
    assert not faults(text)
    assert np.ptp(height) > 0.2
    assert (np.sign(tops).min() < 0.0) == turns


def test_what_bounces_down_stairs_leaves_each_step_and_meets_none():
    text = "a ball bounces down the stairs"
    ball, stairs = actor_of(text, "ball"), actor_of(text, "stairs")
    to_stairs = np.linalg.inv(np.vstack([stairs.track.at(0.0).to_world(), [0, 0, 0, 1]]))
    times = np.linspace(0.0, CLIP_S, 201)
    low = np.array([[*ball.track.at(at).position, 1.0] for at in times]) @ to_stairs.T
    tread = 1.7 - 0.17 * np.ceil((low[:, 0] + 1.2) / 0.3)
    height = low[:, 2] - np.clip(tread, 0.0, 1.7)
    rises = np.flatnonzero((low[1:-1, 2] < low[:-2, 2]) & (low[1:-1, 2] <= low[2:, 2]))
    assert not faults(text)
    assert len(rises) >= 2
    assert height.min() > -0.02


@pytest.mark.parametrize(
    ("text", "noun", "target"),
    [("a cat jumps into a basket", "cat", "basket"), ("a boy leaps into a box", "child", "box"),
     ("a rabbit hops into a box", "rabbit", "box"),
     ("a frog jumps into a bucket", "frog", "bucket"),
     ("a girl jumps into a puddle", "girl", "puddle")],
)  # fmt: skip
def test_who_jumps_into_something_is_outside_first_and_comes_over_its_rim(text, noun, target):
    one, other = actor_of(text, noun), actor_of(text, target)
    half = 0.5 * np.array([other.model.length, other.model.width])
    frame = other.track.at(0.0).to_world()
    times = np.linspace(0.0, CLIP_S, 201)
    off = np.array([one.middle(at) - frame[:, 3] for at in times]) @ frame[:, :3]
    is_inside = (np.abs(off[:, :2]) < half).all(axis=1)
    assert not faults(text)
    assert not is_inside[0]
    assert is_inside[-1]
    enters = one.corners(float(times[is_inside.argmax()]))
    assert enters[:, 2].min() > other.model.height - 0.35 * one.model.height


@pytest.mark.parametrize(
    "text",
    ["a dog jumps into a car", "a dog jumps into a boat", "a cat walks and jumps into a box"],
)
def test_a_jump_into_something_that_is_not_seen_is_told(text):
    assert any("jump" in one for one in staged(text)[1].not_shown)


@pytest.mark.parametrize(
    ("text", "noun"),
    [("a wall topples", "wall"), ("a street lamp falls over", "street lamp"),
     ("a fence falls over", "fence"), ("a ladder topples", "ladder"),
     ("a dog knocks over a brick wall", "brick wall")],
)  # fmt: skip
def test_what_topples_comes_to_lie_on_the_ground_and_not_in_it(text, noun):
    one = actor_of(text, noun)
    up = one.track.at(CLIP_S).to_world()[:3, 2]
    assert not faults(text)
    assert abs(up[2]) < 0.05
    assert abs(one.lowest_m(CLIP_S)) < 0.03
    assert min(one.lowest_m(at) for at in np.linspace(0.0, CLIP_S, 41)) > -0.05


@pytest.mark.parametrize(
    ("text", "noun"),
    [("a clock on a wall falls", "clock"), ("a painting on a wall falls", "painting"),
     ("a mirror on a wall falls", "mirror")],
)  # fmt: skip
def test_what_hangs_on_a_wall_falls_to_the_floor(text, noun):
    one, wall = actor_of(text, noun), actor_of(text, "wall")
    assert not faults(text)
    assert one.lowest_m(0.0) > 0.2 * wall.model.height
    assert abs(one.lowest_m(CLIP_S)) < 0.03
