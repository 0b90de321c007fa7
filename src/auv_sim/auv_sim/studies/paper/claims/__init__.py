"""The paper's claims, each with the rule that it is judged by."""
