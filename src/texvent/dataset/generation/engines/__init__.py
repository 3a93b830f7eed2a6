"""Where shards are made: this process, processes of this machine, a Ray cluster."""
