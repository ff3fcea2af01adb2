#!/usr/bin/env python3
"""A cost model of one contact state on many ranks, fitted to measurements on few.

usage: scaling.py RANKS COARSE

RANKS and COARSE are the tables of contrib/bench ranks (to 16 ranks, more than there are cores) and
contrib/bench coarse. Prints what was fitted and, in markdown, what it predicts: seconds of a cold
state and megabytes per rank, and what limits it first.

Of n unknowns on p ranks, N = n / UNKNOWNS_PER_SUBDOMAIN subdomains in C clusters, r contact rows:
  setup    c + a n/p + b r          seconds, from cubes and flat bodies on 1 and 2 ranks: c and b
                                    are what every rank does for all
  factors  c n/p
  F-mult   d n/p + s(C) + messages (LATENCY + bytes/BANDWIDTH) + collectives (...) log2 p
  face     f(C)                     the coarse factorization after a change of the active set
  memory   M0 + M1 n/p + M2 r + m(C)
f, s and m are of the coarse problem that each rank keeps, powers of C beyond what was measured.
The two cubes of the predictions have r = (n/6)^(2/3) rows. All other surfaces grow as r.
Clusters need more F-mults. The last table has subdomains that are not joined, C = N: of their
large coarse problem, which a team of ranks shares, f, s and m are multiplied by the ratios of the
largest teams that were measured to one rank, seconds by CORES/members as if each member had its
own core.
"""

import itertools
import math
import sys

from runs import print_head, print_row, read_csv

UNKNOWNS_PER_SUBDOMAIN = 500.  # as Decomposition/Subdomains = auto makes them of cubes
F_MULTS, FACES = 25, 14        # of a cold state of the paper's scene, which do not grow with n
COARSE_SOLVES = 3.5            # per F-mult: projections, amplitudes, feasible forces
LATENCY, BANDWIDTH = 2e-6, 1e10  # of a usual cluster network [s, bytes/s]; assumed, not measured
MEMORY = 4000.                 # MB a rank has; assumed
CORES = 2                      # of the machine that measured: seconds of more ranks say nothing
MODES = 6                      # of a subdomain
# as Decomposition/Subdomains per cluster edge = auto chooses clusters
MOST_SINGLE, MOST_CLUSTERS = 2500, 1000
# F-mults with clusters of so many subdomains per edge over those without, see doc/choices.md; those
# of 5 and more are assumed
MORE_F_MULTS = {1: 1., 2: 1.29, 3: 1.37, 4: 1.48, 5: 1.6, 6: 1.7}
COARSE = {"factorization": "factorization", "solve": "solve", "MB": "memory"}


def cluster_edge(subdomains):
    """Return the number of subdomains along the edge of a cluster."""
    edge = 1
    while subdomains > MOST_SINGLE and subdomains / edge ** 3 > MOST_CLUSTERS:
        edge += 1
    return edge


def contact_rows(n):
    """Return the contact rows of two cubes with n unknowns in all."""
    return (n / 6.) ** (2. / 3.)


def team(parts, p):
    """Return the ranks that share a coarse problem, as Solver/Coarse ranks = 0 chooses them."""
    rows = MODES * parts
    return 1 if rows <= 20000 or p < 4 else min(p, max(4, int(rows / 6000)))


def least_squares(rows, right):
    """Return x with the least |A x - b|, by the normal equations of columns of length one."""
    m = len(rows[0])
    lengths = [math.sqrt(sum(row[j] ** 2 for row in rows)) or 1. for j in range(m)]
    scaled = [[row[j] / lengths[j] for j in range(m)] for row in rows]
    table = [[sum(row[i] * row[j] for row in scaled) for j in range(m)]
             + [sum(row[i] * b for row, b in zip(scaled, right))] for i in range(m)]
    for i in range(m):
        pivot = max(range(i, m), key=lambda k: abs(table[k][i]))
        table[i], table[pivot] = table[pivot], table[i]
        for k in range(m):
            if k != i:
                factor = table[k][i] / table[i][i]
                table[k] = [a - factor * b for a, b in zip(table[k], table[i])]
    return [table[i][m] / table[i][i] / lengths[i] for i in range(m)]


class Power:
    """This class interpolates measured points; beyond them the last two give the exponent."""

    def __init__(self, points):
        self.points = sorted(points)
        (x, y), (u, v) = self.points[-2:]
        self.exponent = math.log(v / y) / math.log(u / x)

    def __call__(self, x):
        if x >= self.points[-1][0]:
            u, v = self.points[-1]
            return v * (x / u) ** self.exponent
        for (a, y), (b, z) in zip(self.points, self.points[1:]):
            if x <= b:
                return y * (x / a) ** (math.log(z / y) / math.log(b / a))
        raise ValueError(x)


