"""The report: one HTML file with everything of a result; it opens without a network and prints as PDF."""
