#!/usr/bin/python3
"""Speak the protocol of `snug --serve` for formulas of two design variables."""

import json
import sys

stiffness, requests = 1., 0


def answer(request):
    global stiffness
    do = request["do"]
    if do == "describe":
        return {"variables": [{"name": f"face[{i}]", "lower": -1., "upper": 1., "start": 0.,
                               "scale": .5 - .25 * i, "unit": "mm"} for i in range(2)],
                "limits": [{"row": [1., -1.], "bound": 1.5, "entry": "Shape/Maximum slope"}],
                "load_cases": [], "responses": [{"name": "energy"}, {"name": "size"}]}
    if do == "set":
        entry, value = next(iter(request["entries"].items()))
        if entry != "Body/Stiffness":
            return {"error": {"kind": "input", "message": f"no entry '{entry}'", "line": 3,
                              "entry": entry, "value": value, "allowed": "Body/Stiffness"}}
        stiffness = float(value)
        return {"rebuilt": ["problem"]}
    if do == "write":
        return {"x": request["x"], "directory": "output", "files": ["a.csv", "b/c.vtu"]}
    x, y = request["x"]
    if max(abs(x), abs(y)) > 1. or x - y > 1.5:
        return {"error": {"kind": "request", "message": "outside"}}
    if x > .9:
        return {"error": {"kind": "tangled", "message": "the mesh is tangled"}}
    if y == -1.:
        print("a fault", file=sys.stderr, flush=True)
        sys.exit(5)
    if y == -.875:
        sys.stdin.readline()  # no answer
    rows = {"energy": [stiffness * (2. * (x - 1.) + y), stiffness * (4. * (y + .5) + x)],
            "size": [2. * x, 2. * y]}
    wanted = request["gradients"]
    names = list(rows) if wanted is True else wanted or []
    energy = stiffness * ((x - 1.) ** 2 + 2. * (y + .5) ** 2 + x * y)
    case = {"name": "", "certificate": 1e-9}
    contact = {"load_case": "", "pair": "a: b", "position": [[0., 1.]], "normal": [[0., 1.]],
               "pressure": [2.], "gap": [0.], "force": [2.], "area": [1.], "status": ["closed"]}
    return {"x": [x, y], "values": {"energy": energy, "size": x * x + y * y},
            "gradients": {name: rows[name] for name in names}, "load_cases": [case],
            "objective": {"value": energy}, "constraints": [], "drift": 0.,
            "work": {"f_mults": requests}, **({"contact": [contact]} if request["contact"] else {}),
            **({"errors": {"energy": .5}} if request["errors"] else {})}


sys.stderr.write("a long log\n" * 20000)  # more than a pipe holds
if "--set" in sys.argv:
    name, _, text = sys.argv[-1].partition("=")
    if name != "Body/Stiffness":
        print(f"model.prm: no entry '{name}'", file=sys.stderr)
        sys.exit(2)
    stiffness = float(text)
print(json.dumps({"protocol": "snug-1", "ready": True}), flush=True)
for line in sys.stdin:
    requests += 1
    given = json.loads(line)
    print(json.dumps({"id": given["id"], **answer(given)}), flush=True)
