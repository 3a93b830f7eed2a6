"""A stand-in for torch: tensors are arrays of NumPy, layers of networks are empty.

It is enough for all that is around a network: samples, batches, losses, scores, schedules and
files. A loss has no gradient of its own: a step moves every parameter along the losses so far, so
that weights tell what was seen, in which order, and at which rate. What networks compute, and
whether they learn, is held with torch.
"""

import contextlib
import pickle
import sys
import zipfile
from types import ModuleType, SimpleNamespace

import cv2
import numpy as np

CPU = SimpleNamespace(type="cpu")
MOMENTUM, EDGE = 0.5, cv2.BORDER_REPLICATE


class Tensor(np.ndarray):
    """An array with the methods of a tensor."""

    device, layout, data = CPU, "strided", property(lambda self: self)

    def __array_wrap__(self, array, context=None, return_scalar=False):
        return tensor(array)

    def __getitem__(self, key):
        return tensor(np.asarray(self)[np.asarray(key) if isinstance(key, Tensor) else key])

    def __iter__(self):
        return (self[place] for place in range(len(self)))

    def __deepcopy__(self, memo):
        return tensor(self.copy()).view(type(self))

    def view(self, *shape):
        is_shape = all(isinstance(one, int | tuple) for one in shape)
        return self.reshape(*shape) if is_shape else super().view(*shape)

    def to(self, what=None, **more):
        return self.astype(what) if isinstance(what, np.dtype | type) else self

    def detach(self):
        return np.asarray(self).view(Tensor)

    def flatten(self, first=0, last=-1):
        shape, last = self.shape, last % self.ndim
        return self.reshape(*shape[:first], -1, *shape[last + 1 :])

    def flip(self, *axes):
        return tensor(np.flip(np.asarray(self), axes))

    def gather(self, axis, places):
        return tensor(np.take_along_axis(np.asarray(self), np.asarray(places), axis))

    def chunk(self, count, dim=0):
        return list(map(tensor, np.array_split(np.asarray(self), count, dim)))

    def split(self, size, dim=0):
        return self.chunk(self.shape[dim] // size, dim)

    def backward(self):
        for one in Optimizer.moved:
            one.grad = one.grad + float(self)


def tensor(values, dtype=None, device=None):
    return np.asarray(values, dtype).view(Tensor)


def _along(name):
    """A function of NumPy over some axes, as a method of a tensor."""

    def method(self, dim=None, keepdim=False, axis=None, keepdims=False, **more):
        more = {key: one for key, one in more.items() if one is not None}
        options = {"axis": axis if dim is None else dim, **more}
        if keepdim or keepdims:
            options["keepdims"] = True
        return tensor(getattr(np, name)(np.asarray(self), **options))

    return method


def _plain(function, **usual):
    return lambda *values, **more: tensor(function(*map(np.asarray, values), **(usual | more)))


for _name in ("mean", "sum", "all", "any", "argmax"):
    setattr(Tensor, _name, _along(_name))
for _name, _function in {
    "abs": np.abs, "isnan": np.isnan, "isfinite": np.isfinite,
    "float": np.float32, "double": np.float64, "long": np.int64, "int": np.int32,
    "clone": np.array, "cpu": np.asarray, "numel": np.size, "is_complex": np.iscomplexobj,
    "nan_to_num": lambda one, nan: np.nan_to_num(one, nan=nan), "movedim": np.moveaxis,
    "clamp": lambda one, min=None, max=None: np.clip(one, min, max), "contiguous": np.asarray,
}.items():  # fmt: skip
    setattr(Tensor, _name, _plain(_function))
Tensor.numpy = lambda self: np.asarray(self)


class Parameter(Tensor):
    """A tensor that is trained."""

    grad = None

    def __new__(cls, values):
        return np.array(values, np.float32).view(cls)


class Module:
    """A network, or a layer that computes nothing."""

    def __init__(self, *_, **__):
        self.training = True

    def __call__(self, *values):
        return self.forward(*values)

    def state_dict(self, keep_vars=False):
        found = {}
        for name, one in vars(self).items():
            if isinstance(one, Module):
                found |= {f"{name}.{key}": own for key, own in one.state_dict(keep_vars).items()}
            elif isinstance(one, Tensor):
                found[name] = one if keep_vars else one.detach()  # the memory is the same
        return found

    def parameters(self):
        return list(self.state_dict(keep_vars=True).values())

    def load_state_dict(self, state, strict=True, assign=False):
        own = self.state_dict()
        if {name: one.shape for name, one in state.items()} != {n: o.shape for n, o in own.items()}:
            raise RuntimeError("other tensors")
        for name, one in state.items():
            own[name][...] = one

    def train(self, mode=True):
        self.training = mode
        return self

    def eval(self):
        return self.train(mode=False)

    def to(self, *_, **__):
        return self


class Optimizer:
    """Steps along the losses so far."""

    moved = ()

    def __init__(self, parameters, **options):
        self.param_groups = [{"params": list(parameters), **options}]
        self._moments = [np.zeros_like(one) for one in self.param_groups[0]["params"]]

    def zero_grad(self):
        Optimizer.moved = self.param_groups[0]["params"]
        for one in Optimizer.moved:
            one.grad = np.zeros(one.shape, np.float32)

    def step(self):
        (group,) = self.param_groups
        for place, one in enumerate(group["params"]):
            gradient = one.grad + group["weight_decay"] * np.asarray(one)
            self._moments[place] = MOMENTUM * self._moments[place] + gradient
            one[...] = one - group["lr"] * self._moments[place]

    def state_dict(self):
        groups = [{name: one for name, one in group.items() if name != "params"}
                  for group in self.param_groups]  # fmt: skip
        return {"state": [one.copy() for one in self._moments], "param_groups": groups}

    def load_state_dict(self, state):
        self._moments = [one.copy() for one in state["state"]]
        for own, one in zip(self.param_groups, state["param_groups"], strict=True):
            own.update(one)


def clip_grad_norm_(parameters, most):
    total = np.sqrt(sum(np.square(one.grad).sum() for one in parameters))
    for one in parameters:
        one.grad = one.grad * min(1.0, most / max(total, 1e-6))


def load_batches(dataset, *, sampler, batch_size, collate_fn, **_):
    for first in range(0, len(sampler), batch_size):
        yield collate_fn([dataset[one] for one in sampler[first : first + batch_size]])


def save(content, path):
    with zipfile.ZipFile(path, "w") as archive:
        archive.writestr("data.pkl", pickle.dumps(content))


def load(path, **_):
    with zipfile.ZipFile(path) as archive:
        return pickle.loads(archive.read("data.pkl"))


def cross_entropy(scores, classes, reduction="mean"):
    scores = np.asarray(scores, np.float64)
    chosen = np.take_along_axis(scores, np.asarray(classes)[:, None], 1)[:, 0]
    top = scores.max(axis=1)
    found = top + np.log(np.exp(scores - top[:, None]).sum(axis=1)) - chosen
    return tensor(found.mean() if reduction == "mean" else found)


def conv2d(images, kernel):
    """Of [n, 1, H, W] with one kernel; nothing is added around."""
    windows = np.lib.stride_tricks.sliding_window_view(np.asarray(images), kernel.shape[2:], (2, 3))
    return tensor((windows * np.asarray(kernel)[0, 0]).sum(axis=(-2, -1)))


def grid_sample(images, grid, padding_mode, align_corners):
    """Values between pixels, at places from −1 to 1, x first; the edge goes on."""
    assert (padding_mode, align_corners) == ("border", True)
    sides = np.array(images.shape[:1:-1]) - 1
    places = np.clip((np.asarray(grid) + 1) / 2, 0, 1) * sides
    x, y = np.moveaxis(places.astype(np.float32), -1, 0)
    found = [
        [cv2.remap(np.asarray(one), *at, cv2.INTER_LINEAR, None, EDGE) for one in image]
        for image, *at in zip(images, x, y, strict=True)
    ]  # exact at places of 1/32 pixel
    return tensor(np.array(found))


def _layer(name):
    if name.startswith("_"):
        raise AttributeError(name)
    return type(name, (Module,), {})


def _module(name, /, **parts):
    found = ModuleType(name)
    vars(found).update(parts)
    return found


def modules():
    """Name → module, as they are imported."""

    def without(*_, **__):
        return contextlib.nullcontext()

    def pad(image, margins, value=0):
        sides = [(0, 0)] * (image.ndim - len(margins) // 2)
        return tensor(np.pad(image, [*sides, *zip(margins[-2::-2], margins[::-2], strict=True)]))

    functional = _module(
        "functional", cross_entropy=cross_entropy, conv2d=conv2d, grid_sample=grid_sample, pad=pad
    )
    utils = SimpleNamespace(clip_grad_norm_=clip_grad_norm_)
    nn = _module("torch.nn", Module=Module, Parameter=Parameter, functional=functional, utils=utils)
    nn.__getattr__ = _layer
    data = _module(
        "torch.utils.data", Dataset=object, IterableDataset=object, DataLoader=load_batches,
        default_collate=lambda values: tensor(np.stack(values)), get_worker_info=lambda: None,
    )  # fmt: skip
    stated = {name: np.dtype(name) for name in ("uint8", "int8", "int64", "float32", "bool")}
    torch = _module(
        "torch", Tensor=Tensor, nn=nn, tensor=tensor, as_tensor=tensor, from_numpy=tensor,
        strided="strided", bfloat16="bfloat16", __version__="arrays", save=save, load=load,
        optim=SimpleNamespace(
            Adam=type("Adam", (Optimizer,), {}), AdamW=type("AdamW", (Optimizer,), {})
        ), device=lambda name: CPU,
        cuda=SimpleNamespace(is_available=lambda: False), autocast=without, no_grad=without,
        inference_mode=without, manual_seed=lambda seed: None, set_num_threads=lambda count: None,
        random=SimpleNamespace(fork_rng=without),
        distributed=SimpleNamespace(is_available=lambda: False),
        serialization=SimpleNamespace(safe_globals=without),
        arange=lambda count, device=None: tensor(np.arange(count)),
        zeros=lambda *shape, dtype=np.float32, device=None: tensor(np.zeros(shape, dtype)),
        cat=lambda parts, dim=0: tensor(np.concatenate(parts, dim)),
        stack=lambda parts, dim=0: tensor(np.stack(parts, dim)),
        meshgrid=lambda *axes, indexing: list(map(tensor, np.meshgrid(*axes, indexing=indexing))),
        exp=_plain(np.exp), isnan=_plain(np.isnan), **stated,
    )  # fmt: skip
    return {one.__name__: one for one in (torch, nn, data)} | {"torch.nn.functional": functional}


def forget(before):
    """Let modules go that were imported since, and hold a part of this one, or of such a module."""
    new = {name: one for name, one in sys.modules.items() if name not in before}
    parts = {
        name: {str(getattr(part, "__module__", getattr(part, "__name__", None)))
               for part in [*vars(one).values()]}
        for name, one in new.items() if name.startswith("texvent")
    }  # fmt: skip
    gone, known = {*modules(), __name__}, 0
    while known < len(gone):
        known = len(gone)
        gone |= {name for name, held in parts.items() if not gone.isdisjoint(held)}
    for name in gone - {__name__}:
        one = sys.modules.pop(name, None)
        parent, _, inner = name.rpartition(".")
        if one is not None and vars(sys.modules.get(parent, one)).get(inner) is one:
            delattr(sys.modules[parent], inner)
