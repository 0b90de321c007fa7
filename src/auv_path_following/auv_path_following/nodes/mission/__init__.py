"""The mission in the guidance node: chosen, kept, reported and posted."""
