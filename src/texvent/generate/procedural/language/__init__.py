"""From the words of a prompt to what they mean: lexicon, tagging, readers."""
