"""Results of experiments."""

import csv
import os


TEXTS = ("scene", "method", "measure", "unit", "version")


def _value(key, text):
    """Returns the value of a field: a text, a number, or None if a number is unknown."""
    if key in TEXTS:
        return text
    if text == "":
        return None
    return int(text) if text.lstrip("-").isdigit() else float(text)


def read_runs(folder, file="runs.csv"):
    """Returns the runs of an experiment as a list of dictionaries, as `pandas.DataFrame` takes it.

    `folder` is the output folder of `pharos experiment`. The keys are the columns of runs.csv; with
    `file="measures.csv"` there is one dictionary per run and measure, and with `file="convergence.csv"`
    one per checkpoint of a run. Unknown numbers are None. Raises OSError if there is no such file.
    """
    with open(os.path.join(os.fspath(folder), file), encoding="utf-8", newline="") as table:
        return [{key: _value(key, text) for key, text in row.items()} for row in csv.DictReader(table)]
