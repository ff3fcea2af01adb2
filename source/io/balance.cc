#include <snug/base/values.h>
#include <snug/io/balance.h>

#include <algorithm>
#include <cmath>
#include <sstream>

namespace snug::io {
namespace {
/// Return the quantity of which this rank has @p mine. Collective.
Spread spread(MPI_Comm comm, const double mine)
{
  int n_ranks;
  MPI_Comm_size(comm, &n_ranks);
  double ends[2] = {mine, -mine}; // one reduction finds both
  double sum     = mine;
  MPI_Allreduce(MPI_IN_PLACE, ends, 2, MPI_DOUBLE, MPI_MAX, comm);
  MPI_Allreduce(MPI_IN_PLACE, &sum, 1, MPI_DOUBLE, MPI_SUM, comm);
  return {-ends[1], sum / n_ranks, ends[0]};
}
} // namespace

template <int dim>
Balance collect_balance(const RunContext          &context,
                        const mesh::BodyMesh<dim> &mesh,
                        const mesh::Tearing       &tearing,
                        const feti::RowLayout     &layout)
{
  const MPI_Comm comm     = context.communicator();
  unsigned int   n_mine   = 0;
  double         unknowns = 0.;
  for (const auto &subdomain : tearing.subdomains)
    {
      n_mine += subdomain.nodes.empty() ? 0 : 1; // a reference point has no nodes
      unknowns += double(dim) * subdomain.nodes.size();
    }
  const double solves = context.work.subdomain_solve_seconds;
  Balance      result;
  result.n_ranks      = context.n_ranks();
  result.n_subdomains = tearing.n_global - tearing.n_points;
  result.subdomains   = spread(comm, n_mine);
  result.cells        = spread(comm, mesh.cells().size());
  result.unknowns     = spread(comm, unknowns);
  result.own_seconds =
    spread(comm, context.seconds("assembly") + context.seconds("factorization") + solves);
  for (const char *stage : stage_names)
    if (const auto of_stage = spread(comm, context.seconds(stage)); of_stage.largest > 0.)
      result.seconds.emplace_back(stage, of_stage);
  result.seconds.emplace_back("subdomain solves", spread(comm, solves));
  const auto    sent    = layout.sent();
  unsigned long most[3] = {sent.neighbours, sent.messages, sent.numbers * sizeof(double)};
  MPI_Allreduce(MPI_IN_PLACE, most, 3, MPI_UNSIGNED_LONG, MPI_MAX, comm);
  result.neighbours = most[0];
  result.messages   = most[1];
  result.bytes      = most[2];
  return result;
}

std::string balance_note(const Balance &balance)
{
  const double       bad = 1.3;
  std::ostringstream text;
  text.precision(2);
  if (balance.unknowns.ratio() > bad)
    {
      const unsigned int per_rank = std::lround(std::max(balance.subdomains.largest, 1.));
      const unsigned int fewer    = (balance.n_subdomains + per_rank - 1) / per_rank;
      text << "balance: a rank has " << balance.unknowns.ratio()
           << " times the mean number of unknowns: ";
      if (fewer < balance.n_ranks)
        text << "use " << counted(fewer, "rank") << ", which is as fast, or ";
      text << "set Decomposition/Subdomains to "
           << std::max(4 * balance.n_ranks, 2 * balance.n_subdomains) << " or more";
    }
  // Less than a second may be noise.
  else if (const auto &own = balance.own_seconds; own.ratio() > bad && own.largest - own.mean > 1.)
    text << "balance: a rank worked " << own.ratio()
         << " times as long on its subdomains as the mean, with as many unknowns: check that every "
            "rank has a core of its own, bound to it, and that no thread variable is above 1";
  return text.str();
}

template Balance collect_balance(const RunContext &,
                                 const mesh::BodyMesh<2> &,
                                 const mesh::Tearing &,
                                 const feti::RowLayout &);
template Balance collect_balance(const RunContext &,
                                 const mesh::BodyMesh<3> &,
                                 const mesh::Tearing &,
                                 const feti::RowLayout &);
} // namespace snug::io
