"""The figures as tables: one description, for the terminal and for the page."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass
from typing import Any

from rich.console import Console

from auv_sim.terminal import headed_table
from auv_sim.views.doc_pages import markdown_table

#: Simulated seconds per lockstep step, the simulator's default.
STEP = 0.05
_LOCKSTEP_ROWS = (
    ("plain floor", "plain rclpy nodes, empty callbacks", "floor"),
    ("floor", "floor: the suite's way over the wire, empty callbacks", "floor"),
    ("suite", "the mission", "floor"),
    ("floor, recorded", "floor with a recorder that only counts", "floor, recorded"),
    ("suite, recorded", "the mission with its recorder", "floor, recorded"),
    ("suite, recorded, on any processor", "the same, any processor (`--any-processor`)", "floor, recorded"),
)


@dataclass(frozen=True)
class Sheet:
    """One table; the first column is text, the others are numbers."""

    title: str
    heads: tuple[str, ...]
    rows: tuple[tuple[str, ...], ...]


def sheets(figures: dict[str, Any]) -> list[Sheet]:
    """Return the tables of everything that was measured."""
    makers = {
        "lockstep": _lockstep, "dimensions": _dimensions, "fleet": _fleet, "latency": _latency,
        "operation": _operation, "console": _console, "simulation": _simulation,
        "start_up": _start_up, "subpaths": _subpaths, "recording": _recording, "against": _against,
    }  # fmt: skip
    found: list[Sheet] = []
    for name, make in makers.items():
        if figures.get(name):
            found += make(figures[name])
    return found


def _lockstep(figures: dict[str, Any]) -> list[Sheet]:
    heads = ("", "times its floor", "us a step", "processor us", "switches", "times real time")
    found = []
    for place, title in (("separate", "one process for each node"), ("composed", "all nodes in one process")):
        runs = figures[place]
        found.append(Sheet(f"Lockstep, {title}", heads, tuple(_lockstep_rows(runs))))
        cost = {k: runs[f"{k}, recorded"]["step_us"] / runs[k]["step_us"] for k in ("floor", "suite")}
        ratios = tuple(f"{cost[k]:.2f}" for k in ("suite", "floor"))
        recording = ("step recorded / not recorded", "mission", "floor")
        found.append(Sheet(f"Recording, {title}", recording, (("", *ratios),)))
    return [*found, _by_node(figures["separate"]["suite, recorded"]["cpu_by_process_us"], figures["memory"])]


def _lockstep_rows(runs: dict[str, Any]) -> Iterator[tuple[str, ...]]:
    for kind, text, yardstick in _LOCKSTEP_ROWS:
        if kind in runs:
            run, floor = runs[kind], runs[yardstick]
            yield (
                text,
                f"{run['step_us'] / floor['step_us']:.2f}",
                f"{run['step_us']:.0f}",
                f"{run['cpu_us']:.0f}",
                f"{run['switches']:.1f}",
                f"{STEP * 1e6 / run['step_us']:.0f}",
            )


def _by_node(used: dict[str, float], memory: dict[str, dict[str, float]]) -> Sheet:
    """Processor time (us a step) and memory (bytes) of each node, and of all."""
    by_node = [
        (name, f"{used[name]:.0f}", *(f"{held[kind] / 2**20:.0f}" for kind in ("rss", "pss")))
        for name, held in memory.items()
    ]
    sums = (sum(held[kind] for held in memory.values()) for kind in ("rss", "pss"))
    total = ("all", f"{sum(used.values()):.0f}", *(f"{size / 2**20:.0f}" for size in sums))
    columns = ("node (recorded mission)", "processor us a step", "RSS MiB", "PSS MiB")
    return Sheet("Processor and memory, by node", columns, (*by_node, total))


def _dimensions(figures: dict[str, Any]) -> list[Sheet]:
    """A step in three dimensions against one in the plane; the compiled engine against `closed_loop`."""
    places = {"separate": "one process for each node", "composed": "all nodes in one process"}
    rows = []
    for place, text in places.items():
        planar, dives = figures[place]["planar"], figures[place]["dives"]
        costs = [f"{run[key]:.0f}" for key in ("step_us", "cpu_us") for run in (planar, dives)]
        rows.append((text, f"{dives['step_us'] / planar['step_us']:.2f}", *costs))
    heads = ("lockstep", "3-D / planar", "us a step, planar", "3-D", "processor us, planar", "3-D")
    title = "compiled engine" if figures["compiled"] else "engine, not compiled"
    engines = [
        (
            {"planar": "in the plane", "dives": "in three dimensions"}[kind],
            f"{run['closed_loop'] / run['batch']:.0f}",
            f"{run['closed_loop']:.1f}",
            f"{run['batch']:.2f}",
        )
        for kind, run in figures["engine"].items()
    ]
    columns = (f"a flight on one core, {title}", "times closed_loop", "us a step, closed_loop", "engine")
    return [
        Sheet("Three dimensions against the plane", heads, tuple(rows)),
        Sheet("Engines, in the plane and in three dimensions", columns, tuple(engines)),
    ]


def _fleet(figures: dict[str, Any]) -> list[Sheet]:
    places = {"separate": "one process for each node", "composed": "one process for each vehicle"}
    rows, kinds = [], []
    for place, text in places.items():
        one, four = figures[place]["1"], figures[place]["4"]
        ratio = f"{four['cpu_us'] / one['cpu_us']:.2f}"
        rows.append((text, ratio, f"{one['cpu_us']:.0f}", f"{four['cpu_us']:.0f}"))
        for name, cost in four["cpu_by_process_us"].items():
            alone = one["cpu_by_process_us"].get(name)
            kinds.append((name, "-" if alone is None else f"{alone:.0f}", f"{cost:.0f}"))
    heads = ("lockstep", "of four / alone", "processor us a vehicle's step, alone", "of four")
    return [
        Sheet("A vehicle of a fleet of four against one alone", heads, tuple(rows)),
        Sheet("The same, by process", ("process", "us, alone", "of four"), tuple(kinds)),
    ]


def _latency(figures: dict[str, Any]) -> list[Sheet]:
    rows = []
    for rate, at in figures.items():
        cells = [f"{at[key]:.2f}" for key in ("p50_ms", "p99_ms", "p99.9_ms", "largest_ms", "jitter_ms")]
        period = 1e3 / float(rate)
        share = f"{100.0 * at['p50_ms'] / period:.1f}"
        rows.append((f"{rate} Hz", *cells, share, f"{at['missed']} of {at['cycles']}"))
    heads = ("odometry", "p50 ms", "p99", "p99.9", "largest", "jitter", "p50 in % of the period", "missed")
    latency = Sheet("Free running: from odometry to rudder command", heads, tuple(rows))
    names = list(next(iter(figures.values()))["cpu_percent"])
    used = [(name, *(f"{at['cpu_percent'][name]:.1f}" for at in figures.values())) for name in names]
    columns = ("% of one core", *(f"{rate} Hz" for rate in figures))
    return [latency, Sheet("Free running: processor time, by node", columns, tuple(used))]


def _operation(figures: dict[str, Any]) -> list[Sheet]:
    row = (str(figures["aborts"]), f"{figures['p50_ms']:.1f}", f"{figures['largest_ms']:.1f}")
    heads = ("aborts", "p50 ms", "largest ms")
    return [Sheet("Free running at 20 Hz: from the call of abort to thrust 0", heads, (row,))]


def _console(figures: dict[str, Any]) -> list[Sheet]:
    row = (
        f"{figures['cpu_percent']:.1f}", f"{figures['rss'] / 2**20:.0f}", str(figures["aborts"]),
        f"{figures['p50_ms']:.1f}", f"{figures['largest_ms']:.1f}",
    )  # fmt: skip
    heads = ("% of one core", "RSS MiB", "aborts", "request to thrust 0, p50 ms", "largest ms")
    return [Sheet("Console with one browser, free running at 20 Hz", heads, (row,))]


def _simulation(figures: dict[str, Any]) -> list[Sheet]:
    scalar = figures["closed_loop"]["vehicle_steps_per_second"]
    rows = [("closed_loop, one vehicle", "1.0", f"{scalar:,.0f}", f"{1e6 / scalar:.2f}", "-", "-")]
    batch = figures["batch"]
    how = "batch" if batch["compiled"] else "batch, not compiled"
    for number, rate in batch["vehicle_steps_per_second"].items():
        rows.append(
            (
                f"{how}, {int(number):,} vehicle{'s' * (number != '1')}",
                f"{rate / scalar:.1f}",
                f"{rate:,.0f}",
                f"{1e6 / rate:.3f}",
                f"{batch['step_us'][number]:.3f}",
                f"{batch['fixed_us'][number]:.1f}",
            )
        )
    heads = (
        "", "times closed_loop", "vehicle-steps a second", "us a vehicle-step",
        "of it for the step", "us a flight, once",
    )  # fmt: skip
    return [Sheet("Simulation without ROS", heads, tuple(rows))]


def _start_up(figures: dict[str, Any]) -> list[Sheet]:
    return [
        Sheet(
            "Start-up", ("", "s"), (("launcher called to first rudder command", f"{figures['seconds']:.1f}"),)
        )
    ]


def _subpaths(figures: dict[str, Any]) -> list[Sheet]:
    costs = figures["step_us"]
    least = next(iter(costs.values()))
    rows = tuple((f"{int(n):,}", f"{cost / least:.2f}", f"{cost:.1f}") for n, cost in costs.items())
    heads = ("subpaths", "times the shortest path's", "us a step of guidance")
    return [Sheet("Guidance, by number of subpaths", heads, rows)]


def _against(figures: dict[str, Any]) -> list[Sheet]:
    many = f"batch, {figures['vehicles']:,} vehicles, all cores"
    rows = (
        ("closed_loop: time", f"{figures['closed_loop']:.2f}"),
        (f"{many}: times the other's closed_loop", f"{figures['batch']:.0f}"),
        ("batch, rough sea, one core: times the other's closed_loop", f"{figures['batch_at_sea']:.1f}"),
        ("first rudder command, one process for each node: time", f"{figures['first_command']:.2f}"),
        ("first rudder command, all nodes in one process: time", f"{figures['first_command_composed']:.2f}"),
        ("one process for each node: recorded / not recorded", f"{figures['recorded']:.2f}"),
        ("all nodes in one process: recorded / not recorded", f"{figures['recorded_composed']:.2f}"),
    )
    return [Sheet("Against the other checkout", ("", "ratio"), rows)]


def _recording(figures: dict[str, Any]) -> list[Sheet]:
    costs, rate = figures["cpu_percent"], figures["rate_hz"]
    rows = tuple((n, f"{cost:.1f}", f"{cost * 1e4 / (float(n) * rate):.0f}") for n, cost in costs.items())
    heads = (f"topics at {rate:g} Hz", "% of one core", "us a message")
    return [Sheet("Recorder, by number of topics", heads, rows)]


def show(found: list[Sheet], console: Console) -> None:
    """Print the tables."""
    for sheet in found:
        table = headed_table(sheet.title, sheet.heads[:1], sheet.heads[1:])
        for row in sheet.rows:
            table.add_row(*row)
        console.print(table)


def markdown(found: list[Sheet]) -> str:
    """Return the tables for the page."""
    texts = []
    for sheet in found:
        texts.append(f"**{sheet.title}**\n\n{markdown_table(sheet.heads, sheet.rows)}")
    return "\n\n".join(texts)