class Model:
    """This class has what is fitted to the tables of ranks and of the coarse problem."""

    def __init__(self, ranks, coarse):
        same = [row for row in ranks if row["case"] == "same work"]
        timed = [row for row in same if row["ranks"] <= CORES]
        one, n = timed[0], timed[0]["unknowns"]
        with_flat = timed + [row for row in ranks if row["case"] == "same work, flat"]
        self.setup = least_squares([[1., row["unknowns"] / row["ranks"], row["contact_rows"]]
                                    for row in with_flat], [row["setup"] for row in with_flat])
        self.factors = (one["factorization"] + one["assembly"]) / n
        self.f_mult = one["solve"] / one["f_mults"] / n
        most = max(same, key=lambda row: row["ranks"])
        share = (most["unknowns"] / most["ranks"]) ** (2. / 3.)
        self.messages = most["messages_per_f_mult"]
        self.bytes_per_share = most["message_bytes_per_f_mult"] / share
        self.collectives = most["collectives_per_f_mult"]
        self.bytes_per_subdomain = most["collective_bytes_per_f_mult"] / most["subdomains"]
        alone = [row for row in coarse if row["ranks"] == 1]
        self.coarse = {key: Power([(row["subdomains"], row[key]) for row in alone])
                       for key in COARSE}
        sized = [row for row in ranks if row["case"] in ("same work", "more work in clusters")]
        self.memory = least_squares(
            [[1., row["unknowns"] / row["ranks"], row["contact_rows"]] for row in sized],
            [row["MB_solve"] - self.coarse["MB"](row["clusters"]) for row in sized])
        largest = max(alone, key=lambda row: row["subdomains"])
        self.teams = {int(row["ranks"]): {
            key: row[key] / largest[key] * (1. if key == "MB" else min(1., CORES / row["ranks"]))
            for key in COARSE}
            for row in coarse if row["subdomains"] == largest["subdomains"]}

    def of_coarse(self, key, parts, p):
        """Return seconds or megabytes of the coarse problem of clusters or single subdomains, of a
        team at most as large as the largest measured."""
        members = team(parts, p)
        share = self.teams[max(size for size in self.teams if size <= members)]
        return share[key] * self.coarse[key](parts)

    def stages(self, n, p, joins):
        """Return the seconds of the stages of a cold state."""
        subdomains = n / UNKNOWNS_PER_SUBDOMAIN
        edge = cluster_edge(subdomains) if joins else 1
        parts, f_mults = subdomains / edge ** 3, F_MULTS * MORE_F_MULTS[edge]
        messages = self.messages * LATENCY + self.bytes_per_share * (n / p) ** (2. / 3.) / BANDWIDTH
        collectives = math.log2(p) * (self.collectives * LATENCY
                                      + self.bytes_per_subdomain * parts / BANDWIDTH)
        return {"setup, of the rank's part": self.setup[1] * n / p,
                "setup, of all on each rank": self.setup[0] + self.setup[2] * contact_rows(n),
                "factorizations": self.factors * n / p,
                "F": f_mults * self.f_mult * n / p,
                "coarse solves": f_mults * COARSE_SOLVES * self.of_coarse("solve", parts, p),
                "coarse factorizations": FACES * self.of_coarse("factorization", parts, p),
                "messages": f_mults * messages,
                "collective calls": f_mults * collectives}

    def megabytes(self, n, p, joins):
        """Return the parts of the memory of a rank."""
        subdomains = n / UNKNOWNS_PER_SUBDOMAIN
        parts = subdomains / (cluster_edge(subdomains) if joins else 1) ** 3
        return {"of the rank's part": self.memory[0] + self.memory[1] * n / p,
                "of all on each rank": self.memory[2] * contact_rows(n),
                "coarse factor": self.of_coarse("MB", parts, p)}


def main(ranks, coarse):
    model = Model(read_csv(ranks), read_csv(coarse))
    print(f"setup {model.setup[0]:.2e} s + {model.setup[1]:.2e} s/unknown of the rank",
          f"+ {model.setup[2]:.2e} s/contact row;",
          f"factorizations {model.factors:.2e}; F-mult {model.f_mult:.2e}")
    print(f"memory {model.memory[0]:.0f} MB + {1e3 * model.memory[1]:.2f} kB/unknown of the rank",
          f"+ {1e3 * model.memory[2]:.2f} kB/contact row")
    print(f"per F-mult {model.messages:.1f} messages, {model.collectives:.1f} collective calls of",
          f"{model.bytes_per_subdomain:.0f} bytes per subdomain")
    print("coarse exponents: " + ", ".join(
        f"{COARSE[key]} {power.exponent:.2f}" for key, power in model.coarse.items()))
    for members, of in sorted(model.teams.items()):
        print(f"a team of {members}: factorization {of['factorization']:.2f} of one rank's,",
              f"solve {of['solve']:.2f}, memory {of['MB']:.2f}")
    print()
    for joins, sizes in ((True, [(1.6e6, 16), *itertools.product((1e7, 1e8), (64, 256, 1024))]),
                         (False, [(1e7, 64), (1e8, 1024)])):
        print_head("unknowns", "ranks", "seconds", "of these compute shared out",
                   "largest of the rest", "MB per rank", "largest of these")
        for n, p in sizes:
            stages, memory = model.stages(n, p, joins), model.megabytes(n, p, joins)
            shared = ("setup, of the rank's part", "factorizations", "F")
            total, part = sum(stages.values()), sum(stages[key] for key in shared)
            worst = max((key for key in stages if key not in shared), key=stages.get)
            most = max(memory, key=memory.get)
            beyond = " (too much)" if sum(memory.values()) > MEMORY else ""
            print_row(f"{n:.1e}", p, f"{total:.3g}", f"{100 * part / total:.0f} %",
                      f"{worst}: {stages[worst]:.3g} s", f"{sum(memory.values()):.0f}{beyond}",
                      f"{most}: {memory[most]:.0f}")
        print()


if __name__ == "__main__":
    if len(sys.argv) != 3:
        sys.exit(__doc__)
    main(*sys.argv[1:])
