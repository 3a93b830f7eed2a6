"""A data set that was made: what its folder holds, checked, counted, put together."""
