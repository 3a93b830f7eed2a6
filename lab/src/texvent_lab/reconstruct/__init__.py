"""Images from events alone, by published recurrent networks."""
