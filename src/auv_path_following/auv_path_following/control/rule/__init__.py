"""Gains by rule, for a hull without shipped ones."""
