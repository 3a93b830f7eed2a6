"""Page of `texvent app`: prompts, scenes and videos in, events out, one job at a time.

It reads files of one folder of the user's, and those that it was sent.
"""

from __future__ import annotations

import base64
import contextlib
import functools
import itertools
import json
import os
import re
import shutil
import subprocess
import sys
import threading
import tomllib
from collections import deque
from collections.abc import Mapping, Sequence
from importlib import resources
from io import BufferedIOBase
from pathlib import Path
from typing import Any

from texvent._registry import GENERATORS, SIMULATORS
from texvent.config import RunConfig
from texvent.errors import InputError, TexventError, shown
from texvent.generation.subjects import scenes
from texvent.generation.video_models.known_models import MODELS
from texvent.generation.video_models.model_files import HUB
from texvent.io.atomic import atomic_file
from texvent.options.values import option_names
from texvent.runtime.files.file_names import VIDEO_EXTENSIONS, file_stem, usable_path
from texvent.runtime.files.hidden_parts import temporary_folder
from texvent.sensor import SENSORS
from texvent.settings.resolution import read_basis
from texvent.web.server import FILE_BYTES, HTML, NOTHING_POLICY, Answer, Gets, PageServer, page_text

VIEWER_POLICY = (
    "sandbox allow-scripts; default-src 'none'; script-src 'unsafe-inline'; "
    "style-src 'unsafe-inline'; img-src data:; frame-ancestors 'self'"
)
STILLS = "stills.png"
RESULTS = {
    "/stills": (STILLS, "image/png", NOTHING_POLICY),
    "/events": ("events.h5", "application/octet-stream", NOTHING_POLICY),
    "/video": ("events.events.mp4", "video/mp4", NOTHING_POLICY),
    "/page": ("events.events.html", HTML, VIEWER_POLICY),
}
"""Files that a run writes, their kinds, and what a browser may do with them."""
MOST_LINES = 20
"""Lines of a run that the page shows, the latest."""
SCENE_MARK = "[[objects]]"
"""Text that no sentence contains, and nearly every scene file in TOML does."""
STEP_MARK = "\x1e"
"""Begins a line of a job that says how far it is."""
PIECE_BYTES = 2**20
"""Bytes of a file that are read at once."""
MOST_LETTERS = 60
"""Letters of the name of a file that was sent, the last."""
SECONDS = 1.0
"""Length of scenes that the page begins with, s."""
MOST_VIDEOS = 200
"""Videos of the folder that the page lists."""


class Job:
    """A run in a process of its own, which ends with this one, however that ends.

    Its words go through a pipe: those that start a process are shown to every user of the machine.

    Args:
        folder: an empty folder for its files.
        command: "generate" or "simulate".
        options: flags of the command.
        subject: a prompt, or the absolute path of a scene file or a video.
        has_stills: draw stills of the scene first.
        home: folder from which the options name files.
    """

    def __init__(
        self,
        folder: Path,
        command: str,
        options: Sequence[str],
        subject: str,
        *,
        has_stills: bool = False,
        home: Path | None = None,
    ) -> None:
        self.folder, self.subject = folder, subject
        path = Path(subject)
        self.name = file_stem(path.stem if path.is_absolute() else subject)
        self._is_stopped = False
        self._lines: deque[str] = deque(maxlen=MOST_LINES)
        self._step: dict[str, Any] = {}
        outputs: list[tuple[str, ...]]
        outputs = [("-o", str(folder / "events.h5"), "--previews", "mp4,html")]
        if has_stills:
            outputs.insert(0, ("--preview", str(folder / STILLS)))
        self._process = subprocess.Popen(
            [sys.executable, "-m", "texvent.cli.simulation.job"],
            cwd=home,
            stdin=subprocess.PIPE,
            stdout=subprocess.DEVNULL,
            stderr=subprocess.PIPE,
            encoding="utf-8",
            errors="replace",
        )
        self._send([(command, *options, *files, "--", subject) for files in outputs])
        self._reader = threading.Thread(target=self._read, daemon=True)
        self._reader.start()

    @property
    def state(self) -> str:
        """running, done, failed or stopped."""
        if self._process.poll() is None:
            return "running"
        self._reader.join()
        if self._is_stopped:
            return "stopped"
        return "failed" if self._process.returncode else "done"

    def describe(self) -> dict[str, Any]:
        """State, text and latest step, JSON-ready."""
        state = self.state
        return {
            "state": state,
            "text": "\n".join(self._lines).replace(f"{self.folder}/", "") or state,
            "step": self._step,
            "name": self.name,
            "has_stills": (self.folder / STILLS).is_file(),
        }

    def stop(self) -> None:
        """End the run, if it is not over; returns when its process has cleaned up."""
        if self._process.poll() is None:
            self._is_stopped = True
            self._process.terminate()
            self._process.wait()

    def file(self, name: str) -> Path | None:
        """A result by its file name; None where there is none."""
        path = self.folder / name
        is_there = (name == STILLS or self.state == "done") and path.is_file()
        return path if is_there else None

    def _send(self, commands: Sequence[Sequence[str]]) -> None:
        """Give the process its words; the pipe stays open as long as this process lives."""
        with contextlib.suppress(BrokenPipeError):  # it has ended already, and says why
            if self._process.stdin is not None:
                self._process.stdin.write(json.dumps(commands) + "\n")
                self._process.stdin.flush()

    def _read(self) -> None:
        if self._process.stderr is not None:
            with self._process.stderr as lines:
                for line in map(str.rstrip, lines):
                    if line.startswith(STEP_MARK):
                        self._step = json.loads(line.removeprefix(STEP_MARK))
                    elif line not in self._lines:  # the stills say what the run says
                        self._lines.append(line)
        with contextlib.suppress(BrokenPipeError):
            if self._process.stdin is not None:
                self._process.stdin.close()


