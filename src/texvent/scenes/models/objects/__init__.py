"""Models of buildings, plants, furniture, toys and street furniture."""
