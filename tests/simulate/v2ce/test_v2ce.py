"""V2CE's sequences, options and errors; the network itself is in test_v2ce_network."""

import hashlib
import sys
from pathlib import Path

import numpy as np
import pytest
from tests.frame_pairs import advance_through

import texvent
from texvent.errors import ConfigError
from texvent.events import EventStream
from texvent.pipeline import video_to_events
from texvent.settings.resolution import resolve
from texvent.simulate.packets import FrameInterval, make_packet
from texvent.simulate.random.draws import frame_key
from texvent.simulate.v2ce import ldati
from texvent.simulate.v2ce.simulator import V2ceConfig, V2ceSimulator, normalise
from texvent.video import Frame, Video

from ..pixel_frames import moving_texture
from .v2ce_files import StandInNetwork


@pytest.fixture
def weights(tmp_path) -> Path:
    path = tmp_path / "v2ce_3d.pt"
    path.write_bytes(b"stands for the weights")
    return path


@pytest.fixture
def stand_in(monkeypatch) -> None:
    module = sys.modules[V2ceSimulator.__module__]
    monkeypatch.setattr(module, "load_network", lambda *_: StandInNetwork())


@pytest.fixture
def model(stand_in, weights):
    def build(seed=0, **options):
        return V2ceSimulator(V2ceConfig(weights=weights, **options), seed=seed)

    return build


def ramp(count: int, shape=(3, 4), **options) -> list[Frame]:
    """Frames that all differ, so that their order can be told."""
    texture = moving_texture(count, shape, **options)
    return [Frame(f.pixels // 2 + np.uint8(2 * i), f.t_us) for i, f in enumerate(texture)]


def answers(simulator, frames) -> EventStream:
    return EventStream.concat([packet for _, packet in advance_through(simulator, frames)])


def means(frames) -> list[float]:
    return [float(normalise(frame.luma).mean()) for frame in frames]


def test_sequences_follow_one_another_and_the_last_reaches_back(model):
    simulator, frames = model(sequence_length=4), ramp(11)
    answers(simulator, frames)
    first = means(frames)
    expected = [first[0:4], first[4:8], first[6:10]]
    assert simulator._network.seen == [pytest.approx(one) for one in expected]


def test_every_packet_is_the_voxel_grid_of_its_own_pair(model):
    frames = ramp(8)
    found = dict(
        enumerate(packet for _, packet in advance_through(model(sequence_length=5), frames))
    )
    network = StandInNetwork()
    levels = np.stack([normalise(frame.luma) for frame in frames])
    pairs = np.stack([levels[:-1], levels[1:]], axis=1)
    for pair, start in ((1, 0), (4, 0), (5, 2), (6, 2)):
        grid = network.predict(pairs[start : start + 5])[pair - start]
        before, after = frames[pair].t_us, frames[pair + 1].t_us
        interval = FrameInterval(before, after, frame_key(0, after - frames[0].t_us))
        expected = make_packet(ldati.sample_events(grid, interval), interval, frames[0].size)
        assert found[pair + 1].equals(expected)
        assert len(expected) > 0


def test_answers_come_a_sequence_late_and_no_later(model):
    fed = []

    def feed():
        for frame in ramp(9):
            fed.append(frame)
            yield frame

    answered = advance_through(model(sequence_length=4), feed())
    lag = [len(fed) - i for i, _ in enumerate(answered, start=1)]
    assert lag == [0, 3, 2, 1, 0, 3, 2, 1, 0]


def test_one_frame_gives_an_empty_stream_and_none_gives_nothing(model):
    assert len(answers(model(), ramp(1))) == 0
    assert list(advance_through(model(), [])) == []


def test_a_single_step_answers_from_the_last_pairs(model):
    simulator, frames = model(sequence_length=3), ramp(6)
    packets = [simulator.step(frame) for frame in frames]
    first = means(frames)
    expected = [first[0:1], first[0:2], first[0:3], first[1:4], first[2:5]]
    assert simulator._network.seen == [pytest.approx(one) for one in expected]
    for before, frame, packet in zip(frames, frames[1:], packets[1:], strict=False):
        assert before.t_us <= packet.t.min() <= packet.t.max() < frame.t_us


def test_frames_are_scaled_as_in_training():
    # Mean 0.153 and standard deviation 0.165 of full scale.
    assert normalise(np.array([[0, 255]], np.uint8)) == pytest.approx(
        np.array([[-0.153 / 0.165, 0.847 / 0.165]]), rel=1e-6
    )


def test_the_frames_of_the_video_are_used_unless_asked_otherwise():
    for command in ("simulate", "generate"):
        assert resolve(command, {"simulator": "v2ce"}).interpolate.interpolate == "none"
        asked = resolve(command, {"simulator": "v2ce", "interpolate": "blend"})
        assert asked.interpolate.interpolate == "blend"
    assert resolve("simulate", {}).interpolate.interpolate == "flow"
    assert resolve("generate", {}).interpolate.interpolate == "motion"


def test_a_run_uses_whole_sequences(model, weights):
    frames = ramp(9)
    video = Video(np.stack([f.pixels for f in frames]), [f.t_us for f in frames])
    settings = resolve(
        "simulate", {"simulator": "v2ce", "weights": str(weights), "sequence_length": 4}
    )
    simulation = video_to_events(video, settings)
    expected = answers(model(sequence_length=4), frames)
    assert simulation.packets.collect().equals(expected.without_label())
    assert simulation.provenance["settings"]["simulate"]["weights"] == str(weights)
    sha256 = hashlib.sha256(weights.read_bytes()).hexdigest()
    assert simulation.provenance["weights"] == {
        "simulator": {"file": weights.name, "sha256": sha256}
    }
    found = texvent.simulate(video, simulator="v2ce", weights=weights, sequence_length=4)
    assert found.equals(expected.without_label())


def test_no_weights_is_one_clear_error_that_says_where_they_are():
    with pytest.raises(ConfigError, match=r"v2ce_3d\.pt.*V2CE-Toolbox.*weights=PATH"):
        V2ceSimulator()
