"""Options as dataclass fields: how one is declared, read from text and typed as a keyword."""
