"""Snug as a function of JAX."""

import jax
import numpy as np


def function(model, names):
    """Return the function x -> array of the responses `names`, with derivatives in reverse mode.
    It works in jit and vmap. The numbers of JAX must have 64 bits (jax_enable_x64)."""
    names, n = list(names), len(model.start)

    def values(x):
        result = model.evaluate(np.asarray(x))
        return np.array([result[name] for name in names], x.dtype)

    def with_rows(x):
        result = model.evaluate(np.asarray(x), gradients=names)
        return (np.array([result[name] for name in names], x.dtype),
                np.array([result.gradients[name] for name in names], x.dtype))

    def shape(x, *sizes):
        return jax.ShapeDtypeStruct(sizes, x.dtype)

    @jax.custom_vjp
    def responses(x):
        return jax.pure_callback(values, shape(x, len(names)), x, vmap_method="sequential")

    def forward(x):
        return jax.pure_callback(with_rows, (shape(x, len(names)), shape(x, len(names), n)), x,
                                 vmap_method="sequential")

    responses.defvjp(forward, lambda rows, factors: (factors @ rows,))
    return responses
