"""`texvent caption IMAGES`: prompts from images, ready for `texvent batch`."""

from __future__ import annotations

import csv
from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from pathlib import Path
from typing import ClassVar

from texvent.cli.notices import say, write_out
from texvent.cli.option_types import REQUIRED
from texvent.cli.options import parse_configs
from texvent.config import check_range
from texvent.errors import ConfigError, InputError, TexventError
from texvent.io.atomic import atomic_file, check_output
from texvent.runtime.displays.console_progress import ConsoleProgress
from texvent_lab.nt_imagenet.captioner import INSTRUCTION, Captioner, find_images

DESCRIPTION = """Describe images with a vision-language model of yours (such as LLaVA, run by
transformers), one line each. The result of -o is a file for texvent batch:

  texvent caption photos/ --model hub:llava-hf/llava-1.5-7b-hf -o prompts.csv
  texvent batch prompts.csv --generator wan-1.3b -o events"""


@dataclass(frozen=True, kw_only=True)
class CaptionOptions:
    """Which images, which model, what to ask."""

    input_texts: ClassVar[tuple[str, ...]] = ("model",)
    positional: ClassVar[tuple[str, ...]] = ("images",)
    short_flags: ClassVar[Mapping[str, str]] = {"out": "-o", "quiet": "-q"}

    images: Path = REQUIRED
    """Image, or folder of images."""
    model: str = REQUIRED
    """Folder of a vision-language model saved by transformers, or hub:org/name."""
    out: Path | None = None
    """CSV file for the captions (columns name, prompt); without it they are printed."""
    instruction: str = INSTRUCTION
    """What the model is asked."""
    longest: int = 124
    """Most tokens of a caption."""
    generator_device: str = "auto"
    """Where the model runs: auto, cpu, cuda, cuda:1."""
    overwrite: bool = False
    """Replace the file if it exists already."""
    quiet: bool = False
    """No progress."""

    def __post_init__(self) -> None:
        check_range("longest", self.longest, 1, 4096)
        if self.out is not None and self.out.suffix.lower() != ".csv":
            raise ConfigError(f"captions are written as CSV; {self.out} must end in .csv")


def run(arguments: Sequence[str]) -> int:
    """Run the command; returns 0.

    Raises:
        TexventError: some images have no caption; those of the others are written.
    """
    (options,) = parse_configs(
        arguments, {"input": CaptionOptions()}, prog="texvent caption", description=DESCRIPTION
    )
    if options.out is not None:
        check_output(options.out, overwrite=options.overwrite)
    images = find_images(options.images)
    progress = ConsoleProgress(is_quiet=options.quiet)
    captioner = Captioner(options.model, device=options.generator_device)
    rows: list[tuple[str, str]] = []
    for number, image in enumerate(images, start=1):
        progress.announce(f"{number}/{len(images)} {image}")
        try:
            text = captioner.caption(
                image, instruction=options.instruction, longest=options.longest
            )
        except InputError as error:
            # The other images keep their captions.
            if len(images) == 1:
                raise
            say(f"failed   {error}")
            continue
        rows.append((_row_name(image, images), text))
        if options.out is None:
            write_out(f"{text}\n")
    if options.out is not None and rows:
        with (
            atomic_file(options.out, overwrite=options.overwrite) as part,
            part.open("w", encoding="utf-8", newline="") as file,
        ):
            csv.writer(file).writerows([("name", "prompt"), *rows])
        write_out(f"{options.out}\n")
    if len(rows) < len(images):
        failed = len(images) - len(rows)
        raise TexventError(f"{failed} of {len(images)} images have no caption")
    return 0


def _row_name(image: Path, images: Sequence[Path]) -> str:
    """The stem, or the whole name where a.png and a.jpg would share it: `batch` wants each once."""
    is_shared = sum(other.stem == image.stem for other in images) > 1
    return image.name if is_shared else image.stem
