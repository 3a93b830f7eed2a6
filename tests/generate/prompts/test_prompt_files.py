"""Files of prompts: every format, and every mistake by its line."""

import pytest

from texvent.errors import FileFormatError, InputError
from texvent.generate.prompts.prompt_files import PromptLine, read_prompts


def written(tmp_path, name, text):
    path = tmp_path / name
    path.write_text(text, encoding="utf-8")
    return path


def test_a_text_file_has_one_prompt_per_line(tmp_path):
    path = written(tmp_path, "p.txt", "a red car\n\n  ein Bär läuft \n")
    assert read_prompts(path) == (PromptLine("a red car", 1), PromptLine("ein Bär läuft", 3))


def test_a_csv_has_columns_for_prompt_name_and_seed(tmp_path):
    text = 'name,prompt,seed\ncar,"a red car, fast",7\n,"a\nball",\n'
    lines = read_prompts(written(tmp_path, "p.csv", text))
    assert lines[0] == PromptLine("a red car, fast", 2, "car", 7)
    assert (lines[1].prompt, lines[1].name, lines[1].seed) == ("a\nball", None, None)


@pytest.mark.parametrize("column", ["text", "caption"])
def test_other_names_of_the_prompt_are_understood(tmp_path, column):
    assert read_prompts(written(tmp_path, "p.csv", f"{column}\na dog\n"))[0].prompt == "a dog"


def test_json_lines_hold_texts_or_objects(tmp_path):
    text = '"a red car"\n{"text": "a ball", "seed": 0, "name": "ball"}\n'
    assert read_prompts(written(tmp_path, "p.jsonl", text)) == (
        PromptLine("a red car", 1),
        PromptLine("a ball", 2, "ball", 0),
    )


@pytest.mark.parametrize(
    ("name", "text", "why"),
    [
        ("p.csv", "words,seed\na car,1\n", "no column prompt or text or caption; it has: words"),
        ("p.csv", "prompt,seed\na car,x\n", "line 2: seed is 'x'"),
        ("p.csv", "prompt,seed\n,3\n", "line 2 has no prompt"),
        ("p.csv", 'prompt\n"a car\n', "after line 1"),
        ("p.jsonl", '"a car"\n{"prompt": \n', "line 2 is not JSON"),
        ("p.jsonl", "[1]\n", "line 1 is neither a text nor an object"),
        ("p.jsonl", '{"prompt": "a", "seed": -1}\n', "line 1: seed is -1"),
        ("p.jsonl", '{"prompt": "a", "seed": 1.5}\n', "seed is 1.5"),
        ("p.jsonl", '{"prompt": "a", "name": "../x"}\n', "no name for a file"),
    ],
)
def test_a_wrong_line_is_named(tmp_path, name, text, why):
    with pytest.raises(FileFormatError, match=why):
        read_prompts(written(tmp_path, name, text))


def test_files_that_hold_nothing_are_refused(tmp_path):
    with pytest.raises(InputError, match="holds no prompt"):
        read_prompts(written(tmp_path, "p.txt", "\n\n"))
    with pytest.raises(InputError, match="cannot read prompts"):
        read_prompts(tmp_path / "none.txt")
    with pytest.raises(InputError, match=r"must end in \.txt, \.csv or \.jsonl"):
        read_prompts(written(tmp_path, "p.yaml", "a"))
    (tmp_path / "p.txt").write_bytes(b"\xff\xfe\xff")
    with pytest.raises(FileFormatError, match="not UTF-8"):
        read_prompts(tmp_path / "p.txt")
