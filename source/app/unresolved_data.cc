#include <snug/accuracy/surface_residual.h>
#include <snug/app/adaptation.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <ostream>

namespace snug::app {
namespace {
/// Return the part of formulas that the first mesh may miss. Where formulas jump, this error
/// decreases irregularly from mesh to mesh; therefore it is made small compared with the targets at
/// once.
double missed_data(const scene::Scene &scene)
{
  const double least = 0.002;
  double       part  = 0.05;
  for (const auto &of_response : scene.accuracy.targets)
    {
      const auto target = accuracy::read_target(of_response.second);
      part              = std::min(part, target.relative ? 0.25 * target.value : 0.01);
    }
  return std::max(part, least);
}
} // namespace

/// Refine the first mesh until it resolves the formulas and the surfaces of the scene, and warn of
/// what remains unresolved. States and estimates cannot depend on details without Gauss points and
/// nodes. Collective.
template <int dim>
void Adaptation<dim>::resolve_data()
{
  const RunContext::Timer timer(context, "setup");
  while (true)
    {
      const auto mesh  = build_mesh(scene, forest_with(last_refinement), false);
      auto       next  = last_refinement;
      const auto found = with_file_context(scene, [&]() {
        return accuracy::unresolved_data(*mesh, build_model(scene, *mesh), missed_data(scene));
      });
      add_cells(*mesh, last_refinement, found.cells, next);
      if (next != last_refinement && is_affordable(*mesh))
        {
          last_refinement = std::move(next);
          continue;
        }
      context.warn("unresolved data", found.lines);
      return;
    }
}

/// Return the part of pressures that the roughness of gaps between nodes may change. The part is
/// smaller for responses that are functions of pressures, because the roughness changes others
/// little. Collective.
template <int dim>
double Adaptation<dim>::allowed_roughness() const
{
  double                              least  = 0.1;
  const auto                         &solver = *solved->problem->solver;
  std::vector<response::PressureRows> none(solver.contact(0).named_pairs().size());
  for (unsigned int d = 0; d < demands.size(); ++d)
    if (solved->responses[demands[d].place]->measured(solver, 0, none))
      least = std::min(least, 0.25 * demands[d].allowed(solved->measured[d]) /
                                std::max(std::abs(solved->measured[d].value),
                                         std::numeric_limits<double>::min()));
  return least;
}

#define SNUG_INSTANTIATE(dim)                      \
  template void   Adaptation<dim>::resolve_data(); \
  template double Adaptation<dim>::allowed_roughness() const;
SNUG_INSTANTIATE(2)
SNUG_INSTANTIATE(3)
#undef SNUG_INSTANTIATE
} // namespace snug::app
