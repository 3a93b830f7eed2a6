"""Scenes as values: what they say survives files and staging, and wrong fields are named."""

import dataclasses
import json
import math
import os
import tomllib
from collections.abc import Iterator
from pathlib import Path
from typing import Annotated, Any, Literal, get_args, get_origin

import jsonschema
import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st
from tests.scenes.golden.golden import read_lines, stored_scenes

from texvent.errors import ConfigError
from texvent.sensor import SensorSize
from texvent_scenes.colours import PALETTES
from texvent_scenes.defaults import complete
from texvent_scenes.description import to_description
from texvent_scenes.procedural import ProceduralConfig, ProceduralGenerator
from texvent_scenes.scene_input import describe_scene, list_nouns, list_words
from texvent_scenes.spec import scene as scene_module
from texvent_scenes.spec.data import scene_from_data, scene_to_data
from texvent_scenes.spec.files import (
    ENDINGS,
    is_scene_file,
    json_schema,
    load_scene,
    save_scene,
    scene_text,
)
from texvent_scenes.spec.limits import Between, Colour, Word
from texvent_scenes.spec.scene import (
    Camera,
    Lamp,
    Light,
    Motion,
    Place,
    Relation,
    Scene,
    SceneObject,
)
from texvent_scenes.spec.tables import field_types, inner_type, required_fields
from texvent_scenes.staging.compose import compose_scene

WORDS = list_words(list_nouns())
SCHEMA = jsonschema.Draft202012Validator(json_schema(WORDS))
EVERY_FIELD = Path(__file__).parent / "every_field.toml"


def test_what_is_decided_stays_as_it_is():
    for sentence in read_lines("filmed.txt"):
        scene = scene_from_data(stored_scenes()[sentence])
        decided = dataclasses.replace(describe_scene(scene, list_nouns()), notes=())
        assert dataclasses.replace(complete(decided, list_nouns()), notes=()) == decided


def strategy(hint: Any) -> st.SearchStrategy[Any]:
    """Values of a field's type; ids stay as usual, `drawn_scenes` names them."""
    if inner_type(hint) is not hint:
        return st.none() | strategy(inner_type(hint))
    origin, arguments = get_origin(hint), get_args(hint)
    if origin is Literal:
        return st.sampled_from(arguments)
    if origin is tuple:
        return st.lists(strategy(arguments[0]), max_size=3).map(tuple)
    if dataclasses.is_dataclass(hint):
        named = {name: one for name, one in field_types(hint).items() if name not in IDS}
        place = st.tuples(*[st.floats(0.0, 9.0)] * 3)
        needed = {Relation: {"to": st.just(())}, Lamp: {"position_m": place}}.get(hint, {})
        return st.builds(hint, **needed, **{name: strategy(one) for name, one in named.items()})
    if origin is not Annotated:
        return {str: st.text(st.characters(exclude_categories=["Cs"])), bool: st.booleans()}[hint]
    match arguments[1]:
        case Between(low, high) if arguments[0] is int:
            return st.integers(int(low), min(int(high), 5))
        case Between(low, high):
            return st.floats(low, high)
        case Word(kind):
            return st.sampled_from(sorted(WORDS[kind]))
        case Colour(palette):
            return st.sampled_from(sorted(PALETTES[palette])) | st.just("#0a80ff")


IDS = ("id", "model", "to", "source", "target", "distance_m", "position_m", "look_at_m",
       "crossing_m", "road_m")  # fmt: skip


@st.composite
def drawn_scenes(draw: st.DrawFn) -> Scene:
    """Scenes of all fields, whose relations point at objects that come later."""
    scene = draw(strategy(Scene))
    ids = [f'{number} "ü' for number in range(len(scene.objects))]
    objects = tuple(
        dataclasses.replace(
            one,
            id=ids[n],
            relations=tuple(
                dataclasses.replace(each, to=tuple(ids[n + 1 :]))
                for each in one.relations
                if n + 1 < len(ids)
            ),
        )
        for n, one in enumerate(scene.objects)
    )
    target = draw(st.sampled_from([None, *ids]))
    effects = tuple(dataclasses.replace(one, source=target) for one in scene.effects)
    camera = dataclasses.replace(scene.camera, target=target)
    rain = scene.place.weather == "rain"  # which wets the ground
    place = dataclasses.replace(scene.place, is_wet=None if rain else scene.place.is_wet)
    return dataclasses.replace(scene, objects=objects, effects=effects, camera=camera, place=place)


