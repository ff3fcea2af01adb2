#include <snug/base/narrow.h>
#include <snug/feti/initial_active_set.h>
#include <snug/qp/row_set.h>

#include <deal.II/base/mpi.h>

#include <algorithm>
#include <cmath>

namespace snug::feti {
namespace {
/// The constant c. A set of up to three times the rows of the exact set takes hardly more F-mults
/// than the exact set. A set with too few rows takes as many F-mults as the set of all rows.
const double generosity = 2.;

/// Gap at the edge of a contact as a fraction of the approach; the value holds for spheres.
const double edge_gap = 0.5;

/// Number of bisections of delta, which reach a thousandth of the maximum gap.
const unsigned int n_bisections = 10;

/// Motions slower than this fraction of the fastest motion are round-off.
const double slow = 1e-8;

/// Return g of the owned rows after the motion that the loads begin where only contacts hold a
/// body, up to its first touch. For a shaft in its bore, gaps are then small on the side where it
/// falls.
std::vector<double> rigidly_closed_gaps(const LoadedProblem &problem)
{
  const auto equality = qp::complement(problem.linearization().contact_rows());
  if (free_bodies(problem.linearization(), equality).empty())
    return std::vector<double>(problem.g().column(0), problem.g().column(0) + problem.n_owned());
  const auto  set         = problem.free_set(equality);
  const auto &motions     = set->unresisted_motions();
  const auto  motion      = times(motions, transpose_times(motions, problem.e()));
  const auto  rates       = problem.apply_Gt(motion);
  double      extremes[2] = {0., HUGE_VAL}; // maximum rate, time until the first touch
  for (unsigned int i = 0; i < problem.n_owned(); ++i)
    extremes[0] = std::max(extremes[0], std::abs(rates(i)));
  const MPI_Comm comm = problem.context().communicator();
  MPI_Allreduce(MPI_IN_PLACE, &extremes[0], 1, MPI_DOUBLE, MPI_MAX, comm);
  std::vector<double> gaps(problem.n_owned());
  for (unsigned int i = 0; i < gaps.size(); ++i)
    {
      gaps[i] = problem.g()(i);
      if (problem.bounded()[i] && rates(i) > slow * extremes[0])
        extremes[1] = std::min(extremes[1], std::max(gaps[i], 0.) / rates(i));
    }
  MPI_Allreduce(MPI_IN_PLACE, &extremes[1], 1, MPI_DOUBLE, MPI_MIN, comm);
  if (std::isfinite(extremes[1]))
    for (unsigned int i = 0; i < gaps.size(); ++i)
      if (problem.bounded()[i])
        gaps[i] -= extremes[1] * rates(i);
  return gaps;
}

/// Fraction of the loads that a set may leave unbalanced.
const double start_balance_tolerance = 1e-8;

/// Maximum number of changes of the set, after which the set is taken as it is.
const unsigned int most_changes = 20;

/**
 * Return the contacts in @p rows that press where subdomains are rigid and rows are springs of
 * equal stiffness, and where pulling rows are released. The forces are G_M'(G_M G_M')^+ e on the
 * set M. Where a slender body lifts off, equilibrium alone determines approximately where.
 */
qp::RowSet rigid_contact_rows(const LoadedProblem &problem, const qp::RowSet &rows)
{
  const MPI_Comm comm   = problem.context().communicator();
  const double   size   = problem.feasibility_scale(0.);
  qp::RowSet     result = rows;
  for (unsigned int change = 0; change < most_changes; ++change)
    {
      const auto      set = problem.free_set(result);
      qp::MultiVector lambda(problem.n_owned());
      if (set->make_feasible(lambda, problem.e())[0] > start_balance_tolerance * size)
        return rows;
      const auto rates   = problem.apply_Gt(set->amplitudes(lambda));
      double     largest = 0.;
      for (unsigned int i = 0; i < problem.n_owned(); ++i)
        largest = std::max(largest, std::abs(lambda(i)));
      MPI_Allreduce(MPI_IN_PLACE, &largest, 1, MPI_DOUBLE, MPI_MAX, comm);
      bool changed = false;
      for (unsigned int i = 0; i < problem.n_owned(); ++i)
        if (problem.bounded()[i] && rows[i] && std::abs(rates(i)) > slow * largest &&
            result[i] != (rates(i) > 0.))
          {
            result[i] = rates(i) > 0.;
            changed   = true;
          }
      qp::free_tangents(problem.cones(), result);
      if (!dealii::Utilities::MPI::logical_or(changed, comm))
        break;
    }
  return result;
}

/// Known data of the pairs, equal on all ranks.
struct PairLoads
{
  std::vector<double> force;           ///< P
  std::vector<double> least, greatest; ///< minimum and maximum gap
  double              held = 0.;       ///< maximum held displacement
};

PairLoads
pair_loads(const LoadedProblem &problem, const std::vector<double> &gaps, const ContactPairs &pairs)
{
  const unsigned int n_pairs = pairs.n;
  const MPI_Comm     comm    = problem.context().communicator();
  qp::MultiVector    lambda(problem.n_owned());
  problem.free_set(qp::RowSet(problem.n_owned(), 1))->make_feasible(lambda, problem.e());
  PairLoads loads;
  loads.force.assign(n_pairs, 0.);
  loads.least.assign(n_pairs, HUGE_VAL);
  loads.greatest.assign(n_pairs, -HUGE_VAL);
  for (unsigned int i = 0; i < problem.n_owned(); ++i)
    {
      const double       gap  = gaps[i];
      const unsigned int pair = pairs.of_row[i];
      if (problem.linearization().contact_rows()[i] && !problem.bounded()[i])
        continue; // tangential rows
      if (pair == n_pairs)
        {
          loads.held = std::max(loads.held, std::abs(gap));
          continue;
        }
      loads.force[pair] += std::max(lambda(i), 0.);
      loads.least[pair]    = std::min(loads.least[pair], gap);
      loads.greatest[pair] = std::max(loads.greatest[pair], gap);
    }
  MPI_Allreduce(MPI_IN_PLACE, loads.force.data(), n_pairs, MPI_DOUBLE, MPI_SUM, comm);
  MPI_Allreduce(MPI_IN_PLACE, loads.least.data(), n_pairs, MPI_DOUBLE, MPI_MIN, comm);
  MPI_Allreduce(MPI_IN_PLACE, loads.greatest.data(), n_pairs, MPI_DOUBLE, MPI_MAX, comm);
  MPI_Allreduce(MPI_IN_PLACE, &loads.held, 1, MPI_DOUBLE, MPI_MAX, comm);
  return loads;
}
} // namespace

qp::RowSet rigid_prediction(const LoadedProblem &problem, const ContactPairs &pairs)
{
  const unsigned int n_pairs = pairs.n;
  const auto         gaps    = rigidly_closed_gaps(problem);
  const PairLoads    loads   = pair_loads(problem, gaps, pairs);
  // The maximum gap of a row in the set lies between low and high.
  std::vector<double> low(n_pairs), high(n_pairs);
  for (unsigned int p = 0; p < n_pairs; ++p)
    {
      low[p]  = loads.least[p] + edge_gap * loads.held + std::max(-loads.least[p], 0.);
      high[p] = std::max(loads.greatest[p], low[p]);
    }
  for (unsigned int step = 0; step < n_bisections; ++step)
    {
      std::vector<double> middle(n_pairs), sums(2 * n_pairs, 0.); // number of rows, sum of F_ii
      for (unsigned int p = 0; p < n_pairs; ++p)
        middle[p] = (low[p] + high[p]) / 2;
      for (unsigned int i = 0; i < problem.n_owned(); ++i)
        {
          const unsigned int pair = pairs.of_row[i];
          if (pair == n_pairs || !problem.bounded()[i] || gaps[i] > middle[pair])
            continue;
          sums[2 * pair] += 1.;
          sums[2 * pair + 1] += problem.diagonal()[i];
        }
      MPI_Allreduce(MPI_IN_PLACE, sums.data(), narrow<int>(sums.size()), MPI_DOUBLE, MPI_SUM,
                    problem.context().communicator());
      for (unsigned int p = 0; p < n_pairs; ++p)
        {
          const double n        = std::max(sums[2 * p], 1.);
          const double approach = generosity * loads.force[p] * sums[2 * p + 1] / n *
                                  (pairs.dim == 3 ? 1. / std::sqrt(n) : 1.);
          (approach < middle[p] - loads.least[p] ? high : low)[p] = middle[p];
        }
    }
  qp::RowSet expected(problem.n_owned(), 1);
  for (unsigned int i = 0; i < problem.n_owned(); ++i)
    {
      const unsigned int pair = pairs.of_row[i];
      // Pairs without a known force that presses them together keep all their rows.
      if (pair < n_pairs && (loads.force[pair] > 0. || low[pair] > loads.least[pair]))
        expected[i] = gaps[i] <= high[pair];
    }
  qp::free_tangents(problem.cones(), expected);
  return rigid_contact_rows(problem, expected);
}
} // namespace snug::feti
