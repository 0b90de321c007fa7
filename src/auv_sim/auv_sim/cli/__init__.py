"""The commands, one a file. Each parses its arguments and hands over."""