class JobServer(PageServer):
    """The page and its latest job, in a folder that is deleted at the end.

    Args:
        home: the folder whose files the page may name.
        port: TCP port; 0: any free one.

    Raises:
        InputError: the port is taken.
    """

    def __init__(self, home: Path = Path(), *, port: int = 0) -> None:
        self.job: Job | None = None
        self._jobs, self._home = 0, home.resolve()
        self._lock = threading.Lock()
        self._ended = contextlib.ExitStack()
        gets: Gets = {path: functools.partial(self._result, path) for path in RESULTS}
        gets = {"/job": self._state, "/words": _words, **gets}
        posts = {"/run": self._run, "/stop": self._stop}
        uploads = {"/file": self._take}
        with self._ended as ended:
            self.folder = ended.enter_context(temporary_folder())
            super().__init__(page_html(self._home), gets, posts, uploads, port=port)
            self._ended = ended.pop_all()

    def begin(
        self, command: str, options: Sequence[str], subject: str, *, has_stills: bool = False
    ) -> None:
        """Start a job, which takes the place of the one before.

        Its arguments are those of `Job`, but for a scene file the subject may also be its text.

        Raises:
            TexventError: a scene cannot be read, or names a file that the page may not read.
        """
        with self._lock:
            self._jobs += 1
            folder = self.folder / f"job-{self._jobs}"
            folder.mkdir()
            is_json = subject.lstrip().startswith("{")
            if is_json or SCENE_MARK in subject:
                path = folder / ("scene.json" if is_json else "scene.toml")
                path.write_text(subject, encoding="utf-8")
                subject = str(path)
            try:
                for file in _files_of(subject, is_read=has_stills):
                    self._allowed(file)
            except TexventError as error:
                shutil.rmtree(folder)
                raise InputError(str(error).replace(f"{folder}/", "")) from None
            if self.job is not None:
                self.job.stop()
                shutil.rmtree(self.job.folder, ignore_errors=True)
            self.job = Job(
                folder, command, options, subject, has_stills=has_stills, home=self._home
            )

    def close(self) -> None:
        """Stop the job and the server, and delete all files."""
        self._stop({})
        super().close()
        self._ended.close()

    def _run(self, values: Mapping[str, Any]) -> None:
        """Start a job of the page's fields; empty ones are left to the defaults.

        Raises:
            InputError: a file is named that the page may not read.
        """
        texts = {name: str(text).strip() for name, text in values.items()}
        video, prompt = texts.get("video", ""), texts.get("prompt", "")
        if video:
            self.begin("simulate", flags_of(texts), self._allowed(video))
            return
        name = texts.get("generator") or GENERATORS.names()[0]
        is_listed = name.startswith(HUB) or name in GENERATORS.names()
        if not is_listed and (name[0] == "~" or os.sep in name or os.path.isdir(self._home / name)):
            name = texts["generator"] = self._allowed(name)
        subject = self._allowed(prompt) if scenes().is_scene_file(prompt) else prompt
        has_stills = getattr(GENERATORS.load(name), "takes_scenes", False)
        self.begin("generate", flags_of(texts), subject, has_stills=has_stills)

    def _allowed(self, text: str) -> str:
        """The path of a file that the page may read: in the user's folder, or sent by the page.

        Raises:
            InputError: it is elsewhere.
        """
        path = Path(os.path.realpath(usable_path(self._home / os.path.expanduser(text))))
        if not (path.is_relative_to(self._home) or path.is_relative_to(self._sent)):
            raise InputError(
                f"{shown(text)} is outside of {self._home}; choose the file with the button, or "
                f"start texvent app --folder {path.parent}"
            )
        return str(path)

    @property
    def _sent(self) -> Path:
        """Folder of the files that the page was sent."""
        return self.folder.resolve() / "sent"

    def _take(self, name: str, body: BufferedIOBase, length: int) -> Answer:
        """Keep a file that the page sends, in place of the ones before; its path.

        Raises:
            InputError: it does not arrive whole, or the disk has no room for it.
        """
        used = None if self.job is None else Path(self.job.subject)
        self._sent.mkdir(exist_ok=True)
        for one in self._sent.iterdir():
            if one != used:
                one.unlink()
        cleaned = re.sub(r"[^\w.-]+|^\.+", "-", Path(name).name)[-MOST_LETTERS:]
        path = self._sent / (cleaned or "file")
        if shutil.disk_usage(self._sent).free < length:
            raise InputError(f"no room for {length:,} bytes in {self.folder}; remove files there")
        with atomic_file(path, overwrite=True) as part, part.open("wb") as file:
            while length and (piece := body.read(min(length, PIECE_BYTES))):
                length -= file.write(piece)
            if length:
                raise InputError(f"{shown(name)} did not arrive whole; send it again")
        return Answer(json.dumps({"path": str(path)}))

    def _stop(self, values: Mapping[str, Any]) -> None:
        if self.job is not None:
            self.job.stop()

    def _state(self, query: Mapping[str, str]) -> Answer:
        nothing = {"state": "none", "text": ""}
        return Answer(json.dumps(nothing if self.job is None else self.job.describe()))

    def _result(self, path: str, query: Mapping[str, str]) -> Answer | None:
        name, kind, policy = RESULTS[path]
        file = None if self.job is None else self.job.file(name)
        return None if file is None else Answer(file.read_bytes(), kind, policy)


