"""What is checked, one group of checks a file."""
