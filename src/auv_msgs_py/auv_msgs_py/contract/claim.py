"""What a launcher or a simulator claims in a graph, and which of two claims gives way. ROS-free.

Each publishes its claim on `/graph_claims` (latched) before anything else, and again as `held` once it has
looked at the graph and found no other. One that looks gives way to one that holds. Of two that look at the
same moment, or that both hold because they found each other too late, the earlier one stays. So both sides
decide alike, whichever sees the other first, and at most one of them flies.
"""

from __future__ import annotations

import dataclasses
import json

from auv_msgs_py.contract.topics import MAVLINK_DRIVER, PLANT, full_name

#: Longest claim, characters of JSON; a longer text is no claim.
_LONGEST = 4000


@dataclasses.dataclass(frozen=True, kw_only=True)
class Claim:
    """One launcher's or simulator's claim.

    Attributes:
        holder: full name of the node that makes it.
        namespace: of the nodes.
        names: node names that are reserved in this namespace.
        clock: whether /clock is published.
        held: False while the claimant still looks.
        process: process and host, for messages.
        since, token: wall time of the claim (ns), and a unique text for two of the same time. `GraphLook`
            fills in these and `process`.
    """

    holder: str
    namespace: str
    names: tuple[str, ...]
    clock: bool
    held: bool = False
    process: str = ""
    since: int = 0
    token: str = ""

    def encode(self) -> str:
        """Return the claim as JSON."""
        return json.dumps(dataclasses.asdict(self))

    def contested(self, other: Claim) -> str:
        """Return what both claim; empty where they do not conflict."""
        if self.token == other.token:
            return ""
        if self.clock and other.clock:
            return "/clock"
        common = sorted(set(self.names) & set(other.names)) if self.namespace == other.namespace else []
        return f"{common[0]} in {self.namespace}" if common else ""

    def gives_way_to(self, other: Claim) -> bool:
        """Return whether this claim gives way; something is contested."""
        if self.held != other.held:
            return other.held
        return (other.since, other.token) < (self.since, self.token)


def of_simulator(namespace: str, name: str) -> Claim:
    """Return the claim of a simulator started by hand: the clock and the vehicle's place in its namespace."""
    return Claim(
        holder=full_name(namespace, name), namespace=namespace, names=(PLANT, MAVLINK_DRIVER), clock=True
    )


def decode(text: str) -> Claim | None:
    """Return a claim from its JSON; None for anything else that was published on the topic."""
    if len(text) > _LONGEST:
        return None
    try:
        data = json.loads(text)
        claim = Claim(**{**data, "names": tuple(map(str, data["names"]))})
    except (ValueError, TypeError, KeyError, RecursionError):
        return None
    texts = (claim.holder, claim.namespace, claim.process, claim.token)
    right = all(type(text) is str for text in texts) and type(claim.since) is int
    return claim if right and type(claim.clock) is type(claim.held) is bool else None
