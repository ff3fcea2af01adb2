#include <snug/base/entries.h>
#include <snug/scene/scene.h>

namespace snug::scene {
namespace {
/// Add the entry with the names of @p list. The items have subsections of their own, which are
/// made before.
template <typename Named>
void add_names(Entries                  &entries,
               const std::string        &entry,
               const std::vector<Named> &list,
               const std::string        &meaning)
{
  Form form = allowed("names separated by commas");
  form.type = ValueType::names;
  entries.add(entry, {[&list]() { return to_text(names_of(list)); }, [](const std::string &) {}},
              form, meaning);
}

void declare_general(Entries &entries, Scene &scene)
{
  entries.add("Task", scene.task, "The kind of run.");
  entries.add("Dimension", scene.dimension, choice({{"2"}, {"3"}}), "The dimension of the meshes.");
  entries.add("Model", scene.model,
              choice_or_auto<mesh::Idealization::Kind>("solid in 3D, plane strain in 2D"),
              "The mechanical model of the meshes.");
  entries.add(
    "Thickness", scene.thickness, positive(),
    "The thickness to which forces, energies and volumes of plane strain and plane stress "
    "models refer. Units: length.");
  entries.add("Accept large displacements", scene.accept_large_displacements,
              "Whether a run succeeds although large displacements would change its result: a "
              "stiffness by more than 20 %, or rotations of more than 0.5 rad. If not, the results "
              "are written, and the exit status is 3.");
  entries.add("Units", scene.units, allowed("a list 'length, force'"),
              "The names of the units of length and force, for the log, summary.json and pictures: "
              "'mm, N' gives stresses in MPa. Numbers are never converted. An empty list means "
              "results without units.");
  add_names(entries, "Bodies", scene.bodies,
            "The names of the bodies. Each body has a subsection Body NAME.");
  add_names(entries, "Materials", scene.materials,
            "The names of the materials. Each material has a subsection Material NAME. Bodies "
            "refer to materials by their names.");
  add_names(entries, "Obstacles", scene.obstacles,
            "The names of the rigid obstacles. Each obstacle has a subsection Obstacle NAME.");
  add_names(entries, "Reference points", scene.points,
            "The names of points with a rigid motion that faces and obstacles follow. Each point "
            "has a subsection Reference point NAME. Load cases may have entries for them in "
            "'Force', 'Moment' and 'Displacement', as 'NAME: 0 0 -100' and 'NAME: rz = 0.01'.");
  add_names(entries, "Bolts", scene.bolts,
            "The names of the bolts. Each bolt has a subsection Bolt NAME.");
  add_names(entries, "Shapes", scene.shapes,
            "The names of the shapes. Each shape has a subsection Shape NAME. An empty list means "
            "one shape without a name, in subsection Shape.");
  add_names(
    entries, "Load cases", scene.load_cases,
    "The names of the load cases. Each load case has a subsection Load case NAME with loads "
    "that are added to the loads of the bodies. An empty list means one load case with the "
    "loads of the bodies.");
  add_names(entries, "Responses", scene.responses,
            "The names of the responses. Each response has a subsection Response NAME. The values "
            "of responses are reported, and responses can be the objective or constraints. A "
            "quantity can also be used under its own name, without a subsection.");
  declare_gravity(entries, scene.gravity);
  entries.add("Output directory", scene.output_directory,
              "The name of the output directory, relative to the working directory. The directory "
              "is created if it does not exist.");
  entries.add("Element degree", count_or_auto(scene.degree),
              with_meanings(choice({{"auto"}, {"1"}, {"2"}}),
                            {{"auto", "2 if a mesh file or a mesh of a CAD file has tetrahedra or "
                                      "prisms, in 2D triangles; 1 otherwise"},
                             {"1", "bilinear in 2D, trilinear in 3D"},
                             {"2", "biquadratic in 2D, triquadratic in 3D; quadratic on the "
                                   "elements of mesh files that are split into cells, see "
                                   "doc/theory.md"}}),
              "The polynomial degree of the elements of all bodies.");
  entries.add(
    "Least scaled Jacobian", scene.least_scaled_jacobian, between(0., 0.99),
    "The minimum of det J over the product of the edge lengths, in all cells: 1 for right "
    "angles, 0 for degenerate cells. Meshes below it are rejected, designs below it count "
    "as tangled. A value of 0 rejects tangled cells only.");
}

/// Declare the subsections of the named items.
template <typename Named>
void declare_named(Entries &entries, std::vector<Named> &list, const std::string &meaning)
{
  for (auto &item : list)
    {
      entries.begin_section(item.section(), meaning);
      item.declare(entries);
    }
}

Access number_or_auto(std::optional<double> &value)
{
  Access result  = access(value);
  result.numbers = [&value]() { return std::vector<double>(value ? 1 : 0, value.value_or(0.)); };
  return result;
}

void declare_solver(Entries &entries, Scene &scene)
{
  entries.begin_section("Solver", "Solution of the contact problem.");
  scene.solver.declare(entries);
  Form form    = with_meanings(between(1e-14, 0.1),
                               {{"auto", "1e-6, but at most 'Objective tolerance' in optimizations "
                                            "whose objective or constraints are sensitive to these "
                                            "errors. All responses of the state except the "
                                            "potential energy are sensitive."}});
  form.allowed = "auto or a number";
  entries.add("Relative tolerance", number_or_auto(scene.state_tolerance), form,
              "The tolerance of the relative errors of equilibrium, continuity, penetration, "
              "negative pressure and complementarity, between 1e-14 and 0.1.");
  entries.add("Report linear reference", scene.report_linear_reference,
              "Whether to solve also the linear problem with the final active contacts, from zero, "
              "and to report its number of F-mults.");
  scene.feti.declare(entries);
}
} // namespace

void declare(Entries &entries, Scene &scene)
{
  declare_general(entries, scene);
  declare_named(entries, scene.materials, "An isotropic, linear elastic material.");
  declare_named(entries, scene.bodies, "A body: its mesh, material, supports and loads.");
  declare_named(
    entries, scene.load_cases,
    "The loads of a load case, in addition to the loads of the bodies and of the scene. A "
    "displacement component that one load case prescribes is held at zero in the load cases that "
    "do not "
    "prescribe it.");
  declare_named(entries, scene.obstacles, "A rigid obstacle.");
  declare_named(entries, scene.points,
                "A point with a rigid motion, under forces and moments, that faces and obstacles "
                "follow. Components that a load case prescribes are free in other load cases.");
  declare_named(entries, scene.bolts,
                "A bolt, cut across its shank into two bodies that are tied (Law = tied). It is "
                "tightened by moving the sides of the cut into each other. In a load step it keeps "
                "its length, unless the load case has a 'Preload' or a 'Shortening' for it.");
  entries.begin_section("Contact",
                        "The pairs of faces that may come into contact, and the method.");
  scene.contact.declare(entries);
  declare_named(entries, scene.contact.pairs, "Entries of Contact for one pair.");
  declare_named(entries, scene.shapes,
                "The design variables of a shape. For several shapes see the entry 'Shapes'.");
  entries.begin_section("Decomposition",
                        "Domain decomposition: tearing the bodies into subdomains.");
  scene.tearing.declare(entries);
  declare_solver(entries, scene);
  entries.begin_section("Accuracy", "Discretization error and adaptive mesh refinement.");
  scene.accuracy.declare(entries);
  entries.begin_section("Gradient", "Derivatives with respect to the design variables.");
  scene.gradient.declare(entries);
  declare_named(
    entries, scene.responses,
    "A response: a scalar function of a state or a design. Entries that its quantity does "
    "not read must keep their defaults.");
  entries.begin_section("Optimization", "The optimizer and its stopping criteria.");
  scene.optimization.declare(entries);
  entries.begin_section("Output", "The log and the files in 'Output directory'.");
  scene.output.declare(entries);
}
} // namespace snug::scene
