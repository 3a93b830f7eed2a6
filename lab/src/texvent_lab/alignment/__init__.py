"""How well the events of a data set fit the texts they were made from, as a number."""
