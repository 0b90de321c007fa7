"""A campaign with given gains, and the sentence that it proves."""
