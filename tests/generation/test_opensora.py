"""The Open-Sora adapter against a stand-in program that honours the same command line."""

import os
import signal
import stat
import subprocess
import sys
import textwrap
import threading
import time

import pytest

from texvent.errors import TexventError
from texvent.generation.opensora import (
    CONFIGS,
    IMAGE_WEIGHTS,
    SCRIPT,
    WEIGHTS,
    OpenSoraConfig,
    OpenSoraGenerator,
    run_program,
)

from .watcher import Watcher

PROMPT = 'a red car, "fast", drives left'
TORCHRUN = """
    #!{python}
    # Stands in for torchrun + Open-Sora's inference script: same words, same results, no model.
    import argparse, csv, pathlib, sys
    import av
    import numpy as np

    launch = argparse.ArgumentParser()
    launch.add_argument("--nproc_per_node", type=int, required=True)
    launch.add_argument("--standalone", action="store_true")
    launch.add_argument("script", type=pathlib.Path)
    launch.add_argument("config", type=pathlib.Path)
    for name in ("--save-dir", "--dataset.data-path", "--seed", "--fps_save",
                 "--sampling_option.seed", "--sampling_option.num_frames",
                 "--sampling_option.num_steps", "--sampling_option.guidance",
                 "--sampling_option.aspect_ratio"):
        launch.add_argument(name, required=True)
    words = vars(launch.parse_args())
    assert words["script"].is_file() and words["config"].is_file(), "run in the checkout"
    rows = list(csv.DictReader(open(words["dataset.data_path"], newline="")))
    prompt = rows[0]["text"]
    print("Inference progress:", prompt)
    if "crash" in prompt:
        sys.exit("RuntimeError: CUDA out of memory")
    if "nothing" in prompt:
        sys.exit(0)
    seed = int(words["sampling_option.seed"])
    if not seed:
        sys.exit("an unseeded run")
    folder = pathlib.Path(words["save_dir"]) / ("video_" + words["config"].stem)
    folder.mkdir(parents=True)
    seed += words["config"].stem.startswith("t2i2v")
    ground = np.random.default_rng(seed).integers(0, 255, (48, 80, 3), dtype=np.uint8)
    ground = np.repeat(np.repeat(ground, 2, axis=0), 2, axis=1)
    with av.open(str(folder / (prompt[:8].replace('"', "") + ".mp4")), "w") as container:
        stream = container.add_stream("libx264", rate=int(words["fps_save"]))
        stream.width, stream.height, stream.pix_fmt = 96, 64, "yuv420p"
        for index in range(int(words["sampling_option.num_frames"])):
            image = ground[:64, index * 2 : index * 2 + 96].copy()
            frame = av.VideoFrame.from_ndarray(image, format="rgb24")
            container.mux(stream.encode(frame))
        container.mux(stream.encode())
"""


def program(path, text) -> None:
    path.parent.mkdir(parents=True, exist_ok=True)
    path.write_text(textwrap.dedent(text).lstrip().format(python=sys.executable))
    path.chmod(path.stat().st_mode | stat.S_IXUSR)


@pytest.fixture
def root(tmp_path, monkeypatch):
    """A checkout as `git clone` and the weights' download leave it, with a small torchrun."""
    monkeypatch.setenv("TEXVENT_CACHE", str(tmp_path / "cache"))
    folder = tmp_path / "Open-Sora"
    for path in (SCRIPT, CONFIGS / "256px.py", CONFIGS / "t2i2v_256px.py", WEIGHTS, *IMAGE_WEIGHTS):
        (folder / path).parent.mkdir(parents=True, exist_ok=True)
        (folder / path).write_text("")
    program(folder / ".venv/bin/torchrun", TORCHRUN)
    monkeypatch.setenv("OPENSORA_ROOT", str(folder))
    return folder


def build(seed=0, **options):
    return OpenSoraGenerator(OpenSoraConfig(**{"frames": 9, **options}), seed=seed)


def test_a_prompt_becomes_the_frames_of_its_mp4_and_is_kept(root):
    told = Watcher()
    video = build().generate(PROMPT, progress=told)
    assert (video.fps, video.size, video.frame_count) == (24, (96, 64), 9)
    assert len(list(video)) == 9
    assert video.metadata["prompt"] == PROMPT
    assert video.metadata["check"]["problems"] == []
    assert told.steps == []
    assert told.lines == ["running Open-Sora (256px, 50 steps)"]
    (root / ".venv/bin/torchrun").unlink()
    again = build().generate(PROMPT, progress=told)
    assert again.path == video.path
    assert "generated before" in told.lines[-1]


def test_seeds_differ_and_seed_zero_is_a_seed(root):
    first, second = (build(seed=seed).generate(PROMPT) for seed in (0, 1))
    assert (next(iter(first)).pixels != next(iter(second)).pixels).any()


def test_the_video_starts_from_an_image_where_it_is_asked_for(root):
    first, direct = (build(**way).generate(PROMPT) for way in ({"image_first": True}, {}))
    assert (next(iter(first)).pixels != next(iter(direct)).pixels).any()
    assert first.path != direct.path


def test_its_failure_is_told_in_its_own_words(root):
    with pytest.raises(TexventError, match=r"ended with code 1; .*CUDA out of memory"):
        build().generate("crash please")
    with pytest.raises(TexventError, match="without writing a video"):
        build().generate("nothing at all")
    assert not list((root.parent / "cache" / "videos").glob("*"))


@pytest.mark.parametrize(
    ("remove", "why"),
    [
        (SCRIPT, r"there is no Open-Sora 2 checkout in .*Open-Sora;"),
        (WEIGHTS, r"Open_Sora_v2.safetensors are missing; .* hf download"),
        (".venv/bin/torchrun", r"no torchrun in .*link it as \.venv"),
    ],
)
def test_what_is_missing_is_named_with_what_to_do(root, monkeypatch, remove, why):
    (root / remove).unlink()
    monkeypatch.setenv("PATH", "/nonexistent")
    with pytest.raises(TexventError, match=why):
        build().generate(PROMPT)


@pytest.mark.parametrize("remove", IMAGE_WEIGHTS)
def test_weights_of_the_image_are_needed_only_with_an_image(root, remove):
    (root / remove).unlink()
    with pytest.raises(TexventError, match=f"{remove.name} are missing"):
        build(image_first=True).generate(PROMPT)
    build().generate(PROMPT)


def test_stopping_ends_the_program_and_its_children(tmp_path):
    marker = tmp_path / "child.pid"
    program(
        tmp_path / "slow",
        f"""
        #!/bin/sh
        sleep 60 &
        echo $! > {marker}
        wait
        """,
    )
    main_thread = threading.main_thread().ident

    def interrupt():
        while not marker.exists() or not marker.read_text().strip():
            time.sleep(0.01)
        while sys._current_frames()[main_thread].f_code is not subprocess.Popen._try_wait.__code__:
            time.sleep(0.01)
        signal.pthread_kill(main_thread, signal.SIGINT)

    threading.Thread(target=interrupt).start()
    with pytest.raises(KeyboardInterrupt):
        run_program([str(tmp_path / "slow")], cwd=tmp_path, log=tmp_path / "log")
    child = int(marker.read_text())
    deadline = time.monotonic() + 60
    while is_running(child) and time.monotonic() < deadline:
        time.sleep(0.01)
    assert not is_running(child)


def is_running(process: int) -> bool:
    try:
        os.kill(process, 0)
    except ProcessLookupError:
        return False
    with open(f"/proc/{process}/stat") as file:
        return file.read().split()[2] != "Z"
