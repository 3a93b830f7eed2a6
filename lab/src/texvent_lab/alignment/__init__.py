"""Scores of the fit between the events of a data set and the texts they were made from."""
