"""N-ImageNet's ResNet as layers of torch, which name their tensors as torchvision's does."""

from collections.abc import Mapping
from typing import Any


def torch_resnet(tensors: Mapping[str, Any], blocks: tuple[int, ...]) -> Any:
    """A torch module with these tensors; it loads as strictly as N-ImageNet's program."""
    from torch import nn

    def convolution(before: int, after: int, side: int, stride: int, padding: int) -> nn.Conv2d:
        return nn.Conv2d(before, after, side, stride=stride, padding=padding, bias=False)

    class Block(nn.Module):
        def __init__(self, before: int, after: int, stride: int) -> None:
            super().__init__()
            self.conv1, self.bn1 = convolution(before, after, 3, stride, 1), nn.BatchNorm2d(after)
            self.conv2, self.bn2 = convolution(after, after, 3, 1, 1), nn.BatchNorm2d(after)
            self.downsample = nn.Sequential()
            if before != after:
                short = convolution(before, after, 1, stride, 0)
                self.downsample = nn.Sequential(short, nn.BatchNorm2d(after))

        def forward(self, x):
            inner = self.bn2(self.conv2(self.bn1(self.conv1(x)).relu()))
            return (inner + self.downsample(x)).relu()

    class ResNet(nn.Module):
        def __init__(self, channels: int, width: int, classes: int) -> None:
            super().__init__()
            self.conv1, self.bn1 = convolution(channels, width, 14, 2, 3), nn.BatchNorm2d(width)
            before = width
            for stage, count in enumerate(blocks):
                after = width * 2**stage
                layer = nn.Sequential()
                for number in range(count):
                    layer.append(Block(before, after, 2 if stage and not number else 1))
                    before = after
                self.add_module(f"layer{stage + 1}", layer)
            self.fc = nn.Linear(before, classes)

        def forward(self, x):
            x = nn.functional.max_pool2d(self.bn1(self.conv1(x)).relu(), 3, 2, 1)
            for stage in range(len(blocks)):
                x = getattr(self, f"layer{stage + 1}")(x)
            return self.fc(nn.functional.adaptive_avg_pool2d(x, 1).flatten(1))

    width, channels = tensors["conv1.weight"].shape[:2]
    network = ResNet(channels, width, len(tensors["fc.weight"]))
    network.load_state_dict({name: tensor.detach().clone() for name, tensor in tensors.items()})
    return network
