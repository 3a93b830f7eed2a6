"""Untrained networks in the published layouts, a few channels wide, and files of them."""

import sys
from types import ModuleType

import numpy as np

from texvent.networks import shapes_of
from texvent_lab.registries import RECONSTRUCTORS

WIDTH, BINS, SIDE = 4, 5, 3
"""Instead of 16 or 32 channels; every name and relation of shapes stays."""

HEADS = {
    "firenet": "net.head.conv.conv2d.weight",
    "firenet+": "head.conv2d.weight",
    "e2vid": "unetrecurrent.head.conv2d.weight",
    "e2vid+": "unetrecurrent.head.conv2d.weight",
    "hypere2vid": "unetrecurrent.head.conv2d.weight",
    "et-net": "head.conv2d.weight",
    "e2depth": "unetrecurrent.head.conv2d.weight",
}


def network_class(name):
    return RECONSTRUCTORS.load(name).network


def small_shapes(name, *marks):
    """Names and shapes of a narrow network; marks are names that tell variants from each other."""
    encoders = [f"unetrecurrent.encoders.{number}.any" for number in range(3)]
    found = {
        HEADS[name]: (WIDTH, BINS, SIDE, SIDE),
        **dict.fromkeys((*encoders, *marks) if "unet" in HEADS[name] else (), (1,)),
    }
    return shapes_like(name, found)


def shapes_like(name, found):
    """Name → shape of the variant that a file with such tensors holds."""
    return shapes_of(network_class(name).like(found, {}).tensors)


def random_tensors(shapes, seed=0):
    """Name → float32 array of a network whose output is neither constant nor huge."""
    random = np.random.default_rng(seed)
    tensors = {}
    for name, shape in shapes.items():
        is_scale = len(shape) == 1 and name.endswith("weight")
        if is_scale or name.endswith("running_var"):
            values = random.uniform(0.5, 1.5, shape)
        elif len(shape) > 1:
            values = random.normal(0, 1.2 / np.sqrt(np.prod(shape[1:])), shape)
        else:
            values = random.normal(0, 0.1, shape)
        tensors[name] = values.astype(np.float32)
    return tensors


def random_state(torch, name):
    """Name → tensor of a narrow network, as its file holds them."""
    return {key: torch.from_numpy(one) for key, one in random_tensors(small_shapes(name)).items()}


def save_published(torch, name, path, *, settings=None, **more):
    """A training checkpoint as each program leaves it: the weights among much else."""
    state = random_state(torch, name)
    content = {"arch": name, "epoch": 3, "state_dict": state, "optimizer": {"lr": 1e-4}, **more}
    if name == "e2vid":
        content["model"] = settings or {}
    elif name in ("firenet", "e2depth"):
        content["config"] = {"model": settings or {}}
    elif settings is not None:
        content["config"] = config_parser({"arch": {"args": {"kwargs": settings}}})
    torch.save(content, path)
    return path


def config_parser(config):
    """An object of the class whose instances the training programs leave in their files."""
    module = ModuleType("parse_config")
    module.ConfigParser = type("ConfigParser", (), {"__module__": "parse_config"})
    sys.modules["parse_config"] = module
    parser = module.ConfigParser()
    parser._config = config
    return parser
