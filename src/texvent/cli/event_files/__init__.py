"""Commands that read event files."""
