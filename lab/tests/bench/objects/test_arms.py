"""Arms that differ from one in a property of their clips, as a file says."""

import json
from dataclasses import replace
from pathlib import Path
from typing import Any

import numpy as np
import pytest

from texvent.dataset import read_specification
from texvent.dataset.specification.items import read_items
from texvent.errors import ConfigError
from texvent_lab.bench.clip_counts import with_count
from texvent_lab.bench.objects.arms import Arm, read_factors
from texvent_lab.bench.objects.plan import ObjectsPlan, Run
from texvent_lab.bench.page import page_files
from texvent_lab.commands.bench.bench import run

from .stand_in import write_frames, write_specifications, write_turntables

FACTORS = """
arm = "texvent"

[factors."no noise"]
table.options.noise = "none"
turntable.options.noise = "none"

[factors.far]
table.vary."camera.position_m[1]" = { choice = [-0.8] }

[factors.more]
table.clips = 2
table.threshold = [0.05, 2.0]

[factors.late]
table.times = "frames"

[factors.drawn]
turntable.stream = "recommended"

[factors.own]
turntable.scenes.assets = "looks"
turntable.threshold = 0.4
"""
COUNTS = "number of events alone"
LOOK = """
[mug]
parts = "box paint  0 0 .05  .1 .1 .1"
"""


@pytest.fixture
def configs(tmp_path):
    folder = tmp_path / "configs"
    write_specifications(folder)
    (folder / "looks").mkdir()
    (folder / "looks" / "mug.toml").write_text(LOOK)
    (folder / "factors.toml").write_text(FACTORS)
    return folder


def arms_of(configs):
    found = {}
    for test in ("table", "turntable"):
        one = read_specification(configs / f"{test}.toml")
        found[test] = {each.name: Arm(one, each.options) for each in one.variants}
    return found


def test_a_factor_replaces_one_property_and_leaves_the_others(configs):
    found = read_factors(configs / "factors.toml", arms_of(configs))
    base = found["table"]["texvent"]
    assert list(found["table"]) == ["texvent", "no noise", "far", "more", "late"]
    assert list(found["turntable"]) == ["texvent", "no noise", "drawn", "own"]
    assert found["table"]["no noise"] == Arm(base.specification, {"noise": "none"})
    far = found["table"]["far"].items
    assert {one.scene["camera"]["position_m"][1] for one in far} == {-0.8}
    nouns = [[one.scene["objects"][0]["noun"] for one in arm] for arm in (base.items, far)]
    assert sorted(nouns[0]) == sorted(nouns[1])
    more = {one.key for one in found["table"]["more"].items}
    assert len(more) == 4
    assert more > {one.key for one in base.items}


def test_models_of_an_arm_count_from_the_folder_of_its_file(configs):
    own = read_factors(configs / "factors.toml", arms_of(configs))["turntable"]["own"]
    assert own.specification.options["assets"] == str(configs / "looks")
    assert own.looks == {"mug.toml": LOOK}


def test_thresholds_are_matched_fixed_or_drawn_per_clip(configs):
    found = read_factors(configs / "factors.toml", arms_of(configs))
    base, drawn = found["table"]["texvent"], found["table"]["more"]
    assert base.threshold_of("a", 0.3) == 0.3
    assert base.threshold_of("a", None) is None
    assert found["turntable"]["own"].threshold_of("a", 0.3) == 0.4
    logs = np.log([drawn.threshold_of(str(number), None) for number in range(2000)])
    ends = np.log([0.05, 2.0])
    assert ends[0] <= logs.min() < logs.max() <= ends[1]
    quarters = ends[0] + np.diff(ends) * [0.25, 0.5, 0.75]
    assert np.allclose(np.quantile(logs, [0.25, 0.5, 0.75]), quarters, atol=0.15)
    spread = Arm(base.specification, {}, spread=0.5)
    logs = np.log([spread.threshold_of(str(number), 0.3) for number in range(2000)])
    assert logs.mean() == pytest.approx(np.log(0.3), abs=0.05)
    assert logs.std() == pytest.approx(0.5, rel=0.1)


