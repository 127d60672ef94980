"""Tests of the plots of experiments. They need numpy and matplotlib."""

import importlib.util
import os
import pathlib
import subprocess
import sys
import tempfile
import unittest

import numpy as np

from pharos import plots

HEADER = "scene,method,seed,samples_per_pixel,seconds,mse,capped_mse,relative_mse,trimmed_relative_mse\n"


def write_runs(folder):
    """Writes runs of two methods and three seeds whose errors fall with the number of samples."""
    lines = [HEADER]
    for scene in ("box", "hall"):
        for method, factor in (("path", 4.0), ("guided", 1.0)):
            for seed in (1, 2, 3):
                for n in (1, 2, 4, 8):
                    error = factor * (1 + 0.1 * seed) / n
                    lines.append(f"{scene},{method},{seed},{n},{0.1 * n},{error},{error},{error},\n")
    pathlib.Path(folder, "convergence.csv").write_text("".join(lines), encoding="utf-8")


class MeanCurveTest(unittest.TestCase):
    def test_power_laws_stay_power_laws(self):
        work = np.array([1.0, 2, 4, 8])
        places, mean, error = plots.mean_curve([(work, 4 / work), (2 * work, 1 / (2 * work))])
        self.assertAlmostEqual(places[0], 2)
        self.assertAlmostEqual(places[-1], 8)
        np.testing.assert_allclose(mean, 2 / places)
        np.testing.assert_allclose(error, np.log(2))  # logarithms differ by log 4: deviation log(4)/sqrt(2)

    def test_curves_without_common_work(self):
        self.assertIsNone(plots.mean_curve([(np.array([1.0, 2]), np.array([1.0, 1])),
                                            (np.array([3.0, 4]), np.array([1.0, 1]))]))


@unittest.skipUnless(importlib.util.find_spec("matplotlib"), "matplotlib is not installed")
class PlotTest(unittest.TestCase):
    def test_panels_lines_and_unknown_values(self):
        with tempfile.TemporaryDirectory() as folder:
            write_runs(folder)
            figure = plots.plot_convergence(folder, metric="mse", axis="samples_per_pixel")
            self.assertEqual([panel.get_title() for panel in figure.axes], ["box", "hall"])
            guided = {line.get_label(): line for line in figure.axes[0].lines}["guided"]
            np.testing.assert_allclose(guided.get_ydata() * guided.get_xdata(), (1.1 * 1.2 * 1.3) ** (1 / 3))
            with self.assertRaises(ValueError):
                plots.plot_convergence(folder, metric="trimmed_relative_mse")

    def test_colors_are_those_of_the_legend_in_all_panels(self):
        with tempfile.TemporaryDirectory() as folder:
            pathlib.Path(folder, "convergence.csv").write_text(
                HEADER + "box,path,1,1,1,2,,,\nbox,path,2,3,3,1,,,\nbox,guided,1,1,1,1,,,\n"
                "hall,guided,1,1,1,1,,,\nhall,guided,1,2,2,0.5,,,\n", encoding="utf-8")
            figure = plots.plot_convergence(folder, metric="mse")
            box, hall = ({line.get_label(): line for line in panel.lines} for panel in figure.axes)
            self.assertEqual(hall["guided"].get_color(), box["guided"].get_color())
            self.assertNotEqual(box["path"].get_color(), box["guided"].get_color())
            self.assertEqual(box["path"].get_marker(), "x")  # seeds 1 and 2 have no work in common
            labels = [text.get_text() for text in figure.legends[0].texts]
            self.assertEqual(labels, ["path", "guided"])

    def test_files_by_the_command(self):
        with tempfile.TemporaryDirectory() as folder:
            write_runs(folder)
            for name, begin in (("plot.pdf", b"%PDF"), ("plot.svg", b"<?xml")):
                file = os.path.join(folder, name)
                subprocess.run([sys.executable, "-m", "pharos.plots", folder, "-o", file], check=True)
                self.assertTrue(pathlib.Path(file).read_bytes().startswith(begin))
            self.check_refused([folder, "-o", os.path.join(folder, "plot.xyz")], "xyz")
            self.check_refused([folder + "/no", "-o", "x.pdf"], "convergence.csv")

    def check_refused(self, arguments, part):
        refused = subprocess.run([sys.executable, "-m", "pharos.plots", *arguments], capture_output=True, text=True)
        self.assertEqual(refused.returncode, 2)
        self.assertIn(part, refused.stderr)
        self.assertNotIn("Traceback", refused.stderr)


if __name__ == "__main__":
    unittest.main()
