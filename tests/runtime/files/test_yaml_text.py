import math
from pathlib import Path

import pytest

from texvent.errors import InputError
from texvent.io.calibration import read_calibration
from texvent.runtime.files.yaml_text import MOST_VALUES, load_yaml
from texvent.settings.config_files import read_config


def doubling(form: str, levels: int = 40) -> str:
    """Each level names the one before twice."""
    lines = ["a0: &a0 {x: 1}"]
    lines += [f"a{n}: &a{n} " + form.format(f"*a{n - 1}") for n in range(1, levels)]
    return "\n".join(lines)


@pytest.mark.parametrize(
    ("text", "why"),
    [
        (doubling("{{<<: [{0}, {0}]}}"), "aliases stand for"),
        (doubling("[{0}, {0}]"), "aliases stand for"),
        (doubling("{{x: {0}, y: {0}}}"), "aliases stand for"),
        ("a: &a [*a]", "aliases stand for"),
        ("[" * 1000, "nested too deeply"),
        ("fps: 3\nfps: 4", "'fps' is named twice"),
        ("a: [", "expected the node content"),
        ("a: !!timestamp 2001-99-99", "month must be"),
    ],
)
def test_yaml_of_any_origin_is_read_or_refused_at_once(tmp_path: Path, text: str, why: str) -> None:
    with pytest.raises(ValueError, match=why):
        load_yaml(text)
    path = tmp_path / "cams.yaml"
    path.write_text(text)
    for read in (read_config, read_calibration):
        with pytest.raises(InputError):
            read(path)


HUNDRED = f"&a [{', '.join(['0'] * 99)}]"
PAIRS = [f"k{n}: *a" for n in range(988)] + [f"o{n}: 0" for n in range(54)]


@pytest.mark.parametrize(
    "text",
    [
        f"[{HUNDRED}, {'*a, ' * 998}{'0, ' * 98}LAST]",
        f"{{first: {HUNDRED}, {', '.join(PAIRS)}, last: LAST}}",
    ],
    ids=["sequence", "mapping"],
)
def test_as_many_values_as_are_allowed_are_read_and_one_more_is_refused(text: str) -> None:
    assert load_yaml(text.replace("LAST", "0"))
    with pytest.raises(ValueError, match=f"more than {MOST_VALUES:,} values"):
        load_yaml(text.replace("LAST", "[0]"))


def test_aliases_and_merge_keys_are_read() -> None:
    text = "base: &b {seed: 3, fps: 24}\nown: {<<: *b, fps: 30}\nlist: [*b, *b]"
    found = load_yaml(text)
    assert found["own"] == {"seed": 3, "fps": 30}
    assert found["list"] == [{"seed": 3, "fps": 24}] * 2
    assert load_yaml("") is None


@pytest.mark.parametrize(
    ("word", "value"),
    [
        *((one, one) for one in ("1:30", "on", "No", "y", "2020-01-01", "0b1", "=", "1.5.2")),
        *(("010", 10), ("0o10", 8), ("0x1F", 31), ("-1_000", -1000), ("1e-3", 1e-3), (".5", 0.5)),
        *(("true", True), ("False", False), ("~", None), ("", None), ("-.inf", -math.inf)),
    ],
)
def test_plain_words_mean_the_values_of_yaml_1_2(word: str, value: object) -> None:
    (found,) = load_yaml(f"a: {word}").values()
    assert (found, type(found)) == (value, type(value))
