"""Things that no other table has: of the table and the garden, of workshop, sport and science."""
