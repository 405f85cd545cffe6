"""What arches, bridges and barrel vaults are made of: sections in a plane, coursed masonry beside and above them."""
