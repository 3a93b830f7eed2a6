"""A sentence becomes a description: words, tags, links."""
