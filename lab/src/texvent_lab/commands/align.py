"""`texvent align DIR --clip MODEL`: how well events fit their texts."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import asdict, dataclass
from pathlib import Path
from typing import ClassVar

from texvent.cli.notices import write_out
from texvent.cli.option_types import REQUIRED
from texvent.cli.options import parse_configs
from texvent.config import check_range
from texvent.errors import ConfigError
from texvent.runtime.console_progress import ConsoleProgress
from texvent_lab.alignment.align import align, alignment_table
from texvent_lab.alignment.clip_model import ClipModel
from texvent_lab.alignment.recordings import (
    DrawnEvents,
    TextRecording,
    ids_of_clips,
    keep_common,
    list_samples,
    list_streams,
)
from texvent_lab.bench.document import describe_environment
from texvent_lab.commands.bench.bench import ResultOptions
from texvent_lab.nt_imagenet.files import read_captioned

SCHEMA = "texvent-alignment-1"
DESCRIPTION = """Does the text that a recording was made from fit it better than other texts? A CLIP
model of yours ranks all texts for each recording; beside it stand captions exchanged at random.

  texvent align nt-events --clip hub:openai/clip-vit-large-patch14
  texvent align --n-imagenet N_Imagenet --captions nt/captions.jsonl \\
      --clip clip/

With both, the same captions are ranked for ours and for the recorded streams."""
RECORDED = "N-ImageNet"


@dataclass(frozen=True, kw_only=True)
class AlignOptions:
    """Recordings and model."""

    input_texts: ClassVar[tuple[str, ...]] = ("clip",)
    positional: ClassVar[tuple[str, ...]] = ("folder",)
    main_options: ClassVar[tuple[str, ...]] = (
        *("folder", "clip", "n_imagenet", "captions", "split", "limit", "images"),
        *("least_similarity", "seed", "device", "out", "overwrite"),
    )

    folder: Path | None = None
    """Folder of a data set made from prompts."""
    clip: str = REQUIRED
    """CLIP model: folder saved by transformers, or hub:org/name."""
    n_imagenet: Path | None = None
    """Folder of N-ImageNet, to score its recorded streams; needs --captions."""
    captions: Path | None = None
    """captions.jsonl of texvent nt-imagenet."""
    split: str | None = None
    """Samples of that split alone."""
    limit: int | None = None
    """At most this many texts, evenly spaced; chance depends on how many there are."""
    images: int = 4
    """Most images of a recording."""
    events_per_image: int | None = None
    """Events in a drawn image; default: 70,000 at 640x480, in proportion for other sensors."""
    least_similarity: float | None = None
    """List recordings whose similarity with their own text is less than this above the mean of that
    with the others; 0: those that fit the others better, where a video model may have failed."""
    seed: int = 0
    """Seed of the bootstrap and of the exchanged captions."""
    device: str = "auto"
    """Device of the model: auto, cpu, cuda, cuda:1."""

    def __post_init__(self) -> None:
        check_range("limit", self.limit, 2)
        check_range("images", self.images, 1, 64)
        check_range("events_per_image", self.events_per_image, 1)
        check_range("least_similarity", self.least_similarity, -2, 2)
        check_range("seed", self.seed, 0, 2**63 - 1)

    def sources(self) -> dict[str, list[TextRecording]]:
        """The recordings by source.

        Raises:
            ConfigError: nothing to score, N-ImageNet without captions, or one text alone.
            InputError, FileFormatError: they cannot be read.
        """
        if self.folder is None and self.n_imagenet is None:
            raise ConfigError("nothing to score; give a data set, or --n-imagenet and --captions")
        if self.n_imagenet is not None and self.captions is None:
            raise ConfigError("the recorded streams need their texts; give them with --captions")
        captioned = None if self.captions is None else read_captioned(self.captions)
        found: dict[str, list[TextRecording]] = {}
        if self.folder is not None:
            ids = None if captioned is None else ids_of_clips(self.folder, captioned)
            found |= list_samples(self.folder, split=self.split, ids=ids)
        if self.n_imagenet is not None:
            found[RECORDED] = list_streams(self.n_imagenet, captioned or [])
        kept = keep_common(found, limit=self.limit)
        for name, one in kept.items():
            if self.least_similarity is not None and len({each.text for each in one}) < 2:
                raise ConfigError(
                    f"{name} has one text alone; least_similarity compares with others"
                )
        return kept


def run(arguments: Sequence[str]) -> int:
    """Run the command; returns 0."""
    options, output = parse_configs(
        arguments,
        {"input": AlignOptions(), "output": ResultOptions()},
        prog="texvent align",
        description=DESCRIPTION,
    )
    output.check()
    sources = options.sources()
    clip = ClipModel(options.clip, device=options.device)
    draw, margin = DrawnEvents(options.images, options.events_per_image), options.least_similarity
    with ConsoleProgress(is_quiet=output.quiet) as progress:
        reports = align(
            sources, draw, clip, seed=options.seed, margin=margin, progress=progress.advance
        )
    texts = {recording.text for one in sources.values() for recording in one}
    cut = sum(clip.count_tokens(text) > clip.most_tokens for text in texts)
    output.write(
        lambda: {
            "schema": SCHEMA,
            "environment": describe_environment(),
            "clip": options.clip,
            "images": options.images,
            "events_per_image": options.events_per_image,
            "seed": options.seed,
            "least_similarity": margin,
            "texts_cut": cut,
            "rows": [{"source": name, **asdict(one)} for name, one in reports.items()],
        }
    )
    write_out(alignment_table(reports))
    for name, one in reports.items() if margin is not None else ():
        write_out(f"{name}: {len(one.misfits):,} of {one.recordings:,} fit their text too little\n")
        for misfit in one.misfits:
            write_out("  {sample}  own {own:.4f}, others {others:.4f}  {text}\n".format(**misfit))
    if cut:
        write_out(
            f"{cut:,} of {len(texts):,} texts are longer than the {clip.most_tokens} tokens that "
            "this model reads\n"
        )
    return 0
