#include <snug/base/errors.h>
#include <snug/base/gather.h>
#include <snug/base/narrow.h>
#include <snug/feti/loaded_problem.h>
#include <snug/qp/nnls.h>
#include <snug/qp/row_set.h>

#include <deal.II/base/mpi.h>

#include <algorithm>
#include <cmath>
#include <sstream>

namespace snug::feti {
namespace {
/// Rigid loads below this part of all loads, taken before they cancel, are rounding errors.
const double balance_tolerance = 1e-10;

/// A row's wrench in free motions is rounding error below this part of the row's whole wrench. An
/// example is the moment of forces on round faces.
const double wrench_cut = 1e-10;

/// Maximum number of times that edges of cones are added; 1 to 15 suffice.
const unsigned int most_passes = 50;

/// A body is at rest in a free motion if the square of its share in the motion is below this value.
const double rest_cut = 1e-6;

/// Return the columns of all ranks, in the order of the ranks. Collective.
qp::MultiVector gather_columns(const std::vector<double> &mine, unsigned int n_rows, MPI_Comm comm)
{
  std::vector<double> numbers;
  for (const auto &of_rank : all_gather(comm, mine))
    numbers.insert(numbers.end(), of_rank.begin(), of_rank.end());
  // Columns are contiguous in memory, so the gathered numbers are the matrix.
  qp::MultiVector columns(n_rows, narrow<unsigned int>(numbers.size() / n_rows));
  std::copy(numbers.begin(), numbers.end(), columns.column(0));
  return columns;
}

/// Return the columns Z'g_i of @p rows, each followed by the row's numbers in @p values, on all
/// ranks and in the order of the ranks.
qp::MultiVector
row_columns(const CoarseSpace &coarse, const qp::RowSet &rows, const qp::MultiVector &values)
{
  // Row i of G'Z is the wrench of a unit force of contact i, in coordinates of the body modes.
  const RowLayout &layout = coarse.structure().layout;
  auto             all    = coarse.transpose_multiply(coarse.body_modes());
  all.append(values);
  std::vector<double> mine;
  for (unsigned int i = 0; i < layout.n_owned(); ++i)
    if (rows[i])
      for (unsigned int k = 0; k < all.n_columns(); ++k)
        mine.push_back(all(i, k));
  return gather_columns(mine, all.n_columns(), layout.communicator());
}

/// Return an orthonormal basis of the body motions that no row of @p rows resists. @p rows holds
/// the equality rows and some contact rows.
qp::MultiVector motions_unresisted_by(const CoarseSpace &coarse, const qp::RowSet &rows)
{
  // Gluing rows are among these rows, but resist no motion that moves each body rigidly.
  return coarse.near_kernel(coarse.gram(rows)).kernel;
}

/// Return a text such as "translation (0 0 1), rotation (0 0 0)" for the motion of one body. The
/// length of @p motion has no effect.
std::string describe_motion(const std::vector<double> &motion)
{
  const auto m = narrow<unsigned int>(motion.size());
  // The models in this order: space, plane section, axisymmetric section.
  const unsigned int n_translations = m == 6 ? 3 : (m == 3 ? 2 : 1);
  double             square         = 0.;
  for (const double part : motion)
    square += part * part;
  std::ostringstream text;
  text.precision(2);
  for (unsigned int i = 0; i < m; ++i)
    {
      // The parts are coordinates of orthonormal modes of the body. Directions are meaningful, but
      // amounts of rotations are not.
      const double part = motion[i] / std::sqrt(square);
      text << (i == 0                ? "translation ("
               : i == n_translations ? "), rotation ("
                                     : " ")
           << (std::abs(part) < 2e-2 ? 0. : part);
    }
  text << ")";
  return text.str();
}

/// Return a text such as "body punch is not held against its load along translation (0 0 1),
/// rotation (0 0 0)" for the body that moves most under @p motion, which is in coordinates of the
/// body modes.
std::string describe_escape(const qp::MultiVector &motion, const SubdomainTable &table)
{
  const unsigned int  m = table.n_modes;
  std::vector<double> squares(table.body_names.size(), 0.);
  for (unsigned int i = 0; i < motion.n_rows(); ++i)
    squares[i / m] += motion(i) * motion(i);
  const auto body = std::max_element(squares.begin(), squares.end()) - squares.begin();
  return "body " + table.body_names[body] + " is not held against its load along " +
         describe_motion({motion.column(0) + body * m, motion.column(0) + (body + 1) * m});
}

/// Return the motions that span the range of the projector @p P of one body, separated by "; ". The
/// text is empty if the body is at rest. The motions are the steps of a Cholesky factorization with
/// pivots, so that a body that may move along one axis only gets this axis.
std::string describe_range(qp::MultiVector P)
{
  const unsigned int m = P.n_rows();
  std::string        text;
  for (unsigned int step = 0; step < m; ++step)
    {
      unsigned int pivot = 0;
      for (unsigned int i = 1; i < m; ++i)
        // Among equal pivots take the first, independently of rounding.
        if (P(i, i) > 1.001 * P(pivot, pivot))
          pivot = i;
      if (P(pivot, pivot) <= rest_cut)
        break;
      const std::vector<double> motion(P.column(pivot), P.column(pivot) + m);
      text += (text.empty() ? "" : "; ") + describe_motion(motion);
      for (unsigned int j = 0; j < m; ++j)
        for (unsigned int i = 0; i < m; ++i)
          P(i, j) -= motion[i] * motion[j] / motion[pivot];
    }
  return text;
}

/**
 * This class generates the wrenches of contact forces in the motions @p free that no equality row
 * resists: forces along the normals and, with friction, along the edges of the cones. Circular
 * cones have infinitely many edges. Those against which a motion pushes are added on demand.
 */
class ContactWrenches
{
public:
  ContactWrenches(const LoadedProblem &the_problem, const qp::MultiVector &free)
    : problem(the_problem)
    , columns(the_problem.linearization().coarse().transpose_multiply(
        times(the_problem.linearization().coarse().body_modes(), free)))
    , whole(the_problem.linearization().coarse().transpose_multiply(
        the_problem.linearization().coarse().body_modes()))
    , wrenches(columns.n_columns(), 0)
  {
    auto                without_friction = problem.bounded();
    std::vector<double> mine;
    for (const qp::FrictionCone &cone : problem.cones())
      {
        without_friction[cone.normal] = 0;
        for (unsigned int t = 0; t < cone.n_tangents; ++t)
          for (const double sign : {1., -1.})
            {
              std::array<double, 2> h = {};
              h[t]                    = sign;
              add(cone, h, mine);
            }
        if (cone.coefficient == 0.)
          add_row(cone.normal, mine);
      }
    for (unsigned int i = 0; i < problem.n_owned(); ++i)
      if (without_friction[i])
        add_row(i, mine);
    gather(mine);
  }

