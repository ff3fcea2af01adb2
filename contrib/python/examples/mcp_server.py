"""Serve a model of Snug to agents by the Model Context Protocol.

usage: mcp_server.py FILE.prm ["Subsection/Entry=value"]...

The server speaks on its standard input and output. It needs the packages mcp (version 2), scipy and
matplotlib.
"""

import functools
import io
import sys
import threading
from typing import Any

import matplotlib
from mcp.server import MCPServer
from mcp.server.mcpserver import Image
from mcp.server.mcpserver.exceptions import ToolError
from scipy.optimize import minimize

import snug
import snug.scipy

matplotlib.use("Agg")
import snug.plot  # noqa: E402

server = MCPServer("snug", instructions="Contact shape optimization. Begin with the tool describe.")
model = snug.Model(sys.argv[1], dict(part.split("=", 1) for part in sys.argv[2:]))
lock = threading.Lock()  # tools run in threads, and the model answers one request after the other


def tool(function):
    """Return the function as a tool, whose errors are told to the agent."""
    @functools.wraps(function)
    def answer(*values, **keys):
        try:
            with lock:
                return function(*values, **keys)
        except snug.SnugError as error:
            raise ToolError(str(error)) from error
    return server.tool()(answer)


@tool
def describe() -> dict[str, Any]:
    """Return variables with bounds, responses with units, load cases, objective and constraints."""
    return model.about


@tool
def evaluate(x: list[float] | None = None, gradients: list[str] | None = None) -> dict[str, Any]:
    """Return the responses of a design, of the start design without x, the gradients of the listed
    responses, the largest pressure and contact area of each load case, and warnings."""
    answer = model.evaluate(x, gradients=gradients or False).answer
    return {key: answer.get(key) for key in ("x", "values", "gradients", "load_cases", "warnings")}


@tool
def optimize(objective: str, limits: dict[str, tuple[float, float]] | None = None,
             iterations: int = 50) -> dict[str, Any]:
    """Minimize a response within limits of responses, such as {"volume": [0.9, 1.0]}, by SLSQP from the
    start design. Return the design, its responses, and whether the search converged."""
    problem = snug.scipy.problem(model, objective, [(name, *pair)
                                                    for name, pair in (limits or {}).items()])
    found = minimize(**problem, method="SLSQP", options={"ftol": 1e-9, "maxiter": iterations})
    result = model.evaluate(found.x * model.scale)
    return {"x": result.answer["x"], "values": result.values, "converged": bool(found.success),
            "message": found.message, "evaluations": found.nfev}


@tool
def picture(x: list[float] | None = None, load_case: int = 0) -> Image:
    """Return a picture of the contact pressure of a design, of the start design without x."""
    figure = snug.plot.pressure(model.evaluate(x, contact=True).contact(load_case)).figure
    figure.savefig(file := io.BytesIO(), format="png", dpi=100)
    matplotlib.pyplot.close(figure)
    return Image(data=file.getvalue(), format="png")


server.run("stdio")
