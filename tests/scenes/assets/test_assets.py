"""Models of files as nouns: names, sizes, GLB, OBJ and PLY, bad files."""

import zlib
from itertools import permutations
from pathlib import Path

import cv2
import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st
from tests.scenes.assets.glb_bar import write_bar, write_triangle

from texvent.errors import ConfigError, FileFormatError, InputError, TexventWarning
from texvent.sensor import SensorSize
from texvent_scenes.assets.index import Asset, read_folder
from texvent_scenes.assets.model_file import MOST_NODES
from texvent_scenes.assets.nouns import load_model, merge_nouns
from texvent_scenes.colours import rgb_of
from texvent_scenes.mesh import LARGEST_SIDE, light_of, mean_colour
from texvent_scenes.models.materials import has_colour
from texvent_scenes.models.nouns import NOUNS
from texvent_scenes.models.protocol import Pose
from texvent_scenes.named_files import check_files
from texvent_scenes.procedural import ProceduralConfig, ProceduralGenerator
from texvent_scenes.scene_input import describe_scene, nouns_of
from texvent_scenes.spec.files import load_scene
from texvent_scenes.spec.scene import Scene, SceneObject


def test_a_scene_brings_models_by_path(tmp_path):
    write_bar(tmp_path / "bar.glb")
    path = tmp_path / "scene.toml"
    path.write_text(
        '[[objects]]\nnoun = "weathercock"\nmodel = "bar.glb"\n[[objects]]\nnoun = "car"'
    )
    scene = load_scene(path)
    assert scene.objects[0].model == str(tmp_path.resolve() / "bar.glb")
    config = ProceduralConfig(duration=0.1)
    generator = ProceduralGenerator(config, size=SensorSize(48, 36))
    video = generator.generate(scene)
    assert set(video.class_names.values()) == {"weathercock", "car"}
    assert video.metadata["files"][0]["file"] == scene.objects[0].model
    assert {part.mesh is not None for part in video.scene.actors[0].place(0.0).parts} == {True}
    for model, message in (("no.glb", "does not exist"), ("bar.stl", r"must end in \.glb")):
        path.write_text(f'[[objects]]\nnoun = "bar"\nmodel = "{model}"')
        with pytest.raises(InputError, match=message):
            generator.generate(load_scene(path))
    two = '[[objects]]\nnoun = "car"\n'
    path.write_text(f'{two}{two}model = "bar.glb"')
    with pytest.raises(
        ConfigError, match=r"objects\[1\]\.model is .*, but objects\[0\] is 'car' too"
    ):
        load_scene(path)


def test_a_glb_file_brings_its_nodes_and_linear_colours(tmp_path):
    model = load_model(Asset(write_bar(tmp_path / "bar.glb"), "bar"))
    (part,) = model.parts(Pose(0.0, 0.0, 0.0))
    assert part.mesh is not None
    places = part.mesh.vertices @ part.to_body[:, :3].T + part.to_body[:, 3]
    np.testing.assert_allclose(places.min(axis=0), [-0.1, -0.1, 0.0], atol=1e-6)
    np.testing.assert_allclose(places.max(axis=0), [0.1, 0.1, 2.0], atol=1e-6)
    np.testing.assert_allclose(part.mesh.colours[0, 0], [0.8, 0.2, 0.0], atol=0.005)


def test_a_generated_scene_shows_assets_and_says_which_files(tmp_path):
    write_bar(tmp_path / "wobbly_lamp.glb")
    config = ProceduralConfig(duration=0.5, assets=tmp_path)
    video = ProceduralGenerator(config, seed=1, size=SensorSize(48, 36)).generate("a wobbly lamp")
    assert next(iter(video.class_names.values())) == "wobbly lamp"
    (described,) = video.metadata["files"]
    assert described["file"].endswith("wobbly_lamp.glb")
    truth = video.ground_truth(0, 100_000)
    assert (truth.instance == 1).any()
    assert np.isfinite(truth.flow[truth.instance == 1]).all()
    check_files(video.metadata["files"])
    write_bar(tmp_path / "wobbly_lamp.glb", height=3.0)
    with pytest.raises(FileFormatError, match="was changed since"):
        check_files(video.metadata["files"])
    (tmp_path / "wobbly_lamp.glb").unlink()
    with pytest.raises(InputError, match="is not here"):
        check_files(video.metadata["files"])