  const qp::MultiVector &all() const { return wrenches; }

  /// Add the edges of circular cones against which the motion @p v pushes, in coordinates of the
  /// free motions. Return whether there are any. Collective.
  bool add_edges_against(const qp::MultiVector &v)
  {
    const auto          rates   = times(columns, v);
    const double        largest = qp::norms(v, MPI_COMM_SELF)[0];
    std::vector<double> mine;
    for (const qp::FrictionCone &cone : problem.cones())
      {
        if (cone.n_tangents < 2 || cone.coefficient == 0.)
          continue;
        const double x = rates(cone.tangents[0]), y = rates(cone.tangents[1]);
        const double along = std::hypot(x, y);
        if (rates(cone.normal) + cone.coefficient * along > wrench_cut * largest)
          add(cone, {{x / along, y / along}}, mine);
      }
    const bool any =
      dealii::Utilities::MPI::logical_or(!mine.empty(), problem.context().communicator());
    if (any)
      gather(mine);
    return any;
  }

private:
  const LoadedProblem  &problem;
  const qp::MultiVector columns, whole; ///< G' in free motions; in all motions of the bodies
  qp::MultiVector       wrenches;

  void add_row(const unsigned int row, std::vector<double> &mine) const { add({row}, {}, mine); }

  /// Add the wrench of the force n + mu h, or of h for a given bound.
  void
  add(const qp::FrictionCone &cone, const std::array<double, 2> &h, std::vector<double> &mine) const
  {
    const bool   is_bound = cone.n_tangents > 0 && cone.coefficient == 0.;
    const double mu       = is_bound ? 1. : cone.coefficient;
    const auto   wrench   = [&](const qp::MultiVector &G, const unsigned int k) {
      double sum = is_bound ? 0. : G(cone.normal, k);
      for (unsigned int t = 0; t < cone.n_tangents; ++t)
        sum += mu * h[t] * G(cone.tangents[t], k);
      return sum;
    };
    double part = 0., all = 0.;
    for (unsigned int k = 0; k < columns.n_columns(); ++k)
      part += std::pow(wrench(columns, k), 2);
    for (unsigned int k = 0; k < whole.n_columns(); ++k)
      all += std::pow(wrench(whole, k), 2);
    for (unsigned int k = 0; k < columns.n_columns(); ++k)
      mine.push_back(part < wrench_cut * wrench_cut * all ? 0. : wrench(columns, k));
  }

