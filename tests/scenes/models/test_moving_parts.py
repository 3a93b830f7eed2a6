"""Parts that spin or swing: seen to move in a few stills, and at rest until they are struck."""

from __future__ import annotations

import numpy as np
import pytest

from texvent.scenes.models.machine_acts import STRUCK_SWING_S
from texvent.scenes.models.nouns import NOUNS
from texvent.scenes.models.protocol import Pose


def _build(noun: str):  # type: ignore[no-untyped-def]
    return NOUNS[noun].build(colour=None, scale=1.0, seed=3)


@pytest.mark.parametrize("step_s", [0.2, 0.4])
@pytest.mark.parametrize("pace", [0.5, 1.0, 1.7])
@pytest.mark.parametrize("noun", ["fan", "propeller", "pinwheel", "wind turbine", "windmill"])
def test_blades_stand_elsewhere_in_the_next_still(noun: str, pace: float, step_s: float) -> None:
    model = _build(noun)
    first, second = (
        np.array([part.to_body[:, 3] for part in model.parts(Pose(t, 0.0, 0.0))])
        for t in (0.0, pace * step_s)
    )
    # Each blade is apart from where any blade was, by some share of the whole.
    moved = np.linalg.norm(first - second, axis=1) > 1e-6
    apart = np.linalg.norm(second[moved][:, None] - first[moved][None], axis=2).min(axis=1)
    assert apart.max() > 0.02 * model.height


@pytest.mark.parametrize("noun", ["punching bag", "pinata"])
def test_what_hangs_rests_until_it_is_struck_and_swings_away(noun: str) -> None:
    model = _build(noun)

    def places(act_s: float | None) -> np.ndarray:
        pose = Pose(1.3, 0.0, 0.0, act_s=act_s)
        return np.array([part.to_body[:, 3] for part in model.parts(pose)])

    rest = places(None)
    assert np.allclose(places(0.0), rest)
    assert np.allclose(places(STRUCK_SWING_S), rest, atol=1e-9)
    away = places(0.5 * STRUCK_SWING_S) - rest
    assert away[:, 0].max() > 0.1
    assert away[:, 0].min() > -0.01
