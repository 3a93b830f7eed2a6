"""A data set made shard by shard, resumable at any moment."""
