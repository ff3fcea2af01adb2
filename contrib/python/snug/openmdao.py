"""Snug as a component of OpenMDAO."""

import re

import openmdao.api as om

from .errors import DesignFailed
from .model import Model


class SnugComp(om.ExplicitComponent):
    """The design is the input `x`; each response is an output. Characters of names that OpenMDAO
    does not take are underscores. Designs that fail raise AnalysisError."""

    def initialize(self):
        self.options.declare("model", types=Model, recordable=False)
        self.options.declare("responses", default=None, desc="names, all by default")

    def setup(self):
        model = self.options["model"]
        names = list(self.options["responses"] or model.responses)
        self.outputs = {name: re.sub(r"\W", "_", name) for name in names}
        self.add_input("x", val=model.start)
        for output in self.outputs.values():
            self.add_output(output)
        self.declare_partials("*", "x")

    def result(self, inputs, gradients=False):
        try:
            return self.options["model"].evaluate(inputs["x"], gradients=gradients)
        except DesignFailed as error:
            raise om.AnalysisError(str(error)) from error

    def compute(self, inputs, outputs):
        result = self.result(inputs)
        for name, output in self.outputs.items():
            outputs[output] = result[name]

    def compute_partials(self, inputs, partials):
        result = self.result(inputs, list(self.outputs))
        for name, output in self.outputs.items():
            partials[output, "x"] = result.gradients[name]