@given(scene=drawn_scenes())
def test_any_scene_survives_files_and_the_schema(scene):
    data = scene_to_data(scene)
    assert scene_from_data(tomllib.loads(scene_text(scene, ".toml")), WORDS) == scene
    assert scene_from_data(json.loads(scene_text(scene, ".json")), WORDS) == scene
    assert len(to_description(scene).relations) == sum(len(one.relations) for one in scene.objects)
    SCHEMA.validate(data)


@given(scene=drawn_scenes())
def test_a_scene_that_is_put_together_is_that_of_its_file(scene):
    tables = scene_to_data(scene)
    whole = Scene(
        prompt=scene.prompt, absent=list(scene.absent), place=tables.get("place", Place())
    )
    parts = [*scene.effects, scene.camera, dataclasses.replace(scene.light, lamps=())]
    for part in (*scene.objects, *parts, *scene.light.lamps):
        # Its own fields are tables, as in a file.
        whole += type(part)(**scene_to_data(part))
    assert whole == scene


@pytest.mark.parametrize("fields", [{"objects": 5}, {"light": "dusk"}, {"light": Light(lamps=4)}])
def test_a_wrong_scene_is_refused_when_a_part_is_added(fields):
    for part in (SceneObject("car"), Lamp((0, 0, 1))):
        with pytest.raises(ConfigError, match=r"^(objects|light|light\.lamps) is "):
            Scene(**fields) + part


@pytest.mark.parametrize(
    ("part", "path", "table"),
    [
        (SceneObject("car", motions=[{"kind": "drive", "drection": "left"}]), "objects",
         {"noun": "car", "motions": [{"kind": "drive", "drection": "left"}]}),
        (SceneObject("car", size="large"), "objects", {"noun": "car", "size": "large"}),
        (Lamp((0, 0)), "light.lamps", {"position_m": [0, 0]}),
        (Place(sky="blu"), "place", {"sky": "blu"}),
    ],
)  # fmt: skip
def test_a_wrong_part_is_refused_as_in_a_file(part, path, table):
    outer, _, inner = path.partition(".")
    value = {inner: [table]} if inner else [table] if outer == "objects" else table
    with pytest.raises(ConfigError) as of_file:
        scene_from_data({outer: value})
    with pytest.raises(ConfigError) as of_part:
        Scene() + part
    assert str(of_part.value) == str(of_file.value)
    with pytest.raises(ConfigError, match=r"'car' is no part of a scene; add one of SceneObject"):
        Scene() + "car"


OWNERS = [one for one in vars(scene_module).values() if dataclasses.is_dataclass(one)
          and isinstance(one, type) and one.__module__ == scene_module.__name__]  # fmt: skip


@pytest.mark.parametrize("owner", OWNERS, ids=lambda owner: owner.__name__)
def test_a_wrong_keyword_is_one_line_with_the_nearest_field(owner):
    for name in field_types(owner):
        with pytest.raises(
            ConfigError, match=rf"^{owner.__name__} has no field '{name}x'; .*{name}"
        ):
            owner(**{f"{name}x": 1})
    needed = required_fields(owner)
    for name in needed:
        with pytest.raises(ConfigError, match=rf"^{owner.__name__} has no {name}, which it must"):
            owner(**dict.fromkeys({*needed} - {name}))
    with pytest.raises(ConfigError, match="fields; 99 are given"):
        owner(*range(99))


def values(part: Any) -> Iterator[Any]:
    """All dataclasses inside a scene, and itself."""
    yield part
    for name in field_types(type(part)):
        value = getattr(part, name)
        for one in value if isinstance(value, tuple) else (value,):
            if dataclasses.is_dataclass(one):
                yield from values(one)


