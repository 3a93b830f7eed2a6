"""Models of one's own: folders of GLB, OBJ and PLY files as nouns."""
