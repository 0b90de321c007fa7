"""Operation under the launcher: it waits for an operator and logs each mission that was flown."""
