"""Where things stand: groups of copies, relations and free places."""
