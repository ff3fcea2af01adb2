#include <snug/accuracy/sharp_edges.h>
#include <snug/advice/advice.h>
#include <snug/advice/cost.h>
#include <snug/state/validity_checks.h>

#include <cmath>
#include <set>
#include <sstream>

namespace snug::advice {
namespace {
/// Advise fewer subdomains if there are more than four times as many as 'auto' makes: then the
/// coarse problem and the F-mults cost more than the smaller factorizations save.
template <int dim>
void add_subdomains(const AdviceInput<dim> &input, std::vector<Advice> &advice)
{
  const auto given   = count(input.scene, input.mesh());
  auto       by_auto = given;
  by_auto.subdomains = given.subdomains_by_size;
  if (input.scene.tearing.subdomains == 0 || given.subdomains <= 4. * by_auto.subdomains)
    return;
  const auto seconds = [&](const Counts &counts) {
    const auto cost = estimate_cost(input.scene, counts, input.solver.context().n_ranks(), 1.);
    return cost.setup + cost.factorization + cost.solve;
  };
  std::ostringstream text;
  text << given.subdomains << " subdomains have only " << given.cells / given.subdomains
       << " cells each: with 'Subdomains' = auto there are about " << by_auto.subdomains;
  advice.push_back(
    {"too many subdomains", text.str(), seconds(given) / seconds(by_auto), 0., "time"});
}

/// Where elements lock, their estimated errors are too large, but of the right order.
template <int dim>
void add_locking(const AdviceInput<dim> &input, std::vector<Advice> &advice)
{
  const double relative = input.largest_error();
  if (input.mesh().idealization().kind == mesh::Idealization::Kind::plane_stress)
    return;
  for (unsigned int b = 0; b < input.model().bodies.size(); ++b)
    for (const auto &material : input.model().bodies[b].materials)
      if (material.poissons_ratio >= 0.49 &&
          input.model().bodies[b].formulation == elasticity::Formulation::standard)
        {
          std::ostringstream text;
          text << "body " << input.model().body_names[b] << " with Poisson's ratio "
               << material.poissons_ratio
               << " locks: it is far too stiff on these cells; set its 'Formulation' = B-bar";
          advice.push_back({"locking", text.str(), 1., relative * relative});
          break;
        }
}

/// Return whether a response is a pressure or a stress, on which the estimate of the energy gives
/// no information.
bool has_local_response(const scene::Scene &scene)
{
  std::vector<std::string> quantities;
  for (const auto &response : scene.responses)
    quantities.push_back(response.quantity);
  if (scene.task != scene::Task::state)
    quantities.push_back(scene::response_called(scene, scene.optimization.objective)->quantity);
  return std::any_of(quantities.begin(), quantities.end(), [](const std::string &quantity) {
    return quantity.find("pressure") != std::string::npos ||
           quantity.find("Mises") != std::string::npos || quantity == "contact area";
  });
}

/// Return the minimum width of a contact in faces, of all load cases. The width of a side that is
/// in contact as a whole follows from the number of its rows.
template <int dim>
double contact_width(const AdviceInput<dim> &input)
{
  double width = std::numeric_limits<double>::infinity();
  for (const auto &state : input.states)
    {
      width = std::min(width, state.validity.width);
      for (const auto &pair : state.pairs)
        if (pair.active_contacts > 0)
          width = std::min(width, std::pow(pair.active_contacts, 1. / (dim - 1)));
    }
  return width;
}

/// Errors of energies are squares of errors in the energy norm and grow by 4^p from mesh to mesh
/// where nothing is singular. Contacts must be wide enough on the coarser mesh as well.
template <int dim>
void add_fine_mesh(const AdviceInput<dim> &input, std::vector<Advice> &advice)
{
  const double       relative = input.largest_error();
  const unsigned int p        = input.mesh().degree();
  const double       coarser  = std::pow(4., p) * relative * relative;
  if (relative == 0. || coarser > 0.8 * input.target || has_local_response(input.scene) ||
      contact_width(input) < 2. * input.scene.accuracy.contact_faces * p)
    return;
  std::ostringstream text;
  text << "the estimated error of the energy is " << 100. * relative * relative
       << " %: cells of twice the size would do";
  advice.push_back({"mesh finer than needed", text.str(), std::pow(2., dim), coarser});
}

/// Report the load case with the highest facets relative to the closed gap.
template <int dim>
void add_facets(const AdviceInput<dim> &input, std::vector<Advice> &advice)
{
  double worst = 0.;
  for (const auto &state : input.states)
    if (const auto facets = state::facet_warning(state.validity))
      if (facets->value > worst)
        {
          if (worst > 0.)
            advice.pop_back();
          worst = facets->value;
          advice.push_back({"facets", facets->text, 1., facets->value});
        }
}

/// Report a sharp edge under pressure once for each pair, whatever the load case.
template <int dim>
void add_corners(const AdviceInput<dim> &input, std::vector<Advice> &advice)
{
  std::set<unsigned int> pairs;
  for (const auto &state : input.states)
    for (const auto &edge : accuracy::sharp_edges(input.solver, state))
      if (pairs.insert(edge.pair).second)
        advice.push_back(
          {"corner", edge.text + ": round the edge, or use energies and forces only"});
}
} // namespace

template <int dim>
std::vector<Advice> collect(const AdviceInput<dim> &input)
{
  std::vector<Advice> advice;
  // A section of revolution keeps all planes of symmetry except those across the axis. The loads of
  // reference points are not compared.
  const bool compares = input.model().points.empty();
  if constexpr (dim == 3)
    if (compares)
      advice = revolution(input);
  if (advice.empty() && compares)
    advice = symmetry_planes(input);
  for (const auto &more : {unstressed_regions(input), needless_friction(input)})
    advice.insert(advice.end(), more.begin(), more.end());
  add_subdomains(input, advice);
  add_locking(input, advice);
  add_fine_mesh(input, advice);
  add_facets(input, advice);
  add_corners(input, advice);
  return advice;
}

template std::vector<Advice> collect(const AdviceInput<2> &);
template std::vector<Advice> collect(const AdviceInput<3> &);
} // namespace snug::advice
