"""Serve Snug as a Tesseract: `tesseract-runtime serve` with the variable TESSERACT_API_PATH set to this
file, or Tesseract.from_tesseract_api("tesseract_api.py") in Python (package tesseract-core[runtime]).

The variable SNUG_MODEL names the parameter file, SNUG_RESPONSES the responses, separated by commas. The
endpoints are apply, jacobian_vector_product, vector_jacobian_product and abstract_eval.
"""

import functools
import os

import numpy as np
from pydantic import BaseModel
from tesseract_core.runtime import Array, Differentiable, Float64

import snug


class InputSchema(BaseModel):
    x: Differentiable[Array[(None,), Float64]]


class OutputSchema(BaseModel):
    responses: Differentiable[Array[(None,), Float64]]


NAMES = os.environ["SNUG_RESPONSES"].split(",")


@functools.cache
def model():
    return snug.Model(os.environ["SNUG_MODEL"])


def rows(inputs):
    """Return the matrix of derivatives of the responses with respect to the design."""
    gradients = model().evaluate(inputs.x, gradients=NAMES).gradients
    return np.array([gradients[name] for name in NAMES])


def apply(inputs: InputSchema) -> OutputSchema:
    result = model().evaluate(inputs.x)
    return OutputSchema(responses=np.array([result[name] for name in NAMES]))


def jacobian_vector_product(inputs: InputSchema, jvp_inputs: set[str], jvp_outputs: set[str],
                            tangent_vector):
    return {"responses": rows(inputs) @ tangent_vector["x"]}


def vector_jacobian_product(inputs: InputSchema, vjp_inputs: set[str], vjp_outputs: set[str],
                            cotangent_vector):
    return {"x": cotangent_vector["responses"] @ rows(inputs)}


def abstract_eval(abstract_inputs):
    return {"responses": {"shape": (len(NAMES),), "dtype": "float64"}}
