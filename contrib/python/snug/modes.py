"""Shape variables for profiles of any formula."""


def heights(places, direction, coordinate="x"):
    """Return an entry Shape/Modes whose variables are the displacements along the vector `direction`
    at increasing places of a coordinate, a formula such as "abs(x)". The displacement is linear
    between the places and constant beyond them. With a formula z(p) of the profile at the places
    a response J(z(p)) has the derivatives dJ/dz dz/dp (chain rule)."""
    t = f"min(max({coordinate},{places[0]:.12g}),{places[-1]:.12g})"
    places = [places[0] - 1., *places, places[-1] + 1.]
    hats = (f"max(0,min(({t}-({a:.12g}))/{b - a:.12g},({c:.12g}-{t})/{c - b:.12g}))"
            for a, b, c in zip(places, places[1:], places[2:]))
    return "; ".join(", ".join(f"{part:g}*{hat}" if part else "0" for part in direction)
                     for hat in hats)
