"""From a vehicle's time since boot to ROS time. ROS-free; all times in ns.

A vehicle stamps its measurements with the time since its boot; the suite needs their ROS time. The offset
between the two clocks is estimated from messages, which arrive with a delay.
"""

from __future__ import annotations

from collections import deque

_MS = 1_000_000
_SECOND = 1_000 * _MS
#: A vehicle whose time goes back by more than this has been restarted.
REBOOT = _SECOND
#: A larger error of the offset is corrected at once, a smaller one gradually, so that dt stays true.
STEP = 500 * _MS
#: Rate of the gradual correction, as a share of the time that passes: within `NEAR`, and beyond it.
SLEW, FAST, NEAR = 0.002, 0.05, 15 * _MS
#: Time from the first message until a vehicle's time is reliable.
SETTLING = _SECOND
#: Two components share a clock if the messages of one seem to arrive at most this much later than those of
#: the other, and at most this much earlier.
SHARED, EARLY = 100 * _MS, 20 * _MS
#: Time for which a sample counts, and number of time exchanges compared.
WINDOW, EXCHANGES = 10 * _SECOND, 20


class OffsetEstimate:
    """ROS time minus time since boot, for a vehicle in real time.

    A message cannot arrive before it was sent, so every arrival is an upper bound, and the least of them is
    too large by the shortest delay. An exchange of times (TIMESYNC) measures its own duration; half of it is
    a better estimate of the delay. The quickest of the last exchanges is used, if there are any.

    Args:
        settling: time after the first message in which the estimate moves freely.
    """

    def __init__(self, settling: int = SETTLING) -> None:
        self.restarts = self.steps = 0
        self._settling = settling
        self._forget()

    def _forget(self) -> None:
        self._newest: int | None = None
        self._heard_from: int | None = None
        self._applied: int | None = None
        self._applied_at = 0
        # Arrivals that no later one undercuts: the first is the least of the window.
        self._bounds: deque[tuple[int, int]] = deque()
        self._exchanges: deque[tuple[int, int]] = deque(maxlen=EXCHANGES)

    @property
    def round_trip(self) -> int | None:
        """Duration of the quickest exchange; None without any."""
        return min(self._exchanges)[0] if self._exchanges else None

    def heard(self, boot: int, now: int) -> bool:
        """Process a message with this time that arrived now; return True when the vehicle was restarted."""
        anew = self._newest is not None and boot < self._newest - REBOOT
        if anew:
            self.restarts += 1
            self._forget()
        self._newest = boot if self._newest is None else max(self._newest, boot)
        bound = now - boot
        if self._bounds and abs(bound - self._bounds[-1][1]) > REBOOT:
            # No delay changes this much: one of the two clocks was set, or this process was suspended.
            self._bounds.clear()
            self._exchanges.clear()
        while self._bounds and self._bounds[-1][1] >= bound:
            self._bounds.pop()
        self._bounds.append((now, bound))
        while self._bounds[0][0] < now - WINDOW or self._bounds[0][0] > now:
            self._bounds.popleft()
        self._apply(self._newest)
        return anew

    def exchanged(self, sent: int, vehicle: int, received: int) -> None:
        """Process a TIMESYNC that was sent and received by us, and answered in between at `vehicle`."""
        offset = (sent + received) // 2 - vehicle
        if self._bounds and abs(offset - self._bounds[0][1]) < _SECOND:
            # Otherwise it answers with another clock than it stamps with, such as the time of day.
            self._exchanges.append((received - sent, offset))

    @property
    def least(self) -> int | None:
        """Upper bound of the offset; None before the first message."""
        return self._bounds[0][1] if self._bounds else None

    @property
    def offset(self) -> int | None:
        """Offset added to a time since boot; None before the first message."""
        return self._applied

    def _target(self) -> int:
        least = self._bounds[0][1]
        return min(min(self._exchanges)[1], least) if self._exchanges else least

    @property
    def settled(self) -> bool:
        """Whether the vehicle has been heard for the settling time."""
        return self._heard_from is not None and self._applied_at - self._heard_from >= self._settling

    def _apply(self, newest: int) -> None:
        target = self._target()
        if self._heard_from is None:
            self._heard_from = newest
        if self._applied is None or not self.settled:
            self._applied = target
        elif abs(target - self._applied) > STEP:
            self.steps += 1
            self._applied = target
        else:
            share = SLEW if abs(target - self._applied) <= NEAR else FAST
            reach = round(
                share * (newest - self._applied_at)
            )  # in the vehicle's time: arrivals come in bursts
            self._applied += min(max(target - self._applied, -reach), reach)
        self._applied_at = newest

    def stamp(self, boot: int) -> int:
        """Return the ROS time of a time since boot; at least one message must have been heard."""
        assert self._applied is not None
        return boot + self._applied


