"""Prompts: files of them, captions of images, detailed versions."""