def test_a_file_by_hand_gives_every_field():
    scene = load_scene(EVERY_FIELD)
    fields = {(type(part), name) for part in values(scene) for name in field_types(type(part))}
    given = {(type(part), name) for part in values(scene) for name in field_types(type(part))
             if getattr(part, name) != default(part, name)}  # fmt: skip
    assert fields - given == {  # not with a target, travel and a road
        (Camera, "position_m"), (Camera, "look_at_m"), (Camera, "framing"), (Place, "wave_height"),
        (Place, "road_m"), (Place, "road_heading_deg"), (Place, "is_lit"),
        (Place, "weather_amount"),
    }  # fmt: skip
    SCHEMA.validate(tomllib.loads(EVERY_FIELD.read_text()))
    described = describe_scene(scene, list_nouns())
    assert described.objects[0].motion == to_description(scene).objects[0].motion
    assert described.place.name == "road"


def default(part: Any, name: str) -> Any:
    """What a field is when it is left out; a value that no field has where it must be given."""
    field = {one.name: one for one in dataclasses.fields(part)}[name]
    has_factory = field.default_factory is not dataclasses.MISSING
    return field.default_factory() if has_factory else field.default


def test_schema_is_valid_and_refuses_what_the_reader_refuses():
    jsonschema.Draft202012Validator.check_schema(SCHEMA.schema)
    for wrong in ({"objects": [{}]}, {"objects": [{"noun": "car", "siz": 1}]}, {"light": 3},
                  {"objects": [{"noun": "car", "count": 0}]}):  # fmt: skip
        assert not SCHEMA.is_valid(wrong)
    text = SCHEMA.schema["properties"]["objects"]["items"]["properties"]["blink_hz"]
    assert text["description"].endswith("Hz.")
    assert text["minimum"] > 0


CAR, ON_CAR = {"noun": "car"}, [{"kind": "on", "to": ["car"]}]
WRONG = [
    (3, "scene is 3; it must be a table of fields"),
    ({"object": []}, "scene has no field 'object'; "),
    ({"objects": CAR}, "objects is {'noun': 'car'}; it must be a list"),
    ({"objects": [{}]}, "objects[0] has no noun, which it must have"),
    ({"objects": [CAR, {"noun": "cra"}]}, "objects[1].noun is 'cra'; did you mean 'crab'?"),
    ({"objects": [{"noun": "jogger"}]}, "objects[0].noun is 'jogger'; did you mean 'runner'?"),
    ({"objects": [{"noun": "can"}]},
     "objects[0].noun is 'can'; did you mean 'watering can' or 'soda can'?"),
    ({"objects": [{"noun": "pendulum", "motions": [{"kind": "swing"}]}]},
     "objects[0].motions[0].kind is 'swing'; did you mean 'work'?"),
    ({"objects": [{**CAR, "siz": 2}]}, "objects[0] has no field 'siz'; "),
    ({"objects": [{**CAR, "count": 0}]}, "objects[0].count is 0; it must be 1..60"),
    ({"objects": [CAR] * 10_000}, "objects have 10,000 copies in all; a scene shows 60 at most"),
    ({"objects": [{**CAR, "count": "3"}]}, "objects[0].count is '3'; it must be a whole number"),
    ({"objects": [{**CAR, "size": math.nan}]}, "objects[0].size is nan; it must be 0.01..100"),
    ({"objects": [{**CAR, "colour": "rde"}]}, "objects[0].colour is 'rde'; did you mean 'red'?"),
    ({"objects": [{**CAR, "motions": [{"kind": "drvie"}]}]},
     "objects[0].motions[0].kind is 'drvie'; did you mean 'drive'?"),
    ({"objects": [CAR, {**CAR, "id": "car"}]},
     "objects[1].id is 'car', which is that of objects[0]; "),
    ({"objects": [{**CAR, "relations": [{"kind": "on", "to": ["cart"]}]}]},
     "objects[0].relations[0].to[0] is 'cart', which is no object's id; allowed: car; "),
    ({"objects": [{**CAR, "relations": [{"kind": "on", "to": "car"}]}]},
     "objects[0].relations[0].to is 'car'; it must be a list"),
    ({"objects": [{**CAR, "relations": [{"kind": "on", "to": []}]}]},
     "objects[0].relations[0].to is empty; "),
    ({"objects": [{**CAR, "relations": ON_CAR}]},
     "objects[0].relations[0].to is 'car', which is the object itself"),
    ({"objects": [{**CAR, "relations": [{"kind": "on", "to": ["van"]}]},
                  {"noun": "van", "relations": ON_CAR}]},
     "objects[0].relations go round in a circle ('car', 'van', 'car'); "),
    ({"objects": [{**CAR, "position_m": [1]}]},
     "objects[0].position_m is [1]; it must have 2 numbers"),
    ({"objects": [CAR, {"noun": "van", "relations": [{**ON_CAR[0], "distance_m": 2}]}]},
     "objects[1].relations[0].distance_m is given, but 'on' has no distance; "),
    ({"camera": {"position_m": [0, 0, 1]}}, "camera.position_m and camera.look_at_m are given to"),
    ({"camera": {"position_m": [0, 0, 1], "look_at_m": [0, 0, 1]}},
     "camera.look_at_m is (0.0, 0.0, 1.0), the place of camera.position_m itself; "),
    ({"camera": {"position_m": [0, 0, 1], "look_at_m": [0, 5, 1], "moves": [{"kind": "travel"}]}},
     "camera.position_m is given with a target or with travel"),
    ({"place": {"name": "raod"}}, "place.name is 'raod'; did you mean 'road'?"),
    ({"place": {"name": "street"}}, "place.name is 'street'; did you mean 'city'?"),
    ({"place": {"name": "pavment"}}, "place.name is 'pavment'; did you mean 'city'?"),
    ({"absent": ["hous"]}, "absent[0] is 'hous'; did you mean 'house'?"),
]  # fmt: skip


