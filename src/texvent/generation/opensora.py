"""Open-Sora 2 in the user's own installation, run as a separate program (paper, Figs. 13-14).

Open-Sora pins versions of Python, torch and CUDA extensions that exclude most other packages, so
it lives in an environment of its own and is called by its documented command line. It writes an
ordinary 8-bit mp4, which is kept byte by byte.
"""

from __future__ import annotations

import contextlib
import csv
import functools
import os
import shutil
import signal
import subprocess
import tempfile
from collections.abc import Sequence
from dataclasses import dataclass
from fractions import Fraction
from pathlib import Path
from typing import Any, ClassVar

from texvent._version import __version__
from texvent.config import check_range
from texvent.errors import ConfigError, InputError, TexventError
from texvent.generation.video_models.config import GeneratedVideoConfig
from texvent.generation.videos.retries import generate_checked
from texvent.generation.videos.stored_video import FinishedVideo, StoredVideo, open_stored
from texvent.generation.videos.video_cache import VideoCache, content_key
from texvent.io.atomic import atomic_file
from texvent.options.values import plain
from texvent.runtime.progress import Progress
from texvent.sensor import SensorSize

ROOT_VARIABLE = "OPENSORA_ROOT"
"""Environment variable that names the folder of Open-Sora."""
SCRIPT = Path("scripts/diffusion/inference.py")
CONFIGS = Path("configs/diffusion/inference")
WEIGHTS = Path("ckpts/Open_Sora_v2.safetensors")
"""The last of the files that its configs load, in its own folder."""
IMAGE_WEIGHTS = (Path("ckpts/flux1-dev.safetensors"), Path("ckpts/flux1-dev-ae.safetensors"))
"""Further ones where an image comes first."""
LAUNCHERS = (Path(".venv/bin/torchrun"), Path("venv/bin/torchrun"))
SEED_MODULUS = 2**31 - 2
MP4 = ".mp4"
GRACE_S = 10.0
"""Time to end by itself after SIGTERM."""
LAST_LINES, LONGEST_LINE = 4, 300


@dataclass(frozen=True, kw_only=True)
class OpenSoraConfig(GeneratedVideoConfig):
    """Options of a call of Open-Sora."""

    fps: Fraction | None = Fraction(24)
    """Frame rate that Open-Sora takes (a whole number), and the video's."""
    height: int = 256
    """Size class of the 16:9 image, 256 or 768 px: 256 takes about a minute and 52 GB on an H100,
    768 half an hour and 60 GB."""
    frames: int = 129
    """Frames to generate, 4k+1, at most 129."""
    steps: int = 50
    """Denoising steps."""
    guidance: float = 7.5
    """Strength with which the prompt is followed."""
    image_first: bool = False
    """Make an image and the video from it, as its README recommends, instead of the video alone.
    The image model, FLUX.1 [dev], has a non-commercial licence."""

    @property
    def program(self) -> Path:
        """Open-Sora's own configuration file for these options."""
        return CONFIGS / f"{'t2i2v_' if self.image_first else ''}{self.height}px.py"

    def __post_init__(self) -> None:
        super().__post_init__()
        check_range("frames", self.frames, 5, 129)
        check_range("steps", self.steps, 1, 1000)
        check_range("guidance", self.guidance, 0.0, 1000.0)
        if self.height not in (256, 768):
            raise ConfigError(f"height is {self.height}; Open-Sora makes 256 and 768 px")
        if self.frames % 4 != 1:
            raise ConfigError(f"frames is {self.frames}; Open-Sora makes 4k+1, such as 97 or 129")
        if self.fps is None or Fraction(self.fps).denominator != 1:
            raise ConfigError(f"fps is {self.fps}; Open-Sora takes a whole number, such as 24")