VALUES = st.recursive(
    st.none() | st.booleans() | st.integers() | st.text(max_size=3),
    lambda one: st.lists(one, max_size=3) | st.dictionaries(st.sampled_from(["sha256", "a"]), one),
    max_leaves=6,
)


@given(VALUES)
def test_what_is_no_list_of_files_is_passed(described):
    check_files(described)


AXES = ("x", "-x", "y", "-y", "z", "-z")


@pytest.mark.parametrize("colour", ["red", "#0040ff", "dark green"])
@pytest.mark.parametrize("ending", ["glb", "obj", "ply"])
@pytest.mark.parametrize("material", [None, "brass", "striped"])
def test_a_model_with_or_without_materials_is_painted_in_a_stated_colour(
    tmp_path, ending, colour, material
):
    write_bar(path := tmp_path / f"bar.{ending}")
    one = SceneObject("bar", model=str(path), colour=colour, material=material)
    nouns = nouns_of(Scene(objects=(one,)), NOUNS)
    if material is not None:
        with pytest.raises(ConfigError, match="material has no effect: a model of a file has only"):
            describe_scene(Scene(objects=(one,)), nouns)
        return
    describe_scene(Scene(objects=(one,)), nouns)
    (part,) = (
        nouns["bar"].build(colour=rgb_of(colour), scale=1.0, seed=0).parts(Pose(0.0, 0.0, 0.0))
    )
    np.testing.assert_allclose(mean_colour(part.mesh), rgb_of(colour), atol=1e-3)
    assert has_colour([part], rgb_of(colour))
    assert not has_colour([part], rgb_of("yellow"))


