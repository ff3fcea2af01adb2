"""Tables: DataFrames with pandas, and otherwise dictionaries of arrays."""

import numpy as np


def table(columns):
    """Return a DataFrame of the columns, or a dictionary of arrays if pandas is missing."""
    try:
        import pandas
    except ImportError:
        return {name: np.asarray(values) for name, values in columns.items()}
    return pandas.DataFrame(columns)


def vectors(name, rows):
    """Return the columns name_x, name_y, .. of a list of vectors; without a name x, y, .."""
    rows = np.asarray(rows, float)
    return {(name + "_" if name else "") + axis: rows[:, i]
            for i, axis in zip(range(rows.shape[-1] if rows.size else 0), "xyz")}