class OpenSoraGenerator:
    """Open-Sora 2, run in your own installation of it ($OPENSORA_ROOT)."""

    config_type: ClassVar[type] = OpenSoraConfig
    default_interpolate: ClassVar[str] = "flow"
    default_sensor: ClassVar[str | None] = None
    licence: ClassVar[str] = (
        "Apache-2.0; its decoder: Tencent Hunyuan Community License ?; with image_first: "
        "FLUX.1 [dev] Non-Commercial License of Black Forest Labs ?"
    )

    def __init__(
        self, config: OpenSoraConfig, *, seed: int = 0, size: SensorSize | None = None
    ) -> None:
        del size  # the pipeline fits the finished frames
        self.config = config
        self.seed = seed

    @classmethod
    def find_missing(cls, *, image_first: bool = False) -> str | None:
        """The first missing piece of the installation, and what to do; None if it is complete."""
        root = _root()
        if root is None or not (root / SCRIPT).is_file():
            return (
                f"there is no Open-Sora 2 checkout in {root or 'the environment'}; install it "
                "(github.com/hpcaitech/Open-Sora) in an environment of its own, then set "
                f"{ROOT_VARIABLE} to its folder"
            )
        if _launcher() is None:
            return (
                f"no torchrun in {root}/.venv, {root}/venv or on the PATH; activate Open-Sora's "
                "environment, or link it as .venv of the checkout"
            )
        for path in (WEIGHTS, *(IMAGE_WEIGHTS if image_first else ())):
            if not (root / path).exists():
                return (
                    f"the weights {root / path} are missing; in {root} run: hf download "
                    "hpcai-tech/Open-Sora-v2 --local-dir ./ckpts"
                )
        return None

    def generate(self, prompt: str, *, progress: Progress | None = None) -> FinishedVideo:
        """The video for `prompt`, made now unless it was made before.

        Raises:
            InputError: the prompt is empty.
            TexventError: Open-Sora is missing, lacks a file, or fails; its last output follows.
        """
        if not prompt.strip():
            raise InputError("the prompt is empty; describe a scene, such as 'a car drives left'")
        return generate_checked(
            functools.partial(self._find_or_make, prompt),
            self.config,
            seed=self.seed,
            progress=progress,
        )

    def plan(self, prompt: str) -> str | None:
        """Cost of making the video, or None if it was made before."""
        config = self.config
        if VideoCache(is_kept=config.reuse_video).has(self._key(prompt, self.seed), MP4):
            return None
        state = self.find_missing(image_first=self.config.image_first) or "it is ready"
        return (
            f"the video is not made yet: Open-Sora would make it ({config.frames} frames, "
            f"{config.steps} steps, {config.height}px); {state}"
        )

    def _key(self, prompt: str, seed: int) -> str:
        names = ("fps", "height", "frames", "steps", "guidance", "image_first")
        facts = {name: getattr(self.config, name) for name in names}
        return content_key({**facts, "source": "open-sora 2", "prompt": prompt, "seed": seed})

    def _find_or_make(self, prompt: str, seed: int, progress: Progress) -> StoredVideo:
        config = self.config
        fps = Fraction(config.fps or 24)
        key = self._key(prompt, seed)
        cache = VideoCache(is_kept=config.reuse_video)
        path = cache.path(key, MP4)
        origin = {
            "generator": "opensora",
            "version": __version__,
            "prompt": prompt,
            "seed": seed,
            "options": plain(config),
        }
        if cache.has(key, MP4):
            progress.announce(f"this video was generated before: {path}")
            return open_stored(path, fps, origin)
        missing = self.find_missing(image_first=self.config.image_first)
        if missing is not None:
            raise TexventError(missing)
        with tempfile.TemporaryDirectory(prefix="texvent-opensora-") as folder:
            progress.announce(f"running Open-Sora ({config.height}px, {config.steps} steps)")
            made = self._run(prompt, seed, Path(folder))
            with atomic_file(path, overwrite=True) as part:
                part.write_bytes(made.read_bytes())
            cache.seal(path)
        return open_stored(path, fps, origin)

    def _run(self, prompt: str, seed: int, folder: Path) -> Path:
        """Call the program; returns the mp4 it wrote."""
        root = _root()
        prompts = folder / "prompts.csv"
        with prompts.open("w", encoding="utf-8", newline="") as file:
            csv.writer(file).writerows([["text"], [prompt]])
        run_program(self._command(prompts, folder / "out", seed), cwd=root, log=folder / "log.txt")
        videos = sorted((folder / "out").rglob("*.mp4"))
        if not videos:
            raise TexventError(
                f"Open-Sora ended without writing a video below {folder / 'out'}; "
                "run it by hand to see why"
            )
        return videos[0]

    def _command(self, prompts: Path, out: Path, seed: int) -> list[str]:
        config = self.config
        # Open-Sora reads seed 0 as "no seed", and its libraries take 32 bits.
        its_seed = str(seed % SEED_MODULUS + 1)
        options: dict[str, Any] = {
            "--save-dir": out,
            "--dataset.data-path": prompts,
            "--seed": its_seed,
            "--fps_save": config.fps,
            "--sampling_option.seed": its_seed,
            "--sampling_option.num_frames": config.frames,
            "--sampling_option.num_steps": config.steps,
            "--sampling_option.guidance": config.guidance,
            "--sampling_option.aspect_ratio": "16:9",
        }
        words = [str(word) for pair in options.items() for word in pair]
        return [
            str(_launcher()),
            *("--nproc_per_node", "1", "--standalone"),
            *(str(SCRIPT), str(config.program)),
            *words,
        ]


def _launcher() -> Path | None:
    """The torchrun of Open-Sora's environment, or None."""
    root = _root() or Path()
    for path in LAUNCHERS:
        if os.access(root / path, os.X_OK):
            return (root / path).absolute()
    on_path = shutil.which("torchrun")
    return Path(on_path) if on_path else None


def _root() -> Path | None:
    named = os.environ.get(ROOT_VARIABLE)
    return Path(named).expanduser() if named else None


def run_program(command: Sequence[str], *, cwd: Path | None, log: Path) -> None:
    """Run a program, without a shell; Ctrl-C or any other exception ends it and its children.

    Raises:
        TexventError: it cannot be started, or ends with an error; its last lines are quoted.
    """
    with log.open("wb") as output:
        try:
            process = subprocess.Popen(
                command,
                cwd=cwd,
                stdin=subprocess.DEVNULL,
                stdout=output,
                stderr=subprocess.STDOUT,
                # A group of its own, so that a terminal's Ctrl-C reaches it only through us.
                start_new_session=True,
            )
        except OSError as error:
            raise TexventError(f"{command[0]} cannot be started: {error.strerror}") from error
        try:
            code = process.wait()
        except BaseException:
            _end_group(process)
            raise
    if code != 0:
        lines = [line.strip() for line in log.read_text("utf-8", "replace").splitlines()]
        last = " | ".join([line[:LONGEST_LINE] for line in lines if line][-LAST_LINES:])
        raise TexventError(
            f"{Path(command[0]).name} ended with code {code}; its last output: {last or '(none)'}"
        )


def _end_group(process: subprocess.Popen[bytes]) -> None:
    """SIGTERM to the whole process group, then SIGKILL."""
    with contextlib.suppress(ProcessLookupError):
        os.killpg(process.pid, signal.SIGTERM)
        try:
            process.wait(GRACE_S)
        except subprocess.TimeoutExpired:
            os.killpg(process.pid, signal.SIGKILL)
            process.wait()
