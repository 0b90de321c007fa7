"""The substance of `scripts/mission.py`: options, plan, supervision, progress, results."""
