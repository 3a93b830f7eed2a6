"""The samples of a shard: each clip simulated, on a GPU several as one batch, and its files."""

from __future__ import annotations

from collections import defaultdict
from collections.abc import Callable, Collection, Iterator, Mapping, Sequence
from contextlib import contextmanager
from dataclasses import replace
from functools import partial
from itertools import islice
from pathlib import Path
from typing import TYPE_CHECKING, Any, NamedTuple

from texvent.dataset.generation.make_sample import (
    SampleRun,
    count_boxes,
    prepare_clip,
    record_truth,
    sample_members,
    simulate_sample,
)
from texvent.dataset.generation.recipe import VIDEOS, Recipe, Shard
from texvent.dataset.generation.shard_files import (
    FILTERED,
    MADE,
    SampleRecord,
    read_members,
    read_record,
)
from texvent.dataset.specification.clips import NumberedClip, simulation_seed, with_seed
from texvent.dataset.specification.items import KEY_DIGITS
from texvent.errors import InputError, TexventError, warnings_to
from texvent.frames import FrameStream
from texvent.generation.kept_frames import KeptFrames
from texvent.generation.videos.stored_video import EXTENSION, reopen, write_stream
from texvent.pipeline import Simulation, fit_to_sensor, simulate_together, with_scene
from texvent.prompt_report import REPORT_KEY
from texvent.run.prepare import make_video, prepare_video
from texvent.runtime.devices import AUTO
from texvent.runtime.files.file_names import inside
from texvent.runtime.identity import digest
from texvent.settings.resolution import Settings
from texvent.simulation.gpu.support import choose_device
from texvent.truth.clip import ClipTruth

if TYPE_CHECKING:
    from texvent.truth.recorder import TruthRecorder
    from texvent.truth.sinks import SampleSink

Members = Mapping[str, bytes]
Make = Callable[[], tuple[Members, dict[str, Any]]]
"""Gives the members of a sample, none of one that is left out, and further facts for its record."""
CLIPS_AT_ONCE = 16
"""Most samples of a batch; their events and some frames of each are held in memory."""


class Making(NamedTuple):
    """Circumstances of making a shard."""

    frames: KeptFrames | None
    """Frames that other shards of the same clips show too."""
    retry_failed: bool
    device: str
    """Device of the pixel model; "auto": that of the specification."""


class _Plan(NamedTuple):
    """One sample to make."""

    key: str
    clip: NumberedClip
    settings: Settings


class _Run(NamedTuple):
    """One sample that is being simulated."""

    simulation: Simulation
    recorder: TruthRecorder[SampleSink] | None
    sample: SampleRun


@contextmanager
def _noting() -> Iterator[list[str]]:
    """Note texvent's warnings and the error that ends the block, instead of giving them on."""
    said: list[str] = []
    try:
        with warnings_to(said.append):
            yield said
    except (TexventError, MemoryError) as error:
        said.append(str(error) or "memory ran out")


