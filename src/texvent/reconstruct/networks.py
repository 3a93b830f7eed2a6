"""The published networks, with the normalisations that belong to them.

Source of the normalisations and of the files: B. Ercan et al., "EVREAL: towards a comprehensive
benchmark and analysis suite for event-based video reconstruction", CVPRW 2023, and its project.
"""

from __future__ import annotations

from texvent.reconstruct.protocol import PublishedNetwork

EVREAL = "the project ercanburak/EVREAL on GitHub carries it as pretrained/{}/model.pth"

FIRENET = PublishedNetwork(
    name="firenet",
    network="texvent.reconstruct.firenet:FireNet",
    is_normalised=True,
    is_stretched=False,
    file_name="firenet.pth",
    where_from=EVREAL.format("FireNet"),
    sha256=("a64af3191a00e9f01cd47d086d9a88c35ff1e63756566ca44b4ff02301ca696e",),
)
FIRENET_PLUS = PublishedNetwork(
    name="firenet+",
    network="texvent.reconstruct.firenet:FireNetPlus",
    is_normalised=False,
    is_stretched=False,
    file_name="firenet+.pth",
    where_from=EVREAL.format("FireNet+"),
    sha256=("76122a81cf6313d84036509f388f150127482bcd977d46e8de650b7f841239f8",),
)
E2VID = PublishedNetwork(
    name="e2vid",
    network="texvent.reconstruct.recurrent_unet:E2vid",
    is_normalised=True,
    is_stretched=True,
    file_name="e2vid.pth",
    where_from=f"{EVREAL.format('E2VID')}, and uzh-rpg/rpg_e2vid links to it",
)
E2VID_PLUS = PublishedNetwork(
    name="e2vid+",
    network="texvent.reconstruct.recurrent_unet:E2vidPlus",
    is_normalised=False,
    is_stretched=False,
    file_name="e2vid+.pth",
    where_from=EVREAL.format("E2VID+"),
)
HYPER_E2VID = PublishedNetwork(
    name="hypere2vid",
    network="texvent.reconstruct.recurrent_unet:HyperE2vid",
    is_normalised=False,
    is_stretched=False,
    file_name="hypere2vid.pth",
    where_from=f"{EVREAL.format('HyperE2VID')}, and ercanburak/HyperE2VID links to it",
)
ET_NET = PublishedNetwork(
    name="et-net",
    network="texvent.reconstruct.et_net:EtNet",
    is_normalised=False,
    is_stretched=False,
    file_name="et-net.pth",
    where_from=f"{EVREAL.format('ET-Net')}, and WarranWeng/ET-Net links to it",
)
