#ifndef snug_scene_scene_h
#define snug_scene_scene_h

#include <snug/accuracy/accuracy_parameters.h>
#include <snug/base/units.h>
#include <snug/contact/pair.h>
#include <snug/elasticity/formulation.h>
#include <snug/elasticity/material.h>
#include <snug/feti/feti_parameters.h>
#include <snug/geometry/body_geometry.h>
#include <snug/mesh/idealization.h>
#include <snug/mesh/tearing.h>
#include <snug/optimization/optimization_parameters.h>
#include <snug/qp/solver.h>
#include <snug/response/response_parameters.h>
#include <snug/scene/bolt.h>
#include <snug/scene/load_parameters.h>
#include <snug/scene/output_parameters.h>
#include <snug/scene/reference_point.h>
#include <snug/sensitivity/gradient_parameters.h>
#include <snug/shape/shape_parameters.h>

#include <map>
#include <optional>
#include <string>
#include <utility>
#include <vector>

namespace snug::scene {
/// Task of a run.
enum class Task
{
  state,       ///< one contact problem
  sensitivity, ///< derivatives by all methods, compared
  optimize     ///< optimization of the shape
};
inline Names names(Task)
{
  return {{"state", "one contact analysis"},
          {"sensitivity", "one contact analysis and its derivatives by all gradient methods"},
          {"optimize", "search for the best shape"}};
}

/// Entries of `subsection Material NAME`.
struct NamedMaterial
{
  std::string          name;
  elasticity::Material material;

  std::string section() const { return "Material " + name; }

  void declare(Entries &entries) { material.declare(entries); }
};

/// Entries of `subsection Body NAME`.
struct Body
{
  std::string                  name;
  geometry::BodyMeshParameters mesh;
  /// material of the whole body, if the next member is empty
  elasticity::Material material;
  /// region -> name of its material; "" is the whole body
  std::map<std::string, std::string> materials;
  elasticity::Formulation            formulation = elasticity::Formulation::standard;
  /// axis of the radial, tangential and axial components: direction of any length, and point
  /// [length]; empty: z through the origin
  std::vector<double> axis, axis_point;
  /// boundary -> components held at zero: words made of "xyz", "normal", "radial", ...
  std::map<std::string, std::string> supports;
  /// boundary -> 'components = value at x y z', see point_hold()
  std::vector<std::pair<std::string, std::string>> point_supports;
  /// boundary -> 'components = formula' [force / length^3]
  std::vector<std::pair<std::string, std::string>> springs;
  /// boundary -> 'x y z at x y z', see placed_force() [force / length]
  std::vector<std::pair<std::string, std::string>> point_springs;
  LoadParameters                                   loads;
  /// formulas of the components [force / length^3]; empty: none
  std::vector<std::string> body_force;
  /// formula of the temperature above that of the unstressed body; empty: none
  std::string temperature;

  std::string section() const { return "Body " + name; }

  void declare(Entries &entries);
};

/**
 * Entries of a parameter file. Units are chosen by the user, but must be consistent: with mm, N
 * and MPa, pressures and moduli are in MPa and energies in N mm.
 */
struct Scene
{
  std::string                             file; ///< scene file, for messages
  Task                                    task      = Task::state;
  unsigned int                            dimension = 3;  ///< dimension of the meshes
  std::optional<mesh::Idealization::Kind> model;          ///< none: by dimension
  double                                  thickness = 1.; ///< of plane models [length]
  std::vector<std::string>                units;          ///< names of length and force
  std::string                             output_directory = "output";
  /// degree of the elements, 1 or 2; 0 is auto, which read_scene() replaces
  unsigned int                             degree                = 0;
  double                                   least_scaled_jacobian = 0.; ///< minimum of all cells
  std::vector<NamedMaterial>               materials;
  std::vector<Body>                        bodies;
  std::vector<contact::ObstacleParameters> obstacles;
  std::vector<ReferencePoint>              points;
  std::vector<Bolt>                        bolts;
  std::vector<double>                      gravity; ///< [length / time^2]; empty: none
  /// empty: one load case, with the loads of the bodies alone
  std::vector<LoadCaseParameters> load_cases;
  unsigned int                    subdomains = 0; ///< number over all ranks; 0: by size
  /// whether a run succeeds although large displacements change its result much
  bool accept_large_displacements = false;
  /// whether the linear problem on the final active set is solved from zero too
  bool report_linear_reference = false;

