#include <snug/advice/advice.h>
#include <snug/advice/cost.h>

#include <cmath>
#include <sstream>

namespace snug::advice {
namespace {
/// Advise fewer subdomains if there are more than four times as many as 'auto' makes: then the
/// coarse problem and the F-mults cost more than the smaller factorizations save.
template <int dim>
void add_subdomains(const Subject<dim> &subject, std::vector<Advice> &advice)
{
  const double       n       = subject.solver.tearing().n_global;
  const unsigned int ranks   = subject.solver.context().n_ranks();
  auto               by_auto = subject.scene;
  by_auto.tearing.subdomains = 0;
  const double n_by_auto     = count(by_auto, ranks).subdomains;
  if (subject.scene.tearing.subdomains == 0 || n <= 4. * n_by_auto)
    return;
  const auto seconds = [&](const scene::Scene &scene) {
    const auto cost = estimate_cost(scene, ranks, 1.);
    return cost.setup + cost.factorization + cost.solve;
  };
  std::ostringstream text;
  text << n << " subdomains have only " << subject.mesh().n_global_cells() / n
       << " cells each: with 'Subdomains' = auto there are about " << n_by_auto;
  advice.push_back(
    {"too many subdomains", text.str(), seconds(subject.scene) / seconds(by_auto), 0., "time"});
}

/// Where elements lock their estimates are too large rather than too small, but of the same order.
template <int dim>
void add_locking(const Subject<dim> &subject, std::vector<Advice> &advice)
{
  const double relative = subject.largest_error();
  if (subject.mesh().idealization().kind == mesh::Idealization::Kind::plane_stress)
    return;
  for (unsigned int b = 0; b < subject.model().bodies.size(); ++b)
    for (const auto &material : subject.model().bodies[b].materials)
      if (material.poissons_ratio >= 0.49 &&
          subject.model().bodies[b].formulation == elasticity::Formulation::standard)
        {
          std::ostringstream text;
          text << "body " << subject.model().body_names[b] << " with Poisson's ratio "
               << material.poissons_ratio
               << " locks: it is far too stiff on these cells; set its 'Formulation' = B-bar";
          advice.push_back({"locking", text.str(), 1., relative * relative});
          break;
        }
}
} // namespace

template <int dim>
std::vector<Advice> settings(const Subject<dim> &subject)
{
  std::vector<Advice> advice;
  add_subdomains(subject, advice);
  add_locking(subject, advice);
  return advice;
}

template <int dim>
std::vector<Advice> give(const Subject<dim> &subject)
{
  auto advice = symmetries(subject);
  for (const auto &more : {needless_cells(subject), settings(subject), mesh_advice(subject)})
    advice.insert(advice.end(), more.begin(), more.end());
  return advice;
}

template std::vector<Advice> settings(const Subject<2> &);
template std::vector<Advice> give(const Subject<2> &);
template std::vector<Advice> settings(const Subject<3> &);
template std::vector<Advice> give(const Subject<3> &);
} // namespace snug::advice