@pytest.mark.parametrize(("clips", "count"), [(None, 4), (1, 2), (3, 2), (4, 4), (9, 8)])
def test_scene_files_share_the_clips_that_are_asked_for(configs, clips, count):
    one = read_specification(configs / "table.toml")
    (near,) = one.sources
    far = replace(near, vary={**near.vary, "camera.position_m[1]": {"choice": [-0.8]}})
    both = with_count(replace(one, sources=(near, far)), clips)
    assert len(read_items(both).all) == count


@pytest.mark.parametrize(
    ("text", "message"),
    [
        ('arm = "rvt"', r"arm is 'rvt'; it must be one of texvent, difference"),
        ('arm = "texvent"\nfactor = 1', "unknown 'factor'"),
        ('arm = "texvent"\n[factors.a.tables]', "a: unknown 'tables'"),
        ('arm = "texvent"\n[factors.a.table]\nnoise = 1', "a, table: unknown 'noise'"),
        ('arm = "texvent"\n[factors.a.table]\nclips = "all"', "a, table: clips is 'all'"),
        ('arm = "texvent"\n[factors.a.table]\nthreshold = [1, 2, 3]', "give one above 0, or the"),
        (
            'arm = "texvent"\n[factors.a.table]\ntimes = "frame"',
            "allowed: exact, frames",
        ),
        ('arm = "texvent"\n[factors.a.table]\nstream = "v3v"', "stream is 'v3v'; .*'v2v'"),
        ('arm = "texvent"\n[factors.a.table]\nthreshold = -1', "give one above 0, or the"),
    ],
)
def test_what_is_no_factor_is_refused_in_one_line(configs, text, message):
    (configs / "factors.toml").write_text(text)
    with pytest.raises(ConfigError, match=message):
        read_factors(configs / "factors.toml", arms_of(configs))


@pytest.mark.usefixtures("networks", "torch")
def test_the_command_compares_factors_with_their_arm(configs, tmp_path, capsys):
    write_frames(tmp_path / "frames")
    write_turntables(tmp_path / "turntables")
    words = ["objects", str(configs), "--frames", str(tmp_path / "frames"), "--quiet"]
    words += ["--turntables", str(tmp_path / "turntables"), "--work", str(tmp_path / "work")]
    words += ["--steps", "2", "--seeds", "1", "--factors", str(configs / "factors.toml")]
    words += ["--precision", "bfloat16", "-o", str(tmp_path / "one.json")]
    run(words)
    document = json.loads((tmp_path / "one.json").read_text())
    assert document["reference"] == "texvent"
    table, turntable = ([one["arm"] for one in document[test]] for test in ("table", "turntable"))
    assert table == ["texvent", "no noise", "far", "more", "late", "recorded"]
    assert turntable == ["texvent", "no noise", "drawn", "own", "recorded", COUNTS]
    windows = {one["arm"]: one["windows"] for one in document["table"][:5]}
    assert windows["more"]["windows"] == 2 * windows["texvent"]["windows"]
    assert windows["more"]["threshold"] is None
    assert windows["late"]["share"] != windows["texvent"]["share"]
    by_arm = {one["arm"]: one["windows"] for one in document["turntable"]}
    assert by_arm["own"]["threshold"] == 0.4
    assert by_arm["drawn"]["threshold"] is None
    assert by_arm["drawn"]["events"] != by_arm["texvent"]["events"] > 0
    assert document["protocol"]["arms"]["drawn"] == {"stream": "recommended"}
    assert "| less texvent |" in capsys.readouterr().out
    page = page_files(document, "one.json")["one.md"].decode()
    assert "| more | – | " in page


@pytest.mark.parametrize(
    ("test", "factor"), [("table", "three times the clips"), ("turntable", "things as recorded")]
)
def test_recorded_clips_of_the_repository_are_those_of_the_factors_that_taught(test, factor):
    configs, none = Path(__file__).parents[4] / "configs/objects", Path("none")
    usual: dict[str, Any] = {"frames": none, "turntables": none, "work": none}
    varied = ObjectsPlan(configs=configs, factors=configs / "factors.toml", **usual)
    recorded = ObjectsPlan(configs=configs / "recorded", **usual)
    arms = (varied, varied.sets[test][factor]), (recorded, recorded.sets[test]["physical"])
    clips = [[Run(plan, {}).frames_path(arm, one) for one in arm.items]
             for plan, arm in arms]  # fmt: skip
    assert clips[0] == clips[1]
    assert arms[0][1].options == arms[1][1].options
