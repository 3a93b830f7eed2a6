"""Models of toys, playgrounds and musical instruments."""
