"""Depth from events: E2Depth trained with exact depth, and scored."""
