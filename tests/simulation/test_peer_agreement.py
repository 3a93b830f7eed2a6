"""Our versions of published models against the event streams their original programs made.

The streams lie beside the checkout, not in it (`../shared/peers`, read there what made them).
"""

import dataclasses
import math
from pathlib import Path

import numpy as np
import pytest

from texvent.events import EventStream
from texvent.frames import Frame
from texvent.simulation.esim.simulator import EsimSimulator
from texvent.simulation.senpi.simulator import SenpiSimulator
from texvent.simulation.v2e.simulator import V2eSimulator
from texvent.simulation.voltmeter.simulator import VoltmeterSimulator

from .pixel_frames import moving_texture

PEERS = Path(__file__).parents[2].parent / "shared" / "peers"
MISSING = f"no event streams of the original programs in {PEERS.parent.name}/{PEERS.name}"
needs_peers = pytest.mark.skipif(not PEERS.is_dir(), reason=MISSING)
LAST_PAIRS = 3


@pytest.fixture(scope="module")
def clip() -> list[Frame]:
    with np.load(PEERS / "clip_346x260_frames.npz") as stored:
        pairs = zip(stored["gray"], stored["t_us"], strict=True)
        return [Frame(pixels, int(t)) for pixels, t in pairs]


def load_peer(name: str) -> dict[str, np.ndarray]:
    with np.load(PEERS / f"{name}.npz") as stored:
        return {column: stored[column] for column in "xytp"}


def packets_of(simulator_class, preset: str, clip: list[Frame], seed: int = 0) -> list[EventStream]:
    simulator = simulator_class(simulator_class.presets[preset], seed=seed)
    return [simulator.step(frame) for frame in clip]


def count_map(events, shape=(260, 346)) -> np.ndarray:
    """Events per polarity and pixel, [2, H, W]."""
    counts = np.zeros((2, *shape), np.int64)
    np.add.at(counts, (events["p"], events["y"], events["x"]), 1)
    return counts


def mismatch(ours: np.ndarray, theirs: np.ndarray) -> float:
    """Events too many or too few, per pixel and polarity, as a share of theirs."""
    return float(np.abs(ours - theirs).sum() / theirs.sum())


def pair_of(events: dict[str, np.ndarray], start_us: int, stop_us: int) -> dict[str, np.ndarray]:
    """Events with `start_us < t <= stop_us`: the originals stamp some at the later frame."""
    inside = (events["t"] > start_us) & (events["t"] <= stop_us)
    return {name: column[inside] for name, column in events.items()}


def pair_mismatches(packets, theirs, edges_us) -> list[float]:
    """Mismatch in each of the last three pairs."""
    return [
        mismatch(
            count_map(packets[i + 1].columns()),
            count_map(pair_of(theirs, edges_us[i], edges_us[i + 1])),
        )
        for i in range(len(packets) - 1 - LAST_PAIRS, len(packets) - 1)
    ]


def brightness_of(name: str, intensity: int) -> float:
    """What each original compares, for one 8-bit pixel."""
    if name == "esim":
        return math.log(intensity / 255 + 1e-3)
    if name == "senpi":
        return math.log(max(intensity, 1) / 255 * 15_000)
    return intensity * math.log(20) / 20 if intensity <= 20 else math.log(intensity)


def events_by_hand(name: str, levels: list[int]) -> list[tuple[int, int]]:
    """(number of the frame, polarity) of one pixel's events, by the published rule."""
    reference, events = brightness_of(name, levels[0]), []
    for number, level in enumerate(levels[1:], 1):
        change = brightness_of(name, level) - reference
        count = int(abs(change) / 0.2)
        is_on = change > 0
        if name == "senpi":
            count = min(count, 1)
            reference += count * change
        else:
            reference += count * 0.2 * (1 if is_on else -1)
        events += [(number, int(is_on))] * count
    return events


@pytest.mark.parametrize("name", ["esim", "v2e", "senpi"])
def test_the_published_rules_by_hand_on_our_own_frames(name):
    model = {"esim": EsimSimulator, "v2e": V2eSimulator, "senpi": SenpiSimulator}[name]
    frames = moving_texture(8, (10, 12))
    packets = packets_of(model, "peer-common", frames)
    ours = [count_map(packet.columns(), (10, 12)) for packet in packets]
    total = 0
    for y, x in np.ndindex(10, 12):
        expected = np.zeros((8, 2), int)
        for number, p in events_by_hand(name, [int(frame.pixels[y, x]) for frame in frames]):
            expected[number, p] += 1
        assert [counts[:, y, x].tolist() for counts in ours] == expected.tolist()
        total += int(expected.sum())
    assert total > 300


@needs_peers
@pytest.mark.parametrize(
    ("model", "name"), [(EsimSimulator, "esim_py_common"), (V2eSimulator, "v2e_common")]
)
def test_counts_agree_to_99_percent(clip, model, name):
    edges = [frame.t_us for frame in clip]
    # The last stamps of esim_py run 20 µs past the last frame.
    edges[-1] += 100
    packets = packets_of(model, "peer-common", clip)
    assert max(pair_mismatches(packets, load_peer(name), edges)) < 0.005


