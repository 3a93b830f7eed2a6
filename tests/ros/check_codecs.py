"""Compare the node's packets with the decoder of event_camera_codecs, by hand.

    python -m tests.ros.check_codecs PATH

PATH is a checkout of ros-event-camera/event_camera_codecs; its headers are compiled with g++,
without ROS. Every event must come out with its time.
"""

import subprocess
import sys
import tempfile
from pathlib import Path

import numpy as np
from texvent_ros.messages import PacketMaker

from texvent.events import EventStream
from texvent.sensor import SensorSize

SIZE = SensorSize(640, 480)
ROW = np.dtype([("t", "<u8"), ("x", "<u2"), ("y", "<u2"), ("p", "u1")])
RECORDINGS = ((5_000_000_000, 40_000_000), (90_000_000_000, 300_000), (0, 20_000_000))
"""First time in ROS, ns, and length, µs: turns of the counter, a gap, time that starts again."""


def main() -> int:
    """Write, decode and compare; returns the exit code."""
    headers = Path(sys.argv[1]) / "include"
    draw = np.random.default_rng(1)
    maker, packets, expected = PacketMaker(10_000), [], []
    for first_ns, length_us in RECORDINGS:
        maker.start(first_ns)
        t = np.sort(draw.integers(0, length_us, 100_000))
        x, y = draw.integers(0, SIZE.width, t.size), draw.integers(0, SIZE.height, t.size)
        events = EventStream.from_columns(x, y, t, draw.integers(0, 2, t.size), size=SIZE)
        packets += maker.messages(events, length_us, "camera")
        expected.append((events, first_ns))
    sent = np.array(SIZE, dtype="<u4").tobytes()
    sent += b"".join(len(one.payload).to_bytes(4, "little") + one.payload for one in packets)
    with tempfile.TemporaryDirectory() as folder:
        program = Path(folder) / "decode"
        source = Path(__file__).with_name("codecs_decoder.cpp")
        subprocess.run(
            ["g++", "-std=c++17", "-O1", "-I", headers, "-o", program, source], check=True
        )
        received = subprocess.run([program], input=sent, stdout=subprocess.PIPE, check=True).stdout
    rows = np.frombuffer(received, dtype=ROW)
    print(f"{len(packets)} packets, {len(rows)} events")  # noqa: T201
    start = place = 0
    for events, first_ns in expected:
        part = rows[start : start + len(events)]
        bases = []
        while len(bases) < len(events):
            packet, place = packets[place], place + 1
            count = _events_in(packet.payload)
            bases += [packet.time_base_ns] * count
        time_ns = part["t"] + np.array(bases, dtype=np.uint64)  # modulo 2^64
        assert (time_ns == first_ns + 1000 * events.t.astype(np.uint64)).all()
        assert all((part[name] == getattr(events, name)).all() for name in "xyp")
        start += len(events)
    assert start == len(rows)
    print("every event is the same")  # noqa: T201
    return 0


def _events_in(payload: bytes) -> int:
    return int((np.frombuffer(payload, "<u2") >> 12 == 2).sum())


if __name__ == "__main__":
    sys.exit(main())
