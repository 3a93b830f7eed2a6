"""What a data set is made of: a file, or a Python object, that decides every sample."""
