"""Plots of experiments, as vector graphics for papers.

    python3 -m pharos.plots FOLDER -o convergence.pdf

Needs matplotlib.
"""

import argparse

import numpy as np

from .runs import read_runs

LABELS = {
    "mse": "MSE",
    "capped_mse": "capped MSE",
    "relative_mse": "relMSE",
    "trimmed_relative_mse": "trimmed relMSE",
    "samples_per_pixel": "samples per pixel",
    "seconds": "time [s]",
}
METRICS = ("mse", "capped_mse", "relative_mse", "trimmed_relative_mse")
AXES = ("seconds", "samples_per_pixel")


def mean_curve(curves, count=64):
    """Returns the geometric mean of curves, and the standard error of its natural logarithm.

    A curve is a pair of arrays: work and error, both positive, with increasing work. The result has the
    work that all curves have in common, in `count` places on a logarithmic axis, between which errors
    are interpolated on logarithmic axes. The standard error of a single curve is zero. Returns None if
    the curves have no work in common.
    """
    logs = [(np.log(work), np.log(error)) for work, error in curves]
    low, high = max(work[0] for work, _ in logs), min(work[-1] for work, _ in logs)
    if low > high:
        return None
    places = np.linspace(low, high, count)
    errors = np.array([np.interp(places, work, error) for work, error in logs])
    spread = errors.std(axis=0, ddof=1) if len(curves) > 1 else np.zeros(count)
    return np.exp(places), np.exp(errors.mean(axis=0)), spread / np.sqrt(len(curves))


def curves_of(records, axis, metric):
    """Returns dictionaries by scene and by method of lists of curves, one for each seed."""
    points = {}
    for r in records:
        if r[metric] and r[metric] > 0 and r[axis] > 0:
            seeds = points.setdefault(r["scene"], {}).setdefault(r["method"], {})
            seeds.setdefault(r["seed"], []).append((r[axis], r[metric]))
    return {
        scene: {method: [tuple(np.array(sorted(p)).T) for p in seeds.values()]
                for method, seeds in methods.items()}
        for scene, methods in points.items()
    }


def draw_method(panel, method, color, curves):
    """Draws the mean of curves with its band and a mark at its end, or the points of all of them."""
    mean = mean_curve(curves)
    if mean is None:
        panel.loglog(*np.concatenate(curves, axis=1), "x", label=method, color=color)
        return
    work, error, spread = mean
    panel.loglog(work, error, label=method, color=color)
    panel.loglog(work[-1:], error[-1:], "o", markersize=4, color=color)
    panel.fill_between(work, error * np.exp(-2 * spread), error * np.exp(2 * spread),
                       color=color, alpha=0.2, linewidth=0)


def plot_convergence(folder, metric="relative_mse", axis="seconds", columns=4):
    """Plots errors over work, with one panel per scene, and returns a figure of matplotlib.

    `folder` is the output folder of an experiment. Lines are geometric means over seeds; bands are two
    standard errors of the logarithm. If the seeds of a method have no work in common, their points are
    drawn as crosses. Save the figure by `savefig("name.pdf")` or `savefig("name.svg")`. Raises OSError
    if there are no results, and ValueError if none has the metric.
    """
    import matplotlib.pyplot as plt

    scenes = curves_of(read_runs(folder, "convergence.csv"), axis, metric)
    if not scenes:
        raise ValueError(f"{folder}: no run has checkpoints with the metric '{metric}'")
    methods = list(dict.fromkeys(method for of_scene in scenes.values() for method in of_scene))
    colors = {method: f"C{i}" for i, method in enumerate(methods)}
    rows = -(-len(scenes) // columns)
    width = min(columns, len(scenes))
    figure, panels = plt.subplots(rows, width, figsize=(3 * width, 2.6 * rows), squeeze=False)
    for panel, (scene, curves) in zip(panels.flat, scenes.items()):
        for method in curves:
            draw_method(panel, method, colors[method], curves[method])
        panel.set_title(scene)
        panel.set_xlabel(LABELS[axis])
        panel.set_ylabel(LABELS[metric])
    for panel in panels.flat[len(scenes):]:
        panel.set_visible(False)
    figure.tight_layout()
    lines = {line.get_label(): line for panel in panels.flat for line in panel.lines}
    figure.legend([lines[method] for method in methods], methods, loc="lower center",
                  bbox_to_anchor=(0.5, 1), ncol=4)
    return figure


def main():
    parser = argparse.ArgumentParser(prog="python3 -m pharos.plots", description="Plots an experiment's convergence.")
    parser.add_argument("folder", help="output folder of an experiment")
    parser.add_argument("-o", "--output", required=True, help="file whose name ends in .pdf, .svg or .png")
    parser.add_argument("--metric", choices=METRICS, default="relative_mse")
    parser.add_argument("--axis", choices=AXES, default="seconds")
    arguments = parser.parse_args()
    try:
        figure = plot_convergence(arguments.folder, arguments.metric, arguments.axis)
        figure.savefig(arguments.output, bbox_inches="tight")
    except (OSError, ValueError) as error:
        parser.error(str(error))


if __name__ == "__main__":
    main()
