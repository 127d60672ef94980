"""Results of experiments."""

import csv
import os


def _value(text):
    """Returns a number if the text is one, None if it is empty, and otherwise the text."""
    if text == "":
        return None
    for kind in (int, float):
        try:
            return kind(text)
        except ValueError:
            pass
    return text


def read_runs(folder, file="runs.csv"):
    """Returns the runs of an experiment as a list of dictionaries, as `pandas.DataFrame` takes it.

    `folder` is the output folder of `pharos experiment`. The keys are the columns of runs.csv; with
    `file="convergence.csv"` there is one dictionary per checkpoint of a run. Unknown values are None.
    """
    with open(os.path.join(os.fspath(folder), file), encoding="utf-8", newline="") as table:
        return [{key: _value(text) for key, text in row.items()} for row in csv.DictReader(table)]
