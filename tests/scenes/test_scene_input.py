"""Scenes at the doors: Python, the command line, and the metadata of events."""

import subprocess
import sys

import numpy as np
import pytest

import texvent
from texvent.cli.app import main
from texvent.errors import InputError
from texvent.run.regeneration import render_again
from texvent_scenes import Camera, CameraMove, Motion, Place, Scene, SceneObject, load_scene
from texvent_scenes.scene_input import check_words, list_nouns, read, understand
from texvent_scenes.spec.files import save_scene

OPTIONS = {"sensor": "48x36", "duration": 0.2, "seed": 3}
FLAGS = ["--sensor", "48x36", "--duration", "0.2", "--seed", "3", "--previews", "none", "-q"]
SENTENCE = "a red car drives left past two trees at dusk"


def test_the_scene_of_a_sentence_gives_its_events():
    reading = texvent.read(SENTENCE)
    assert reading.shown == ("red", "car", "drives", "left", "past", "two", "trees", "at", "dusk")
    assert reading.substituted == reading.not_understood == ()
    events, of_sentence = (texvent.generate(one, **OPTIONS) for one in (reading.scene, SENTENCE))
    assert events == of_sentence
    assert events.metadata["prompt"] == SENTENCE
    assert texvent.video(reading.scene, **OPTIONS).class_names == {1: "car", 2: "tree", 3: "tree"}


def test_what_a_scene_leaves_open_is_decided_and_what_it_says_stays():
    car = SceneObject(noun="car")
    moving = texvent.video(Scene(objects=(car,)), **OPTIONS).metadata["prompt_report"]
    motion = '[{ kind = "drive" }]'
    assert moving["scene"] == [f'objects: noun = "car", motions = {motion}', 'place: name = "road"']
    still = Scene(
        objects=(SceneObject(noun="man", motions=(Motion(kind="stand"),)),),
        place=Place(name="plain"),
        camera=Camera(moves=(CameraMove(kind="pan", direction="left"),)),
    )
    lines = texvent.video(still, **OPTIONS).metadata["prompt_report"]["scene"]
    assert lines == [
        'objects: noun = "man", motions = [{ kind = "stand" }]',
        'camera: moves = [{ kind = "pan", direction = "left" }]',
        'place: name = "plain"',
    ]


def test_events_of_a_scene_are_made_again_from_their_file(tmp_path, capsys):
    path = tmp_path / "car.h5"
    scene = texvent.read("a ball bounces").scene
    texvent.generate(scene, **OPTIONS).save(path)
    metadata = texvent.open(path).metadata
    assert metadata["scene"]["objects"][0]["noun"] == "ball"
    again = render_again(metadata)
    np.testing.assert_array_equal(again.at(0).pixels, texvent.video(scene, **OPTIONS).at(0).pixels)


def test_the_command_line_writes_a_scene_and_takes_it(tmp_path, capsys, monkeypatch):
    monkeypatch.chdir(tmp_path)
    assert main(["generate", f"{SENTENCE} under a wug", "--write-scene", "car.toml"]) == 0
    said = capsys.readouterr()
    assert said.out == "car.toml\n"
    assert "not understood: " in said.err
    assert "wug" in said.err
    assert load_scene("car.toml").objects[0].colour == "red"
    assert main(["generate", "car.toml", *FLAGS]) == 0
    assert texvent.open("car.h5").metadata["scene"]["objects"][0]["noun"] == "car"
    assert main(["generate", "a cat", "--write-scene", "car.toml"]) == 3
    assert main(["generate", "a cat", "--write-scene", "car.toml", "--overwrite"]) == 0
    assert main(["generate", "car.toml", "--write-scene", "cat.json"]) == 0
    assert load_scene("cat.json") == load_scene("car.toml")


def test_a_rig_records_a_scene(tmp_path, capsys, monkeypatch):
    monkeypatch.chdir(tmp_path)
    (tmp_path / "car.toml").write_text('[[objects]]\nnoun = "car"')
    assert main(["rig", "car.toml", "--stereo", "0.12", *FLAGS[:6], "-q"]) == 0
    assert '"noun": "car"' in (tmp_path / "car" / "rig.json").read_text()


