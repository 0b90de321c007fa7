"""A layout for Foxglove: chart, errors, commands, state and health of one vehicle, live or recorded."""

from __future__ import annotations

from auv_msgs_py.contract import topics
from auv_msgs_py.contract.topics import Topic, full_name

#: Title of a plot -> its series: label, topic, field.
PLOTS: dict[str, tuple[tuple[str, Topic, str], ...]] = {
    "Errors (m)": (
        ("xe", topics.PATH_ERROR, "vector.x"), ("ye", topics.PATH_ERROR, "vector.y"),
        ("ze", topics.PATH_ERROR_3D, "vector.z"),
    ),
    "Fins (rad)": (
        ("rudder", topics.RUDDER_STATE, "data"), ("rudder command", topics.RUDDER_CMD, "data"),
        ("stern planes", topics.STERNPLANE_STATE, "data"),
        ("stern plane command", topics.STERNPLANE_CMD, "data"),
    ),
    "Height (m) and requested depth (m, down)": (
        ("z", topics.ODOM, "pose.pose.position.z"), ("desired depth", topics.DESIRED_DEPTH, "data"),
    ),
    "Speed over ground (m/s)": (("u", topics.ODOM, "twist.twist.linear.x"),),
    "Current (m/s)": (
        ("east", topics.CURRENT_ESTIMATE, "vector.x"), ("north", topics.CURRENT_ESTIMATE, "vector.y"),
    ),
}  # fmt: skip


def layout(namespace: str) -> str:
    """Return the layout as JSON.

    Args:
        namespace: of the vehicle's topics.
    """
    import foxglove.layouts as fl

    def path(topic: Topic, field: str) -> str:
        return f"{full_name(namespace, topic.name)}.{field}"

    plots = [
        fl.PlotPanel(
            title=title,
            config=fl.PlotConfig(
                paths=[fl.PlotSeries(label=label, value=path(topic, field)) for label, topic, field in series]
            ),
        )
        for title, series in PLOTS.items()
    ]
    state = fl.StateTransitionsSeries(label="mission state", value=path(topics.MISSION_STATE, "data"))
    chart = fl.ThreeDeePanel(config=fl.ThreeDeeConfig(follow_tf="base_link", fixed_frame="map"))
    left = fl.SplitContainer(
        direction="column",
        items=[
            fl.SplitItem(proportion=4, content=chart),
            fl.SplitItem(
                content=fl.StateTransitionsPanel(config=fl.StateTransitionsConfig(paths=[state])),
            ),
            fl.SplitItem(proportion=1.5, content=fl.DiagnosticsSummaryPanel()),
            fl.SplitItem(content=fl.LogPanel()),
        ],
    )
    right = fl.SplitContainer(direction="column", items=[fl.SplitItem(content=plot) for plot in plots])
    whole = fl.SplitContainer(
        direction="row",
        items=[fl.SplitItem(proportion=3, content=left), fl.SplitItem(proportion=2, content=right)],
    )
    return str(fl.Layout(content=whole).to_json()) + "\n"
