"""What makes a folder of shards a published data set: an index, a card, a description."""
