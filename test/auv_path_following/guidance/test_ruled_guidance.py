"""Guidance that belongs to the gains of the rule."""

from __future__ import annotations

import dataclasses

import pytest

from auv_path_following.control.rule.gain_rule import gains_for
from auv_path_following.guidance.approach import agility_of
from auv_path_following.guidance.path_follower import PathFollowerConfig, prepare
from auv_path_following.guidance.ruled_guidance import with_gains
from auv_path_following.guidance.switching import circles_of, with_overrides
from hulls import DIVER, REMUS


def test_every_law_looks_as_far_ahead_as_the_rule_says() -> None:
    gains = gains_for(DIVER, 0.1)
    config = with_gains(PathFollowerConfig(), gains)
    assert config.ailos.lookahead == config.ilos.lookahead == config.los.lookahead == gains.heading.lookahead
    assert gains.pitch is not None
    assert config.vertical.lookahead == gains.pitch.lookahead
    planar = with_gains(PathFollowerConfig(), gains_for(REMUS))
    assert planar.vertical == PathFollowerConfig().vertical


def test_corners_are_cut_for_the_limits_of_the_reference() -> None:
    gains = gains_for(REMUS, 0.1)
    config = with_gains(PathFollowerConfig(), gains)
    circles = prepare(config, agility_of(REMUS, 6.48)).progress.circles
    reference = gains.heading.autopilot.reference
    assert circles.computed
    assert circles.cornering.rate == reference.max_rate
    lead = 0.5 * reference.max_rate / reference.max_acceleration
    lead += 0.5 * reference.max_acceleration / reference.max_jerk
    assert circles.cornering.lead == pytest.approx(lead + 0.05)
    own = circles_of(PathFollowerConfig().switching, agility_of(REMUS, 6.48).cornering, 5.0)
    assert own.cornering == agility_of(REMUS, 6.48).cornering


def test_a_mission_that_overrides_the_radius_keeps_the_rate() -> None:
    switching = with_gains(PathFollowerConfig(), gains_for(REMUS)).switching
    overridden = with_overrides(switching, "all", None)
    assert overridden == dataclasses.replace(switching, mode="all")
