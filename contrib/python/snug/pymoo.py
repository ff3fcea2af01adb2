"""Problems of pymoo, for several objectives."""

import numpy as np
from pymoo.core.problem import Problem


class SnugProblem(Problem):
    """Minimize the responses `objectives` subject to the limits `at_most` of responses, a
    dictionary, and to the linear limits of the model. The values of failed designs are 1e30;
    `failures` counts them."""

    def __init__(self, model, objectives, at_most=None, processes=1):
        self.model, self.objectives, self.at_most = model, list(objectives), dict(at_most or {})
        self.processes, self.failures = processes, 0
        super().__init__(n_var=len(model.start), n_obj=len(self.objectives), xl=model.lower,
                         xu=model.upper, n_ieq_constr=len(self.at_most) + len(model.limits))

    def _evaluate(self, x, out, *unused, **unused_keys):
        rows = np.array([limit["row"] for limit in self.model.limits]).reshape(-1, self.n_var)
        excess = x @ rows.T - [limit["bound"] for limit in self.model.limits]
        inside = (excess <= 0.).all(axis=1)  # the program refuses the other designs
        values = np.full((len(x), len(self.objectives) + len(self.at_most)), 1e30)
        if inside.any():
            found = self.model.sample(x[inside], self.processes)
            values[inside] = np.array([found[name] for name in [*self.objectives,
                                                                *self.at_most]]).T
        failed = np.isnan(values).any(axis=1)
        self.failures += failed.sum()
        values[failed] = 1e30
        limited = values[:, self.n_obj:] - np.array([*self.at_most.values()])
        out["F"], out["G"] = values[:, :self.n_obj], np.hstack([limited, excess])
