"""What people do for sport, for their body, by craft and at the table: postures, things, words."""