class FollowedClock:
    """ROS time that follows an emulated vehicle's, for one that is faster than real time.

    The vehicle's messages advance time, so a machine that cannot keep the pace only slows time down. While
    the vehicle is silent time advances nevertheless, so that watchdogs notice.

    Args:
        first: the time to begin with.
        speed: times real time, at which time advances in silence.
        patience: silence on the wall clock after which it does.
    """

    def __init__(self, first: int, speed: float, patience: int = 2 * _SECOND) -> None:
        self.now = first
        self.restarts = 0
        self._speed = speed
        self._patience = patience
        self._offset: int | None = None
        self._newest = 0
        self._moved_at: int | None = None

    def heard(self, boot: int, wall: int) -> bool:
        """Process a message with this time; return True when the vehicle was restarted."""
        anew = self._offset is not None and boot < self._newest - REBOOT
        if anew:
            self.restarts += 1
        lags = self._offset is not None and boot + self._offset < self.now - REBOOT
        if self._offset is None or anew or lags:
            self._offset = self.now - boot
            self._newest = boot
        self._newest = max(self._newest, boot)
        if boot + self._offset > self.now:
            self.now = boot + self._offset
        self._moved_at = wall
        return anew

    @property
    def offset(self) -> int | None:
        """Offset added to a time since boot; None before the first message."""
        return self._offset

    @property
    def settled(self) -> bool:
        """Whether the vehicle's time is reliable: at once, since ours follows it."""
        return True

    def pass_silence(self, wall: int) -> bool:
        """Compare with the wall clock; return True when time has advanced in silence."""
        if self._moved_at is None:
            self._moved_at = wall - self._patience
        silence = wall - self._moved_at
        if silence < self._patience:
            return False
        # In small steps: a machine that was suspended must not make time jump.
        self.now += round(self._speed * min(silence - self._patience, _SECOND / 100))
        self._moved_at = wall - self._patience
        return True

    def stamp(self, boot: int) -> int:
        """Return the ROS time of a time since boot; at least one message must have been heard."""
        assert self._offset is not None
        return boot + self._offset


class ComponentTime:
    """Time of a component other than the autopilot: it may count from a boot, or an epoch, of its own.

    Its arrivals alone bound its offset only up to its shortest delay. A component that stamps with the
    autopilot's clock, as most do, uses the autopilot's offset, which the exchange of times corrects. Which of
    the two holds is decided once, and again when they diverge.

    Args:
        autopilot: the time of the autopilot.
        settling: as of `OffsetEstimate`.
    """

    def __init__(self, autopilot: OffsetEstimate | FollowedClock, settling: int = SETTLING) -> None:
        self._autopilot = autopilot
        self._own = OffsetEstimate(settling)
        self._shares: bool | None = None

    @property
    def restarts(self) -> int:
        """Number of restarts of the component."""
        return self._own.restarts

    def heard(self, boot: int, now: int) -> bool:
        """Process a message with this time that arrived now; return True when the component was restarted."""
        anew = self._own.heard(boot, now)
        least, offset = self._own.least, self._autopilot.offset
        if least is None or offset is None:
            return anew
        later = least - offset
        if anew or (self._shares and abs(later) > STEP):
            self._shares = None
        if self._shares is None and self._own.settled and self._autopilot.settled:
            self._shares = -EARLY < later < SHARED
        return anew

    @property
    def settled(self) -> bool:
        """Whether its time is reliable."""
        return self._shares is not None

    def stamp(self, boot: int) -> int:
        """Return the ROS time of a time since boot; it must have settled."""
        return (self._autopilot.offset or 0) + boot if self._shares else self._own.stamp(boot)
