#include <snug/elasticity/finite_difference.h>
#include <snug/elasticity/formulation.h>
#include <snug/mesh/partition.h>
#include <snug/scene/check.h>
#include <snug/scene/entries.h>
#include <snug/sensitivity/data_derivatives.h>
#include <snug/sensitivity/gradient.h>

namespace snug::scene {
namespace {
/// The names of what has subsections of its own.
template <typename Named>
void add_names(Entries                  &entries,
               const std::string        &entry,
               const std::vector<Named> &list,
               const std::string        &meaning)
{
  entries.add(entry,
              {[&list]() {
                 std::vector<std::string> names;
                 for (const auto &item : list)
                   names.push_back(item.name);
                 return listed(names);
               },
               [](const std::string &) {}},
              pairs("names separated by commas"), meaning);
}

void declare_general(Entries &entries, Scene &scene)
{
  entries.add("Task", scene.task, choice("state|sensitivity|optimize"),
              "state: solve one contact problem. sensitivity: also "
              "differentiate it by all methods, side by side. optimize: "
              "find the best shape.");
  entries.add("Dimension", scene.dimension, choice("2|3"), "Dimension of the meshes.");
  entries.add("Model", scene.model, choice("auto|" + names(mesh::idealization_table())),
              "What the meshes stand for. auto: solid in 3D, plane "
              "strain in 2D; " +
                meanings(mesh::idealization_table()) + ".");
  entries.add("Thickness", scene.thickness,
              "Thickness of plane strain and plane stress models "
              "[length]; forces, energies and volumes are those of this "
              "thickness.");
  add_names(entries, "Bodies", scene.bodies,
            "Names of the bodies, separated by commas; each has its "
            "own subsection Body NAME.");
  add_names(entries, "Materials", scene.materials,
            "Names of materials, separated by commas; each has its own "
            "subsection Material NAME, and bodies name those they are "
            "made of.");
  add_names(entries, "Obstacles", scene.obstacles,
            "Names of rigid obstacles, separated by commas; each has "
            "its own subsection Obstacle NAME.");
  add_names(entries, "Shapes", scene.shapes,
            "Names of the shapes, separated by commas; each has its "
            "own subsection Shape NAME. Empty: one shape without a "
            "name, in subsection Shape.");
  add_names(entries, "Load cases", scene.load_cases,
            "Names of the load cases, separated by commas; each has "
            "its own subsection Load case NAME with loads besides "
            "those of the bodies. Empty: one, with the loads of the "
            "bodies alone.");
  add_names(entries, "Responses", scene.responses,
            "Names of responses, separated by commas; each has its own "
            "subsection Response NAME. Their values are reported, and "
            "they may be objective or constraints, as may quantities "
            "under their own names.");
  add_gravity(entries, scene.gravity);
  entries.add("Output directory", scene.output_directory,
              "Where results go; made if it is not there. Relative to "
              "the directory the program is started in.");
  entries.add("Element degree", scene.degree, choice("1|2"),
              "Polynomial degree of the elements: 1 (bilinear, "
              "trilinear) or 2.");
  entries.add("Least scaled Jacobian", scene.least_scaled_jacobian,
              "Meshes with a cell of less are refused, designs as if "
              "they were tangled: det J over the product of the edges' "
              "lengths, 1 for right angles, 0 for tangled cells; 0: none "
              "but tangled ones.");
}

void declare_material(Entries &entries, elasticity::Material &material)
{
  entries.add("Young's modulus", material.youngs_modulus,
              "Young's modulus [force/length^2], positive.");
  entries.add("Poisson's ratio", material.poissons_ratio,
              "Poisson's ratio, above -1 and below 0.5.");
  entries.add("Density", material.density,
              "Mass per volume [mass/length^3], for gravity and mass.");
}

TextMap materials_from(const std::string &text)
{
  TextMap materials;
  if (text.find(':') != std::string::npos)
    from_text(text, materials);
  else if (!text.empty())
    materials[""] = text;
  return materials;
}

void declare_body(Entries &entries, Body &body)
{
  entries.begin_section("Body " + body.name, "One body: its mesh, material, supports and "
                                             "loads.");
  declare_mesh(entries, body.mesh);
  declare_material(entries, body.material);
  entries.add("Materials",
              {[&body]() { return text_of_materials(body.materials); },
               [&body](const std::string &text) { body.materials = materials_from(text); }},
              pairs("the name of a material, or a list 'region: "
                    "material, ...' of different regions"),
              "Materials of the scene the body is made of, instead of "
              "its own modulus, ratio and density: 'steel' for all of "
              "it, or one per region, 'core: steel, coat: rubber'. "
              "Regions are the groups of cells of a mesh file and those "
              "of 'Region formulas'; cells in none are the region body.");
  add_choice(entries, "Formulation", body.formulation, elasticity::formulation_table(),
             "How elements take the change of volume.");
  entries.add("Supports", body.supports,
              pairs("a list 'boundary: components, ...' of different "
                    "boundaries"),
              "Boundaries with the displacement components held at "
              "zero: 'bottom: xyz, left: x'. 'normal' is the component "
              "along the outward normal of any face, flat, oblique or "
              "curved (symmetry planes, rollers): 'side: normal, end: "
              "normal z'.");
  declare_loads(entries, body.loads, "boundary");
  entries.add("Body force",
              {[&body]() { return to_text(body.body_force); },
               [&body](const std::string &text) { body.body_force = vector_components(text); }},
              anything("formulas separated by commas or blanks, one per "
                       "dimension"),
              "Force per volume along x, y, z [force/length^3], formulas "
              "of x, y, z in the reference geometry; empty: none.");
}

void declare_solver(Entries &entries, Scene &scene)
{
  entries.begin_section("Decomposition", "Tearing the bodies into subdomains.");
  entries.add("Subdomains",
              {[&scene]() {
                 return scene.tearing.subdomains == 0 ? std::string("auto")
                                                      : to_text(scene.tearing.subdomains);
               },
               [&scene](const std::string &text) {
                 scene.tearing.subdomains = 0;
                 if (text != "auto")
                   from_text(text, scene.tearing.subdomains);
                 if (text != "auto" && scene.tearing.subdomains == 0)
                   throw std::invalid_argument("no subdomain");
               }},
              anything("auto or a whole number of at least 1"),
              "Wanted number of subdomains of all bodies and ranks; "
              "auto: by size. There are at least as many as ranks.");

  add_choice(entries, "Method", scene.tearing.method, mesh::partition_table<3>(),
             "How a body is divided.");

  entries.begin_section("Solver", "Solving the contact problem.");
  add_choice(entries, "Method", scene.solver.method, qp::solver_table(),
             "Solver of the dual quadratic program.");
  entries.add("Relative tolerance", scene.solver.relative_tolerance,
              "What the relative errors of equilibrium, continuity, "
              "penetration, negative pressure and complementarity may "
              "be; between 1e-14 and 0.1.");
  entries.add("Maximum F-mults", scene.solver.max_iterations,
              "Largest number of applications of the dual operator in "
              "one solve; a state that needs more is an error.");
  entries.add("Report linear reference", scene.report_linear_reference,
              "Also solve the linear problem on the final contacts from "
              "zero and report its number of F-mults.");
  entries.add("Factorization", scene.feti.factorization, choice("CHOLMOD|MUMPS"),
              "Package that factorizes the subdomains.");
  entries.add("Preconditioner", scene.feti.preconditioner, choice("Dirichlet|lumped|none"),
              "Dirichlet: fewest iterations; lumped: cheaper ones; "
              "none: for comparison.");
  entries.add("Scaling", scene.feti.scaling, choice("stiffness|multiplicity"),
              "How the preconditioner weighs the copies of a node: by "
              "their stiffness, for bodies of different moduli, or by "
              "their number.");
}

void declare_gradient(Entries &entries, Scene &scene)
{
  auto &gradient = scene.gradient;
  entries.begin_section("Gradient", "Derivatives by design variables.");
  add_choice(entries, "Method", gradient.method, sensitivity::gradient_table<3>(),
             "How the objective is differentiated.");
  entries.add("Solves", gradient.solves, choice("block|recycled"),
              "How the linear problems of the adjoint and direct "
              "methods are solved: block: all at once; recycled: one "
              "after the other, each starting in the search directions "
              "of those before.");
  add_choice(entries, "Derivatives", gradient.derivatives, sensitivity::derivatives_table(),
             "Derivatives of stiffness, loads and contact rows.");
  entries.add("Semi-analytic step", gradient.semi_analytic_step,
              "Step of those differences relative to the cell size; "
              "above 0, at most 0.1.");
  add_choice(entries, "Differences", gradient.differences, elasticity::stencil_table(),
             "Formula of overall finite differences.");
  entries.add("Step", gradient.step,
              "Step of overall finite differences relative to the "
              "width of the bounds; above 0, at most 0.1.");
  entries.add("Shape gradient", gradient.shape_gradient,
              "Also write the derivative of the objective by the "
              "positions of the nodes, the point field shape_gradient of "
              "solution.pvd.");
  entries.add("Compare", gradient.compare,
              "Task = sensitivity: all methods side by side, or only "
              "Gradient/Method.");
}
} // namespace

void declare(Entries &entries, Scene &scene)
{
  declare_general(entries, scene);
  for (auto &material : scene.materials)
    {
      entries.begin_section("Material " + material.name, "One isotropic, linear elastic material.");
      declare_material(entries, material.material);
    }
  for (auto &body : scene.bodies)
    declare_body(entries, body);
  declare_load_cases(entries, scene);
  declare_contact(entries, scene);
  declare_shapes(entries, scene);
  declare_solver(entries, scene);
  declare_gradient(entries, scene);
  declare_responses(entries, scene);
  declare_optimization(entries, scene);
}
} // namespace snug::scene
