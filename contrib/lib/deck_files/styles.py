"""Write models as decks in the manner of Abaqus/CAE, PrePoMax, FreeCAD, cgx and Mecway."""

import re


def number(x):
    return f"{x:.14g}"


def listed(members, per_line=16):
    """Return numbers as lines of a set."""
    words = [str(member) for member in members]
    return "".join(", ".join(words[i:i + per_line]) + ",\n"
                   for i in range(0, len(words), per_line))


def node_lines(nodes, dim, shift=0):
    return "".join(", ".join([str(n - shift), *map(number, x[:dim])]) + "\n"
                   for n, x in nodes.items())


def element_lines(elements, shift=0):
    """Return elements, those of 15 and 20 nodes in two lines."""
    lines = []
    for e, nodes in elements.items():
        words = [str(n - shift) for n in (e, *nodes)]
        lines += [", ".join(words[:11]) + ("," if len(words) > 11 else "")]
        lines += [", ".join(words[11:])] if len(words) > 11 else []
    return "\n".join(lines) + "\n"


def capitalized(text):
    """Return lines with keywords and options as CAE and PrePoMax write them: *Contact pair."""
    def change(match):
        words = match.group(0).split(",")
        result = ["*" + words[0][1:].capitalize()]
        for word in words[1:]:
            name, equals, value = word.partition("=")
            result.append(name.lower() + equals + value)
        return ",".join(result)
    return re.sub(r"(?m)^\*[A-Z].*$", change, text)


def material_text(model):
    lines = []
    for name, data in model.materials.items():
        lines += [f"*MATERIAL, NAME={name}"]
        for keyword, values in data.items():
            lines += [f"*{keyword}", values]
    return "\n".join(lines) + "\n"


def section_text(part, elset):
    thickness = f"{part.thickness}\n" if part.thickness else ""
    return f"*SOLID SECTION, ELSET={elset}, MATERIAL={part.material}\n{thickness}"


def step_texts(model, head="*STEP", static="*STATIC", output="*NODE FILE\nU\n"):
    """Return the lines of the steps."""
    return "".join(
        head + (f", NAME={step.name}" if step.name and "NAME" not in head else "") +
        f"\n{static}\n{step.static}{step.lines}{output}*END STEP\n" for step in model.steps)


def surfaces_of(model, prefix, one_line=False):
    """Return surfaces made of sets of elements for each number of a face, whose names have a
    prefix, or of single elements."""
    text = ""
    for name, (_, faces) in model.surfaces.items():
        sets = model.faces_by_number(name)
        if not one_line:
            text += "".join(f"*ELSET, ELSET={prefix}{name}_S{k}\n{listed(elements)}"
                            for k, elements in sets.items())
        text += f"*SURFACE, NAME={name}, TYPE=ELEMENT\n"
        text += "".join(f"{prefix}{name}_S{k}, S{k}\n" for k in sets) if not one_line else "".join(
            f"{e},S{k}\n" for e, k, *_ in faces)
    return text


def node_sets_of(model, per_line=16):
    return "".join(f"*NSET, NSET={name}\n{listed(nodes, per_line)}"
                   for name, (_, nodes) in model.node_sets.items())


def element_sets_of(model):
    return "".join(f"*ELSET, ELSET={name}\n{listed(elements)}"
                   for name, (_, elements) in model.element_sets.items())


def prepomax(model):
    """Return {file: text} of a deck as PrePoMax writes it."""
    def title(words):
        return f"**\n** {words} ".ljust(60, "+") + "\n**\n"
    text = "*HEADING\nHash: 7f3a91, Date: 01/02/2026, Unit system: MM_TON_S_C\n"
    text += title("Nodes") + "*NODE\n"
    text += "".join(node_lines(part.nodes, part.dim) for part in model.parts) + title("Elements")
    for i, part in enumerate(model.parts):
        text += (f"*ELEMENT, TYPE={part.kind}, ELSET=Solid_part-{i + 1}\n" +
                 element_lines(part.elements))
    text += model.extra_elements + title("Node sets") + node_sets_of(model)
    text += title("Element sets") + element_sets_of(model)
    text += title("Surfaces") + surfaces_of(model, "Internal_Selection-1_")
    text += title("Materials") + material_text(model) + title("Sections")
    text += "".join(section_text(part, f"Solid_part-{i + 1}")
                    for i, part in enumerate(model.parts))
    text += title("Interactions") + model.before + title("Steps")
    return {"deck.inp": capitalized(text + step_texts(model, static="*STATIC, SOLVER=PASTIX"))}


def freecad(model):
    """Return {file: text} of a deck as FreeCAD writes it: all cells in one set, nodes of sets one
    in a line, surfaces of single elements."""
    text = "** written by FreeCAD inp file writer for CalculiX\n*NODE, NSET=Nall\n"
    text += "".join(node_lines(part.nodes, part.dim) for part in model.parts)
    text += "** Volume elements\n"
    for part in model.parts:
        text += f"*ELEMENT, TYPE={part.kind}, ELSET=Evolumes\n" + element_lines(part.elements)
    text += model.extra_elements + "*ELSET, ELSET=Eall\nEvolumes\n"
    for i, part in enumerate(model.parts):
        text += f"*ELSET,ELSET=MaterialSolid{i}\n" + listed(part.elements, 1)
    text += node_sets_of(model, 1) + element_sets_of(model) + surfaces_of(model, "", True)
    text += "** Materials\n" + material_text(model) + "** Sections\n"
    text += "".join(section_text(part, f"MaterialSolid{i}") for i, part in enumerate(model.parts))
    return {"deck.inp": text + model.before +
            step_texts(model, "*STEP, INC=2000", "*STATIC, SOLVER=SPOOLES",
                       "*NODE FILE\nU\n*EL FILE\nS, E\n** outputs\n*NODE PRINT , NSET=Nall\nU\n")}


