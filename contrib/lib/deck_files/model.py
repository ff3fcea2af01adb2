"""Models of which decks are written in the manner of several pre-processors.

A model has parts with materials, named sets of nodes and faces, contacts, and steps whose lines
name the sets. Keywords are written in upper case here, and by each pre-processor in its manner."""

import collections

STEEL = {"ELASTIC": "210000., 0.3", "DENSITY": "7.8E-9", "EXPANSION": "1.2E-5"}
# name: that of a step, or ""; lines: its data after *STATIC
Step = collections.namedtuple("Step", "lines name static", defaults=["", ""])
# Where a displacement is compared: node, component from 0
Probe = collections.namedtuple("Probe", "node component")


class Model:
    """This class is a model of a deck. The lines between sections and steps are in before, those of
    CalculiX that differ in ccx_lines: {old: new}, and further *ELEMENT lines in extra_elements."""

    def __init__(self, *parts, materials=None, before=""):
        self.parts, self.before, self.steps = parts, before, []
        self.materials = materials or {"STEEL": STEEL}
        self.node_sets, self.surfaces, self.element_sets = {}, {}, {}  # name -> (part, members)
        self.probes, self.ccx_lines, self.extra_elements = [], {}, ""

    def nodes(self, name, part, **where):
        """Define a set of nodes."""
        self.node_sets[name] = (part, part.on(**where))
        assert self.node_sets[name][1], name
        return name

    def surface(self, name, part, **where):
        """Define a surface."""
        self.surfaces[name] = (part, part.faces(**where))
        assert self.surfaces[name][1], name
        return name

    def dload(self, part, value, **where):
        """Return lines of *DLOAD with a pressure for the faces, one for each element."""
        return "".join(f"{e}, P{k}, {value}\n" for e, k, *_ in part.faces(**where))

    def probe(self, part, component, **where):
        """Compare a component of the displacement of the node with these coordinates."""
        node, = part.on(**where)
        self.probes.append(Probe(node, "xyz".index(component)))

    def position(self, node):
        part, = (part for part in self.parts if node in part.nodes)
        return part.nodes[node][:part.dim]

    def faces_by_number(self, name):
        """Return {number of a face: elements} of a surface."""
        result = {}
        for e, k, *_ in self.surfaces[name][1]:
            result.setdefault(k, []).append(e)
        return result


def pair(interaction, slave, master, friction=None, stiffness=0., options=""):
    """Return the lines of a contact pair. With a stiffness it is a penalty of CalculiX."""
    law = ("*SURFACE BEHAVIOR, PRESSURE-OVERCLOSURE=" +
           (f"LINEAR\n{stiffness:.6E}\n" if stiffness else "HARD\n"))
    slope = f", {stiffness / 10.:.6E}" if stiffness else ""
    return (f"*SURFACE INTERACTION, NAME={interaction}\n{law}" +
            (f"*FRICTION\n{friction}{slope}\n" if friction else "") +
            f"*CONTACT PAIR, INTERACTION={interaction}, TYPE=SURFACE TO SURFACE{options}\n"
            f"{slave}, {master}\n")
