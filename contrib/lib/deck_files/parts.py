"""Structured meshes of decks: blocks of cells of one type, numbered, and placed by a formula."""

import itertools
import math

# Corners of the faces S1, S2, ... of each shape
FACES = {"quad": [(0, 1), (1, 2), (2, 3), (3, 0)],
         "tet": [(0, 1, 2), (0, 3, 1), (1, 3, 2), (2, 3, 0)],
         "wedge": [(0, 1, 2), (3, 5, 4), (0, 3, 4, 1), (1, 4, 5, 2), (2, 5, 3, 0)],
         "hex": [(0, 1, 2, 3), (4, 7, 6, 5), (0, 4, 5, 1), (1, 5, 6, 2), (2, 6, 7, 3),
                 (3, 7, 4, 0)]}
# Edges with a middle node, in the order of Abaqus
EDGES = {"quad": [(0, 1), (1, 2), (2, 3), (3, 0)],
         "tet": [(0, 1), (1, 2), (2, 0), (0, 3), (1, 3), (2, 3)],
         "wedge": [(0, 1), (1, 2), (2, 0), (3, 4), (4, 5), (5, 3), (0, 3), (1, 4), (2, 5)],
         "hex": [(0, 1), (1, 2), (2, 3), (3, 0), (4, 5), (5, 6), (6, 7), (7, 4), (0, 4), (1, 5),
                 (2, 6), (3, 7)]}
# Element type, of plane models the number of nodes -> shape and degree
SHAPES = {"C3D8": ("hex", 1), "C3D20": ("hex", 2), "C3D4": ("tet", 1), "C3D10": ("tet", 2),
          "C3D6": ("wedge", 1), "C3D15": ("wedge", 2), "4": ("quad", 1), "8": ("quad", 2)}
HEXAHEDRON = [(x, y, z) for z in (0, 1) for x, y in ((0, 0), (1, 0), (1, 1), (0, 1))]


def shape_of(kind):
    """Return the shape of an element type, such as C3D20R or CPS4I, and its degree."""
    base = kind.rstrip("RI")
    return SHAPES[base if base in SHAPES else base[3:]]


def tetrahedra():
    """Return the corners of the six tetrahedra along a diagonal of a cube."""
    for order in itertools.permutations(range(3)):
        points = [(0, 0, 0)]
        for axis in order:
            points.append(tuple(x + (d == axis) for d, x in enumerate(points[-1])))
        if order in [(0, 1, 2), (1, 2, 0), (2, 0, 1)]:
            yield points
        else:
            yield [points[1], points[0], points[2], points[3]]


def cells_of_cube(shape):
    """Return lists of corners that divide a cube, or a square."""
    if shape == "quad":
        return [HEXAHEDRON[:4]]
    if shape == "hex":
        return [HEXAHEDRON]
    if shape == "tet":
        return list(tetrahedra())
    return [[HEXAHEDRON[i] for i in corners]
            for corners in ((0, 1, 2, 4, 5, 6), (0, 2, 3, 4, 6, 7))]


