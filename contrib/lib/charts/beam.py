"""The compliance of a cantilever of biquadratic elements and its derivative by the
length, with fifty digits: the reference of the chart of slender bodies."""

from decimal import Decimal, getcontext

import numpy as np

getcontext().prec = 50
STEP = Decimal("1e-12")  # of central differences, which leave an error of 1e-24

# Gauss points and weights, shape functions of the nodes -1, 0, 1 and their slopes
POINTS = [(sign * Decimal("0.6").sqrt(), Decimal(weight) / 9)
          for sign, weight in ((-1, 5), (0, 8), (1, 5))]
END_LOADS = np.array([Decimal(1) / 6, Decimal(4) / 6, Decimal(1) / 6])


def shapes(s):
    return np.array([s * (s - 1) / 2, 1 - s * s, s * (s + 1) / 2])


def slopes(s):
    return np.array([s - Decimal("0.5"), -2 * s, s + Decimal("0.5")])


def zeros(*shape):
    return np.full(shape, Decimal(0), dtype=object)


def solve(matrix, right):
    """Return matrix^-1 right by elimination; numpy's is for double precision only."""
    a = np.concatenate([matrix, right], axis=1)
    for i in range(len(matrix)):
        a[i] = a[i] / a[i, i]
        for j in range(len(matrix)):
            if j != i:
                a[j] = a[j] - a[j, i] * a[i]
    return a[:, len(matrix):]


def stiffness(width, height, modulus, ratio):
    """Return the stiffness of a rectangle in plane strain; nodes in columns, each from below."""
    mu = modulus / (2 * (1 + ratio))
    lame = modulus * ratio / ((1 + ratio) * (1 - 2 * ratio))
    D = np.array([[lame + 2 * mu, lame, 0], [lame, lame + 2 * mu, 0],
                  [0, 0, mu]], dtype=object)
    K = zeros(18, 18)
    for s, weight in POINTS:
        for t, other in POINTS:
            B = zeros(3, 18)
            B[0, 0::2] = B[2, 1::2] = np.kron(slopes(s), shapes(t)) * 2 / width
            B[1, 1::2] = B[2, 0::2] = np.kron(shapes(s), slopes(t)) * 2 / height
            K = K + B.T @ D @ B * (weight * other * width * height / 4)
    return K


def compliance(length, columns, rows, modulus, ratio):
    """Return f'u of a cantilever of height 1 under a shear traction of 1 at its end."""
    element = stiffness(length / columns, Decimal(1) / rows, modulus, ratio)
    n = 2 * (2 * rows + 1)  # unknowns of a column of nodes
    K = zeros(3 * n, 3 * n)  # of a column of elements
    load = zeros(n, 1)
    for row in range(rows):
        unknowns = [n * column + 4 * row + i
                    for column in range(3) for i in range(6)]
        K[np.ix_(unknowns, unknowns)] += element
        load[4 * row + 1:4 * row + 6:2, 0] += END_LOADS / rows
    part = zeros(n, n)  # stiffness at the end of the columns so far
    for column in range(columns):
        free = slice(n if column == 0 else 0, 2 * n)  # the first is clamped
        inner = K.copy()
        inner[:n, :n] += part
        across = inner[free, 2 * n:]
        part = K[2 * n:, 2 * n:] - across.T @ solve(inner[free, free], across)
    return (load.T @ solve(part, load))[0, 0]


def compliance_derivative(length, columns, rows, modulus, ratio):
    """Return the derivative by the logarithm of the length."""
    ends = [compliance(Decimal(length) * (1 + sign * STEP), columns, rows,
                       Decimal(modulus), Decimal(ratio)) for sign in (1, -1)]
    return (ends[0] - ends[1]) / (2 * STEP)
