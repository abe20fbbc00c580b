# Copyright 2026 The percuss authors
# SPDX-License-Identifier: Apache-2.0
"""Pictures of results by matplotlib, where it is installed. Legends stand above the axes, where no data are."""

from collections.abc import Sequence
from functools import partial
from io import BytesIO
from typing import TYPE_CHECKING, Any

import numpy as np

if TYPE_CHECKING:
    from .ensemble_reply import EnsembleReply
    from .measured import Comparison
    from .sweeps import Curve, Sweep
    from .traces import Trace

_GREYS = ("#ececec", "#e0e0e0", "#d2d2d2", "#c4c4c4")


def _png(figure: Any) -> bytes:
    picture = BytesIO()
    figure.savefig(picture, format="png")
    return picture.getvalue()


def _figure(given: Any, size: tuple[float, float]) -> Any:
    """A figure of its own, which a notebook shows and nothing else keeps, or the one that is given."""
    try:
        import matplotlib  # noqa: F401
        from matplotlib.figure import Figure
    except ImportError as missing:
        raise ImportError("plot needs matplotlib: pip install 'percuss[plot]'") from missing
    if given is None:
        figure = Figure(figsize=size, layout="constrained")
        # a notebook has no form of its own for figures until pyplot has drawn one
        setattr(figure, "_repr_png_", partial(_png, figure))
        return figure
    if hasattr(given, "set_layout_engine"):
        given.set_layout_engine("constrained")
    return given


def _legend(figure: Any, axes: Sequence[Any]) -> None:
    """One for all axes, above them."""
    found: dict[str, Any] = {}
    for one in axes:
        for handle, label in zip(*one.get_legend_handles_labels()):
            found.setdefault(label, handle)
    if found:
        # in one row if that is wide enough, by about what a letter and a line with its gaps take
        inches = [0.085 * len(label) + 0.7 for label in found]
        wide = figure.bbox.width / figure.dpi
        columns = len(found) if sum(inches) < wide else max(1, int(wide / max(inches)))
        figure.legend(list(found.values()), list(found), loc="outside upper center", ncols=columns, frameon=False)


def _drawn_times(traced: "Trace", i: int) -> tuple[float, float]:
    """The contacts, and a quarter of their time before and after them; a trace goes on for as long as vibration could
    bring the bodies together again."""
    time, subs = traced.contacts[i].time, traced.reply.contacts[i].sub_impacts
    end = traced.reply.contacts[i].end_time
    if not len(subs) or not end > subs["start"][0]:
        return float(time[0]), float(time[-1])
    start = float(subs["start"][0])
    margin = 0.25 * (end - start)
    return max(float(time[0]), start - margin), min(float(time[-1]), end + margin)


_SUB_IMPACTS = ("black", "C3", "C9", "C8")
_TANGENTS = (("C2", "along the first tangent"), ("C4", "along the second tangent"))


def _friction(traced: "Trace", i: int, on: Any, time: Any, panels: Sequence[Any]) -> None:
    """Slip, tangential force within Coulomb's limit, and its way in Coulomb's circle."""
    contact, mu = traced.contacts[i], traced.reply.contacts[i].friction
    slip, force, circle = panels
    limit = mu * contact.force
    # less is rounding
    rates = max(float(np.abs(one).max()) for one in (contact.slip_1, contact.gap_rate))
    both = bool(np.abs(contact.slip_2).max() > 1e-6 * rates)
    slip.update_datalim([(time[0], -0.01 * rates), (time[0], 0.01 * rates)])
    slips = (contact.slip_1, contact.slip_2)
    forces = (contact.force_tangential_1, contact.force_tangential_2)
    force.fill_between(time, -limit[on], limit[on], color="#d8d8d8", linewidth=0, label="within Coulomb's limit")
    for (colour, name), speed, pull in list(zip(_TANGENTS, slips, forces))[: 2 if both else 1]:
        slip.plot(time, speed[on], color=colour, linewidth=1.0, label=name)
        force.plot(time, pull[on], color=colour, linewidth=1.0, label=name)
    # one line for each sub-impact, where the normal force is more than hardly anything
    circle.add_patch(_circle())
    subs = [(k + 1, sub) for k, sub in enumerate(traced.reply.contacts[i].sub_impacts) if not sub["negligible"]]
    for k, (number, sub) in enumerate(subs):
        there = (contact.time >= sub["start"]) & (contact.time <= sub["end"]) & (limit > 0.01 * mu * sub["peak_force"])
        colour = _SUB_IMPACTS[k % len(_SUB_IMPACTS)]
        label = f"sub-impact {number}" if len(subs) <= len(_SUB_IMPACTS) else None
        circle.plot(*(one[there] / limit[there] for one in forces), color=colour, linewidth=1.0, label=label)
    circle.set(title="tangential force over its limit", xlim=(-1.1, 1.1), ylim=(-1.1, 1.1), aspect="equal", xlabel="first tangent", xticks=(-1, 0, 1), yticks=(-1, 0, 1))


