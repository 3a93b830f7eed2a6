"""`--preview`: stills of a scene instead of events."""

from pathlib import Path

import cv2
import numpy as np

from texvent.cli.app import main


def test_a_preview_shows_the_scene_and_says_what_is_shown_and_nothing_more(folder, capsys):
    words = ["generate", "a wug and a red ball bounce", "--sensor", "64x48", "--duration", "0.5"]
    assert main([*words, "--preview", "scene.png"]) == 0
    said = capsys.readouterr()
    assert said.out == "scene.png\n"
    assert 'scene    objects: noun = "ball", colour = "red"' in said.err
    assert "warning  prompt words not understood: wug" in said.err
    assert [path.name for path in Path().iterdir()] == ["scene.png"]
    image = cv2.imread("scene.png")
    assert image.shape == (48, 3 * 64 + 2 * 4, 3)
    assert not np.array_equal(image[:, :64], image[:, 68:132])
    assert main([*words, "--preview", "scene.png"]) == 3  # exists already