@pytest.mark.parametrize(("data", "message"), WRONG, ids=[message for _, message in WRONG])
def test_a_wrong_field_is_named(data, message):
    with pytest.raises(ConfigError) as caught:
        scene_from_data(data, WORDS)
    assert str(caught.value).startswith(message)


@pytest.mark.parametrize("kind", ["stand", "drive", "turn", "bounce"])
def test_objects_and_camera_stand_where_metres_say(kind):
    scene = scene_from_data(
        {
            "objects": [
                {**CAR, "motions": [{"kind": kind}], "position_m": [-3, 2], "heading_deg": 30},
                {"noun": "cup", "relations": [{"kind": "left of", "to": ["car"], "distance_m": 4}]},
                {"noun": "tree", "position_m": [4, 6]},
                {"noun": "drone", "position_m": [0, 0], "height_m": 3},
            ],
            "camera": {"position_m": [0, -12, 3], "look_at_m": [0, 0, 1], "field_of_view_deg": 60},
        },
        WORDS,
    )
    nouns, size = list_nouns(), SensorSize(64, 48)
    staged = compose_scene(describe_scene(scene, nouns), seed=3, size=size, duration_s=1.0)
    at_start = {one.noun.name: one.track.at(0.0) for one in staged.actors}
    places = {name: state.position for name, state in at_start.items()}
    np.testing.assert_allclose(places["car"][:2], (-3.0, 2.0), atol=1e-9)
    assert math.degrees(at_start["car"].yaw) == pytest.approx(30.0)
    np.testing.assert_allclose(places["tree"][:2], (4.0, 6.0), atol=1e-9)
    if kind == "stand":
        np.testing.assert_allclose(places["cup"], (-7.0, 2.0, 0.0), atol=1e-9)
    drone = next(one for one in staged.actors if one.noun.name == "drone")
    assert drone.corners(0.0)[:, 2].min() == pytest.approx(3.0, abs=0.2)  # it hovers
    camera = staged.camera(0.5)
    np.testing.assert_allclose(camera.position, (0.0, -12.0, 3.0), atol=1e-9)
    np.testing.assert_allclose(camera.rotation[2], np.array((0, 12, -2)) / math.hypot(12, 2))
    assert camera.focal == pytest.approx(0.5 / math.tan(math.radians(30.0)))


