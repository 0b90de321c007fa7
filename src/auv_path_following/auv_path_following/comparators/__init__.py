"""Laws of other software in three dimensions, restated from their publications, to compare with."""
