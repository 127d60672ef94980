"""Pharos from Python: renders, comparisons, learned densities and samplers as numpy arrays.

Images are float arrays of height x width x channels with linear radiance, the upper row first.
"""

from .exceptions import InputError, Interrupted, RunError
from .runs import read_runs
from ._pharos import (
    GuidingModel,
    Integrand,
    Sampler,
    __version__,
    compare,
    errors,
    plugins,
    read_image,
    render,
    validate,
)

__all__ = [
    "GuidingModel",
    "InputError",
    "Integrand",
    "Interrupted",
    "RunError",
    "Sampler",
    "compare",
    "errors",
    "plugins",
    "read_image",
    "read_runs",
    "render",
    "validate",
]
