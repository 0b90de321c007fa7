"""The figures of a flown mission, and the rows from which they are computed."""
