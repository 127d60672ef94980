"""Tests of the Python package, against the program and against numpy."""

import _thread
import json
import os
import pathlib
import signal
import subprocess
import tempfile
import unittest

import numpy as np

import pharos

SOURCE = pathlib.Path(os.environ["PHAROS_SOURCE"])
BOX = SOURCE / "configs" / "cornell-box.yaml"
SMALL = ["film.width=32", "film.height=24", "budget={ spp: 8 }"]

# A lamp over a floor.
LAMP = {
    "scene": {
        "shapes": [
            {"type": "quad", "material": {"type": "diffuse", "reflectance": 0.5},
             "to_world": [{"scale": 2}, {"rotate": {"axis": [1, 0, 0], "degrees": -90}}]},
            {"type": "sphere", "to_world": [{"scale": 0.25}, {"translate": [0, 2, 0]}],
             "emitter": {"type": "area", "radiance": [4, 3, 2]}},
        ],
        "sensor": {"type": "perspective",
                   "to_world": {"look_at": {"origin": [0, 3, -6], "target": [0, 0.5, 0],
                                             "up": [0, 1, 0]}}},
    },
    "film": {"width": 24, "height": 16},
    "budget": {"spp": 4},
}


def with_guides(config, model=None):
    guided = {
        **config,
        "budget": {"spp": 32},
        "integrator": {"type": "path", "guiding": {"methods": [
            {"learner": "practical_path_guiding", "guider": "practical_path_guiding"}]}},
    }
    return guided if model is None else {**guided, "output": {"model": model}}


class RenderTest(unittest.TestCase):
    def test_a_file_renders_to_the_bits_of_the_program(self):
        with tempfile.TemporaryDirectory() as folder:
            image = os.path.join(folder, "box.exr")
            settings = [part for assignment in SMALL for part in ("--set", assignment)]
            subprocess.run([os.environ["PHAROS_PROGRAM"], "render", BOX, "-q", "-o", image, *settings],
                           check=True)
            by_program = pharos.read_image(image)
        result = pharos.render(BOX, SMALL)
        self.assertEqual(result["image"].shape, (24, 32, 3))
        self.assertEqual(result["image"].dtype, np.float32)
        np.testing.assert_array_equal(result["image"], by_program["image"])
        self.assertGreater(result["image"].mean(), 0)

    def test_results_do_not_depend_on_threads(self):
        one = pharos.render(LAMP, threads=1)
        three = pharos.render(LAMP, threads=3)
        np.testing.assert_array_equal(one["image"], three["image"])

    def test_layers_and_metadata(self):
        result = pharos.render(LAMP)
        self.assertEqual(result["albedo"].shape, (16, 24, 3))
        self.assertEqual(result["depth"].shape, (16, 24))
        np.testing.assert_allclose(result["albedo"][10, 12], [0.5] * 3, rtol=1e-5)
        facts = result["metadata"]
        self.assertEqual(facts["samples_per_pixel"], 4)
        self.assertEqual(facts["paths"], 4 * 24 * 16)
        self.assertFalse(facts["stopped"])
        self.assertEqual(facts["config"]["film"]["width"], 24)
        self.assertEqual(result["models"], [])

    def test_dictionaries_extend_files(self):
        config = {"extends": str(BOX), "film": {"width": 32, "height": 24}, "budget": {"spp": 8}}
        np.testing.assert_array_equal(pharos.render(config)["image"], pharos.render(BOX, SMALL)["image"])

    def test_numpy_values_are_settings(self):
        config = {**LAMP, "film": {"width": np.int64(8), "height": 8}, "seed": np.int32(3)}
        config["scene"] = {**LAMP["scene"], "emitters": [
            {"type": "constant", "radiance": np.array([0.1, 0.2, 0.3])}]}
        resolved = pharos.validate(config)
        self.assertEqual(resolved["seed"], 3)
        self.assertEqual(resolved["film"]["width"], 8)

    def test_progress_is_called_and_ends_the_render(self):
        calls = []

        def stop(progress):
            calls.append(progress)
            return False

        result = pharos.render(LAMP, ["budget={ seconds: 60 }"], progress=stop)
        self.assertTrue(result["metadata"]["stopped"])
        self.assertLess(result["metadata"]["seconds"], 30)
        self.assertGreaterEqual(calls[0]["fraction"], 0)

    def test_an_error_of_the_callback_ends_the_render(self):
        def fail(progress):
            raise KeyError("mine")

        with self.assertRaises(KeyError):
            pharos.render(LAMP, ["budget={ seconds: 60 }"], progress=fail)

    def test_ctrl_c_keeps_the_samples(self):
        def interrupt(progress):
            if progress["samples_per_pixel"] > 0:
                _thread.interrupt_main()

        # Shells start background jobs with Ctrl-C ignored.
        signal.signal(signal.SIGINT, signal.default_int_handler)
        with self.assertRaises(pharos.Interrupted) as caught:
            pharos.render(LAMP, ["budget={ seconds: 60 }"], progress=interrupt)
        result = caught.exception.result
        self.assertTrue(result["metadata"]["stopped"])
        self.assertGreater(result["metadata"]["samples_per_pixel"], 0)
        self.assertGreater(result["image"].mean(), 0)
        self.assertIsInstance(caught.exception, KeyboardInterrupt)


