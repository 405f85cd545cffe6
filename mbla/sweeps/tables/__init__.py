"""Results of a sweep as a table, and the files that hold it."""
