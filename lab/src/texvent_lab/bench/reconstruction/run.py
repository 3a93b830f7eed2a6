"""Simulators scored by reconstruction: images made from their events, against the true frames.

The idea of the paper's Tables 1, 3 and 8, by the protocol of EVREAL (Ercan et al., CVPRW 2023). A
recording holds frames and events. A network makes an image at every frame from the events since
the frame before, once from the recorded events and once from those that each simulator makes of
the frames; all are compared with the frames themselves.
"""

from __future__ import annotations

import dataclasses
import itertools
import time
from collections.abc import Iterable, Iterator, Sequence
from dataclasses import dataclass, field
from typing import Any

import numpy as np

from texvent.config import check_range
from texvent.errors import ConfigError, InputError, TexventError
from texvent.event_packets import EventPackets
from texvent.events import EventStream
from texvent.frames import MICROSECONDS
from texvent.options.values import option_names
from texvent.pipeline import Simulation, video_to_events
from texvent.represent.slices import slice_between
from texvent.run.rate_search import match_rate
from texvent.simulation.model_options import contrast_threshold_of
from texvent_lab.bench.fidelity.entries import Entry
from texvent_lab.bench.fidelity.event_files import FileEntry
from texvent_lab.bench.jobs import Progress, no_progress
from texvent_lab.bench.kept_frames import keep_frames
from texvent_lab.bench.perturbations import scatter
from texvent_lab.bench.reconstruction.scores import ImageScores, ScoreCollector, score_images
from texvent_lab.frame_recordings import FrameRecording
from texvent_lab.reconstruct.image_measures import Measures
from texvent_lab.reconstruct.reconstructor import Reconstructor

RECORDED = "recorded"
"""Name of the sensor's own events."""
DEFAULT_SKIP = 10
"""Images that do not count where no part of the recording is named: a network needs time."""
MATCH_SECONDS = 1.0
"""Part of a recording that is simulated to fit the number of events, s."""


@dataclass(frozen=True, kw_only=True)
class ReconstructionPlan:
    """Simulators, and the part of a recording that is scored.

    Raises:
        ConfigError: a value is out of range, or an entry does not exist.
    """

    entries: Sequence[Entry] = ()
    start_s: float = 0.0
    """Start of the part that counts, s after the first frame."""
    seconds: float | None = None
    """Length of that part, s; None: EVREAL's part of recordings that it names, all of others."""
    skip: int | None = None
    """Images at the start of a recording that do not count; None: 10, but none where EVREAL names a
    part."""
    is_rate_matched: bool = False
    """Fit each contrast threshold to the number of recorded events, instead of keeping it."""
    frames_gamma: float = 1.0
    """Exponent that makes the frames linear: 1 for those of a DAVIS, 2.2 for ordinary video."""
    seed: int = 0

    def __post_init__(self) -> None:
        check_range("start_s", self.start_s, 0.0)
        check_range("seconds", self.seconds, 0.0)
        check_range("seed", self.seed, 0, 2**63 - 1)
        check_range("frames_gamma", self.frames_gamma, 0.1, 10.0)
        check_range("skip", self.skip, 0)
        for entry in self.entries:
            entry.settings(self.seed)

    def frame_times_us(self, recording: FrameRecording) -> list[int]:
        """Times of the frames of a recording up to the last one that counts, µs."""
        span, _ = self.scored_part(recording)
        times = (frame.t_us for frame in recording.frames)
        return list(times if span is None else itertools.takewhile(lambda t: t <= span[1], times))

    def scored_part(self, recording: FrameRecording) -> tuple[tuple[int, int] | None, int]:
        """First and last µs that count, and how many images at the start do not."""
        span, skip = None, DEFAULT_SKIP
        if self.seconds is not None:
            first_us = next(iter(recording.frames)).t_us + round(self.start_s * MICROSECONDS)
            span = first_us, first_us + round(self.seconds * MICROSECONDS)
        elif self.skip is None and recording.evreal_span_us is not None:
            span, skip = recording.evreal_span_us, 0
        return span, skip if self.skip is None else self.skip


