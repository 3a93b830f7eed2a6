"""Recurrent networks over whole sequences, and compiled."""

import pytest

from texvent_lab.registries import RECONSTRUCTORS

torch = pytest.importorskip("torch", reason="make test-torch runs the tests that need torch")

from texvent_lab.train.reconstruction.task import new_network  # noqa: E402

pytestmark = pytest.mark.torch


def voxels(count: int = 2) -> torch.Tensor:
    return torch.randn(2, count, 5, 16, 16, generator=torch.Generator().manual_seed(0))


@pytest.mark.parametrize("name", ["firenet", "e2vid+"])
def test_the_state_is_carried_from_window_to_window(name: str) -> None:
    published = RECONSTRUCTORS.load(name)
    network, grids = new_network(published, 0), voxels(3)
    with torch.no_grad():
        images = network(grids)
        one_by_one = published.network.from_tensors(network.tensors, {})
        expected = [one_by_one.step(grids[:, place]) for place in range(3)]
        torch.testing.assert_close(images, torch.stack(expected, dim=1))
        assert not torch.equal(network(grids[:, 1:])[:, 0], images[:, 1])


def test_gradients_reach_all_parameters_through_time() -> None:
    network, grids = new_network(RECONSTRUCTORS.load("e2vid+"), 0), voxels(3).requires_grad_()
    network(grids)[:, -1].sum().backward()
    assert grids.grad[:, 0].any()
    assert all(one.grad.any() for one in network.parameters())
