"""The HDF5 result file: its layout as a table, results as its content and back, writing and reading."""