def _circle() -> Any:
    from matplotlib.patches import Circle

    return Circle((0.0, 0.0), 1.0, fill=False, color="#808080", linewidth=0.8)


def _slides(traced: "Trace", i: int) -> bool:
    return len(traced.contacts[i].slip_1) > 0


def _panels(figure: Any, count: int, names: Sequence[str], sliding: bool) -> Any:
    """A row for each name and a column for each contact; with friction a row of circles below."""
    rows = len(names) + (1 if sliding else 0)
    heights = [1.0] * len(names) + ([1.5] if sliding else [])
    return figure.subplots(rows, count, squeeze=False, height_ratios=heights)


def trace(traced: "Trace", figure: Any) -> Any:
    """A column for each contact: the bodies' displacements and velocities, the force, the indentation; where any has friction
    also its slip, the tangential force within its limit, and Coulomb's circle."""
    if not traced.contacts:
        raise ValueError(f"{traced.reply.status}: {traced.reply.message}: there are no histories to plot")
    count = len(traced.contacts)
    names = traced.names or (("a", "b"),) * count
    colours = {name: f"C{k}" for k, name in enumerate(dict.fromkeys(one for pair in names for one in pair))}
    sliding = any(_slides(traced, i) for i in range(count))
    labels = ["displacement, um", "velocity, m/s", "force, N", "indentation, um"]
    labels += ["slip, m/s", "tangential force, N"] if sliding else []
    figure = _figure(figure, (8.0 + 3.0 * (count - 1), 16.0 if sliding else 9.0))
    rows = _panels(figure, count, labels, sliding)
    for i, contact in enumerate(traced.contacts):
        # each row scales to what is on the axis of time
        low, high = _drawn_times(traced, i)
        on = (contact.time >= low) & (contact.time <= high)
        time = 1e3 * contact.time[on]
        displacement, velocity, force, depth = rows[:4, i]
        for values, panel, scale in (
            ((contact.displacement_a, contact.displacement_b), displacement, 1e6),
            ((contact.velocity_a, contact.velocity_b), velocity, 1.0),
        ):
            for name, one in zip(names[i], values):
                if not np.isnan(one).all():
                    panel.plot(time, scale * one[on], color=colours[name], linewidth=1.0, label=name)
        velocity.plot(time, contact.gap_rate[on], "--", color="#808080", linewidth=0.8, label="gap rate of the rigid bodies")
        force.fill_between(time, contact.force[on], color="#d8d8d8", linewidth=0)
        force.plot(time, contact.force[on], color="black", linewidth=0.8)
        depth.plot(time, 1e6 * contact.indentation[on], color="black", linewidth=0.8)
        result = traced.reply.contacts[i]
        subs = f"{result.sub_impact_count} sub-impact{'' if result.sub_impact_count == 1 else 's'}"
        displacement.set(title=f"{' on '.join(names[i])}: e = {result.restitution:.4f}, {subs}")
        lowest = rows[len(labels) - 1 if _slides(traced, i) else 3, i]
        for panel, label in zip(rows[:, i], labels):
            panel.set(ylabel=label if i == 0 else None, xlim=(1e3 * low, 1e3 * high))
            panel.tick_params(labelbottom=panel is lowest)
        lowest.set(xlabel="time, ms")
        if sliding and i == 0:
            rows[-1, 0].set(ylabel="second tangent")
        if _slides(traced, i):
            _friction(traced, i, on, time, rows[4:, i])
        else:
            for panel in rows[4:, i]:
                panel.set_axis_off()
    _legend(figure, rows.flat)
    return figure


def _name(curve: "Curve", curves: Sequence["Curve"]) -> str:
    """What tells the curve from the others."""
    models = len({one.contact_model for one in curves}) > 1
    return f"{curve.b}, {curve.contact_model.text}" if models else curve.b


def sweep(swept: "Sweep", figure: Any) -> Any:
    """The restitution with its total error over the speed, and the number of sub-impacts below."""
    figure = _figure(figure, (8.0, 6.0))
    above, below = figure.subplots(2, 1, sharex=True, height_ratios=(3, 1))
    for i, curve in enumerate(swept.curves):
        error = np.nan_to_num(np.where(np.isnan(curve.error_total), curve.error, curve.error_total))
        there = np.isfinite(curve.restitution)
        style = {"color": f"C{i}", "markersize": 3, "linewidth": 1.0}
        above.errorbar(
            curve.speed[there], curve.restitution[there], error[there], fmt="o-", label=_name(curve, swept.curves), **style
        )
        below.plot(curve.speed[there], curve.sub_impacts[there], "o", color=f"C{i}", markersize=5, fillstyle="none")
        below.plot(curve.speed[there], curve.significant[there], ".", color=f"C{i}", markersize=3)
    names = ", ".join(sorted({curve.a for curve in swept.curves}))
    above.set(ylabel=f"restitution of {names}")
    below.set(xlabel="speed, m/s", ylabel="sub-impacts")
    below.set_title("dots: without those below 1 % of the impulse", loc="right", fontsize="small")
    below.set_ylim(bottom=0)
    below.yaxis.get_major_locator().set_params(integer=True)
    _legend(figure, [above])
    return figure


