#include <snug/accuracy/sharp_edges.h>
#include <snug/advice/advice.h>
#include <snug/state/assumptions.h>

#include <algorithm>
#include <cmath>
#include <set>
#include <sstream>

namespace snug::advice {
namespace {
/// Return whether the scene uses responses for which the estimate of the energy does not hold.
bool asks_for_more(const scene::Scene &scene)
{
  std::vector<std::string> asked;
  for (const auto &response : scene.responses)
    asked.push_back(response.quantity);
  if (scene.task != scene::Task::state)
    asked.push_back(scene::response_called(scene, scene.optimization.objective)->quantity);
  return std::any_of(asked.begin(), asked.end(), [](const std::string &quantity) {
    return quantity.find("pressure") != std::string::npos ||
           quantity.find("Mises") != std::string::npos || quantity == "contact area";
  });
}

/// How many faces wide contact is where it is narrowest, of all load cases; all of a side: as many
/// as its rows say.
template <int dim>
double contact_width(const Subject<dim> &subject)
{
  double width = std::numeric_limits<double>::infinity();
  for (const auto &state : subject.states)
    {
      width = std::min(width, state.assumptions.width);
      for (const auto &pair : state.pairs)
        if (pair.active_contacts > 0)
          width = std::min(width, std::pow(pair.active_contacts, 1. / (dim - 1)));
    }
  return width;
}

/// Errors of energies are squares of those in the energy norm and grow by 4^p from mesh to mesh
/// where nothing is singular. The coarser mesh is to be trusted as well.
template <int dim>
void add_finer(const Subject<dim> &subject, std::vector<Advice> &advice)
{
  const double       relative = subject.largest_error();
  const unsigned int p        = subject.mesh().degree();
  const double       coarser  = std::pow(4., p) * relative * relative;
  if (relative == 0. || coarser > 0.8 * subject.target || asks_for_more(subject.scene) ||
      contact_width(subject) < 2. * subject.scene.accuracy.contact_faces * p)
    return;
  std::ostringstream text;
  text << "the estimated error of the energy is " << 100. * relative * relative
       << " %: cells of twice the size would do";
  advice.push_back({"mesh finer than needed", text.str(), std::pow(2., dim), coarser});
}

template <int dim>
void add_facets(const Subject<dim> &subject, std::vector<Advice> &advice)
{
  double height = 0., closed = 1.;
  for (const auto &state : subject.states)
    if (const auto &found = state.assumptions;
        found.facet_height * closed > height * found.closed_gap)
      {
        height = found.facet_height;
        closed = found.closed_gap;
      }
  if (height <= state::large_facets * closed)
    return;
  std::ostringstream text;
  text << "contact sees facets " << height << " high, and the largest gap or overlap it closes is "
       << closed
       << ": set 'Surface' = smooth for these boundaries of mesh files, or take a finer file";
  advice.push_back({"facets", text.str(), 1., height / closed});
}

/// Sharp edges under pressure, of each joined pair once, whatever the load case.
template <int dim>
void add_corners(const Subject<dim> &subject, std::vector<Advice> &advice)
{
  std::set<unsigned int> pairs;
  for (const auto &state : subject.states)
    for (const auto &edge : accuracy::sharp_edges(subject.solver, state))
      if (pairs.insert(edge.pair).second)
        advice.push_back(
          {"corner", edge.text + ": round the edge, or trust energies and forces alone"});
}
} // namespace

template <int dim>
std::vector<Advice> mesh_advice(const Subject<dim> &subject)
{
  std::vector<Advice> advice;
  add_finer(subject, advice);
  add_facets(subject, advice);
  add_corners(subject, advice);
  return advice;
}

template std::vector<Advice> mesh_advice(const Subject<2> &);
template std::vector<Advice> mesh_advice(const Subject<3> &);
} // namespace snug::advice
