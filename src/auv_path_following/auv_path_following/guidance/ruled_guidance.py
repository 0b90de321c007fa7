"""Settings of guidance that belong to the gains of the rule."""

from __future__ import annotations

import dataclasses

from auv_path_following.control.reference_model import ReferenceLimits
from auv_path_following.control.rule.gain_rule import RuledGains
from auv_path_following.guidance.acceptance import cornering_within
from auv_path_following.guidance.laws.registered import LAWS
from auv_path_following.guidance.path_follower import PathFollowerConfig


def with_gains(config: PathFollowerConfig, gains: RuledGains) -> PathFollowerConfig:
    """Return guidance with the look-aheads of the rule, and a radius computed for each corner.

    Args:
        config: laws and gains; all but look-aheads and circles stay.
        gains: of `gain_rule.gains_for`.
    """
    reference = gains.heading.autopilot.reference
    limits = ReferenceLimits(reference.max_rate, reference.max_acceleration, reference.max_jerk)
    rate, lead = cornering_within(limits)
    switching = dataclasses.replace(config.switching, radius=0.0, turn_rate=rate, lead=lead)
    changes = {
        law.name: dataclasses.replace(getattr(config, law.name), lookahead=gains.heading.lookahead)
        for law in LAWS
        if hasattr(getattr(config, law.name), "lookahead")
    }
    if gains.pitch is not None:
        changes["vertical"] = dataclasses.replace(config.vertical, lookahead=gains.pitch.lookahead)
    return dataclasses.replace(config, switching=switching, **changes)
