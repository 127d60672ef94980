"""Runs the code of the notebooks and compares what it prints with what they show."""

import contextlib
import importlib.util
import io
import json
import os
import pathlib
import unittest

NOTEBOOKS = pathlib.Path(os.environ["PHAROS_SOURCE"]) / "docs" / "notebooks"

# Processors round differently, so that single paths differ, and what guides learn from them.
TOLERANCE = 0.25


def shown_text(cell):
    """Returns what a cell printed when the notebook was saved."""
    return "".join("".join(output["text"]) for output in cell["outputs"]
                   if output["output_type"] == "stream")


def words(text):
    """Returns the words of a text without the brackets of arrays."""
    return text.replace("[", " ").replace("]", " ").split()


def run(code, names):
    """Runs the code of a cell with the names of the cells before, and returns what it prints."""
    printed = io.StringIO()
    with contextlib.redirect_stdout(printed):
        exec(compile(code, "cell", "exec"), names)
    return printed.getvalue()


@unittest.skipUnless(importlib.util.find_spec("matplotlib"), "matplotlib is not installed")
class NotebookTest(unittest.TestCase):
    def test_notebooks_print_what_they_show(self):
        notebooks = sorted(NOTEBOOKS.glob("*.ipynb"))
        self.assertTrue(notebooks)
        numbers = 0
        for notebook in notebooks:
            os.chdir(notebook.parent)
            names = {}
            for cell in json.loads(notebook.read_text(encoding="utf-8"))["cells"]:
                if cell["cell_type"] == "code":
                    text = run("".join(cell["source"]), names)
                    numbers += self.compare(words(text), words(shown_text(cell)))
        self.assertGreater(numbers, 10)

    def compare(self, printed, shown):
        """Compares words. Returns how many of them are numbers."""
        self.assertEqual(len(printed), len(shown), f"{printed} {shown}")
        numbers = 0
        for word, expected in zip(printed, shown):
            try:
                value = float(expected)
            except ValueError:
                self.assertEqual(word, expected)
                continue
            self.assertAlmostEqual(float(word), value, delta=TOLERANCE * abs(value))
            numbers += 1
        return numbers


if __name__ == "__main__":
    unittest.main()