  mesh::TearingParameters                   tearing;
  contact::ContactParameters                contact;
  std::vector<shape::ShapeParameters>       shapes{1}; ///< unnamed, or named
  feti::FetiParameters                      feti;
  qp::SolverParameters                      solver;
  std::optional<double>                     state_tolerance; ///< none: see declare()
  accuracy::AccuracyParameters              accuracy;
  OutputParameters                          output;
  sensitivity::GradientParameters           gradient;
  std::vector<response::ResponseParameters> responses; ///< named responses
  optimization::OptimizationParameters      optimization;
};

/// Declare all entries of @p scene, with its values as defaults. The existing bodies, obstacles,
/// pairs and shapes get their subsections.
void declare(Entries &entries, Scene &scene);

/// Return the names of bodies, materials and the like.
template <typename Named>
std::vector<std::string> names_of(const std::vector<Named> &list)
{
  std::vector<std::string> names;
  for (const auto &item : list)
    names.push_back(item.name);
  return names;
}

/// Return the idealization of the meshes of the scene. The scene must have a model.
mesh::Idealization idealization(const Scene &scene);

/// Return "body.boundary" as {body, boundary}; without a dot, boundary is "".
std::pair<std::string, std::string> split_face(const std::string &face);

/// Return the number of a displacement component: 0, 1, 2 for x, y, z and dimension + 0, 1, 2, 3
/// for normal, radial, tangential and axial.
/// @throws std::invalid_argument with a message that lists the names, for other names.
unsigned int component_number(const std::string &name, unsigned int dimension);

/// Return the component numbers of "xy", "normal" or "tangential z".
/// @throws std::invalid_argument with a message that states the error in the components.
std::vector<unsigned int> component_list(const std::string &words, unsigned int dimension);

/// Return "z = -0.012" as {"z", "-0.012"}; without '=', the second string is "".
std::pair<std::string, std::string> split_displacement(const std::string &text);

/// The response named by a constraint, and its load case or the combination of its values in all
/// load cases. There is neither if the response depends on the geometry, or if there is only one
/// load case.
struct ConstraintName
{
  std::string                              response;
  std::optional<unsigned int>              load_case;
  std::optional<optimization::Combination> combination;
};

/// Split a name such as "closing.compliance" into response and load case, if there is a load case
/// closing, and a name such as "worst of peak" into combination and response. All other names are
/// the response.
ConstraintName constraint_name(const Scene &scene, const std::string &name);

/// Return the unit of a response that response_called() knows, with a blank before it; empty if
/// 'Units' is empty or the response has no dimension.
std::string unit_after_number(const Scene &scene, const std::string &response);

/// Return the response called @p name: a response of the scene, or a quantity with all entries at
/// their defaults; nothing for other names.
std::optional<response::ResponseParameters> response_called(const Scene       &scene,
                                                            const std::string &name);

/// Return the position of the body called @p name; bodies.size() if there is none.
unsigned int body_index(const Scene &scene, const std::string &name);

/// Return the entry Materials of a body: "steel" or "core: steel, coat: rubber".
std::string text_of_materials(const std::map<std::string, std::string> &materials);

/// Return whether a pair has friction.
bool has_friction(const Scene &scene);

/// Return whether the states minimize a potential: no pair has friction, and no load step locks a
/// bolt.
bool has_potential(const Scene &scene);

/// Return the materials of the regions called @p regions, in their order. Regions without a
/// material get that of the body.
std::vector<elasticity::Material>
materials_of(const Scene &scene, const Body &body, const std::vector<std::string> &regions);

/// Return whether a material of the body has a Poisson's ratio of 0.499 or more, and B-bar
/// prevents its elements from locking.
bool is_nearly_incompressible(const Scene &scene, const Body &body);

/// Return the names of a body's boundaries, e.g. left, right, bottom, top.
/// @throws InputError if the body has no mesh (entries without section).
std::vector<std::string> boundary_names(const Body &body, unsigned int dimension);
} // namespace snug::scene

#endif
