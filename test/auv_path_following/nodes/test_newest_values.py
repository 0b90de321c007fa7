"""What a free run remembers beside its odometry."""

from __future__ import annotations

import pytest

from auv_msgs_py.contract import topics
from auv_msgs_py.values.errors import MessageRefused
from auv_path_following.nodes.newest_values import NewestValues

WATER, CURRENT = topics.WATER_VELOCITY, topics.CURRENT_ESTIMATE
SECOND = 1_000_000_000


@pytest.fixture
def newest() -> NewestValues:
    values = NewestValues([WATER, CURRENT])
    values.begin(5 * SECOND)
    return values


def test_the_newest_value_has_its_age_and_a_missing_one_that_of_the_first_odometry(
    newest: NewestValues,
) -> None:
    newest.put(WATER, "old", 5 * SECOND)
    newest.put(WATER, "new", 6 * SECOND)
    newest.begin(7 * SECOND)
    assert newest.at(WATER, 8 * SECOND) == ("new", pytest.approx(2.0))
    assert newest.at(WATER, 5 * SECOND) == ("new", pytest.approx(-1.0))
    assert newest.at(CURRENT, 8 * SECOND) == (None, pytest.approx(3.0))
    assert newest.at(topics.ALTITUDE, 8 * SECOND) == (None, pytest.approx(3.0))


def test_an_overtaken_message_is_refused_and_the_newer_one_stays(newest: NewestValues) -> None:
    newest.put(WATER, "new", 6 * SECOND)
    newest.put(CURRENT, "of another topic", 5 * SECOND)
    with pytest.raises(MessageRefused, match="a stamp that is not newer than the last"):
        newest.put(WATER, "late", 5 * SECOND)
    assert newest.at(WATER, 6 * SECOND)[0] == "new"


def test_a_time_that_went_back_begins_anew(newest: NewestValues) -> None:
    newest.put(WATER, "of the old time", 9 * SECOND)
    newest.reset()
    newest.begin(1 * SECOND)
    assert newest.at(WATER, 2 * SECOND) == (None, pytest.approx(1.0))
    newest.put(WATER, "of the new time", 2 * SECOND)
    assert newest.at(WATER, 2 * SECOND)[0] == "of the new time"