@dataclass(frozen=True, kw_only=True)
class ReconstructionRow:
    """One source of events on one recording."""

    recording: str
    source: str
    """`RECORDED`, or the name of the entry."""
    scores: ImageScores
    events: int
    """From the first frame to the last one that counts."""
    threshold: float | None = None
    """δ of a simulator that has one, log units."""
    seconds: float = 0.0
    """Simulating and reconstructing."""


@dataclass(frozen=True, kw_only=True)
class ReconstructionReport:
    """Everything a run found."""

    network: str
    sha256: str
    """Digest of the network's weights file."""
    plan: ReconstructionPlan
    rows: Sequence[ReconstructionRow]
    absent: dict[str, str] = field(default_factory=dict)
    """Measure → why it is left out."""
    skipped: dict[str, str] = field(default_factory=dict)
    """Entry → why it did not run."""

    def sources(self) -> list[str]:
        """Sources of events, the recorded ones first."""
        return list(dict.fromkeys(row.source for row in self.rows))

    def rows_of(self, source: str) -> list[ReconstructionRow]:
        """The rows of one source, in order of recordings."""
        return [row for row in self.rows if row.source == source]


@dataclass(frozen=True, kw_only=True, eq=False)
class ReconstructionScorer:
    """Turns events into images and compares these with the true frames."""

    reconstructor: Reconstructor
    """The network; it is reset before each recording."""
    measures: Measures
    plan: ReconstructionPlan

    def score(
        self, recording: FrameRecording, packets: Iterable[EventStream], *, source: str = RECORDED
    ) -> ReconstructionRow:
        """Score recorded or simulated events of a recording's scene.

        Args:
            recording: whose frames are the truth.
            packets: the events, in time order.
            source: what to call them.

        Raises:
            InputError: the events have another size than the frames, or no image counts.
        """
        start = time.perf_counter()
        times_us = self.plan.frame_times_us(recording)
        counts: list[int] = []

        def counted() -> Iterator[tuple[int, EventStream]]:
            for t_us, events in slice_between(packets, times_us, size=recording.frames.size):
                counts.append(len(events))
                yield t_us, events

        images = self.reconstructor.reconstruct_all(counted())
        scores = score_images(images, recording.frames, self.new_collector(recording))
        return ReconstructionRow(
            recording=recording.name,
            source=source,
            scores=scores,
            events=sum(counts),
            seconds=time.perf_counter() - start,
        )

    def new_collector(self, recording: FrameRecording) -> ScoreCollector:
        """A collector for the part of a recording that counts."""
        span_us, skip = self.plan.scored_part(recording)
        return ScoreCollector(self.measures, span_us=span_us, skip=skip)


def run_reconstruction(
    recordings: Sequence[FrameRecording],
    scorer: ReconstructionScorer,
    *,
    progress: Progress = no_progress,
) -> ReconstructionReport:
    """Score the recorded events of each recording, and those of each simulator.

    Args:
        recordings: what the sensor saw.
        scorer: network, measures, and the plan: what is simulated and what counts.
        progress: told of every step.

    Raises:
        InputError: a recording cannot be read, or no image of it counts.
    """
    rows: list[ReconstructionRow] = []
    skipped: dict[str, str] = {}
    for recording in recordings:
        progress(f"{recording.name}: recorded events")
        rows.append(scorer.score(recording, recording.events))
        for entry in scorer.plan.entries:
            progress(f"{recording.name}: {entry.name}")
            try:
                packets, threshold = packets_of(recording, entry, scorer.plan)
                row = scorer.score(recording, packets, source=entry.name)
            except TexventError as error:
                skipped[entry.name] = f"{recording.name}: {error}"
                continue
            rows.append(dataclasses.replace(row, threshold=threshold))
    reconstructor = scorer.reconstructor
    return ReconstructionReport(
        network=reconstructor.name,
        sha256=reconstructor.sha256,
        plan=scorer.plan,
        rows=rows,
        absent=dict(scorer.measures.absent),
        skipped=skipped,
    )


PAPER_SHARES = (0.01, 0.05, 0.1, 0.2, 0.3)
"""ρ of the paper's Table 7."""


