"""Campaigns: many missions with parameters drawn from distributions, flown, kept and summed up."""
