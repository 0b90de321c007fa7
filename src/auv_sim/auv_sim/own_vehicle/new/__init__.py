"""A vehicle file from what an owner has at hand."""
