"""Operation under the launcher: a mission's stages, waiting for an operator, a log of what was flown."""
