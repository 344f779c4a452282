"""Tables as Parquet files: their columns, and writing and reading them."""
