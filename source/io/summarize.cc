#include <snug/base/narrow.h>
#include <snug/io/summary.h>

#include <sys/resource.h>

#include <array>
#include <vector>

namespace snug::io {
/// Return the summary of the mesh. The caller adds the rows of B, which are not known here.
template <int dim>
Summary::Mesh summarize(const mesh::BodyMesh<dim> &mesh, const mesh::Tearing &tearing)
{
  Summary::Mesh result;
  // The mesh has a communicator, but no RunContext.
  int n_ranks;
  MPI_Comm_size(mesh.communicator(), &n_ranks);
  result.bodies = mesh.n_bodies();
  result.cells  = mesh.n_global_cells();
  // Count the unknowns before tearing, as other programs count them.
  result.dofs       = dim * mesh.n_global_free_nodes();
  result.subdomains = tearing.n_global;
  result.ranks      = n_ranks;
  return result;
}

namespace {
template <int dim>
std::vector<double> numbers(const dealii::Tensor<1, dim> &v)
{
  return {v.begin_raw(), v.end_raw()};
}
} // namespace

/// Copy the state. The io module has its own struct, so that keys of the file stay the same if
/// the solver's members change.
template <int dim>
Summary::State summarize(const state::ContactState<dim> &state)
{
  Summary::State result;
  result.least_scaled_jacobian = state.least_scaled_jacobian;
  result.energy                = state.energy;
  result.compliance            = state.compliance;
  result.strain_energy         = state.strain_energy;
  result.contact_force         = numbers(state.contact_force);
  result.load                  = numbers(state.load);
  result.balance               = numbers(state.balance);
  result.contact_area          = state.contact_area;
  result.max_pressure          = state.max_pressure;
  result.active_contacts       = state.active_contacts;
  result.weak_contacts         = state.weak_contacts;
  result.degeneracy_distance   = state.degeneracy_distance;
  result.outer_iterations      = state.dual.outer_iterations;
  result.f_mults               = state.f_mults;
  result.linear_f_mults        = state.linear_f_mults;
  result.method                = state.dual.method;
  result.certificate           = state.certificate;
  result.tolerance             = state.tolerance;
  result.validity              = state.validity;
  for (const auto &of_pair : state.pairs)
    {
      Summary::Pair pair;
      pair.name            = of_pair.name;
      pair.rows            = of_pair.rows;
      pair.active_contacts = of_pair.active_contacts;
      pair.force           = numbers(of_pair.force);
      pair.moment          = numbers(of_pair.moment);
      pair.centre          = numbers(of_pair.centre);
      pair.contact_area    = of_pair.contact_area;
      pair.max_pressure    = of_pair.max_pressure;
      pair.peak            = numbers(of_pair.peak);
      pair.peak_size       = of_pair.peak_size;
      result.pairs.push_back(pair);
    }
  for (const auto &reaction : state.reactions)
    result.reactions.push_back(
      {reaction.name, numbers(reaction.centre), numbers(reaction.force), numbers(reaction.moment)});
  return result;
}

namespace {
const std::array<const char *, 8> stages = {
  {"setup", "assembly", "factorization", "soft modes", "solve", "gradient", "accuracy", "output"}};
} // namespace

Summary::Times collect_times(const RunContext &context)
{
  // The stages are in the order of the members of Times.
  std::vector<double> seconds;
  for (const char *stage : stages)
    seconds.push_back(context.seconds(stage));
  seconds.push_back(context.seconds());
  // Take the slowest rank of each stage, because all other ranks wait for it.
  MPI_Allreduce(MPI_IN_PLACE, seconds.data(), seconds.size(), MPI_DOUBLE, MPI_MAX,
                context.communicator());
  return {seconds[0], seconds[1], seconds[2], seconds[3], seconds[4],
          seconds[5], seconds[6], seconds[7], seconds[8]};
}

/// Return the memory. Linux counts it in KiB.
Summary::Memory collect_memory(const RunContext &context)
{
  rusage of_this;
  getrusage(RUSAGE_SELF, &of_this);
  const double    here = double(of_this.ru_maxrss) / 1024.;
  Summary::Memory result;
  MPI_Allreduce(&here, &result.largest, 1, MPI_DOUBLE, MPI_MAX, context.communicator());
  MPI_Allreduce(&here, &result.total, 1, MPI_DOUBLE, MPI_SUM, context.communicator());
  std::vector<double> of_stages(1, context.memory_at_start());
  for (const char *stage : stages)
    of_stages.push_back(context.memory(stage));
  MPI_Allreduce(MPI_IN_PLACE, of_stages.data(), narrow<int>(of_stages.size()), MPI_DOUBLE, MPI_MAX,
                context.communicator());
  result.stages.emplace_back("start", of_stages[0]);
  for (unsigned int i = 0; i < stages.size(); ++i)
    if (of_stages[i + 1] > 0.)
      result.stages.emplace_back(stages[i], of_stages[i + 1]);
  return result;
}

template Summary::Mesh  summarize(const mesh::BodyMesh<2> &, const mesh::Tearing &);
template Summary::Mesh  summarize(const mesh::BodyMesh<3> &, const mesh::Tearing &);
template Summary::State summarize(const state::ContactState<2> &);
template Summary::State summarize(const state::ContactState<3> &);
} // namespace snug::io