class ErrorTest(unittest.TestCase):
    def error(self, config, overrides=()):
        with self.assertRaises(pharos.InputError) as caught:
            pharos.validate(config, list(overrides))
        return caught.exception

    def test_files_have_line_and_column(self):
        with tempfile.TemporaryDirectory() as folder:
            file = os.path.join(folder, "wrong.yaml")
            with open(file, "w", encoding="utf-8") as config:
                config.write(f"extends: {BOX}\nfilm: {{ width: 0 }}\n")
            error = self.error(file)
        self.assertEqual((error.file, error.line, error.column), (file, 2, 16))
        self.assertIn("width must be >= 1", str(error))
        self.assertNotIn("\n", str(error))
        self.assertIsInstance(error, ValueError)

    def test_dictionaries_have_the_path_of_keys(self):
        error = self.error({**LAMP, "film": {"width": -1}})
        self.assertEqual((error.file, error.line), ("film.width", None))

    def test_all_flaws_are_listed(self):
        scene = {**LAMP["scene"], "shapes": [{"type": "spere"}, {"type": "quad", "origin": 3}]}
        error = self.error({**LAMP, "scene": scene})
        self.assertEqual(len(error.flaws), 2)
        self.assertIn("did you mean 'sphere'?", error.flaws[0])
        self.assertEqual(error.flaws[0], str(error))

    def test_values_of_other_types(self):
        self.assertIn("a value of type object", str(self.error({**LAMP, "seed": object()})))
        self.assertIn("finite", str(self.error({**LAMP, "seed": float("nan")})))
        self.assertIn("strings", str(self.error({1: 2})))
        endless = {}
        endless["film"] = endless
        self.assertIn("64 levels", str(self.error(endless)))
        with self.assertRaises(pharos.InputError):
            pharos.render(5)

    def test_arrays_of_wrong_shape(self):
        with self.assertRaises(pharos.InputError):
            pharos.errors(np.zeros((4, 4, 2)), np.zeros((4, 4, 3)))
        with self.assertRaises(pharos.InputError):
            pharos.errors("no-such-file.exr", np.zeros((4, 4, 3)))
        with self.assertRaises(pharos.InputError):
            pharos.Integrand("disk")(np.zeros((4, 3)))


class MeasureTest(unittest.TestCase):
    def test_errors_are_those_of_numpy(self):
        random = np.random.default_rng(1)
        truth = random.random((20, 30, 3), dtype=np.float32) + 0.5
        a = truth + 0.1 * random.standard_normal(truth.shape).astype(np.float32)
        b = truth + 0.2 * random.standard_normal(truth.shape).astype(np.float32)
        both = pharos.compare(a, b, truth)
        mse = float(((a.astype(float) - truth) ** 2).mean())
        self.assertAlmostEqual(both["a"]["mse"] / mse, 1, places=5)
        self.assertAlmostEqual(both["ratio"]["mse"], both["b"]["mse"] / both["a"]["mse"])
        self.assertEqual(pharos.errors(truth, truth)["mse"], 0)
        self.assertEqual(pharos.errors(a, truth), both["a"])

    def test_gray_images_are_colors(self):
        gray = np.random.default_rng(2).random((6, 5), dtype=np.float32)
        color = np.repeat(gray[:, :, None], 3, axis=2)
        self.assertEqual(pharos.errors(gray, color)["mse"], 0)

    def test_runs_are_records(self):
        with tempfile.TemporaryDirectory() as folder:
            with open(os.path.join(folder, "runs.csv"), "w", encoding="utf-8") as table:
                table.write("scene,seed,mse,gain\n1e5,1,0.5,\nbox,2,inf,-3\n")
            self.assertEqual(pharos.read_runs(folder),
                             [{"scene": "1e5", "seed": 1, "mse": 0.5, "gain": None},
                              {"scene": "box", "seed": 2, "mse": float("inf"), "gain": -3}])


