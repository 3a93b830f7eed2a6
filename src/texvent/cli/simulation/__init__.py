"""Commands that make events or prompts."""