@needs_peers
def test_esim_agrees_in_crossing_times_after_its_defective_first_pair(clip):
    ours, theirs = matched_times(clip, load_peer("esim_py_common"))
    late = ours[1] >= clip[1].t_us
    assert late.sum() > 700_000
    assert np.mean(np.abs(ours[1][late] - theirs[1][late]) <= 1) > 0.999


def matched_times(clip, theirs) -> list[tuple[np.ndarray, np.ndarray]]:
    """(place, time) of our and their ESIM events, where both have equally many at a place.

    A place is a pixel and polarity; rows of both are ordered by place, then time.
    """
    ours = EventStream.concat(packets_of(EsimSimulator, "peer-common", clip)).columns()
    rows = []
    for events in (ours, theirs):
        place = (events["y"].astype(np.int64) * 346 + events["x"]) * 2 + events["p"]
        order = np.lexsort((events["t"], place))
        rows.append((place[order], events["t"][order]))
    counts = [np.bincount(place, minlength=260 * 346 * 2) for place, _ in rows]
    is_equal = counts[0] == counts[1]
    return [(place[is_equal[place]], time[is_equal[place]]) for place, time in rows]


@needs_peers
@pytest.mark.parametrize(("preset", "name"), [("default", "v2e_default"), ("noisy", "v2e_noisy")])
def test_v2e_with_noise_agrees_in_rate_and_polarity(clip, preset, name):
    # Other random thresholds and noise: single pixels cannot agree, distributions must.
    theirs = load_peer(name)
    packets = packets_of(V2eSimulator, preset, clip)
    for i in range(1, len(clip)):
        original = pair_of(theirs, clip[i - 1].t_us, clip[i].t_us)
        assert len(packets[i]) == pytest.approx(len(original["t"]), rel=0.02)
        assert packets[i].p.mean() == pytest.approx(original["p"].mean(), abs=0.01)


@needs_peers
@pytest.mark.parametrize(
    ("preset", "name", "most"),
    [("peer-common", "senpi_common", 0.0), ("default", "senpi_default", 0.06)],
)
def test_senpi_agrees_in_every_event_and_with_noise_in_rate_and_polarity(clip, preset, name, most):
    # Its clock runs in steps of 41,667 µs, and its events carry the time of the later frame.
    theirs, packets = load_peer(name), packets_of(SenpiSimulator, preset, clip)
    # Its first frame fires every pixel, so references differ until they have moved on.
    for i in range(2, len(clip)):
        original = pair_of(theirs, i * 41_667 - 1, i * 41_667)
        assert len(packets[i]) == pytest.approx(len(original["t"]), rel=most)
        assert packets[i].p.mean() == pytest.approx(original["p"].mean(), abs=0.2 * most + 1e-9)
        if not most:
            assert np.array_equal(count_map(packets[i].columns()), count_map(original))
            assert (packets[i].t == clip[i].t_us - 1).all()


@needs_peers
@pytest.mark.parametrize(
    ("preset", "name"), [("peer-common", "dvsv_default"), ("davis240", "dvsv_dvs240")]
)
def test_voltmeter_agrees_in_its_distributions(clip, preset, name):
    theirs = load_peer(name)
    config = dataclasses.replace(VoltmeterSimulator.presets[preset], initial_phase="zero")
    simulator = VoltmeterSimulator(config, seed=1)
    ours = EventStream.concat([simulator.step(frame) for frame in clip]).columns()
    assert len(ours["t"]) == pytest.approx(len(theirs["t"]), rel=0.002)
    level = np.mean([frame.pixels for frame in clip], axis=0).astype(int) // 32
    for events, other in zip(
        rates_by_level(ours, level), rates_by_level(theirs, level), strict=True
    ):
        assert events == pytest.approx(other, rel=0.005)
    shares = [intervals_us(events) for events in (ours, theirs)]
    percentiles = np.percentile(shares[1], [5, 10, 25, 50, 75, 90, 95])
    assert np.percentile(shares[0], [5, 10, 25, 50, 75, 90, 95]) == pytest.approx(
        percentiles, rel=0.01
    )


def rates_by_level(events, level) -> tuple[np.ndarray, np.ndarray]:
    """Events per pixel, and the share of ON among them, by the pixels' mean intensity."""
    of_event = level[events["y"], events["x"]]
    counts = np.bincount(of_event, minlength=8)
    on = np.bincount(of_event, weights=events["p"], minlength=8)
    return counts / np.bincount(level.reshape(-1), minlength=8), on / counts


def intervals_us(events) -> np.ndarray:
    """Times between events of the same pixel and polarity, µs."""
    place = (events["y"].astype(np.int64) * 346 + events["x"]) * 2 + events["p"]
    order = np.lexsort((events["t"], place))
    return np.diff(events["t"][order])[np.diff(place[order]) == 0]
