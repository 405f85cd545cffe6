"""Results as tables: one description of the columns, written as CSV and Parquet."""
