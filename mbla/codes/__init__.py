"""What codes ask of a mechanism: from the figures of a result to capacity over demand."""
