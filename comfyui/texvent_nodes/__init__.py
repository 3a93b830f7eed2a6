"""Nodes of texvent for ComfyUI: images, videos and prompts become events of an event camera.

ComfyUI loads this folder from `custom_nodes` and reads the two tables below (its V1 interface,
which every version has).
"""

from .event_nodes import TexventImagesToEvents, TexventPromptToEvents, TexventVideoToEvents
from .model_nodes import model_nodes
from .output_nodes import TexventPreviewEvents, TexventSaveEvents

NODES = (
    TexventImagesToEvents,
    TexventVideoToEvents,
    TexventPromptToEvents,
    *model_nodes(),
    TexventPreviewEvents,
    TexventSaveEvents,
)

NODE_CLASS_MAPPINGS = {node.__name__: node for node in NODES}
NODE_DISPLAY_NAME_MAPPINGS = {node.__name__: node.TITLE for node in NODES}

__all__ = ["NODE_CLASS_MAPPINGS", "NODE_DISPLAY_NAME_MAPPINGS"]