def test_a_batch_takes_scene_files(tmp_path, capsys, monkeypatch):
    monkeypatch.chdir(tmp_path)
    for noun in ("car", "cra"):
        (tmp_path / f"{noun}.toml").write_text(f'[[objects]]\nnoun = "{noun}"')
    assert main(["batch", "car.toml", "-o", "out", *FLAGS]) == 0
    assert texvent.open("out/car.h5").metadata["scene"]["objects"] == [{"noun": "car"}]
    assert main(["batch", "car.toml", "cra.toml", "-o", "two", *FLAGS]) == 2
    assert "cra.toml: objects[0].noun is 'cra'" in capsys.readouterr().err
    assert not (tmp_path / "two").exists()


@pytest.mark.parametrize(
    ("content", "message"),
    [
        (None, "cannot read scene file scene.toml: No such file or directory"),
        ('[[objects]]\nnoun = "car"\ncuont = 2', "scene.toml: objects[0] has no field 'cuont'"),
        ('[[objects]]\nnoun = "cra"', "scene.toml: objects[0].noun is 'cra'; did you mean 'crab'?"),
        ('[[objects]]\nnoun = "dog"\npicture = {kind = "text", value = "A"}',
         "scene.toml: objects[0].picture is given, but a dog shows none"),
    ],
)  # fmt: skip
def test_wrong_files_are_one_line(content, message, tmp_path, capsys, monkeypatch):
    monkeypatch.chdir(tmp_path)
    if content is not None:
        (tmp_path / "scene.toml").write_text(content)
    assert main(["generate", "scene.toml", *FLAGS]) == 2
    (line,) = capsys.readouterr().err.splitlines()
    assert line.startswith(f"error: {message}")


def test_reading_a_scene_file_loads_no_numba(tmp_path):
    path = tmp_path / "car.toml"
    path.write_text('[[objects]]\nnoun = "car"\ncolour = "red"')
    code = (
        "import sys; from texvent_scenes import Scene, load_scene; "
        f"assert load_scene({str(path)!r}).objects; print(*sys.modules)"
    )
    done = subprocess.run([sys.executable, "-c", code], capture_output=True, text=True, check=True)
    assert not {"numba", "torch", "h5py", "cv2"} & set(done.stdout.split())


@pytest.mark.parametrize("name", ["ball.h5", "car.yaml", "clip.mp4", "no/such.avi"])
def test_a_file_that_is_no_scene_is_not_read_as_a_sentence(name):
    with pytest.raises(InputError, match="describe a scene, or name its"):
        texvent.read(name)


def test_a_misspelled_noun_is_named_with_the_one_that_is_meant():
    words = understand("a fokrlift and a wug beside two boxes", list_nouns()).words
    assert words.meant == ("fokrlift: forklift",)
    assert "not understood: fokrlift (did you mean 'forklift'?), " in words.faults()[0]
    sound = ("a red car drives left past two trees", "a man with three hats flaps in a narrow way")
    assert not any(understand(one, list_nouns()).words.meant for one in sound)


@pytest.mark.parametrize(
    "prompt",
    ["a red ball bounces", "a wug and a red ball", "a dog drives at 600 rpm on wet grass"],
)
def test_what_a_scene_does_not_show_of_a_sentence_is_not_understood(prompt):
    words = understand(prompt, list_nouns()).words
    lost = {one.partition(" (")[0] for one in words.not_shown}
    reading = texvent.read(prompt)
    assert set(reading.not_understood) == {*words.not_understood, *lost}
    assert not lost & {*reading.shown}


@pytest.mark.parametrize("text", ["a man claps four times", "a dog runs and jumps again"])
def test_words_left_to_the_drawn_scene_are_neither_lost_nor_shown(text):
    reading = texvent.read(text)
    assert reading.open_words
    assert not {*reading.open_words} & {*reading.not_understood, *reading.shown}


@pytest.mark.parametrize(
    "text",
    ["a forklift drives to a pallet and lifts it", "a robot arm slowly lifts a box from a table",
     "a robot arm turns and picks up a bolt", "a crane lifts a container"],
)  # fmt: skip
def test_what_a_sentence_says_of_an_act_of_a_machine_can_be_read_from_its_file(text, tmp_path):
    scene = read(text).scene
    save_scene(tmp_path / "scene.toml", scene)
    assert check_words(load_scene(tmp_path / "scene.toml")) == scene
