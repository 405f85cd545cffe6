"""The report: one HTML file with everything of a result, that opens in a browser without a network and prints as PDF."""
