"""The table of text-to-video models, and where their files are."""
