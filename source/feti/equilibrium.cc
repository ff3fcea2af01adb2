#include <snug/base/errors.h>
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

/// A body is at rest in a free motion if the square of its share in the motion is below this value.
const double rest_cut = 1e-6;

/// Return the columns Z'g_i of @p rows, each followed by the row's numbers in @p values, on all
/// ranks and in the order of the ranks.
qp::MultiVector
row_columns(const CoarseSpace &coarse, const qp::RowSet &rows, const qp::MultiVector &values)
{
  // Row i of G'Z is the wrench of a unit force of contact i, in coordinates of the body modes.
  const RowLayout &layout = coarse.structure().layout;
  auto             all    = coarse.transpose_multiply(coarse.body_modes(), nullptr);
  all.append(values);
  std::vector<double> mine;
  for (unsigned int i = 0; i < layout.n_owned(); ++i)
    if (rows[i])
      for (unsigned int k = 0; k < all.n_columns(); ++k)
        mine.push_back(all(i, k));
  std::vector<double> numbers;
  for (const auto &of_rank : dealii::Utilities::MPI::all_gather(layout.communicator(), mine))
    numbers.insert(numbers.end(), of_rank.begin(), of_rank.end());
  // Columns are contiguous in memory, so the gathered numbers are the matrix.
  qp::MultiVector columns(all.n_columns(), narrow<unsigned int>(numbers.size() / all.n_columns()));
  std::copy(numbers.begin(), numbers.end(), columns.column(0));
  return columns;
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

/// Return a text such as "body punch escapes: translation (0 0 1), rotation (0 0 0)" for the body
/// that moves most under @p motion, which is in coordinates of the body modes.
std::string describe_escape(const qp::MultiVector &motion, const SubdomainTable &table)
{
  const unsigned int  m = table.n_modes;
  std::vector<double> squares(table.body_names.size(), 0.);
  for (unsigned int i = 0; i < motion.n_rows(); ++i)
    squares[i / m] += motion(i) * motion(i);
  const auto body = std::max_element(squares.begin(), squares.end()) - squares.begin();
  return "body " + table.body_names[body] + " escapes: " +
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
} // namespace

/// Check whether some lambda satisfies G lambda = e, lambda_I >= 0. Multipliers of equality rows
/// have no bounds, so only the motions Z Y that no equality row resists matter: Y'Z'G_I lambda_I =
/// Y'Z'e. All ranks solve the same small problem with the same numbers and get the same result.
void LoadedProblem::check_equilibrium() const
{
  const auto &coarse = linear.coarse();
  const auto  free   = motions_unresisted_by(coarse, qp::complement(bounded()));
  // Supports hold all bodies, so every load can be balanced.
  if (free.n_columns() == 0)
    return;
  const auto columns  = row_columns(coarse, bounded(), qp::MultiVector(n_owned(), 0));
  auto       wrenches = transpose_times(free, columns);
  const auto whole = qp::norms(columns, MPI_COMM_SELF), part = qp::norms(wrenches, MPI_COMM_SELF);
  for (unsigned int k = 0; k < wrenches.n_columns(); ++k)
    if (part[k] < wrench_cut * whole[k])
      std::fill_n(wrenches.column(k), wrenches.n_rows(), 0.);
  const auto load     = transpose_times(free, transpose_times(coarse.body_modes(), rigid_load));
  const auto balance  = qp::nnls(wrenches, load);
  double     residual = 0.;
  for (unsigned int i = 0; i < balance.residual.n_rows(); ++i)
    residual = std::max(residual, std::abs(balance.residual(i)));
  // The residual is the load that no contact resists, hence also the direction of the escape. Loads
  // of one body may cancel, so rounding errors are relative to the loads before they cancel.
  if (residual > balance_tolerance * gross_load)
    throw SolveError("no equilibrium: " +
                     describe_escape(times(free, balance.residual), linear.table()));
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
