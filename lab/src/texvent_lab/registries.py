"""Networks for images from events, and tasks that are trained, by name.

Packages outside add their own through entry points in the groups `texvent.reconstructors` and
`texvent.tasks`.
"""

from __future__ import annotations

from texvent.extending import Registry

RECONSTRUCTORS = Registry(
    "reconstructor",
    {
        "e2depth": "texvent_lab.reconstruct.e2depth:E2DEPTH",
        "e2vid": "texvent_lab.reconstruct.recurrent_unet:E2VID",
        "e2vid+": "texvent_lab.reconstruct.recurrent_unet:E2VID_PLUS",
        "et-net": "texvent_lab.reconstruct.et_net:ET_NET",
        "firenet": "texvent_lab.reconstruct.firenet:FIRENET",
        "firenet+": "texvent_lab.reconstruct.firenet:FIRENET_PLUS",
        "hypere2vid": "texvent_lab.reconstruct.hyper_e2vid:HYPER_E2VID",
        "pie-net": "texvent_lab.reconstruct.pie_net:PIE_NET",
    },
)
TASKS = Registry(
    "task",
    {
        "classification": "texvent_lab.train.classification.config:ClassificationConfig",
        "detection": "texvent_lab.bench.detection.config:DetectionConfig",
        "reconstruction": "texvent_lab.train.reconstruction.config:ReconstructionConfig",
    },
)
