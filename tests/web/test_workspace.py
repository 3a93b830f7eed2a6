from __future__ import annotations

import os
import time

from texvent.web.workspace import Workspace


def test_results_are_given_to_their_own_session_alone() -> None:
    with Workspace() as workspace:
        folder = workspace.new_folder("anna")
        (folder / "events.h5").write_bytes(b"x")
        assert workspace.result("anna", folder.name, "events.h5") == folder / "events.h5"
        for owner, job, name in (
            ("bert", folder.name, "events.h5"),
            (None, folder.name, "events.h5"),
            ("anna", folder.name, "other.h5"),
            ("anna", folder.name, "../uploads"),
            ("anna", "uploads", "events.h5"),
        ):
            assert workspace.result(owner, job, name) is None


def test_broken_off_and_old_uploads_make_room() -> None:
    with Workspace() as workspace:
        now = time.time()
        part, fresh = workspace.uploads / "tmpold", workspace.uploads / "tmpnew"
        complete = [workspace.uploads / str(age) / "clip.mp4" for age in range(12)]
        for path in (part, fresh, *complete):
            path.parent.mkdir(exist_ok=True)
            path.write_bytes(bytes(100))
        os.utime(part, (now - 500, now - 500))
        for age, path in enumerate(complete):
            os.utime(path, (now - 100 - age, now - 100 - age))
        workspace.make_room(100)
        assert not part.exists()
        assert fresh.exists()
        assert [path.exists() for path in complete] == [True] * 8 + [False] * 4
