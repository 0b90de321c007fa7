"""The launcher's substance: configuration, processes, supervision, progress."""
