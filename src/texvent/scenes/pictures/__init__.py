"""Pictures that surfaces show: files, checkerboards and text."""

from texvent.scenes.pictures.checking import can_show, check_picture
from texvent.scenes.pictures.source import PicturedModel, load_picture

__all__ = ["PicturedModel", "can_show", "check_picture", "load_picture"]