class ModelTest(unittest.TestCase):
    def test_a_saved_model_has_the_densities_of_the_render(self):
        learned = pharos.render(with_guides(LAMP))["models"][0]
        with tempfile.TemporaryDirectory() as folder:
            file = os.path.join(folder, "lamp.model")
            config = os.path.join(folder, "lamp.exr")
            with self.assertRaises(pharos.InputError):
                pharos.GuidingModel(file)
            self.write_model(with_guides(LAMP, file), config, folder)
            saved = pharos.GuidingModel(file)
            with self.assertRaises(pharos.InputError):
                pharos.GuidingModel(file, index=7)
        self.assertEqual(saved.learner, "practical_path_guiding")
        points = np.random.default_rng(3).uniform(-1, 1, (50, 3))
        directions = np.random.default_rng(4).standard_normal((50, 3))
        densities = saved.density(points, directions)
        np.testing.assert_array_equal(densities, learned.density(points, directions))
        self.assertGreater(densities.max(), 0)
        each = [saved.density(p, d)[0] for p, d in zip(points, directions)]
        np.testing.assert_array_equal(densities, each)
        np.testing.assert_array_equal(saved.density(points[:1], directions),
                                      saved.density(np.repeat(points[:1], 50, axis=0), directions))
        np.testing.assert_array_equal(densities, saved.density(points, 2.0**90 * directions))
        for wrong in (directions[:3], 0 * directions, np.nan * directions):
            with self.assertRaises(pharos.InputError):
                saved.density(points, wrong)

    def test_the_density_over_directions_finds_the_lamp(self):
        alone = ["budget.spp=256", "integrator.next_event_estimation=false"]
        model = pharos.render(with_guides(LAMP), alone)["models"][0]
        toward, away = model.density([[0, 0.01, 0]], [[0, 1, 0], [1, 0.2, 0]])
        self.assertGreater(toward, 2 * away)

    def write_model(self, config, image, folder):
        # JSON is YAML.
        text = json.dumps({**config, "output": {**config["output"], "image": image}})
        file = os.path.join(folder, "lamp.yaml")
        with open(file, "w", encoding="utf-8") as stream:
            stream.write(text)
        subprocess.run([os.environ["PHAROS_PROGRAM"], "render", file, "-q"], check=True)


class LaboratoryTest(unittest.TestCase):
    def test_the_mean_over_points_is_the_integral(self):
        for name in ("disk", "smooth"):
            integrand = pharos.Integrand(name)
            points = pharos.Sampler("sobol").points(4096, seed=5)
            self.assertEqual(points.shape, (4096, 2))
            self.assertAlmostEqual(integrand(points).mean(), integrand.mean, delta=3e-3)

    def test_seeds_give_other_points(self):
        sampler = pharos.Sampler("independent")
        np.testing.assert_array_equal(sampler.points(16), sampler.points(16, seed=1))
        self.assertFalse(np.array_equal(sampler.points(16), sampler.points(16, seed=2)))

    def test_settings_are_keyword_arguments(self):
        with self.assertRaises(pharos.InputError) as caught:
            pharos.Sampler("sobol", scramble="no such")
        self.assertIn("scramble", str(caught.exception))

    def test_plugins(self):
        everything = pharos.plugins()
        self.assertIn("sobol", everything["sampler"])
        self.assertIn("disk", everything["integrand"])
        keys = [p["key"] for p in everything["shape"]["sphere"]["parameters"]]
        self.assertIn("radius", keys)


if __name__ == "__main__":
    unittest.main()