def noise_curve(
    recording: FrameRecording,
    scorer: ReconstructionScorer,
    shares: Sequence[float] = PAPER_SHARES,
) -> list[ImageScores]:
    """Images from recorded events, a share of them at random places, against those without.

    The paper does not say what Table 7 compares with. Its SSIM of 0.90 at 1 % is far above what
    E2VID reaches against true frames, so it must be images of the unperturbed events.

    Args:
        recording: frames and events.
        scorer: network, measures and what counts.
        shares: of the events; all are reconstructed side by side, in one pass.

    Raises:
        InputError: no image counts.
    """
    clean = scorer.reconstructor.twin()
    networks = [scorer.reconstructor.twin() for _ in shares]
    collectors = [scorer.new_collector(recording) for _ in shares]
    start_us = next(iter(recording.frames)).t_us
    times_us = scorer.plan.frame_times_us(recording)
    for stop_us, events in slice_between(recording.events, times_us, size=recording.frames.size):
        image = clean.reconstruct(events)
        for share, network, collector in zip(shares, networks, collectors, strict=True):
            # The same draws at each share: noise of a larger one includes that of a smaller one.
            chance = np.random.default_rng([scorer.plan.seed, start_us % 2**63])
            noisy = network.reconstruct(scatter(events, chance, share=share))
            collector.add(stop_us, noisy, image)
        start_us = stop_us
    return [collector.scores() for collector in collectors]


def packets_of(
    recording: FrameRecording, entry: Entry, plan: ReconstructionPlan
) -> tuple[EventPackets, float | None]:
    """Events of a row on a recording, and δ of a simulator that has one, log units."""
    if isinstance(entry, FileEntry):
        times_us = plan.frame_times_us(recording)
        span_us, size = (times_us[0], times_us[-1]), recording.frames.size
        entry.check(size, {recording.name: span_us}, is_part=True)
        return entry.packets(recording.name, size, span_us), None
    simulation = simulate_recording(recording, entry, plan)
    return simulation.packets, _threshold_of(simulation)


def simulate_recording(
    recording: FrameRecording, entry: Entry, plan: ReconstructionPlan
) -> Simulation:
    """A run of a simulator on a recording's frames, not started; one without δ is not fitted.

    Args:
        recording: whose frames are simulated, and whose events are counted to fit δ.
        entry: simulator and interpolator.
        plan: seed, gamma of the frames, and whether δ is fitted.

    Raises:
        InputError: no δ gives the recorded number of events.
    """
    settings = entry.settings(plan.seed)
    if "gamma" in option_names(type(settings.simulate)):
        simulate: Any = settings.simulate
        linear = dataclasses.replace(simulate, gamma=plan.frames_gamma)
        settings = dataclasses.replace(settings, simulate=linear)
    simulation = keep_frames(video_to_events(recording.frames, settings))
    if not plan.is_rate_matched or _threshold_of(simulation) is None:
        return simulation
    return match_rate(simulation, recorded_rate_hz(recording), seconds=MATCH_SECONDS)[0]


def recorded_rate_hz(recording: FrameRecording) -> float:
    """Recorded events per second over the start of the frames.

    Raises:
        InputError: nothing was recorded there.
    """
    start_us: int | None = None
    last_us = 0
    for frame in recording.frames:
        start_us = frame.t_us if start_us is None else start_us
        last_us = frame.t_us
        if last_us - start_us >= MATCH_SECONDS * MICROSECONDS:
            break
    start_us = start_us or 0
    count = 0
    for packet in recording.events:
        if len(packet) and int(packet.t[0]) >= last_us:
            break
        count += len(packet.cut(start_us, last_us))
    if not count:
        raise InputError(
            f"{recording.name}: no event was recorded from {start_us} to {last_us} µs, so no "
            "threshold can be fitted"
        )
    return count * MICROSECONDS / (last_us - start_us)


def _threshold_of(simulation: Simulation) -> float | None:
    try:
        return contrast_threshold_of(simulation.settings.simulate)
    except ConfigError:
        return None
