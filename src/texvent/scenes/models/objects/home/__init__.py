"""Models of what is found in a home: screens, pictures, lamps, furniture, clothes."""