def ensemble(reply: "EnsembleReply", figure: Any) -> Any:
    """The restitution's histogram and distribution function with the intervals of its quantiles; the samples over the
    first input, where they were handed over."""
    if "restitution" not in reply.statistics:
        raise ValueError(f"{reply.status}: {reply.message}: there is no distribution to plot")
    of = reply.restitution
    listed = reply.rows is not None and len(reply.columns) > 7
    figure = _figure(figure, (12.0 if listed else 8.0, 4.5))
    axes = figure.subplots(1, 3 if listed else 2)
    shares = of.bin_counts / max(1, of.count)
    axes[0].stairs(shares, of.bin_edges, fill=True, color="C0", alpha=0.5)
    axes[0].axvspan(of.mean_low, of.mean_high, color="C1", alpha=0.4, linewidth=0)
    axes[0].axvline(of.mean, color="C1", linewidth=1.2, label=f"mean {of.mean:.4g}")
    for side in (-1.0, 1.0):
        label = f"standard deviation {of.standard_deviation:.4g}" if side > 0.0 else None
        axes[0].axvline(of.mean + side * of.standard_deviation, color="C1", linestyle=":", linewidth=1.2, label=label)
    axes[0].set(xlabel="restitution", ylabel="share of the samples")
    axes[1].plot(of.curve_values, of.curve_shares, color="C0", linewidth=1.2, label="distribution function")
    sides = np.array([of.quantiles - of.quantiles_low, of.quantiles_high - of.quantiles])
    axes[1].errorbar(
        of.quantiles,
        of.probabilities,
        xerr=np.maximum(0.0, np.nan_to_num(sides)),
        fmt=".",
        color="black",
        capsize=2,
        label="quantiles with 95 % intervals",
    )
    axes[1].set(xlabel="restitution", ylabel="share of the samples below")
    if reply.rows is not None and listed:
        axes[2].plot(reply.rows[:, 0], reply.rows[:, reply.columns.index("restitution")], ".", markersize=2, alpha=0.6)
        axes[2].set(xlabel=reply.columns[0], ylabel="restitution")
    _legend(figure, list(axes))
    return figure


def comparison(compared: "Comparison", figure: Any) -> Any:
    """Every impact joined to its twin over half to two deviations of what was measured (the paper's areas A to D), the
    numbers of sub-impacts, both distributions."""
    figure = _figure(figure, (8.0, 9.0))
    above, middle, below = figure.subplots(3, 1, height_ratios=(2, 1, 1.5))
    speed, ours, theirs = compared.measured.speed, compared.measured.restitution, compared.simulated.restitution
    mean, deviation = compared.measured_mean, compared.measured_deviation
    if deviation > 0.0:
        for i, grey in enumerate(_GREYS):
            half = 0.5 * (4 - i) * deviation
            area = f"{'DCBA'[i]}: {0.5 * (4 - i):g} deviations"
            above.axhspan(mean - half, mean + half, color=grey, linewidth=0, zorder=0, label=area)
        above.axhline(mean, color="#808080", linewidth=0.8, zorder=1)
    above.vlines(speed, ours, theirs, color="#b0b0b0", linewidth=0.8, zorder=2)
    for axes, name in ((above, "restitution"), (middle, "sub_impacts")):
        axes.plot(speed, getattr(compared.measured, name), "o", color="C1", markersize=4, label="measured")
        axes.plot(speed, getattr(compared.simulated, name), "o", color="C0", markersize=6, fillstyle="none", label="simulated")
    for values, colour in ((ours, "C1"), (theirs, "C0")):
        values = np.sort(values[np.isfinite(values)])
        below.step(values, np.arange(1, len(values) + 1) / max(1, len(values)), color=colour, where="post")
    above.set(ylabel="restitution", title=f"{compared.a} on {compared.b}, {len(speed)} impacts")
    middle.set(xlabel="speed, m/s", ylabel="sub-impacts")
    middle.yaxis.get_major_locator().set_params(integer=True)
    below.set(xlabel="restitution", ylabel="share of impacts below")
    _legend(figure, [above])
    return figure
