#include <snug/response/response.h>
#include <snug/scene/check.h>
#include <snug/scene/values.h>
#include <snug/sensitivity/methods.h>

#include <algorithm>
#include <cmath>

namespace snug::scene {
namespace {
/// @p value must be in [lower, upper] (NaN is not).
void require_range(const Origins     &origins,
                   const std::string &path,
                   const double       value,
                   const double       lower,
                   const double       upper)
{
  if (!(value >= lower && value <= upper))
    throw origins.error(path, to_text(value),
                        "must lie between " + to_text(lower) + " and " + to_text(upper));
}

void require_positive(const Origins &origins, const std::string &path, const unsigned int value)
{
  if (value == 0)
    throw origins.error(path, "0", "must be at least 1");
}

void check_optimization(const Scene &scene, const Origins &origins)
{
  const auto       &parameters = scene.optimization;
  const std::string section    = "Optimization/";
  require_positive(origins, section + "Maximum evaluations", parameters.maximum_evaluations);
  const std::pair<const char *, double> tolerances[] = {
    {"Gradient tolerance", parameters.gradient_tolerance},
    {"Objective tolerance", parameters.objective_tolerance},
    {"Design tolerance", parameters.design_tolerance},
    {"Constraint tolerance", parameters.constraint_tolerance}};
  for (const auto &[name, value] : tolerances)
    require_range(origins, section + name, value, 1e-15, 0.1);
}

void check_gradient(const Scene &scene, const Origins &origins)
{
  // The same in 2D and 3D.
  const std::string &objective = scene.optimization.objective;
  const auto         measured  = response_called(scene, objective);
  if (scene.gradient.method == "energy" &&
      sensitivity::needs_solve(*response::make_response<3>(*measured)))
    throw origins.error("Gradient/Method", scene.gradient.method,
                        "must be auto, adjoint, direct or finite "
                        "differences for the objective '" +
                          objective + "'");
  const std::pair<const char *, double> steps[] = {{"Gradient/Semi-analytic step",
                                                    scene.gradient.semi_analytic_step},
                                                   {"Gradient/Step", scene.gradient.step}};
  for (const auto &[path, value] : steps)
    if (!(value > 0. && value <= 0.1))
      throw origins.error(path, to_text(value), "must be above 0 and at most 0.1");
}
} // namespace

namespace {
void check_model(const Scene &scene, const Origins &origins)
{
  const bool plane = scene.model == "plane strain" || scene.model == "plane stress";
  if ((scene.model == "solid") != (scene.dimension == 3))
    throw origins.error("Model", scene.model,
                        scene.dimension == 3 ? "must be solid for Dimension = 3"
                                             : "must be one of plane strain, plane stress, "
                                               "axisymmetric for Dimension = 2");
  if (!(scene.thickness > 0. && std::isfinite(scene.thickness)))
    throw origins.error("Thickness", to_text(scene.thickness), "must be positive");
  if (!plane && scene.thickness != 1.)
    throw origins.error("Thickness", to_text(scene.thickness),
                        "must be left out for Model = " + scene.model);
}
} // namespace

void check(const Scene &scene, const Origins &origins)
{
  if (scene.dimension != 2 && scene.dimension != 3)
    throw origins.error("Dimension", to_text(scene.dimension), "must be one of 2, 3");
  if (scene.degree != 1 && scene.degree != 2)
    throw origins.error("Element degree", to_text(scene.degree), "must be one of 1, 2");
  if (scene.output_directory.empty())
    throw origins.error("Output directory", "", "must not be empty");
  check_model(scene, origins);
  check_names(scene, origins);
  require_range(origins, "Least scaled Jacobian", scene.least_scaled_jacobian, 0., 0.99);
  check_bodies(scene, origins);
  check_loads(scene, origins);
  check_contact(scene, origins);
  check_shapes(scene, origins);
  check_methods(scene, origins);
}

void check_methods(const Scene &scene, const Origins &origins)
{
  require_range(origins, "Solver/Relative tolerance", scene.solver.relative_tolerance, 1e-14, 0.1);
  require_positive(origins, "Solver/Maximum F-mults", scene.solver.max_iterations);
  check_responses(scene, origins);
  check_optimization(scene, origins);
  check_gradient(scene, origins);
}

std::string listed(const std::vector<std::string> &names)
{
  std::string text;
  for (const auto &name : names)
    text += (text.empty() ? "" : ", ") + name;
  return text;
}
} // namespace snug::scene
