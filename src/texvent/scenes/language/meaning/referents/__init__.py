"""What noun groups mean: things, people, parts, crowds; what pronouns mean, whose they are."""
