"""Tables in Parquet files: their columns, writing and reading."""
