"""Networks for images from events, and tasks that are trained, by name.

Packages outside add their own through entry points in the groups `texvent.reconstructors` and
`texvent.tasks`.
"""

from __future__ import annotations

from texvent.extending import Registry

RECONSTRUCTORS = Registry(
    "reconstructor",
    {
        "e2vid": "texvent_lab.reconstruct.networks:E2VID",
        "e2vid+": "texvent_lab.reconstruct.networks:E2VID_PLUS",
        "firenet": "texvent_lab.reconstruct.networks:FIRENET",
        "firenet+": "texvent_lab.reconstruct.networks:FIRENET_PLUS",
        "hypere2vid": "texvent_lab.reconstruct.networks:HYPER_E2VID",
        "et-net": "texvent_lab.reconstruct.networks:ET_NET",
    },
)
TASKS = Registry(
    "task",
    {
        "classification": "texvent_lab.train.classification.config:ClassificationConfig",
        "depth": "texvent_lab.train.depth:DepthConfig",
        "detection": "texvent_lab.bench.detection.config:DetectionConfig",
        "flow": "texvent_lab.train.flow:FlowConfig",
        "reconstruction": "texvent_lab.train.reconstruction.config:ReconstructionConfig",
    },
)
