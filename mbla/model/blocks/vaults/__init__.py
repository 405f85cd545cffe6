"""What vaults have in common: keys of their curve and bond, and webs that meet in mitred blocks."""
