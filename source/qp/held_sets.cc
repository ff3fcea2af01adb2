#include <snug/base/errors.h>
#include <snug/base/gather.h>
#include <snug/base/narrow.h>
#include <snug/qp/held_sets.h>
#include <snug/qp/kkt.h>
#include <snug/qp/row_set.h>

#include <deal.II/base/mpi.h>

#include <algorithm>
#include <cmath>
#include <sstream>
#include <tuple>

namespace snug::qp {
namespace {
/// Rates of contacts below this part of the largest rate are rounding errors.
const double slow = 1e-10;

/// Part of a load that may be rounding errors.
const double load_rounding = 1e-12;

/// Number of changes, without slips against the motion, after which the bodies slide.
const unsigned int most_unopposed = 3;

/// Return the rate of the tangential rows of a slip along its direction.
double rate_along(const Slip &slip, const MultiVector &rates, const unsigned int column = 0)
{
  double rate = 0.;
  for (unsigned int t = 0; t < slip.cone.n_tangents; ++t)
    rate += slip.direction[t] * rates(slip.cone.tangents[t], column);
  return rate;
}

/// Return whether a slip moves in one of the motions with the @p rates, one per column. Bodies that
/// move together have rates that are rounding errors; B and R are orthonormal except for a few
/// rows. Collective.
bool moves_slips(const MultiVector &rates, const std::vector<Slip> &slips, MPI_Comm comm)
{
  double fastest[2] = {0., 1.}; // of slips, of all rows
  for (unsigned int k = 0; k < rates.n_columns(); ++k)
    {
      for (const Slip &slip : slips)
        fastest[0] = std::max(fastest[0], std::abs(rate_along(slip, rates, k)));
      for (unsigned int i = 0; i < rates.n_rows(); ++i)
        fastest[1] = std::max(fastest[1], std::abs(rates(i, k)));
    }
  MPI_Allreduce(MPI_IN_PLACE, fastest, 2, MPI_DOUBLE, MPI_MAX, comm);
  return fastest[0] > slow * fastest[1];
}

double length_of_tangents(const FrictionCone &cone, const MultiVector &x)
{
  double square = 0.;
  for (unsigned int t = 0; t < cone.n_tangents; ++t)
    square += x(cone.tangents[t]) * x(cone.tangents[t]);
  return std::sqrt(square);
}

double largest_of_all(const double mine, MPI_Comm comm)
{
  return dealii::Utilities::MPI::max(mine, comm);
}
} // namespace

/// Return the friction forces of slips with a given bound, which do not depend on y.
MultiVector HeldSets::given_forces(const FreeRows &rows) const
{
  MultiVector forces(problem.n_owned());
  for (const Slip &slip : rows.slips())
    for (unsigned int t = 0; t < slip.cone.n_tangents; ++t)
      forces(slip.cone.tangents[t]) = slip.cone.bound * slip.direction[t];
  return forces;
}

/// Return @p rows without tangential rows that may not be free.
FreeRows HeldSets::independent(const FreeRows &rows) const
{
  RowSet            flags = rows.rows();
  std::vector<Slip> slips;
  for (const FrictionCone &cone : problem.cones())
    for (unsigned int t = cone.n_free_tangents(flags); t < cone.n_tangents; ++t)
      flags[cone.tangents[t]] = 0;
  for (const Slip &slip : rows.slips())
    if (slip.cone.n_tangents == 1 || !slip.cone.is_cornered(flags))
      slips.push_back(slip);
  return {flags, slips};
}

std::unique_ptr<FreeSet>
HeldSets::balanced(FreeRows rows, const MultiVector &w, const double scale, MultiVector &lambda)
{
  rows          = independent(rows);
  auto free_set = problem.free_set(rows);
  bool changed  = false;
  while (change(*free_set, w, scale, lambda, rows))
    {
      changed  = true;
      rows     = independent(rows);
      free_set = problem.free_set(rows);
    }
  repairs += changed;
  const MultiVector given = given_forces(rows);
  MultiVector       e     = problem.e();
  e.add(-1., problem.apply_G(given));
  const double unbalanced = free_set->make_feasible(lambda, e)[0];
  lambda.add(1., given);
  if (unbalanced > balance_tolerance * load_scale(problem, lambda, scale))
    throw NoEquilibrium("no equilibrium: the contacts cannot balance the loads of a floating body");
  return free_set;
}

/// Change the sets once if a motion is missing an equation. Return whether they have changed.
bool HeldSets::change(const FreeSet     &free_set,
                      const MultiVector &w,
                      const double       scale,
                      const MultiVector &lambda,
                      FreeRows          &rows)
{
  const MPI_Comm     comm = problem.context().communicator();
  const MultiVector &V    = free_set.unresisted_motions();
  if (V.n_columns() == 0)
    return false;
  MultiVector forces = lambda;
  rows.restrict(forces);
  rows.expand(forces);
  forces.add(1., given_forces(rows));
  MultiVector missing = problem.e();
  missing.add(-1., problem.apply_G(forces));
  const double size      = load_scale(problem, forces, scale);
  const auto   load      = norms(transpose_times(V, problem.e()), MPI_COMM_SELF)[0];
  const bool   is_loaded = load > balance_tolerance * size;
  if (!is_loaded && !moves_slips(problem.apply_Gt(V), rows.slips(), comm))
    return false;
  const auto  part   = transpose_times(V, missing);
  MultiVector motion = times(V, part);
  double      amount = transpose_times(part, part)(0);
  if (amount == 0.)
    {
      // The friction forces happen to balance the load. Any motion shows which contacts slide.
      motion = V.columns_from(0, 1);
      for (unsigned int k = 1; k < V.n_columns(); ++k)
        motion.add(1., V.columns_from(k, 1));
    }
  const auto rates   = problem.apply_Gt(motion);
  double     sliding = 0., closing = 0.;
  for (const Slip &slip : rows.slips())
    sliding = std::max(sliding, length_of_tangents(slip.cone, rates));
  for (unsigned int i = 0; i < problem.n_owned(); ++i)
    if (problem.bounded()[i] && !rows.rows()[i])
      closing = std::max(closing, rates(i));
  closing = largest_of_all(closing, comm);
  if (sliding = largest_of_all(sliding, comm); sliding > 0. && sliding >= closing)
    {
      hold_slips(moved_slips(w, rates, lambda, rows), amount, rows);
      const double lacking = std::sqrt(amount) / (is_loaded ? load : size);
      if (unopposed > most_unopposed && lacking > load_rounding)
        {
          std::ostringstream text;
          text.precision(2);
          text << "slides: " << problem.describe_motion(motion) << "; friction forces lack "
               << 100. * lacking << " % of the load along it";
          throw SolveError(text.str());
        }
      return true;
    }
  if (closing > 0. && close(rates, rows))
    return true;
  throw NoEquilibrium("no equilibrium: " + problem.describe_motion(motion));
}

/// Return the slips of all ranks that the motion moves, ascending by their slip. Collective.
std::vector<HeldSets::MovedSlip> HeldSets::moved_slips(const MultiVector &w,
                                                       const MultiVector &rates,
                                                       const MultiVector &lambda,
                                                       const FreeRows    &rows) const
{
  std::vector<double> mine; // whether it is moved, slip, gain, whether it is against the motion
  for (const Slip &slip : rows.slips())
    {
      const double rate = rate_along(slip, rates);
      mine.insert(mine.end(),
                  {length_of_tangents(slip.cone, rates), length_of_tangents(slip.cone, w),
                   2. * slip.cone.limit(lambda) * std::abs(rate), rate < 0. ? 1. : 0.});
    }
  const auto             numbers = all_gather(problem.context().communicator(), mine);
  std::vector<MovedSlip> all;
  for (unsigned int rank = 0; rank < numbers.size(); ++rank)
    for (unsigned int i = 0; 4 * i < numbers[rank].size(); ++i)
      if (const double *of = &numbers[rank][std::size_t(4) * i]; of[0] > 0.)
        all.push_back({of[1], of[2], of[3] == 1., rank, i});
  std::sort(all.begin(), all.end(), [](const MovedSlip &a, const MovedSlip &b) {
    return std::tie(a.slip, a.rank, a.index) < std::tie(b.slip, b.rank, b.index);
  });
  return all;
}

/// Turn slips against the motion round, the smallest first, as long as their friction forces do not
/// exceed what is @p missing, and let the next contact stick.
void HeldSets::hold_slips(const std::vector<MovedSlip> &all, const double missing, FreeRows &rows)
{
  const unsigned int     rank = problem.context().rank();
  std::vector<MovedSlip> against;
  std::copy_if(all.begin(), all.end(), std::back_inserter(against),
               [](const MovedSlip &moved) { return moved.is_against; });
  auto      slips  = rows.slips();
  auto      flags  = rows.rows();
  MovedSlip sticks = all.front();
  if (against.empty())
    ++unopposed;
  double gained = 0.;
  for (const MovedSlip &moved : against)
    {
      // The force of the contact that sticks lies between those of both slips. If all turned slips
      // do not suffice, the last one of them sticks.
      sticks = moved;
      if (gained + moved.gain >= missing)
        break;
      gained += moved.gain;
      if (moved.rank == rank)
        for (double &n : slips[moved.index].direction)
          n = -n;
    }
  if (sticks.rank == rank)
    {
      const FrictionCone &cone = slips[sticks.index].cone;
      for (unsigned int t = 0; t < cone.n_tangents; ++t)
        flags[cone.tangents[t]] = 1;
      slips.erase(slips.begin() + sticks.index);
    }
  rows = FreeRows(flags, slips);
}

/// Close open contacts that close in the motion; they stick. Return whether there are any.
bool HeldSets::close(const MultiVector &rates, FreeRows &rows) const
{
  const MPI_Comm comm    = problem.context().communicator();
  double         fastest = 0.;
  for (unsigned int i = 0; i < problem.n_owned(); ++i)
    fastest = std::max(fastest, problem.bounded()[i] ? rates(i) : 0.);
  fastest      = largest_of_all(fastest, comm);
  RowSet flags = rows.rows();
  bool   grows = false;
  for (unsigned int i = 0; i < problem.n_owned(); ++i)
    if (problem.bounded()[i] && !flags[i] && rates(i) > slow * fastest)
      {
        flags[i] = 1;
        grows    = true;
      }
  for (const FrictionCone &cone : problem.cones())
    if (flags[cone.normal] && !rows.rows()[cone.normal])
      for (unsigned int t = 0; t < cone.n_tangents; ++t)
        flags[cone.tangents[t]] = 1;
  rows = FreeRows(flags, rows.slips());
  return any(grows, comm);
}

FreeRows HeldSets::with_one_change(const FreeRows &from, const FreeRows &to) const
{
  const RowSet rows = qp::with_one_change(from.rows(), to.rows(), problem.context().communicator());
  RowSet       flags = rows;
  std::vector<Slip> slips;
  for (const FrictionCone &cone : problem.cones())
    {
      bool changes = rows[cone.normal] != from.rows()[cone.normal];
      for (unsigned int t = 0; t < cone.n_tangents; ++t)
        changes = changes || rows[cone.tangents[t]] != from.rows()[cone.tangents[t]];
      // A contact that does not change keeps its set, with the new direction if it slips.
      const FreeRows &source = changes ? to : from;
      flags[cone.normal]     = source.rows()[cone.normal];
      for (unsigned int t = 0; t < cone.n_tangents; ++t)
        flags[cone.tangents[t]] = source.rows()[cone.tangents[t]];
      const Slip *const slip = source.slip(cone.normal), *const newer = to.slip(cone.normal);
      if (slip)
        slips.push_back(newer ? *newer : *slip);
    }
  return {flags, slips};
}
} // namespace snug::qp
