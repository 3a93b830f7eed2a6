"""What a clause says besides subject, verb and object: where, which way, how fast, when."""
