from __future__ import annotations

import signal
import subprocess
import sys
from pathlib import Path

import pytest

import texvent
from texvent.errors import InputError, TexventError
from texvent.io.files import extension_of
from texvent.scenes.report import PromptReport
from texvent.web.job import Answer, ConvertJob, SimulateJob
from texvent.web.limits import Limits
from texvent.web.supervisor import Supervisor
from texvent.web.worker import convert, simulate

CLIP = Path(__file__).parents[1] / "clips" / "bigbuckbunny_excerpt.mp4"
SCENE = {"generator": "procedural", "duration": 0.1, "sensor": "48x36", "seed": 3}


def run(folder: Path, **values: object) -> tuple[Answer, list[Answer]]:
    told: list[Answer] = []
    return simulate(SimulateJob(folder=str(folder), **values), told.append), told


def test_a_prompt_gives_events_video_and_page_and_reports_on_its_way(tmp_path: Path) -> None:
    done, told = run(tmp_path, prompt="a red ball bounces", options=SCENE)
    events = texvent.load(done.files["events"])
    assert done.text.startswith(f"{len(events):,} events on 48x36 pixels")
    assert "ball" in done.text
    assert [Path(path).stat().st_size > 500 for path in done.files.values()] == [True] * 3
    shares = [answer.share for answer in told if answer.share is not None]
    assert shares == sorted(shares)
    assert shares[-1] == 1.0


def test_the_page_says_what_became_of_the_words(tmp_path: Path) -> None:
    prompt = "a wug and a red ball bounce"
    done, _ = run(tmp_path, prompt=prompt, options=SCENE)
    report = PromptReport.from_json(texvent.load(done.files["events"]).metadata["prompt_report"])
    assert done.text.splitlines()[2:] == report.lines()
    assert report.not_understood == ("wug",)
    with pytest.raises(InputError, match=r"strict: .* not understood: wug"):
        run(tmp_path / "strict", prompt=prompt, options={**SCENE, "strict": True})


def test_a_prompt_that_names_a_file_of_the_server_is_refused(tmp_path: Path) -> None:
    with pytest.raises(InputError, match="no picture files"):
        run(tmp_path, prompt="a poster of /home/somebody/holiday.png", options=SCENE)


def test_the_text_of_a_scene_file_is_a_scene(tmp_path: Path) -> None:
    text = '[[objects]]\nnoun = "ball"\nmotions = [{ kind = "bounce" }]\n'
    done, _ = run(tmp_path, prompt=text, options=SCENE)
    metadata = texvent.load(done.files["events"]).metadata
    assert metadata["scene"]["objects"][0]["noun"] == "ball"
    for wrong, message in (
        (text.replace("ball", "bal"), r"objects\[0\].noun is 'bal'; did you mean 'ball'"),
        ("[[objects]]\nnoun =", "the scene is not valid"),
        ('{"objects": [{"noun": "x", "model": "/etc/x.glb"}]}', "shows no files in scenes"),
    ):
        with pytest.raises(TexventError, match=message):
            run(tmp_path / "wrong", prompt=wrong, options=SCENE)


def test_the_same_events_as_the_command_and_the_api_give(tmp_path: Path) -> None:
    done, _ = run(tmp_path, prompt="a red ball bounces", options=SCENE)
    again = texvent.generate("a red ball bounces", **SCENE)
    assert texvent.load(done.files["events"]).equals(again)


def test_a_video_gives_events_and_its_folder_stays_private(tmp_path: Path) -> None:
    done, _ = run(tmp_path, video=str(CLIP), options={"sensor": "48x36", "interpolate": "none"})
    events = texvent.load(done.files["events"])
    assert len(events) > 500
    assert CLIP.name in str(events.metadata["source"])
    for path in (done.files["page"], done.files["events"]):
        assert str(CLIP.parent).encode() not in Path(path).read_bytes()


def test_a_video_keeps_its_size_unless_a_sensor_is_chosen_and_warnings_are_told(
    tmp_path: Path,
) -> None:
    done, _ = run(tmp_path, prompt="a red ball bounces", options=SCENE)
    width, height = texvent.load(done.files["events"]).size
    (tmp_path / "own").mkdir()
    preview = done.files["video"]  # two images side by side: wider than the sensor
    own, _ = run(tmp_path / "own", video=preview, options={"simulator": "esim"})
    events = texvent.load(own.files["events"])
    assert events.size.width > 2 * width
    assert events.size.height > height
    count, model, size, *warnings = own.text.splitlines()
    assert count == f"{len(events):,} events on {events.size} pixels"
    assert (model, size) == ("simulator esim, preset default", "the video's own size")
    assert [f"{preview} is a preview" in text for text in warnings] == [True]
    (tmp_path / "fitted").mkdir()
    fitted, _ = run(tmp_path / "fitted", video=str(CLIP), options={"sensor": "48x36"})
    assert "48x36 pixels\n" in fitted.text
    assert "frames fitted to 48x36" in fitted.text