def cgx(model):
    """Return {file: text} of a deck whose mesh, sets, surfaces and boundary conditions are files of
    cgx. A file of a step is named by a line '>name' before its lines."""
    files = {"all.msh": "** cgx: send all abq\n*NODE, NSET=Nall\n" +
             "".join(node_lines(part.nodes, part.dim) for part in model.parts)}
    for i, part in enumerate(model.parts):
        files["all.msh"] += (f"*ELEMENT, TYPE={part.kind}, ELSET=E{i + 1}\n" +
                             element_lines(part.elements))
    text = "*INCLUDE, INPUT=all.msh\n"
    for name, (_, nodes) in model.node_sets.items():
        files[name.lower() + ".nam"] = (f"** Names based on {name}\n*NSET,NSET={name}\n" +
                                        listed(nodes, 1))
        text += f"*INCLUDE,INPUT={name.lower()}.nam\n"
    for name, (_, elements) in model.element_sets.items():
        files[name.lower() + ".nam"] = f"*ELSET,ELSET={name}\n" + listed(elements, 1)
        text += f"*INCLUDE,INPUT={name.lower()}.nam\n"
    for name, (_, faces) in model.surfaces.items():
        files[name.lower() + ".sur"] = f"*SURFACE, NAME={name}\n" + "".join(
            f"{e},S{k}\n" for e, k, *_ in faces)
        text += f"*INCLUDE, INPUT={name.lower()}.sur\n"
    text += material_text(model) + "".join(section_text(part, f"E{i + 1}")
                                           for i, part in enumerate(model.parts))
    text += model.before
    steps = step_texts(model)
    for name, lines in re.findall(r"(?m)^>(\S+)\n((?:\d.*\n)+)", steps):
        files[name] = "** cgx\n" + lines
    return {"deck.inp": text + re.sub(r"(?m)^>(\S+)\n(?:\d.*\n)+", r"*INCLUDE, INPUT=\1\n", steps),
            **files}


def mecway(model):
    """Return {file: text} of a deck as Mecway writes it."""
    text = "**Mecway 15\n*NODE, NSET=NALL\n"
    text += "".join(node_lines(part.nodes, part.dim) for part in model.parts)
    for i, part in enumerate(model.parts):
        text += f"*ELEMENT, TYPE={part.kind}, ELSET=Part{i}\n" + element_lines(part.elements)
    text += model.extra_elements + element_sets_of(model) + node_sets_of(model, 8)
    text += surfaces_of(model, "faces_of_") + material_text(model)
    text += "".join(section_text(part, f"Part{i}") for i, part in enumerate(model.parts))
    return {"deck.inp": text + model.before +
            step_texts(model, "*STEP, INC=1000", "*STATIC",
                       "*NODE FILE,GLOBAL=YES\nU,RF\n*EL FILE\nS\n")}


def cae(model):
    """Return {file: text} of a deck as Abaqus/CAE writes it: parts, instances, sets of the
    assembly."""
    text = "*Heading\n** Job name: Job-1 Model name: Model-1\n*Preprint, echo=NO, model=NO\n"
    text += "** PARTS\n"
    instance, part_of = {}, {}
    for part in model.parts:
        same = next((name for name, other in part_of.items() if other.kind == part.kind and
                     list(other.own_nodes.values()) == list(part.own_nodes.values())), None)
        name = same or f"Part-{len(part_of) + 1}"
        number_of_part = 1 + sum(1 for of, _ in instance.values() if of == name)
        instance[part] = (name, f"{name}-{number_of_part}")
        if same:
            continue
        part_of[name] = part
        shift, n = part.first - 1, len(part.elements)
        text += f"*Part, name={name}\n*Node\n" + node_lines(part.own_nodes, part.dim, shift)
        text += f"*Element, type={part.kind}\n" + element_lines(part.elements, shift)
        text += f"*Elset, elset=_PickedSet2, internal, generate\n  1,  {n},   1\n** Section: S-1\n"
        text += f"*Solid Section, elset=_PickedSet2, material={part.material}\n"
        text += f"{part.thickness or ''},\n*End Part\n**\n"
    text += "** ASSEMBLY\n*Assembly, name=Assembly\n"
    for part, (name, own) in instance.items():
        text += f"*Instance, name={own}, part={name}\n"
        text += ", ".join(map(number, part.shift)) + "\n*End Instance\n**\n"
    for name, (part, nodes) in model.node_sets.items():
        text += (f"*Nset, nset={name}, instance={instance[part][1]}\n" +
                 listed(n - part.first + 1 for n in nodes))
    for name, (part, _) in model.surfaces.items():
        sets = model.faces_by_number(name)
        for k, elements in sets.items():
            text += (f"*Elset, elset=_{name}_S{k}, internal, instance={instance[part][1]}\n" +
                     listed(e - part.first + 1 for e in elements))
        text += f"*Surface, type=ELEMENT, name={name}\n"
        text += "".join(f"_{name}_S{k}, S{k}\n" for k in sets)
    text += "*End Assembly\n** MATERIALS\n" + capitalized(material_text(model))
    return {"deck.inp": text + capitalized(model.before) + capitalized(step_texts(
        model, "*STEP, NLGEOM=NO", output="*RESTART, WRITE, FREQUENCY=0\n*OUTPUT, FIELD, "
        "VARIABLE=PRESELECT\n*OUTPUT, HISTORY, VARIABLE=PRESELECT\n"))}
