"""Array formats: npz, Parquet, and folders of arrays."""