  void gather(const std::vector<double> &mine)
  {
    wrenches.append(gather_columns(mine, columns.n_columns(), problem.context().communicator()));
  }
};
} // namespace

std::string LoadedProblem::describe_motion(const qp::MultiVector &v) const
{
  return describe_escape(transpose_times(linear.coarse().body_modes(), v), linear.table());
}

/// Check whether some lambda within the cones satisfies G lambda = e. Multipliers of equality rows
/// have no bounds, so only the motions Z Y that no equality row resists matter: Y'Z'G_I lambda_I =
/// Y'Z'e. All ranks solve the same small problem with the same numbers and get the same result.
void LoadedProblem::check_equilibrium() const
{
  const auto &coarse = linear.coarse();
  const auto  free   = motions_unresisted_by(coarse, qp::complement(linear.contact_rows()));
  // Supports hold all bodies, so every load can be balanced.
  if (free.n_columns() == 0)
    return;
  ContactWrenches wrenches(*this, free);
  const auto      load = transpose_times(free, transpose_times(coarse.body_modes(), rigid_load));
  for (unsigned int pass = 0;; ++pass)
    {
      const auto residual = qp::nnls(wrenches.all(), load).residual;
      double     largest  = 0.;
      for (unsigned int i = 0; i < residual.n_rows(); ++i)
        largest = std::max(largest, std::abs(residual(i)));
      // Loads of one body may cancel, so rounding errors are relative to the loads before they
      // cancel.
      if (largest <= balance_tolerance * gross_load)
        return;
      // The residual is the load that no contact resists, hence also the direction of the escape.
      if (pass == most_passes || !wrenches.add_edges_against(residual))
        throw SolveError("no equilibrium: " +
                         describe_escape(times(free, residual), linear.table()));
    }
}

/// y = N'R'u are the coordinates of u in the motions N = Z Y that the loaded rows do not resist.
/// Replace y by the shortest y that keeps the other contacts open, or closed as far as they are:
/// w_i <= max(w_i, 0), with the w_i before the motion on the right.
void LoadedProblem::add_minimal_rigid_motion(const qp::RowSet &loaded,
                                             PrimalVectors    &u,
                                             qp::MultiVector  &alpha) const
{
  const auto &coarse = linear.coarse();
  const auto  Y      = motions_unresisted_by(coarse, loaded);
  if (Y.n_columns() == 0)
    return;
  qp::RowSet rows = bounded();
  for (unsigned int i = 0; i < n_owned(); ++i)
    rows[i] = rows[i] && !loaded[i];
  auto w = linear.multiply_B(u);
  w.add(-1., gap);
  const auto         columns = row_columns(coarse, rows, w);
  const auto         before  = transpose_times(times(coarse.body_modes(), Y), linear.rigid_part(u));
  const unsigned int n       = columns.n_columns();
  qp::MultiVector    A(Y.n_columns(), n), b(n);
  for (unsigned int j = 0; j < n; ++j)
    {
      b(j) = std::min(0., columns(Y.n_rows(), j));
      for (unsigned int k = 0; k < Y.n_columns(); ++k)
        {
          for (unsigned int i = 0; i < Y.n_rows(); ++i)
            A(k, j) -= Y(i, k) * columns(i, j);
          b(j) += A(k, j) * before(k);
        }
    }
  auto y = qp::shortest(A, b);
  // Large motions between contacts cost y some digits. Add the shortest correction that removes the
  // remaining overlap.
  b.add(-1., transpose_times(A, y));
  y.add(1., qp::shortest(A, b));
  y.add(-1., before);
  const auto shift = times(coarse.body_modes(), times(Y, y));
  alpha.add(1., shift);
  linear.add_rigid(shift, u);
}

std::vector<std::string> free_bodies(const Linearization &linearization, const qp::RowSet &rows)
{
  const auto               Y     = motions_unresisted_by(linearization.coarse(), rows);
  const SubdomainTable    &table = linearization.table();
  const auto               m     = table.n_modes;
  std::vector<std::string> lines;
  for (unsigned int body = 0; body < table.n_bodies(); ++body)
    {
      qp::MultiVector P(m, m); // Y_b Y_b'
      for (unsigned int k = 0; k < Y.n_columns(); ++k)
        for (unsigned int j = 0; j < m; ++j)
          for (unsigned int i = 0; i < m; ++i)
            P(i, j) += Y(body * m + i, k) * Y(body * m + j, k);
      const auto motions = describe_range(P);
      if (!motions.empty())
        lines.push_back("body " + table.body_names[body] + " is free to move: " + motions);
    }
  return lines;
}
} // namespace snug::feti