def test_pictures_and_models_lie_beside_their_file_from_wherever_it_is_named(tmp_path, monkeypatch):
    screen = {"noun": "tv", "picture": {"kind": "file", "value": "shown.png"}}
    part = {"noun": "bracket", "model": "models/bracket.obj"}
    file = tmp_path / "here" / "scene.json"
    file.parent.mkdir()
    file.write_text(json.dumps({"objects": [screen, part]}))
    for folder in (tmp_path, tmp_path / "here"):
        monkeypatch.chdir(folder)
        for path in (
            tmp_path / "here" / "scene.json",
            os.path.relpath(tmp_path / "here/scene.json"),
        ):
            scene = load_scene(path)
            assert scene.objects[0].picture.value == str(tmp_path.resolve() / "here" / "shown.png")
            model = tmp_path.resolve() / "here" / "models" / "bracket.obj"
            assert scene.objects[1].model == str(model)
    scene = dataclasses.replace(scene, objects=scene.objects[:1])
    with pytest.raises(ConfigError, match=r"objects\[0\].picture: the picture .* does not exist"):
        describe_scene(scene, list_nouns())


@pytest.mark.parametrize("name", ["car", "my car", "a red car drives left", "v1.2"])
@pytest.mark.parametrize("case", [str.lower, str.upper, str.title, str.swapcase])
@pytest.mark.parametrize("ending", ENDINGS)
def test_a_written_scene_is_read_again_whatever_the_case_of_its_ending(
    tmp_path, ending, case, name
):
    scene = Scene(objects=(SceneObject(noun="car", motions=(Motion(kind="drive"),)),))
    path = tmp_path / f"{name}{case(ending)}"
    save_scene(path, scene)
    assert [is_scene_file(one) for one in (path.name, name, f"{path.name} x")] == [True] + 2 * [
        False
    ]
    assert load_scene(path) == scene
    text = path.read_text()
    if ending == ".toml":
        assert text == '[[objects]]\nnoun = "car"\nmotions = [{ kind = "drive" }]\n'
    path.write_text(text, "utf-8-sig")
    assert load_scene(path) == scene


def test_the_file_of_the_page_is_a_scene_and_there_are_twenty_more():
    assert len(FILES) >= 20
    page = (Path(__file__).parents[3] / "docs" / "scenes.md").read_text()
    text = page.partition("```toml\n")[2].partition("```")[0]
    scene = scene_from_data(tomllib.loads(text), WORDS)
    assert {one.noun for one in describe_scene(scene, list_nouns()).objects} == {
        "car", "tree", "street lamp",
    }  # fmt: skip


FILES = sorted((Path(__file__).parents[3] / "docs" / "examples" / "scenes").glob("*.toml"))
INSTANTS_US = (100_000, 1_000_000, 1_900_000)
LEAST_PIXELS = 4
"""Of an object at the instant at which it is seen best."""


@pytest.mark.parametrize("path", FILES, ids=lambda path: path.stem)
def test_every_object_is_in_view(path):
    scene = load_scene(path)
    SCHEMA.validate(tomllib.loads(path.read_text()))
    generator = ProceduralGenerator(
        ProceduralConfig(duration=2.0, samples=1), size=SensorSize(160, 120)
    )
    video = generator.generate(scene)
    most: dict[int, int] = {}
    for time_us in INSTANTS_US:
        instance = video.ground_truth(time_us, time_us + 10_000).instance
        for body, pixels in zip(*np.unique(instance, return_counts=True), strict=True):
            most[int(body)] = max(most.get(int(body), 0), int(pixels))
    own = {one.instance: one.noun.name for one in video.scene.actors}
    hidden = [noun for body, noun in own.items() if most.get(body, 0) < LEAST_PIXELS]
    assert hidden == []
    image = video.at(INSTANTS_US[1]).pixels
    assert np.isfinite(image).all()
    assert image.std() > 10.0
    assert scene.prompt
