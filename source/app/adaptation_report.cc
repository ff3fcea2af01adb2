#include <snug/accuracy/sharp_edges.h>
#include <snug/app/adaptation.h>
#include <snug/base/errors.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <ostream>

namespace snug::app {
namespace {
/// Of states of which a response is called unbounded, or zero.
const double sure_tolerance = 1e-6;

/// The least of all load cases.
template <int dim>
double contact_faces(const std::vector<state::ContactState<dim>> &states)
{
  double least = std::numeric_limits<double>::infinity();
  for (const auto &state : states)
    least = std::min(least, state.assumptions.width);
  return least;
}
} // namespace

template <int dim>
unsigned long Adaptation<dim>::unknowns(const mesh::BodyMesh<dim> &mesh)
{
  return dim * mesh.n_global_free_nodes();
}

template <int dim>
void Adaptation<dim>::report(const Stage &stage)
{
  io::Summary::AdaptedMesh mesh;
  mesh.dofs          = unknowns(*stage.problem->mesh);
  mesh.contact_faces = contact_faces(stage.states);
  mesh.tolerance     = tolerance(stage);
  mesh.seconds       = context.seconds() - began;
  for (const auto &state : stage.states)
    mesh.f_mults += state.f_mults;
  auto &out = context.out();
  out << "mesh " << summary.meshes.size() + 1 << ": " << mesh.dofs << " unknowns";
  if (std::isfinite(mesh.contact_faces))
    out << ", contact " << std::round(10. * mesh.contact_faces) / 10. << " faces across";
  for (unsigned int d = 0; d < demands.size(); ++d)
    {
      const auto &estimate = stage.measured[d];
      mesh.responses.push_back({demands[d].name, estimate.value, estimate.error});
      out << ", " << accuracy::text_of(demands[d].name, estimate);
    }
  out << ", " << mesh.f_mults << " F-mults to " << mesh.tolerance << ", " << mesh.seconds << " s"
      << std::endl;
  summary.meshes.push_back(mesh);
}

/// What keeps a demand from ever being met; empty: nothing. What a loose tolerance leaves is no
/// error of the mesh: the answer holds for states that are solved well. Collective.
template <int dim>
std::string Adaptation<dim>::failure()
{
  const auto before = demands;
  auto       why    = noted();
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
  return noted();
}

template <int dim>
std::string Adaptation<dim>::noted()
{
  std::string first;
  for (unsigned int d = 0; d < demands.size(); ++d)
    {
      const auto text = demands[d].note(solved->measured[d], is_met(d));
      first           = first.empty() ? text : first;
    }
  return first;
}

template <int dim>
std::string Adaptation<dim>::missed(const std::string &advice) const
{
  std::string text = "targets are not met:";
  for (unsigned int d = 0; d < demands.size(); ++d)
    if (!is_met(d))
      text += " " + accuracy::text_of(demands[d].name, solved->measured[d]);
  return text +
         (reads_pressure() && contact_faces(solved->states) < scene.accuracy.contact_faces
            ? " with too few faces across a contact"
            : "") +
         (unresolved.empty() ? "" : "; " + unresolved.front()) + "; " + advice;
}

/// Targets of pressures that have no limit, though the errors on a mesh may be small beside its own
/// values. @return why they cannot be met; empty: there are none. Collective.
template <int dim>
std::string Adaptation<dim>::unbounded_at_edge()
{
  const auto &solver = *solved->problem->solver;
  for (unsigned int d = 0; d < demands.size(); ++d)
    {
      const auto pairs = solved->responses[demands[d].place]->unbounded_at_edges(solver);
      if (pairs.empty())
        continue;
      for (const auto &edge : accuracy::sharp_edges(solver, solved->states[demands[d].load_case]))
        for (const auto &part : solver.contact().joined_pairs()[edge.pair].parts)
          if (pairs[part.pair])
            {
              summary.met = false;
              return "targets are not met: " +
                     accuracy::text_of(demands[d].name, solved->measured[d]) + "; " + edge.text +
                     ": round the edge, or ask for energies, forces and areas alone";
            }
    }
  return "";
}

#define SNUG_INSTANTIATE(dim)                                                    \
  template unsigned long Adaptation<dim>::unknowns(const mesh::BodyMesh<dim> &); \
  template void          Adaptation<dim>::report(const Stage &);                 \
  template std::string   Adaptation<dim>::failure();                             \
  template std::string   Adaptation<dim>::missed(const std::string &) const;     \
  template std::string   Adaptation<dim>::unbounded_at_edge();
SNUG_INSTANTIATE(2)
SNUG_INSTANTIATE(3)
#undef SNUG_INSTANTIATE
} // namespace snug::app
