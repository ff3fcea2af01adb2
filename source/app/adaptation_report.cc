#include <snug/accuracy/sharp_edges.h>
#include <snug/app/adaptation.h>
#include <snug/base/errors.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <ostream>

namespace snug::app {
namespace {
/// Tolerance of the states from which a response is reported as unbounded or zero.
const double sure_tolerance = 1e-6;

/// Maximum part of a target's response that may come from a sharp edge.
const double small_part = 0.5;

/// Return the minimum number of faces across a contact in all load cases; infinite: no contact.
template <int dim>
double contact_faces(const std::vector<state::ContactState<dim>> &states)
{
  double least = std::numeric_limits<double>::infinity();
  for (const auto &state : states)
    least = std::min(least, state.validity.width);
  return least;
}
} // namespace

template <int dim>
void Adaptation<dim>::report(const Adapted &adapted)
{
  io::Summary::AdaptedMesh mesh;
  mesh.dofs          = meshes.unknowns(*adapted.problem->mesh);
  mesh.contact_faces = contact_faces(adapted.states);
  mesh.tolerance     = tolerance(adapted);
  mesh.seconds       = context.seconds() - meshes.start_time();
  for (const auto &state : adapted.states)
    mesh.f_mults += state.f_mults;
  auto &out = context.out();
  out << "mesh " << summary.meshes.size() + 1 << ": " << mesh.dofs << " unknowns";
  if (std::isfinite(mesh.contact_faces))
    out << ", faces across the contact: " << std::round(10. * mesh.contact_faces) / 10.;
  for (unsigned int d = 0; d < demands.size(); ++d)
    {
      const auto &estimate = adapted.measured[d];
      mesh.responses.push_back({demands[d].name, estimate.value, estimate.error});
      out << ", " << accuracy::text_of(demands[d].name, estimate);
    }
  out << ", " << counted(mesh.f_mults, "F-mult") << ", solver tolerance " << mesh.tolerance << ", "
      << mesh.seconds << " s" << std::endl;
  summary.meshes.push_back(mesh);
}

/// Return why a target cannot be met by refinement; empty: it can. A loose tolerance leaves an
/// algebraic error, which is no discretization error: the result is only valid for states that are
/// solved to a tight tolerance. Collective.
template <int dim>
std::string Adaptation<dim>::failure_reason()
{
  const auto before = demands;
  auto       why    = record_errors();
  if (why.empty() || tolerance(*solved) <= sure_tolerance)
    return why;
  try
    {
      for (auto &state : solved->states)
        state = solved->problem->solver->solve_on(state, sure_tolerance);
    }
  catch (const SolveError &)
    {
      return why;
    }
  estimate(*solved);
  demands = before;
  return record_errors();
}

/// Record the values and the errors of the last mesh in the demands. Return the first reason why no
/// mesh can meet a demand; empty: there is none.
template <int dim>
std::string Adaptation<dim>::record_errors()
{
  std::string first;
  for (unsigned int d = 0; d < demands.size(); ++d)
    {
      const auto text = demands[d].note(solved->measured[d], is_met(d));
      first           = first.empty() ? text : first;
    }
  return first;
}

/// Return the message that targets are not met, with their errors and @p advice.
template <int dim>
std::string Adaptation<dim>::missed_targets(const std::string &advice) const
{
  std::string text = "targets are not met:";
  for (unsigned int d = 0; d < demands.size(); ++d)
    if (!is_met(d))
      text += " " + accuracy::text_of(demands[d].name, solved->measured[d]);
  return text +
         (reads_pressure() && contact_faces(solved->states) < scene.accuracy.contact_faces
            ? ", and a contact has fewer than " + to_text(scene.accuracy.contact_faces) + " faces"
            : "") +
         (unresolved_gaps.empty() ? "" : "; " + unresolved_gaps.front()) + "; " + advice;
}

/// Return the part of a response that is due to the contact forces at an edge: its change without
/// these forces. Collective.
template <int dim>
double part_of_edge(const response::Response<dim>  &response,
                    const state::StateSolver<dim>  &solver,
                    const state::ContactState<dim> &state,
                    const accuracy::SharpEdge      &edge)
{
  auto without = state;
  for (const unsigned int row : edge.rows)
    without.contact[row].force = 0.;
  return std::abs(response.value(solver, state) - response.value(solver, without));
}

/// Return why a sharp edge prevents a target from being met; empty: no edge does. Pressures at a
/// sharp edge may have no limit as cells get smaller, although their errors are small on each mesh.
/// If the part of the edge is small compared with the target, a warning says that the value holds
/// away from the edge. Collective.
template <int dim>
std::string Adaptation<dim>::unbounded_at_edge()
{
  const auto &solver = *solved->problem->solver;
  for (unsigned int d = 0; d < demands.size(); ++d)
    {
      const auto &state    = solved->states[demands[d].load_case];
      const auto &response = *solved->responses[demands[d].place];
      if (!response.unbounded_at_edges())
        continue;
      for (const auto &edge : accuracy::sharp_edges(solver, state))
        {
          const double part = part_of_edge(response, solver, state, edge);
          if (part > small_part * demands[d].allowed(solved->measured[d]))
            {
              summary.met = false;
              return "targets are not met: " +
                     accuracy::text_of(demands[d].name, solved->measured[d]) + "; " + edge.text +
                     ": round the edge, or set targets of energies, forces and areas only";
            }
          if (part > 0.)
            context.warn({"sharp edge", edge.text + ": " + demands[d].name +
                                          " is valid only away from the edge"});
        }
    }
  return "";
}

#define SNUG_INSTANTIATE(dim)                                                      \
  template void        Adaptation<dim>::report(const Adapted &);                   \
  template std::string Adaptation<dim>::failure_reason();                          \
  template std::string Adaptation<dim>::missed_targets(const std::string &) const; \
  template std::string Adaptation<dim>::unbounded_at_edge();
SNUG_INSTANTIATE(2)
SNUG_INSTANTIATE(3)
#undef SNUG_INSTANTIATE
} // namespace snug::app