@pytest.mark.parametrize(
    ("values", "message"),
    [
        (
            {"prompt": "a ball", "options": {**SCENE, "duration": 30}},
            "duration is 30 s; at most 20",
        ),
        ({"prompt": "  ", "options": SCENE}, "the prompt is empty"),
        ({"prompt": "a ball", "options": {**SCENE, "sensor": "4000x3000"}}, "12,000,000 pixels"),
        ({"prompt": "a ball", "options": {**SCENE, "seed": -1}}, "seed is -1"),
        ({"video": str(CLIP), "limits": Limits(max_seconds=0.1)}, "at most 0.1 s are taken here"),
        ({"video": str(CLIP), "limits": Limits(max_pixels=1000)}, "at most 1,000 are taken here"),
        (
            {
                "video": str(CLIP),
                "options": {"interpolate": "none"},
                "limits": Limits(max_events=10),
            },
            "more than 10 events",
        ),
        ({"video": __file__}, "test_worker.py"),
    ],
)
def test_too_much_is_refused_and_leaves_nothing(tmp_path: Path, values, message: str) -> None:
    with pytest.raises(TexventError, match=message):
        run(tmp_path, **values)
    assert not list(tmp_path.iterdir())


def test_a_job_that_wants_more_memory_than_it_may_take_says_so(tmp_path: Path) -> None:
    hungry = tmp_path / "hungry.npy"
    header = b"{'descr': '|u1', 'fortran_order': False, 'shape': (4, 90000, 90000), }"
    data = b"\x93NUMPY\x01\x00" + len(header).to_bytes(2, "little") + header
    with hungry.open("wb") as file:
        file.write(data)
        file.truncate(len(data) + 4 * 90_000 * 90_000)  # sparse: takes no room on the disk
    folder = tmp_path / "job"
    folder.mkdir()
    job = SimulateJob(folder=str(folder), video=str(hungry), options={"sensor": "48x36"})
    with pytest.raises(InputError):
        list(Supervisor(time_limit_s=120).run(job))


@pytest.mark.skipif(sys.platform != "linux", reason="only Linux bounds memory and time")
def test_the_first_look_at_an_upload_is_bounded_in_time_and_memory() -> None:
    program = (
        "import numpy\n"
        "from texvent.web import process_limits as limits\n"
        "limits.PROBE_CPU_S = 1\n"
        "try:\n"
        "    with limits.bounded_probe(): numpy.empty(3_000_000_000, 'u1')\n"
        "except MemoryError: print('refused', flush=True)\n"
        "kept = numpy.empty(3_000_000_000, 'u1')\n"
        "print('free again', flush=True)\n"
        "with limits.bounded_probe():\n"
        "    while True: pass\n"
    )
    ended = subprocess.run([sys.executable, "-c", program], capture_output=True, timeout=300)
    assert ended.stdout.split(b"\n")[:2] == [b"refused", b"free again"]
    assert ended.returncode == -signal.SIGXCPU


@pytest.fixture(scope="module")
def source(tmp_path_factory: pytest.TempPathFactory) -> str:
    done, _ = run(tmp_path_factory.mktemp("source"), prompt="a red ball bounces", options=SCENE)
    return done.files["events"]


@pytest.mark.parametrize("format", ["hdf5", "evt3", "npz", "ecd", "dsec", "aedat4-none"])
def test_events_are_converted_exactly(tmp_path: Path, source: str, format: str) -> None:
    done = convert(ConvertJob(source=source, folder=str(tmp_path), format=format))
    download = Path(done.files["download"])
    assert download.suffix == extension_of(format)
    events, again = texvent.load(source), texvent.load(download, format=format, size=(48, 36))
    assert events.columns().keys() == again.columns().keys()
    assert events.equals(again)


def test_a_format_that_cannot_hold_the_events_says_so(tmp_path: Path, source: str) -> None:
    with pytest.raises(InputError, match="256"):
        convert(ConvertJob(source=source, folder=str(tmp_path), format="atis"))
    assert not list(tmp_path.iterdir())
