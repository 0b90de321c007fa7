"""What a campaign shows: statistics, a summary, tables for the terminal, pictures."""
