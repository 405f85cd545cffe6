"""What every identifier means that the program prints; ``mbla explain`` shows it (a file for each stage)."""
