"""Published networks that texvent finds by entry points: a simulator and an interpolator."""
