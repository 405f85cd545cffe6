"""What hands tasks to workers: one process, local ones, a cluster."""
