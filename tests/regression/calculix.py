"""Read nodal results of CalculiX from a file .frd."""


def field(path, name):
    """Return {node: components} of the last block called @p name, such as DISP or CONTACT."""
    values, is_inside = {}, False
    for line in path.read_text().splitlines():
        if line.startswith(" -4"):
            is_inside = line.split()[1] == name
            if is_inside:
                values = {}
        elif line.startswith(" -3"):
            is_inside = False
        elif is_inside and line.startswith(" -1"):
            # a mark of 3 characters, a node of 10 and numbers of 12
            numbers = [line[i:i + 12] for i in range(13, len(line.rstrip()), 12)]
            values[int(line[3:13])] = [float(number) for number in numbers]
    return values
