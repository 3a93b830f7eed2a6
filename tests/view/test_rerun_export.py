"""The .rrd file, read back by rerun itself."""

from __future__ import annotations

import sys
from pathlib import Path

import numpy as np
import pytest

from texvent.errors import InputError, MissingDependencyError
from texvent.events import EventStream
from texvent.sensor import SensorSize
from texvent.video import Video
from texvent.view.render import RenderConfig, render_events

SIZE = SensorSize(32, 24)


def recording() -> EventStream:
    step = np.arange(600)
    return EventStream(step % 32, step % 24, 5_000 + step * 500, step // 2 % 2, SIZE)


def test_without_rerun_the_extra_is_named_and_nothing_is_written(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setitem(sys.modules, "rerun", None)
    with pytest.raises(MissingDependencyError, match=r"pip install 'texvent\[rerun\]'"):
        render_events(recording(), tmp_path / "out.rrd")
    assert not list(tmp_path.iterdir())


@pytest.mark.app
class TestWithRerun:
    """Needs the extra."""

    @pytest.fixture(autouse=True)
    def rerun(self):
        return pytest.importorskip("rerun", reason="rerun-sdk is an extra; make test-app")

    def columns(self, path: Path, entity: str) -> dict[str, list]:
        """Component → values of an entity, in time order."""
        from rerun.chunk import RrdReader

        found: dict[str, list] = {}
        for chunk in RrdReader(path).stream():
            if chunk.entity_path == entity:
                batch = chunk.to_record_batch()
                for name in batch.schema.names:
                    found.setdefault(name, []).extend(batch.column(name).to_pylist())
        return found

    def test_every_event_and_frame_is_in_the_file(self, tmp_path: Path) -> None:
        video = Video(np.full((3, *SIZE.shape), 90, dtype=np.uint8), [0, 100_000, 200_000])
        path = render_events(
            recording(), tmp_path / "out.rrd", frames=video, config=RenderConfig(window=10.0)
        )
        points = self.columns(path, "/plane/events")
        places = next(value for name, value in points.items() if name.endswith("positions"))
        together = np.concatenate([np.array(one).reshape(-1, 2) for one in places])
        events = recording()
        np.testing.assert_array_equal(
            together, np.stack([events.x, events.y], axis=1) + np.float32(0.5)
        )
        assert len(next(iter(self.columns(path, "/plane/video").values()))) == 3

    def test_the_cloud_is_thinned_to_the_points_asked_for(self, tmp_path: Path) -> None:
        path = render_events(recording(), tmp_path / "out.rrd", config=RenderConfig(points=100))
        cloud = self.columns(path, "/cloud")
        places = next(value for name, value in cloud.items() if name.endswith("positions"))
        assert len(places[0]) == 100

    def test_no_events_are_an_input_error_and_leave_nothing(self, tmp_path: Path) -> None:
        with pytest.raises(InputError, match="holds no events"):
            render_events(EventStream.empty(SIZE), tmp_path / "out.rrd")
        assert not list(tmp_path.iterdir())
