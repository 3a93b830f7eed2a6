"""Opening of video files whose texts are not UTF-8."""

from pathlib import Path

import av
import numpy as np
import pytest

from texvent.runtime.files.media_files import open_media


@pytest.mark.parametrize("ending", ["mp4", "avi", "mkv"])
def test_a_title_that_is_not_utf8_opens(tmp_path: Path, ending: str) -> None:
    path = tmp_path / f"clip.{ending}"
    with av.open(str(path), "w") as container:
        container.metadata["title"] = "Stra-e"
        stream = container.add_stream("mpeg4", rate=25)
        stream.width, stream.height = 64, 48
        frame = av.VideoFrame.from_ndarray(np.zeros((48, 64, 3), np.uint8), format="rgb24")
        container.mux([*stream.encode(frame), *stream.encode(None)])
    path.write_bytes(path.read_bytes().replace(b"Stra-e", b"Stra\xdfe"))
    with open_media(str(path)) as container:
        assert "title" in container.metadata
        assert len(list(container.decode(video=0))) == 1