class Part:
    """This class is a block of cells. Sets of nodes and faces are chosen by coordinates of the
    block before its nodes are placed: part.on(x=0, y=1), part.faces(z=2)."""

    def __init__(self, kind, cells, size, corner=(0., 0., 0.), first=1, place=None, **options):
        self.kind, self.first = kind, first
        self.material = options.get("material", "STEEL")
        self.shift = options.get("shift", (0., 0., 0.))  # of the instance
        self.thickness = options.get("thickness")
        self.shape, self.degree = shape_of(kind)
        self.dim = 2 if self.shape == "quad" else 3
        cells = (*cells, 0)[:3] if self.dim == 2 else cells
        elements = []
        for cell in itertools.product(*(range(max(1, n)) for n in cells)):
            for corners in cells_of_cube(self.shape):
                doubled = [tuple(2 * (a + b) for a, b in zip(cell, x)) for x in corners]
                if self.degree == 2:
                    doubled += [tuple((a + b) // 2 for a, b in zip(doubled[i], doubled[j]))
                                for i, j in EDGES[self.shape]]
                elements.append(doubled)
        grid = sorted({x for element in elements for x in element}, key=lambda x: x[::-1])
        number = {x: first + i for i, x in enumerate(grid)}
        self.elements = {first + i: [number[x] for x in element]
                         for i, element in enumerate(elements)}
        self.block = {number[x]: tuple(
            c + (i * s / (2. * n) if n else 0.) for c, i, s, n in zip(
                (*corner, 0.)[:3], x, (*size, 0.)[:3], cells)) for x in grid}
        placed = place or (lambda *x: x)
        self.own_nodes = {n: tuple(placed(*x)) for n, x in self.block.items()}
        self.nodes = {n: tuple(a + b for a, b in zip(x, self.shift))
                      for n, x in self.own_nodes.items()}

    def is_at(self, node, where):
        """Return whether the coordinates of a node have these values, or values of these lists."""
        return all(any(abs(self.block[node]["xyz".index(axis)] - value) < 1e-9 for value in (
            values if isinstance(values, (list, tuple)) else [values]))
                   for axis, values in where.items())

    def on(self, **where):
        """Return the nodes with these coordinates in the block."""
        return [n for n in self.block if self.is_at(n, where)]

    def middles(self, corners):
        """Return the nodes in the middle of the edges of a face, in the order of its corners."""
        ends = list(zip(corners, corners[1:] + corners[:1]))
        nodes = next(nodes for nodes in self.elements.values() if set(corners) <= set(nodes))
        n = len(nodes) - len(EDGES[self.shape])
        middle = {frozenset((nodes[i], nodes[j])): nodes[n + k]
                  for k, (i, j) in enumerate(EDGES[self.shape])}
        return [middle[frozenset(end)] for end in ends]

    def faces(self, **where):
        """Return (element, number of the face, corners, middle nodes) of the faces with these
        coordinates in the block."""
        result = []
        for e, nodes in self.elements.items():
            for k, corners in enumerate(FACES[self.shape]):
                if all(self.is_at(nodes[c], where) for c in corners):
                    n = len(nodes) - len(EDGES[self.shape])
                    middles = [nodes[n + i] for i, edge in enumerate(EDGES[self.shape])
                               if self.degree == 2 and set(edge) <= set(corners)]
                    result.append((e, k + 1, [nodes[c] for c in corners], middles))
        return result

    def area(self, corners):
        """Return the area of a plane face, in 2D the length of an edge."""
        x = [self.nodes[n] for n in corners]
        if len(x) == 2:
            return math.dist(*x)

        def doubled(a, b, c):
            u, v = ([q - p for p, q in zip(a, other)] for other in (b, c))
            return math.hypot(u[1] * v[2] - u[2] * v[1], u[2] * v[0] - u[0] * v[2],
                              u[0] * v[1] - u[1] * v[0])
        return .5 * sum(doubled(x[0], x[i], x[i + 1]) for i in range(1, len(x) - 1))

    def forces(self, traction, **where):
        """Return {node: force} of a constant traction on plane faces, parallelograms or
        triangles."""
        result = {}
        for _, _, corners, middles in self.faces(**where):
            n = len(corners)
            weights = [(corners, {2: 1 / 6, 3: 0., 4: -1 / 12}[n] if middles else 1 / n),
                       (middles, {2: 2 / 3, 3: 1 / 3, 4: 1 / 3}[n])]
            size = self.area(corners) * (self.thickness or 1.)
            for nodes, weight in weights:
                for node in nodes:
                    force = result.setdefault(node, [0., 0., 0.])
                    for d, t in enumerate(traction):
                        force[d] += weight * size * t
        return result

    def cloads(self, traction, **where):
        """Return the data lines of *CLOAD of a constant traction."""
        return "".join(f"{n},{d + 1},{f:.13E}\n"
                       for n, force in sorted(self.forces(traction, **where).items())
                       for d, f in enumerate(force) if f)
