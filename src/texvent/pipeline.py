"""The main path of the paper's Figure 2: prompt → video → pairs of frames → events.

    video = generator.generate(prompt)        Eq. 3    texvent.generate
    pair  = plan_pairs(video)                 Eq. 4    texvent.interpolate
    packets = simulator.advance(pair)         Eq. 5-7  texvent.simulate

Everything is pulled through one pair at a time, so memory does not grow with the clip. Decoding
and optical flow run a few frames ahead in threads of their own; the events are the same without.
"""

from __future__ import annotations

from collections.abc import Callable, Iterator, Sequence
from contextlib import ExitStack
from dataclasses import dataclass, field, replace
from typing import Any

from texvent._registry import DEFAULT_GENERATOR, GENERATORS
from texvent.capture.linear_light import adapt_transfer
from texvent.capture.prepare import PreparedFrames
from texvent.config import CaptureConfig, RunConfig
from texvent.errors import warn
from texvent.event_packets import EventPackets
from texvent.events import NOISE, SIGNAL, EventStream
from texvent.frames import Frame, FrameStream
from texvent.generation.subjects import Subject, check_takes, prompt_of
from texvent.interpolate.pairing import plan_pairs
from texvent.pairs.frame_pair import FramePair, OnSceneChange, notify_scene_change
from texvent.runtime.progress import Progress
from texvent.settings.provenance import describe_run
from texvent.settings.resolution import Settings
from texvent.simulation.build import benefits_from_denser_frames, build_simulator
from texvent.simulation.gpu.support import RunDevice, choose_device
from texvent.simulation.model_options import draw_training_config
from texvent.simulation.protocol import Simulator
from texvent.simulation.signal_tally import SignalTally


def text_to_events(
    prompt: Subject, settings: Settings, *, progress: Progress | None = None
) -> Simulation:
    """Events for a text prompt (Eq. 2); none is computed before the result is iterated.

    Raises:
        InputError: the prompt is empty, or the model cannot be had.
    """
    return video_to_events(
        text_to_video(prompt, settings, progress=progress), settings, prompt=prompt_of(prompt)
    )


def text_to_video(
    prompt: Subject, settings: Settings, *, progress: Progress | None = None
) -> FrameStream:
    """The video for a text prompt (Eq. 3), fitted to the sensor; see `text_to_events`."""
    generator_class = GENERATORS.load(settings.generator or DEFAULT_GENERATOR)
    check_takes(prompt, generator_class, str(settings.generator))
    generator = generator_class(settings.source, seed=settings.run.seed, size=settings.size)
    return fit_to_sensor(generator.generate(prompt, progress=progress), settings)


def with_scene(video: FrameStream, prompt: Subject, settings: Settings) -> FrameStream:
    """A stored video with the scene that its model followed; other videos as they are."""
    generator_class = GENERATORS.load(settings.generator or DEFAULT_GENERATOR)
    generator = generator_class(settings.source, seed=settings.run.seed, size=None)
    attach: Callable[..., FrameStream] | None = getattr(generator, "attach", None)
    return video if attach is None else attach(video, prompt)


def fit_to_sensor(video: FrameStream, settings: Settings) -> FrameStream:
    """A generated video at the size of the sensor, if one is asked for."""
    if settings.size in (None, video.size):
        return video
    fit = CaptureConfig(fit=getattr(settings.source, "fit", CaptureConfig.fit))
    return PreparedFrames(video, fit, size=settings.size)


def video_to_events(
    video: FrameStream, settings: Settings, *, prompt: str | None = None
) -> Simulation:
    """Events for a video; nothing is computed before the result is iterated."""
    recipe = settings.run.randomize
    if recipe != "none":
        drawn = draw_training_config(settings.simulate, recipe, seed=settings.run.seed)
        settings = replace(settings, simulate=drawn)
    video, config = adapt_transfer(video, settings.run.simulator, settings.simulate)
    return Simulation(
        video=video,
        settings=replace(settings, simulate=config),
        prompt=prompt,
        device=choose_device(settings.run, config),
    )


