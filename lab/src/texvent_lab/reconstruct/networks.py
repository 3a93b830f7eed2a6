"""The published networks, with the normalisations that belong to them.

Source of the normalisations and of the files: B. Ercan et al., "EVREAL: towards a comprehensive
benchmark and analysis suite for event-based video reconstruction", CVPRW 2023, and its project.
"""

from __future__ import annotations

from texvent_lab.reconstruct.firenet import FireNet, FireNetPlus
from texvent_lab.reconstruct.recurrent_network import PublishedNetwork
from texvent_lab.reconstruct.recurrent_unet import E2vid, E2vidPlus

EVREAL = "the project ercanburak/EVREAL on GitHub carries it as pretrained/{}/model.pth"
FIRENET = PublishedNetwork("firenet", FireNet, EVREAL.format("FireNet"), is_normalised=True)
FIRENET_PLUS = PublishedNetwork("firenet+", FireNetPlus, EVREAL.format("FireNet+"))
E2VID = PublishedNetwork(
    "e2vid",
    E2vid,
    f"{EVREAL.format('E2VID')}, and uzh-rpg/rpg_e2vid links to it",
    is_normalised=True,
    is_stretched=True,
)
E2VID_PLUS = PublishedNetwork("e2vid+", E2vidPlus, EVREAL.format("E2VID+"))
