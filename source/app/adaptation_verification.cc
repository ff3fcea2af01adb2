#include <snug/app/adaptation.h>
#include <snug/base/errors.h>
#include <snug/mesh/refined_cells.h>

#include <algorithm>
#include <cmath>
#include <ostream>

namespace snug::app {
namespace {
/// Number of unknowns up to which the mesh for verification takes about a second, so that it is
/// always solved.
constexpr double cheap_unknowns = 1e4;

/// Maximum number of meshes for verification that are refined further after missing the targets.
constexpr unsigned int most_finer = 3;
} // namespace

/// Check the targets on a mesh with all cells divided and all elements of CAD files halved. Its
/// error is assumed to be 4^-p of the error of the mesh before. The estimates meet the targets
/// already. An analysis that fails on the finer mesh is therefore a reason to fail only if `Verify`
/// is true.
template <int dim>
std::string Adaptation<dim>::verify()
{
  if (const auto unbounded = unbounded_at_edge(); !unbounded.empty())
    return unbounded;
  Refinement everywhere = meshes.everywhere(*solved->problem->mesh, last_refinement);
  auto       mesh       = meshes.make(everywhere);
  if (!meshes.is_affordable(*mesh))
    return "the mesh for verification has " + std::to_string(meshes.unknowns(*mesh)) +
           " unknowns; increase 'Maximum unknowns', or " +
           (scene.task == scene::Task::optimize ? "relax 'Target'" : "set 'Verify' to false");
  std::unique_ptr<Adapted> fine;
  try
    {
      fine = solve_next(std::move(mesh));
    }
  catch (const SolveError &error)
    {
      const std::string text =
        std::string("the analysis on the mesh for verification failed: ") + error.what();
      if (scene.accuracy.verify.value_or(false))
        return text;
      context.out() << text << std::endl;
      return "";
    }
  const double rest = std::pow(4., -1. * scene.degree);
  std::string  missed;
  finer_is_enough = true;
  summary.verified.clear();
  for (unsigned int d = 0; d < demands.size(); ++d)
    {
      const double value = fine->measured[d].value;
      const double error = std::abs(value - solved->measured[d].value) / (1. - rest);
      const double most  = demands[d].target.allowed(value);
      const auto   text  = accuracy::text_of(demands[d].name, {solved->measured[d].value, error});
      if (error > most)
        missed += (missed.empty() ? "" : ", ") + text;
      else
        context.out() << "verified with " << meshes.unknowns(*fine->problem->mesh)
                      << " unknowns: " << text << std::endl;
      summary.verified.push_back({demands[d].name, value, error});
      finer_is_enough = finer_is_enough && rest * error <= most;
    }
  if (missed.empty())
    return "";
  summary.met   = false;
  finer         = std::move(everywhere);
  finer_problem = std::move(fine);
  return "verification failed on the finer mesh (" + missed + "): relax 'Target'";
}

/// Return whether the mesh is to be verified: as `Verify` says or, without this entry, if the
/// verification takes no longer than the meshes before.
template <int dim>
bool Adaptation<dim>::is_to_be_verified() const
{
  if (is_at_rest())
    return false;
  if (const auto &given = scene.accuracy.verify)
    return *given;
  double spent = cheap_unknowns;
  for (const auto &mesh : summary.meshes)
    spent = std::max(spent, 1. * mesh.dofs);
  const double needed = (1 << dim) * meshes.unknowns(*solved->problem->mesh);
  return needed <= std::min(spent, scene.accuracy.maximum_unknowns);
}

/// Continue on the mesh for verification if the targets are missed there.
template <int dim>
std::string Adaptation<dim>::reach_and_verify()
{
  std::string refused;
  for (unsigned int n = 0;; ++n)
    {
      const auto why = reach(1.);
      if (!why.empty())
        return why;
      if (!is_to_be_verified())
        {
          const auto unbounded = unbounded_at_edge();
          return !unbounded.empty() ? unbounded : finer_is_enough ? "" : refused;
        }
      refused = verify();
      if (refused.empty() || !finer_problem || n == most_finer)
        return refused;
      context.out() << refused.substr(0, refused.find(':')) << ": refining further" << std::endl;
      last_refinement = finer;
      solved          = std::move(finer_problem);
    }
}

#define SNUG_INSTANTIATE(dim)                               \
  template std::string Adaptation<dim>::verify();           \
  template std::string Adaptation<dim>::reach_and_verify(); \
  template bool        Adaptation<dim>::is_to_be_verified() const;
SNUG_INSTANTIATE(2)
SNUG_INSTANTIATE(3)
#undef SNUG_INSTANTIATE
} // namespace snug::app
