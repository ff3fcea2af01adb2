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
  entries.add(entry, {[&list]() { return to_text(names_of(list)); }, [](const std::string &) {}},
              allowed("names separated by commas"), meaning);
}

void declare_general(Entries &entries, Scene &scene)
{
  entries.add("Task", scene.task,
              "state: solve one contact problem. sensitivity: also differentiate it by all "
              "methods, side by side. optimize: find the best shape.");
  entries.add("Dimension", scene.dimension, choice({{"2"}, {"3"}}), "Dimension of the meshes.");
  entries.add("Model", scene.model,
              choice_or_auto<mesh::Idealization::Kind>("solid in 3D, plane strain in 2D"),
              "What the meshes stand for.");
  entries.add("Thickness", scene.thickness, positive(),
              "Thickness of plane strain and plane stress models [length]; forces, energies and "
              "volumes are those of this thickness.");
  add_names(entries, "Bodies", scene.bodies,
            "Names of the bodies, separated by commas; each has its own subsection Body NAME.");
  add_names(entries, "Materials", scene.materials,
            "Names of materials, separated by commas; each has its own subsection Material NAME, "
            "and bodies name those they are made of.");
  add_names(
    entries, "Obstacles", scene.obstacles,
    "Names of rigid obstacles, separated by commas; each has its own subsection Obstacle NAME.");
  add_names(entries, "Shapes", scene.shapes,
            "Names of the shapes, separated by commas; each has its own subsection Shape NAME. "
            "Empty: one shape without a name, in subsection Shape.");
  add_names(
    entries, "Load cases", scene.load_cases,
    "Names of the load cases, separated by commas; each has its own subsection Load case NAME with "
    "loads besides those of the bodies. Empty: one, with the loads of the bodies alone.");
  add_names(entries, "Responses", scene.responses,
            "Names of responses, separated by commas; each has its own subsection Response NAME. "
            "Their values are reported, and they may be objective or constraints, as may "
            "quantities under their own names.");
  declare_gravity(entries, scene.gravity);
  entries.add("Output directory", scene.output_directory,
              "Where results go; made if it is not there. Relative to the directory the program is "
              "started in.");
  entries.add("Element degree", scene.degree, choice({{"1"}, {"2"}}),
              "Polynomial degree of the elements: 1 (bilinear, trilinear) or 2.");
  entries.add("Least scaled Jacobian", scene.least_scaled_jacobian, between(0., 0.99),
              "Meshes with a cell of less are refused, designs as if they were tangled: det J over "
              "the product of the edges' lengths, 1 for right angles, 0 for tangled cells; 0: none "
              "but tangled ones.");
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
  entries.begin_section("Solver", "Solving the contact problem.");
  scene.solver.declare(entries);
  Form form    = between(1e-14, 0.1);
  form.allowed = "auto or a number";
  entries.add("Relative tolerance", number_or_auto(scene.state_tolerance), form,
              "What the relative errors of equilibrium, continuity, penetration, negative pressure "
              "and complementarity may be; between 1e-14 and 0.1. auto: 1e-6, but no more than "
              "'Objective tolerance' in optimizations whose objective or constraints feel these "
              "errors, as all that depend on the state but the potential energy do.");
  entries.add("Report linear reference", scene.report_linear_reference,
              "Also solve the linear problem on the final contacts from zero and report its number "
              "of F-mults.");
  scene.feti.declare(entries);
}
} // namespace

void declare(Entries &entries, Scene &scene)
{
  declare_general(entries, scene);
  declare_named(entries, scene.materials, "One isotropic, linear elastic material.");
  declare_named(entries, scene.bodies, "One body: its mesh, material, supports and loads.");
  declare_named(
    entries, scene.load_cases,
    "Loads of one load case besides those of the bodies and the scene. A displacement component "
    "prescribed in one load case is held in all: at zero where they say nothing.");
  declare_named(entries, scene.obstacles, "One rigid obstacle: nothing gets into it.");
  entries.begin_section("Contact", "Which faces may touch, and how.");
  scene.contact.declare(entries);
  declare_named(entries, scene.contact.pairs, "Entries of Contact for one of its pairs.");
  declare_named(entries, scene.shapes, "Design variables. Several shapes: see the entry 'Shapes'.");
  entries.begin_section("Decomposition", "Tearing the bodies into subdomains.");
  scene.tearing.declare(entries);
  declare_solver(entries, scene);
  entries.begin_section("Accuracy", "How far the mesh is from the truth.");
  scene.accuracy.declare(entries);
  entries.begin_section("Gradient", "Derivatives by design variables.");
  scene.gradient.declare(entries);
  declare_named(entries, scene.responses,
                "One response: a number that a state or a design has. Entries that its quantity "
                "does not read stay as they are.");
  entries.begin_section("Optimization", "Finding the best shape.");
  scene.optimization.declare(entries);
  entries.begin_section("Output", "What is written of states, in 'Output directory'.");
  scene.output.declare(entries);
}
} // namespace snug::scene