@dataclass(frozen=True, kw_only=True, eq=False)
class Simulation:
    """One run, not started: `steps` makes the events."""

    video: FrameStream
    settings: Settings
    prompt: str | None = None
    warns: bool = False
    """Whether the end of the video warns of a run with hardly a signal."""
    device: RunDevice = field(default_factory=RunDevice)
    """GPU on which frames, network and pixels stay; by default all is on the CPU."""

    def steps(
        self, on_scene_change: OnSceneChange | None = None
    ) -> Iterator[tuple[Frame, EventStream]]:
        """Every dense frame with the packet of events that ends at it.

        Intermediate frames may be drawn only when their pixels are read.

        Warns:
            TexventWarning: `warns`, and there is no signal, or hardly any.
        """
        run, tally = self.settings.run, SignalTally()
        with ExitStack() as threads:
            simulator, pairs = self.begin(threads)
            tally.begin(simulator)
            for pair in pairs:
                notify_scene_change(pair, on_scene_change)
                tally.see(pair.second)
                for frame, packet in simulator.advance(pair):
                    tally.count(packet)
                    yield frame, select_events(packet, run)
            for frame, packet in simulator.finish():
                tally.count(packet)
                yield frame, select_events(packet, run)
        message = tally.warning(run.keep_events) if self.warns else None
        if message is not None:
            warn(message)

    def begin(self, threads: ExitStack) -> tuple[Simulator, Iterator[FramePair]]:
        """A simulator at rest, and the pairs of frames that it advances through."""
        resident = self.device.resident
        simulator = build_simulator(self.settings.run, self.settings.simulate, resident)
        pairs = plan_pairs(
            self.video,
            self.settings.interpolate,
            threads,
            balance=simulator.balance,
            contrast_threshold=simulator.contrast_threshold,
            counts_motion=benefits_from_denser_frames(simulator),
            gpu=self.device.gpu,
            is_resident=resident is not None,
        )
        return simulator, pairs

    def __iter__(self) -> Iterator[EventStream]:
        return (packet for _, packet in self.steps())

    def report_to(self, progress: Progress) -> Iterator[EventStream]:
        """The packets; `progress` receives the number of source frames done."""
        done = 0
        for frame, packet in self.steps():
            done += frame.is_source
            progress.advance("simulate", done, self.video.frame_count)
            yield packet

    @property
    def packets(self) -> EventPackets:
        """The events alone, packet by packet; simulated again for each pass."""
        return EventPackets(self, self.video.size, self.provenance)

    @property
    def provenance(self) -> dict[str, Any]:
        """Provenance: stored in every output, enough to make the events again."""
        facts = describe_run(self.settings, prompt=self.prompt, source=self.video.metadata)
        return facts | self.device.facts


def simulate_together(
    runs: Sequence[Simulation], take: Callable[[int, Frame, EventStream], bool]
) -> list[int]:
    """`Simulation.steps` of several runs as one batch on their device.

    Args:
        runs: of one size and pixel model, on one device.
        take: called with the number of a run, its next dense frame, and the packet that ends
            there; False: no more of that run is wanted.

    Returns:
        Numbers of runs that broke off; alone, `Simulation.steps` says why.

    Raises:
        TexventError: as `Simulation.steps`, of any of them.
    """
    from texvent.simulation.gpu.together import advance_together  # brings torch and Triton

    def give(number: int, frame: Frame, packet: EventStream) -> bool:
        return take(number, frame, select_events(packet, runs[number].settings.run))

    seeds = [one.settings.run.seed for one in runs]
    with ExitStack() as threads:
        clips = [one.begin(threads)[1] for one in runs]
        device = runs[0].device.resident
        return advance_together(runs[0].settings.simulate, seeds, clips, device, give)


def select_events(packet: EventStream, run: RunConfig) -> EventStream:
    """The events of a packet that a run keeps, with the label only if it is wanted."""
    if packet.label is not None and run.keep_events != "all":
        packet = packet[packet.label == (SIGNAL if run.keep_events == "signal" else NOISE)]
    return packet if run.label_noise else packet.without_label()
