"""Super SloMo: intermediate frames by a published network."""
