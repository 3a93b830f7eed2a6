"""Lists of prompts and videos: every format, and every mistake by its line."""

import json

import pytest

from texvent.dataset.specification.list_files import (
    LABEL_COLUMNS,
    NAME_COLUMNS,
    NOT_READ,
    ListEntry,
    read_list,
)
from texvent.errors import FileFormatError, TexventWarning


def written(tmp_path, name, text):
    path = tmp_path / name
    path.write_text(text, encoding="utf-8", errors="surrogateescape")
    return path


def test_a_text_file_has_one_prompt_per_line_and_comments(tmp_path):
    path = written(tmp_path, "p.txt", "# cars\na red\u2028car\n\n  # bears\n  ein Bär läuft \n")
    assert read_list(path) == (
        ListEntry(f"{path} line 2", "a red\u2028car"),
        ListEntry(f"{path} line 5", "ein Bär läuft"),
    )


@pytest.mark.parametrize("column", [*NAME_COLUMNS, "seed", *LABEL_COLUMNS])
def test_a_number_may_be_a_name_a_seed_or_a_label_and_0_is_one(tmp_path, column):
    rows = [{"prompt": "a car", column: value} for value in (0, 7, None, "")]
    path = written(tmp_path, "p.jsonl", "\n".join(map(json.dumps, rows)))
    field = "seed" if column == "seed" else "name" if column in NAME_COLUMNS else "label"
    found = [getattr(one, field) for one in read_list(path)]
    assert found == ([0, 7] if field == "seed" else ["0", "7"]) + [None, None]


def test_a_csv_has_columns_for_prompt_name_and_seed(tmp_path):
    path = tmp_path / "p.csv"
    path.write_bytes(b'name,prompt,seed\r\ncar,"a red car, fast",7\r\n,"a\r\nball",\r\n')
    entries = read_list(path)
    assert entries[0] == ListEntry(f"{path} line 2", "a red car, fast", name="car", seed=7)
    assert (entries[1].prompt, entries[1].name, entries[1].seed) == ("a\r\nball", None, None)


def test_videos_count_from_the_folder_of_the_list(tmp_path):
    path = written(tmp_path, "v.csv", "video,prompt\nclips/a.mp4,a dog runs\n/tmp/b.mp4,\n")
    first, second = read_list(path)
    assert (first.video, first.prompt) == (tmp_path / "clips" / "a.mp4", "a dog runs")
    assert (str(second.video), second.prompt) == ("/tmp/b.mp4", None)


@pytest.mark.parametrize(
    ("name", "text"),
    [
        ("s.txt", "scenes/car.toml\na dog\n"),
        ("s.csv", "scene,text\nscenes/car.toml,\n,a dog\n"),
        ("s.jsonl", '{"prompt": "scenes/car.toml"}\n"a dog"\n'),
    ],
)
def test_a_line_may_name_a_scene_file(tmp_path, name, text):
    (tmp_path / "scenes").mkdir()
    written(tmp_path / "scenes", "car.toml", 'prompt = "a car"\n[[objects]]\nnoun = "car"\n')
    scene, dog = read_list(written(tmp_path, name, text))
    assert (scene.prompt, scene.name) == ("a car", "car")
    assert scene.scene.objects[0].noun == "car"
    assert (dog.prompt, dog.scene) == ("a dog", None)


@pytest.mark.parametrize("column", ["text", "caption"])
def test_other_names_of_the_prompt_are_understood(tmp_path, column):
    assert read_list(written(tmp_path, "p.csv", f"{column}\na dog\n"))[0].prompt == "a dog"


def test_json_lines_hold_texts_or_objects(tmp_path):
    text = '"a red\x85car"\r\n{"text": "a ball", "seed": 0, "name": "ball"}\n'
    path = written(tmp_path, "p.jsonl", text)
    assert read_list(path) == (
        ListEntry(f"{path} line 1", "a red\x85car"),
        ListEntry(f"{path} line 2", "a ball", name="ball", seed=0),
    )


@pytest.mark.parametrize(
    ("name", "text", "why"),
    [
        (
            "p.csv",
            "words,seed\na car,1\n",
            "no column prompt, .* or video, separated by commas; it has: 'words | seed'",
        ),
        ("p.csv", "prompt,seed\na car,x\n", "line 2: seed is 'x'"),
        ("p.csv", "prompt,seed\n,3\n", "line 2 has no prompt"),
        ("p.csv", 'prompt\n"a car\n', "after line 1"),
        (
            "p.csv",
            "prompt\na car, fast, drives\n",
            "line 2 has 3 values for 1 columns; put a prompt with commas in double quotes",
        ),
        ("p.csv", "name,prompt,seed\na,a car,1\nb,a dog\n", "line 3 has 2 values for 3 columns"),
        ("p.jsonl", '"a car"\n{"prompt": \n', "line 2 is not JSON"),
        ("p.jsonl", '{"prompt": "a car", "seed": 1, "seed": 2}', "'seed' is named twice"),
        ("p.csv", "prompt,seed,seed\na car,1,2\n", "'seed' is named twice"),
        ("p.jsonl", "[1]\n", "line 1 is neither a text nor an object"),
        ("p.jsonl", '{"prompt": "a", "seed": -1}\n', "line 1: seed is -1"),
        ("p.jsonl", '{"prompt": "a", "seed": 1.5}\n', "seed is 1.5"),
        ("p.jsonl", '{"prompt": "a", "name": "../x"}\n', "no name for a file"),
        ("p.jsonl", '{"prompt": "a", "name": "a\\u0000b"}\n', "no name for a file"),
        ("p.jsonl", '{"prompt": "a", "seed": Infinity}\n', "seed is inf"),
        ("p.jsonl", '{"prompt": "a", "seed": 9223372036854775808}\n', "from 0 to 2"),
        ("p.jsonl", '{"prompt": ["a"]}\n', "it must be a text"),
        ("p.jsonl", '{"video": 3}\n', "it must be a path"),
        (
            "p.csv",
            "prompt,scene\na car,a.toml\n",
            "line 2 has a scene and a prompt or video; leave",
        ),
        ("p.jsonl", '{"prompt": "a", "label": ["b"]}\n', r"label is \['b'\]; it must be a text"),
        ("p.txt", "a c\udce4r\n", r"p\.txt is not UTF-8 text: invalid continuation byte"),
        ("p.jsonl", "[" * 100_000 + "\n", "line 1 is not JSON"),
        ("p.csv", "prompt\n" + "x" * 200_000 + "\n", "field larger than field limit"),
    ],
)
def test_a_wrong_line_is_named(tmp_path, name, text, why):
    with pytest.raises(FileFormatError, match=why) as caught:
        read_list(written(tmp_path, name, text))
    assert len(str(caught.value).replace(str(tmp_path), "")) < 300


@pytest.mark.parametrize("name", sorted(NOT_READ))
def test_a_column_that_would_set_an_option_is_warned_of(tmp_path, name):
    path = written(tmp_path, "p.jsonl", json.dumps({"prompt": "a dog", "tag": 1, name: 9}))
    with pytest.warns(TexventWarning, match=f"its {name} is not read"):
        read_list(path)
