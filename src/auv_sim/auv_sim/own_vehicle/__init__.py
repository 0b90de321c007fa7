"""A vehicle of your own: its file, manoeuvres, coefficients and gains."""