@pytest.mark.parametrize("ending", ["glb", "obj", "ply"])
@pytest.mark.parametrize("forward", [*AXES, None])
@pytest.mark.parametrize("up", [*AXES, None])
def test_a_model_is_turned_upright_and_to_the_front_and_not_mirrored(tmp_path, up, forward, ending):
    """A triangle whose corners are one, two and three units along the file's axes."""
    corners = [[1.0, 0.0, 0.0], [0.0, 2.0, 0.0], [0.0, 0.0, 3.0]]
    path = write_model(tmp_path / f"thing.{ending}", corners, [0, 1, 2])
    asset = Asset(path, "thing", scale=1.0, up=up, forward=forward)
    usual = ("z", "-y") if ending == "ply" else ("y", "z")
    names = (up or usual[0], forward or usual[1])
    if names[0][-1] == names[1][-1]:
        with pytest.raises(InputError, match="they must be two axes"):
            load_model(asset)
        return
    above, ahead = (np.eye(3)[AXES.index(one) // 2] * (-1) ** AXES.index(one) for one in names)
    left = np.cross(above, ahead)  # of a right-handed frame: ahead, left, above
    expected = np.array(corners) @ np.stack([ahead, left, above], axis=1)
    low, high = expected.min(axis=0), expected.max(axis=0)
    (part,) = load_model(asset).parts(Pose(0.0, 0.0, 0.0))
    places = part.mesh.vertices @ part.to_body[:, :3].T + part.to_body[:, 3]
    foot = [*(0.5 * (low + high))[:2], low[2]]
    np.testing.assert_allclose(places[part.mesh.triangles[0]], expected - foot, atol=1e-6)
    model = load_model(asset)
    assert (model.length, model.width, model.height) == pytest.approx(tuple(high - low))


USUAL = NOUNS["car"].build(colour=None, scale=1.0, seed=0)
SIDES = [
    # Noun, what the index says, longest side in the file; then in metres, of GLB and of others.
    ("thing", {}, 19.0, 19.0, 19.0),
    ("thing", {}, 21.0, 21.0, 0.21),  # centimetres
    ("thing", {}, 999.0, 999.0, 9.99),
    ("thing", {}, 1500.0, 1500.0, 1.5),  # millimetres
    ("sports car", {}, 7.0, 7.0, max(USUAL.length, USUAL.width, USUAL.height)),
    ("car", {"scale": 0.5, "height": 9.0, "length": 9.0}, 7.0, 3.5, 3.5),
    ("car", {"height": 2.0, "length": 9.0}, 7.0, 2.0, 2.0),  # of its height
    ("car", {"length": 9.0}, 7.0, 9.0, 9.0),
]


@pytest.mark.parametrize("ending", ["glb", "obj", "ply"])
@pytest.mark.parametrize(("noun", "said", "side", "glb_m", "other_m"), SIDES)
def test_a_model_is_as_large_as_its_index_its_unit_or_its_noun_says(
    tmp_path, noun, said, side, glb_m, other_m, ending
):
    for sides in permutations((1.0, 0.5, 0.2)):
        ahead, across, above = np.multiply(side, sides)
        corners = [[0.0, 0.0, 0.0], [ahead, 0.0, across], [0.0, above, 0.0]]
        path = write_model(tmp_path / f"{sides}.{ending}", corners, [0, 1, 2])
        asset = Asset(path, noun, up="y", forward="x", **said)
        for scale in (1.0, 2.0):
            model = load_model(asset, scale=scale)
            expected = scale * (glb_m if ending == "glb" else other_m)
            of = sides[2] if next(iter(said), "") == "height" else 1.0
            extents = np.array([model.length, model.width, model.height])
            np.testing.assert_allclose(extents, np.multiply(expected / of, sides), rtol=1e-5)


def test_an_asset_takes_the_place_of_the_embedded_noun_and_its_habits(tmp_path):
    write_bar(tmp_path / "car.glb")
    write_bar(tmp_path / "sports_van.glb")
    write_bar(tmp_path / "gizmo.glb")
    nouns = merge_nouns(read_folder(tmp_path))
    assert nouns["car"].habitat == "ground"
    assert nouns["car"].synonyms == NOUNS["car"].synonyms
    assert nouns["sports van"].speed_m_s == NOUNS["van"].speed_m_s
    assert nouns["gizmo"].habitat == "fixed"
    assert nouns["dog"] is not None
    said = [word for noun in nouns.values() for word in (noun.name, *noun.synonyms)]
    assert said.count("car") == 1


@pytest.mark.parametrize("name", ["Lamp.GLB", "lamp.Glb", "lamp.glb"])
def test_endings_of_models_may_be_in_capitals(tmp_path, name):
    write_bar(tmp_path / name)
    (asset,) = read_folder(tmp_path)
    assert asset.path == tmp_path / name
    assert load_model(asset).length > 0.0


def test_an_index_names_sizes_and_turns(tmp_path):
    write_bar(tmp_path / "m_17.glb")
    (tmp_path / "assets.toml").write_text(
        '["m_17.glb"]\nnoun = "weathercock"\nsynonyms = ["vane"]\nheight = 3.0\n'
        'up = "y"\nforward = "x"\nhabitat = "air"\nspeed = 2\nmotion = "fly"\n'
    )
    (asset,) = read_folder(tmp_path)
    assert (asset.noun, asset.synonyms, asset.habitat) == ("weathercock", ("vane",), "air")
    model = load_model(asset)
    assert (model.height, model.length) == pytest.approx((3.0, 0.3))


@pytest.mark.parametrize(
    ("text", "message"),
    [
        ("not toml", "cannot be read"),
        ('["other.glb"]\nnoun = "x"\n', "no model beside it"),
        ('["a.glb"]\ncolour = "red"\n', "has no field 'colour'"),
        ('["a.glb"]\nheight = -1\n', "height is -1"),
        ('["a.glb"]\nup = "w"\n', "up is 'w'"),
        ('["a.glb"]\nsynonyms = "one"\n', "must be a list"),
    ],
)
def test_a_bad_index_is_one_clear_line(tmp_path, text, message):
    write_bar(tmp_path / "a.glb")
    (tmp_path / "assets.toml").write_text(text)
    with pytest.raises(FileFormatError, match=message) as caught:
        read_folder(tmp_path)
    assert "\n" not in str(caught.value)


def test_damaged_glb_files_are_one_clear_line(tmp_path):
    whole = write_bar(tmp_path / "whole.glb").read_bytes()
    cases = {
        "short.glb": whole[:40],
        "text.glb": b"hello, this is no model at all",
        "json.glb": whole.replace(b'"asset"', b'"asset', 1),
        "empty.glb": b"",
    }
    for name, data in cases.items():
        path = tmp_path / name
        path.write_bytes(data)
        with pytest.raises(FileFormatError) as caught:
            load_model(Asset(path, "thing"))
        assert "\n" not in str(caught.value)
        assert name in str(caught.value)


PLY = (
    "ply\nformat ascii 1.0\nelement vertex 3\nproperty float x\nproperty float y\n"
    "property float z\nelement face 1\nproperty list uchar int vertex_indices\nend_header\n"
)


def write_model(path: Path, corners: list[list[float]], numbers: list[int]) -> Path:
    """A triangle in any of the formats."""
    lines = [" ".join(f"{one:g}" for one in corner) for corner in corners]
    if path.suffix == ".glb":
        return write_triangle(path, corners=corners, numbers=numbers, materials=[{}])
    if path.suffix == ".ply":
        path.write_text(PLY + "\n".join(lines) + f"\n3 {' '.join(map(str, numbers))}\n")
    else:
        faces = " ".join(str(number + 1) for number in numbers)
        path.write_text("".join(f"v {line}\n" for line in lines) + f"f {faces}\n")
    return path


@pytest.mark.parametrize("ending", ["glb", "obj", "ply"])
@pytest.mark.parametrize(
    ("corner", "third", "message"),
    [
        ([0.0, np.nan, 0.0], 2, "a coordinate is not a number below 1e"),
        ([np.inf, 0.0, 0.0], 2, "a coordinate is not a number below 1e"),
        ([0.0, 1e30, 0.0], 2, "a coordinate is not a number below 1e"),
        ([0.0, 1.0, 0.0], 7, "names a vertex outside|out of bounds"),
        ([0.0, 0.0, 0.0], 2, "has an area"),
    ],
)
def test_a_mesh_that_cannot_be_is_one_clear_line(tmp_path, ending, corner, third, message):
    path = tmp_path / f"thing.{ending}"
    write_model(path, [[0.0, 0.0, 0.0], [1.0, 0.0, 0.0], corner], [0, 1, third])
    with pytest.raises(FileFormatError, match=message) as caught:
        load_model(Asset(path, "thing"))
    assert "\n" not in str(caught.value)


@pytest.mark.parametrize(
    ("changes", "message"),
    [
        ({"nodes": [{"mesh": 0}] * (MOST_NODES + 1)}, "are the most, so join its parts"),
        (
            {"accessors": [{"componentType": 5126, "count": 2**31, "type": "VEC3"}]},
            "claims to unpack to",
        ),
    ],
)
def test_a_small_file_of_a_large_model_is_refused(tmp_path, changes, message):
    path = write_triangle(tmp_path / "thing.glb", **changes)
    with pytest.raises(FileFormatError, match=message):
        load_model(Asset(path, "thing"))


@pytest.mark.parametrize("name", ["/etc/passwd", "../private.png", "..\\private.png", "none.png"])
@pytest.mark.parametrize("ending", ["glb", "obj", "ply"])
def test_a_model_reaches_no_file_outside_its_folder(tmp_path, monkeypatch, ending, name):
    folder = tmp_path / "models"
    folder.mkdir()
    private = tmp_path / "private.png"
    cv2.imwrite(str(private), np.full((8, 8, 3), 255, np.uint8))
    path = folder / f"thing.{ending}"
    if ending == "glb":
        write_triangle(path, images=[{"uri": name}])
    else:
        write_model(path, [[0, 0, 0], [1, 0, 0], [0, 1, 0]], [0, 1, 2])
        text = path.read_text().replace("ascii 1.0\n", f"ascii 1.0\ncomment TextureFile {name}\n")
        path.write_text(text if ending == "ply" else f"mtllib {name}\n{text}")
    read = []
    monkeypatch.setattr(Path, "read_bytes", lambda one: read.append(one) or b"")
    with pytest.warns(TexventWarning, match="is not in its folder or below"):
        (part,) = load_model(Asset(path, "thing")).parts(Pose(0.0, 0.0, 0.0))
    assert (part.mesh.images, read) == ((), [])


def png(pixels):
    return cv2.imencode(".png", pixels)[1].tobytes()


def test_a_large_texture_is_made_smaller_and_16_bits_keep_their_light(tmp_path):
    large = np.zeros((2, LARGEST_SIDE * 2, 3), np.uint8)
    large[:, ::2] = 255
    assert light_of(large).shape == (1, LARGEST_SIDE, 3)
    np.testing.assert_allclose(light_of(large), 0.5, atol=1e-4)  # of light, not of its code
    grey = np.full((8, 8), 128 * 257, np.uint16)
    for pixels in (grey, (grey // 257).astype(np.uint8)):
        path = write_triangle(tmp_path / f"{pixels.dtype}.glb", image=png(pixels))
        (part,) = load_model(Asset(path, "thing")).parts(Pose(0.0, 0.0, 0.0))
        assert part.mesh.images[0].levels[0].mean() == pytest.approx(0.2158, abs=1e-3)


def test_a_texture_that_would_fill_the_memory_is_refused(tmp_path):
    head = bytearray(png(np.zeros((8, 8, 3), np.uint8)))
    head[16:24] = (14_000).to_bytes(4, "big") * 2
    head[29:33] = zlib.crc32(head[12:29]).to_bytes(4, "big")
    path = write_triangle(tmp_path / "thing.glb", image=bytes(head))
    with pytest.raises(FileFormatError, match="claims to unpack to 784000000"):
        load_model(Asset(path, "thing"))


def write_obj(folder: Path) -> Path:
    """A square of two materials, one with an image."""
    image = np.zeros((8, 8, 3), dtype=np.uint8)
    image[:4] = (0, 0, 255)  # the upper half is red
    cv2.imwrite(str(folder / "skin.png"), image)
    (folder / "panel.mtl").write_text(
        "newmtl painted\nKd 1 1 1\nmap_Kd skin.png\nnewmtl plain\nKd 0 0 1\n"
    )
    path = folder / "panel.obj"
    path.write_text(
        "mtllib panel.mtl\nv 0 0 0\nv 2 0 0\nv 2 2 0\nv 0 2 0\nv 2 0 -1\nv 2 2 -1\n"
        "vt 0 0\nvt 1 0\nvt 1 1\nvt 0 1\nusemtl painted\nf 1/1 2/2 3/3 4/4\n"
        "usemtl plain\nf 2/1 5/2 6/3 3/4\n"
    )
    return path


def test_an_obj_brings_its_materials_and_image_upright(tmp_path):
    pytest.importorskip("trimesh")
    model = load_model(Asset(write_obj(tmp_path), "panel", height=1.0))
    (part,) = model.parts(Pose(0.0, 0.0, 0.0))
    mesh = part.mesh
    assert mesh is not None
    assert len(mesh.triangles) == 4
    assert model.height == pytest.approx(1.0)
    shown = mesh.image >= 0
    assert shown.sum() == 2
    places = (mesh.vertices @ part.to_body[:, :3].T + part.to_body[:, 3])[mesh.triangles]
    upper = places[shown][..., 2] > 0.5
    assert (mesh.uv[shown][upper][:, 1] < 0.5).all()
    assert mesh.images[0].levels[0][0, 0, 0] == pytest.approx(1.0)
    np.testing.assert_allclose(mesh.colours[~shown][0, 0], [0.0, 0.0, 1.0], atol=0.01)


def test_the_pack_of_more_nouns_is_whole():
    pack = Path(__file__).parents[3] / "packs" / "more-nouns"
    assets = read_folder(pack)
    assert len(assets) > 100
    nouns = merge_nouns(assets)
    for asset in assets[::9]:
        assert nouns[asset.noun].build(colour=None, scale=1.0, seed=0).height > 0.0
