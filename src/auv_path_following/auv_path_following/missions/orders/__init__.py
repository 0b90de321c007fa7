"""What an operator orders: where a mission begins, and a goal instead of a mission file."""
