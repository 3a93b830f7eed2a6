"""A data set that was made, read for training: by number, in any order, from any process."""
