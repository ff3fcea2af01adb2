"""Problems of scipy.optimize."""

import numpy as np
from scipy.optimize import Bounds, LinearConstraint, NonlinearConstraint

from .errors import DesignFailed


def problem(model, objective, constraints=()):
    """Return keywords of scipy.optimize.minimize for a response as the objective and constraints
    (response, lower, upper). The variables are in units of `scale`: x = result.x * model.scale.
    Values of failed designs are infinite."""
    names = [objective, *(name for name, _, _ in constraints)]
    scale = model.scale

    def at(y):
        return model.evaluate(y * scale, gradients=names)

    def value(y):
        try:
            return at(y)[objective], at(y).gradients[objective] * scale
        except DesignFailed:
            return np.inf, np.zeros_like(scale)

    def constraint(name, lower, upper):
        def bound(y):
            try:
                return at(y)[name]
            except DesignFailed:
                return np.inf

        return NonlinearConstraint(bound, lower, upper,
                                   jac=lambda y: (at(y).gradients[name] * scale)[None, :])

    rows = [LinearConstraint(np.array(limit["row"])[None, :] * scale, -np.inf, limit["bound"])
            for limit in model.limits]
    return {"fun": value, "jac": True, "x0": model.start / scale,
            "bounds": Bounds(model.lower / scale, model.upper / scale, keep_feasible=True),
            "constraints": [*(constraint(*given) for given in constraints), *rows]}
