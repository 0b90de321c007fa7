"""Whether a driver keeps the contract: pure functions over what was recorded of its topics."""
