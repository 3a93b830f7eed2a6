"""How the page looks beside Gradio's own theme."""

FONTS = ("system-ui", "Segoe UI", "Roboto", "DejaVu Sans", "sans-serif")
"""Fonts of the visitor's own machine: none is fetched."""
CSS = """
.texvent-status { padding: 8px 12px; min-height: 24px; overflow-wrap: anywhere; }
.texvent-status progress { width: 12em; }
.texvent-status ul { margin: 4px 0 0 1.2em; font-size: .92em; }
#examples .caption-label { position: static; display: block; max-width: 100%; padding: 2px 6px;
  white-space: normal; font-size: .75rem; line-height: 1.25; text-align: left; }
#examples .thumbnail-lg { height: auto; aspect-ratio: auto; }
#examples .thumbnail-lg img { height: auto; aspect-ratio: 4 / 3; }
#examples .grid-wrap { max-height: none; }
#examples .grid-container {
  grid-template-columns: repeat(auto-fill, minmax(min(220px, 45%), 1fr)); }
input[role=combobox] { padding-right: 18px; text-overflow: ellipsis; }
.icon-wrap { right: 6px !important; }
.block:has(> .html-container > .prose:empty) { display: none; }
.texvent-hint p { font-size: .85rem; line-height: 1.35; }
#preview { display: block; width: 100%; max-height: 46vh; background: #fff; border-radius: 8px; }
.texvent-error { border-left: 4px solid #c62828; }
"""
