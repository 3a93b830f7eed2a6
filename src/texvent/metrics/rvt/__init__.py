"""EQS and LFS: similarity of the features of a detection network."""
