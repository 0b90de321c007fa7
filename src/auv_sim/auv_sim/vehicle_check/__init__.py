"""Whether somebody's driver keeps the contract: pure functions over what was recorded of its topics."""