class ShardSamples:
    """The samples of a shard: a record that lacks its results, and a `Make`, for each."""

    def __init__(
        self,
        recipe: Recipe,
        folder: Path,
        shard: Shard,
        scratch: Path,
        making: Making,
        kept: Collection[str],
    ) -> None:
        self._recipe, self._shard, self._scratch, self._making = recipe, shard, scratch, making
        self._kept = kept
        self._simulated: dict[str, _Run] = {}
        self._batch: Sequence[_Plan] | None = None
        """The batch that was simulated last."""
        self._labels = {label: number for number, label in enumerate(recipe.items.labels)}
        self._stored: StoredVideos | None = None
        if recipe.stores_videos and shard.variant != VIDEOS:
            self._stored = StoredVideos(folder, replace(shard, variant=VIDEOS), scratch)

    def __iter__(self) -> Iterator[tuple[SampleRecord, Make]]:
        if self._shard.variant == VIDEOS:
            for clip in self._recipe.clips_of(self._shard):
                yield _record(clip.key, clip, clip.seed), partial(self._make_video, clip)
            return
        plans = self._plans()
        while batch := list(islice(plans, CLIPS_AT_ONCE)):
            for plan in batch:
                seed = plan.settings.run.seed
                yield _record(plan.key, plan.clip, seed), partial(self._make_events, plan, batch)

    def _plans(self) -> Iterator[_Plan]:
        variant, device = self._recipe.variants[self._shard.variant], self._making.device
        for clip in self._recipe.clips_of(self._shard):
            settings = self._recipe.settings[variant.name].of(clip)
            if device != AUTO:
                settings = replace(settings, run=replace(settings.run, device=device))
            for number in range(variant.seeds):
                key = digest([clip.key, variant.name, number])[:KEY_DIGITS]
                yield _Plan(key, clip, with_seed(settings, simulation_seed(clip, number)))

    def _make_video(self, clip: NumberedClip) -> tuple[Members, dict[str, Any]]:
        settings = self._recipe.settings[VIDEOS].of(clip)
        settings = replace(settings, run=replace(settings.run, sensor=None))  # its generator's size
        path = self._scratch / f"{clip.key}{EXTENSION}"
        stored = write_stream(make_video(clip.item.subject, settings), path, overwrite=True)
        content = path.read_bytes()
        path.unlink()
        width, height = stored.size
        report = stored.metadata.get(REPORT_KEY)
        return (
            {EXTENSION[1:]: content, "txt": (clip.item.prompt or "").encode()},
            {"width": width, "height": height, REPORT_KEY: report},
        )

    def _begin(self, plan: _Plan, name: str = "video") -> _Run:
        """A sample before it is simulated; `name` is that of its stored video meanwhile."""
        item, specification = plan.clip.item, self._recipe.specification
        if self._stored is None:
            frames = self._making.frames
            simulation = prepare_clip(self._recipe, plan.clip, plan.settings, frames)
        else:
            made = self._recipe.settings[VIDEOS].of(plan.clip)
            video = with_scene(self._stored.open(plan.clip, name), item.subject, made)
            video = fit_to_sensor(video, plan.settings)
            simulation = prepare_video(video, plan.settings, prompt=item.prompt)
        recorder = record_truth(specification, item, simulation) if specification.truth else None
        on_frame = None if recorder is None else recorder.append
        return _Run(simulation, recorder, SampleRun(simulation, specification.filters, on_frame))

    def _simulate_together(self, batch: Sequence[_Plan]) -> None:
        """Simulate clips of one size and model as one batch where they run on a GPU.

        Clips that fail or warn are left, to be simulated alone: that shows which one it is.
        """
        groups = defaultdict[Any, dict[str, _Run]](dict)
        for plan in batch if self._making.frames is None else ():
            on_gpu = choose_device(plan.settings.run, plan.settings.simulate).resident is not None
            if not on_gpu or plan.key in self._kept:
                continue
            with _noting() as said:
                run = self._begin(plan, plan.key)
            if not said:
                simulation = run.simulation
                kind = simulation.device, simulation.video.size, simulation.settings.simulate
                groups[kind][plan.key] = run
        for runs in groups.values():
            samples = [one.sample for one in runs.values()]

            def take(number: int, *step: Any, samples: Any = samples) -> bool:
                return bool(samples[number].take(*step))

            with _noting() as said:
                broken = simulate_together([one.simulation for one in samples], take)
            if not said:
                whole = enumerate(runs.items())
                self._simulated.update(one for number, one in whole if number not in broken)
        for plan in batch:
            (self._scratch / f"{plan.key}{EXTENSION}").unlink(missing_ok=True)

    def _make_events(self, plan: _Plan, batch: Sequence[_Plan]) -> tuple[Members, dict[str, Any]]:
        key, clip, specification = plan.key, plan.clip, self._recipe.specification
        if self._batch is not batch:
            self._batch = batch
            self._simulate_together(batch)
        run = self._simulated.pop(key, None)
        if run is None:
            run = self._begin(plan)
            simulate_sample(run.sample)
        simulation, simulated = run.simulation, run.sample.finish()
        known = {
            "signal_events": simulated.signal_events,
            REPORT_KEY: simulation.provenance.get(REPORT_KEY),
        }
        if simulated.left_out is not None:
            return {}, {"status": FILTERED, "reason": simulated.left_out, **known}
        width, height = simulation.video.size
        known |= {
            "events": len(simulated.events),
            "start_us": simulated.start_us,
            "duration_us": simulated.duration_us,
            "width": width,
            "height": height,
        }
        truth = None if run.recorder is None else run.recorder.finish()
        facts = {
            **simulation.provenance,
            **known,
            "key": key,
            "clip": clip.key,
            "split": clip.split,
            "variant": self._shard.variant,
            "label": clip.item.label,
            **({} if truth is None else {"truth": truth.facts}),
        }
        members = sample_members(
            simulated,
            facts,
            class_number=None if clip.item.label is None else self._labels[clip.item.label],
            preview=specification.previews,
            truth={} if truth is None else truth.members,
        )
        known["unboxed"] = () if truth is None else truth.unboxed
        return members, {**known, **count_boxes(ClipTruth(members.__getitem__, key))}


def _record(key: str, clip: NumberedClip, seed: int) -> SampleRecord:
    item = clip.item
    return SampleRecord(
        key=key,
        clip=clip.key,
        status=MADE,
        seed=seed,
        prompt=item.prompt,
        label=item.label,
        is_scene=item.scene is not None,
    )


class StoredVideos:
    """The videos of a shard of the first stage."""

    def __init__(self, folder: Path, shard: Shard, scratch: Path) -> None:
        self._shard, self._scratch = shard, scratch
        self._path = inside(folder, shard.path.as_posix())
        record = read_record(self._path)
        if record is None:
            raise InputError(f"{self._path} is not made yet; make the shards of videos first")
        self._samples = {sample.key: sample for sample in record.samples}

    def open(self, clip: NumberedClip, name: str = "video") -> FrameStream:
        """The video of a clip, until another is opened under the same name.

        Raises:
            InputError: it could not be made.
        """
        sample = self._samples[clip.key]
        if sample.status != MADE:
            raise InputError(f"its video was not made: {sample.reason}")
        place = self._scratch / f"{name}{EXTENSION}"
        place.write_bytes(read_members(self._path, sample.members, (EXTENSION[1:],))["avi"])
        video = reopen(place)
        if video is None:
            raise InputError(f"{self._path} holds no video for {clip.key}")
        return video.with_metadata(stored=str(self._shard.path))
