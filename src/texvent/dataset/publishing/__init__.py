"""Publication of a data set: index, card and Croissant description."""
