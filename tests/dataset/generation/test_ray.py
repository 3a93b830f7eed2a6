"""A Ray cluster makes the bytes of one process, whatever it loses; an unfit node is named."""

import os
import socket
from collections.abc import Iterator
from contextlib import closing, contextmanager
from pathlib import Path
from typing import Any

import pytest
from tests.dataset.generation.small_sets import clips_recipe, digests, make

import texvent
from texvent.dataset.generation.make import ShardTask, find_work, remove_dead_parts
from texvent.dataset.generation.ray_cluster import RayEngine
from texvent.dataset.generation.recipe import Recipe, Shard
from texvent.errors import ConfigError, MissingDependencyError, OutputError
from texvent.runtime.work.engines import Work

pytestmark = pytest.mark.dataset
pytest.importorskip("ray")

SOON = {"health_check_period_ms": 1000, "health_check_failure_threshold": 4}
"""A lost node is noticed in seconds."""
NODE = {"object_store_memory": 100 * 2**20, "num_gpus": 0}


@pytest.fixture(scope="module")
def cluster(tmp_path_factory: pytest.TempPathFactory) -> Iterator[Any]:
    """A head that makes shards of events, one at a time."""
    with pytest.MonkeyPatch.context() as patch:
        patch.setenv("RAY_USAGE_STATS_ENABLED", "0")
        patch.setenv("RAY_AUTH_MODE", "disabled")
        from ray.cluster_utils import Cluster

        nodes = Cluster(
            initialize_head=True, head_node_args={**NODE, "num_cpus": 1, "_system_config": SOON}
        )
        yield nodes
        nodes.shutdown()


@contextmanager
def no_cpu_of_the_head(cluster: Any) -> Iterator[None]:
    """Keep the head's CPU busy, so that work goes to the other nodes; needs a connection."""
    import ray
    from ray.util.scheduling_strategies import NodeAffinitySchedulingStrategy

    class Occupant:
        def is_there(self) -> bool:
            return True

    here = NodeAffinitySchedulingStrategy(cluster.head_node.node_id, soft=False)
    occupant = ray.remote(num_cpus=1, scheduling_strategy=here)(Occupant).remote()
    assert ray.get(occupant.is_there.remote())
    yield
    ray.kill(occupant)


def video_recipe(folder: Path, videos: int) -> Recipe:
    """Shards of one video each, which are stored before they are simulated."""
    return clips_recipe(
        folder,
        clips=0,
        sources=[{"prompts": ["a red car drives left"]}],
        options={"duration": 0.05, "sensor": "16x12"},
        repeats=videos,
        samples_per_shard=1,
        store_videos=True,
    )


def test_a_node_without_the_folder_is_named(cluster: Any, tmp_path: Path) -> None:
    with closing(RayEngine(cluster.address)) as engine:
        engine.submit(ShardTask(tmp_path / "elsewhere", (Shard("paper", "train", 0),)))
        with pytest.raises(OutputError, match="elsewhere is not here; all workers need") as found:
            engine.next()
        (tmp_path / "local").mkdir()
        engine.submit(ShardTask(tmp_path / "local", (Shard("paper", "train", 0),)))
        with pytest.raises(ConfigError, match="holds no data set of texvent"):
            engine.next()
    assert str(found.value).startswith(f"node {socket.gethostname()}: ")


ABSENT = "import sys\nsys.modules['texvent'] = None\n"
OTHER_NUMBA = """
from importlib import metadata
of = metadata.version
metadata.version = lambda name: "0.1" if name == "numba" else of(name)
"""


@pytest.mark.parametrize(
    ("startup", "message"),
    [
        (ABSENT, r"node \S+ has no texvent \d.*; install it on every node"),
        (OTHER_NUMBA, r"node \S+ has numba 0\.1, and this machine \d.*install the same"),
    ],
    ids=["absent", "other numba"],
)
def test_a_node_without_texvent_or_with_other_packages_ends_the_run_in_one_line(
    cluster: Any, tmp_path: Path, startup: str, message: str
) -> None:
    (tmp_path / "site").mkdir()
    (tmp_path / "site" / "sitecustomize.py").write_text(startup)
    places = [str(tmp_path / "site"), str(Path(texvent.__file__).parents[1])]
    recipe, folder = clips_recipe(tmp_path), tmp_path / "out"
    recipe.begin(folder)
    node = cluster.add_node(**NODE, num_cpus=8, env_vars={"PYTHONPATH": os.pathsep.join(places)})
    try:
        with (
            closing(RayEngine(cluster.address)) as engine,
            no_cpu_of_the_head(cluster),
            pytest.raises(MissingDependencyError, match=message) as found,
        ):
            list(find_work(recipe, folder).make(engine))
    finally:
        cluster.remove_node(node, allow_graceful=False)
    assert "\n" not in str(found.value)
    assert not list(folder.rglob(".texvent-*"))


def test_a_cluster_that_is_not_there() -> None:
    with pytest.raises(ConfigError, match=r"cannot use the Ray cluster 'nowhere'") as found:
        RayEngine("nowhere")
    assert "\n" not in str(found.value)
    with pytest.raises(ConfigError, match=r"no Ray cluster answers at '127\.0\.0\.1:1' \("):
        RayEngine("127.0.0.1:1")


def make_losing(cluster: Any, node: Any, recipe: Recipe, folder: Path) -> tuple[Work, int]:
    """Make a data set and lose a node after the first shard: what was done, in how many shards."""
    recipe.begin(folder)
    work, seen = find_work(recipe, folder), 0
    with closing(RayEngine(cluster.address)) as engine:
        for seen, _ in enumerate(work.make(engine), start=1):
            if seen == 1:
                cluster.remove_node(node, allow_graceful=False)
    remove_dead_parts(recipe, folder)
    assert not work.failures
    return work, seen


def test_a_node_that_is_lost_changes_no_byte(cluster: Any, tmp_path: Path) -> None:
    recipe, folder = clips_recipe(tmp_path), tmp_path / "out"
    make(recipe, tmp_path / "wanted")
    second = cluster.add_node(**NODE, num_cpus=1)
    work, seen = make_losing(cluster, second, recipe, folder)
    assert seen == len(work.complete) == 6
    assert sum(counts.total() for counts in work.complete.values()) == 24
    assert digests(folder) == digests(tmp_path / "wanted")
    assert not list(folder.rglob(".texvent-*"))


def test_videos_have_a_gpu_each_and_outlive_its_node(cluster: Any, tmp_path: Path) -> None:
    # GPUs that Ray counts; nothing looks for the device.
    recipe, folder = video_recipe(tmp_path, 5), tmp_path / "out"
    make(recipe, tmp_path / "wanted")
    nodes = [cluster.add_node(**{**NODE, "num_gpus": 1}, num_cpus=1) for _ in range(2)]
    make_losing(cluster, nodes[-1], recipe, folder)
    assert digests(folder) == digests(tmp_path / "wanted")
    assert len(digests(folder)) == 15