def _files_of(subject: str, *, is_read: bool) -> list[str]:
    """Files that a scene file names, or a sentence if a generator reads it as a scene."""
    if scenes().is_scene_file(subject):
        return scenes().files_of(scenes().load_scene(subject))
    with contextlib.suppress(TexventError):  # the job says what cannot be read
        return scenes().files_of(scenes().read(subject).scene) if is_read else []
    return []


def flags_of(texts: Mapping[str, str]) -> list[str]:
    """Flags of the page's fields."""
    names = ["simulator", "preset", "sensor", "seed", "palette"]
    if not texts.get("video"):
        names += ["generator", "duration", "frames", "fps"]
    return [f"--{name}={texts[name]}" for name in names if texts.get(name)]


def _words(query: Mapping[str, str]) -> Answer:
    """The words of prompts by family: each with its other names."""
    return Answer(json.dumps(scenes().list_vocabulary()))


def list_generators() -> dict[str, dict[str, Any]]:
    """Generators by name: option that sets the length of the video, its default, and a note.

    Those that need an image are left out.
    """
    found = {}
    for name in GENERATORS.names():
        if name in MODELS and MODELS[name].needs_image:
            continue
        source = read_basis("generate", {"generator": name}).defaults.source
        length = "duration" if "duration" in option_names(type(source)) else "frames"
        note = (GENERATORS.load(name).__doc__ or "").strip().splitlines()[0]
        if name in MODELS:
            note = f"{name} is fetched when first used; licence: {MODELS[name].licence}"
        default = SECONDS if length == "duration" else getattr(source, length)
        found[name] = {"length": length, "default": default, "note": note}
    return found


def page_html(home: Path = Path()) -> str:
    """The page, with the names to choose from and the videos of a folder."""
    choices = {
        "generators": list_generators(),
        "simulators": SIMULATORS.names(),
        "simulator": RunConfig.simulator,
        "presets": {name: list(SIMULATORS.load(name).presets) for name in SIMULATORS.names()},
        "sensors": {one.name: f"{one.size.width}×{one.size.height}" for one in SENSORS.values()},
        "examples": list_examples(),
        "home": str(home),
        "videos": _list_videos(home),
        "most_bytes": FILE_BYTES,
    }
    return page_text("job_page.html", choices)


def list_examples() -> list[dict[str, str]]:
    """Sentences and scene files, the latter with a title, each with a picture of its events."""
    folder = resources.files("texvent.web").joinpath("examples")
    examples = tomllib.loads(folder.joinpath("examples.toml").read_text("utf-8"))["examples"]
    for number, one in enumerate(examples):
        picture = folder.joinpath(f"{number}.png").read_bytes()
        one["picture"] = base64.b64encode(picture).decode()
    return list(examples)


def _list_videos(home: Path) -> list[str]:
    """Videos in a folder and in its folders, by their paths from there."""
    found = (path for pattern in ("*", "*/*") for path in sorted(home.glob(pattern)))
    named = (path for path in found if path.suffix.lower() in VIDEO_EXTENSIONS)
    return [str(path.relative_to(home)) for path in itertools.islice(named, MOST_VIDEOS)]
