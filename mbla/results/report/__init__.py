"""The report: one HTML file of a result for a client; it opens without a network and prints as PDF."""
