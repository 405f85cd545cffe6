"""Flow without normality: one file a scheme, and the joint law with its states that all of them share."""
