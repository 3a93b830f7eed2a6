"""Generation of a data set shard by shard, resumable at any moment."""
