"""The tables of docs/tuning.md: limit cycles and distances with several gains on many hulls."""
