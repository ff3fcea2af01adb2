#include <snug/base/errors.h>
#include <snug/base/narrow.h>
#include <snug/feti/total_feti.h>
#include <snug/qp/nnls.h>

#include <algorithm>
#include <cmath>
#include <sstream>

namespace snug::feti {
namespace {
/// Rigid loads below this part of all loads are round-off.
const double balance_tolerance = 1e-8;

/// Columns Z'g_i of all contact rows, on all ranks in rank order.
qp::MultiVector contact_columns(const CoarseSpace &coarse, const RowLayout &layout)
{
  const unsigned int n_modes = coarse.body_modes().n_columns();
  // Row i of G'Z is the wrench, in body mode coordinates, that a unit force of contact i exerts.
  const auto          rows = coarse.transpose_multiply(coarse.body_modes(), nullptr);
  std::vector<double> mine;
  for (unsigned int i = 0; i < layout.n_owned(); ++i)
    if (layout.bounded()[i])
      for (unsigned int mode = 0; mode < n_modes; ++mode)
        mine.push_back(rows(i, mode));
  int n_ranks, count = narrow<int>(mine.size());
  MPI_Comm_size(layout.communicator(), &n_ranks);
  std::vector<int> counts(n_ranks), starts(n_ranks + 1, 0);
  MPI_Allgather(&count, 1, MPI_INT, counts.data(), 1, MPI_INT, layout.communicator());
  for (int r = 0; r < n_ranks; ++r)
    starts[r + 1] = starts[r] + counts[r];
  // Columns contiguous in memory: the gathered numbers are the matrix already.
  qp::MultiVector columns(n_modes, starts.back() / n_modes);
  MPI_Allgatherv(mine.data(), count, MPI_DOUBLE, columns.column(0), counts.data(), starts.data(),
                 MPI_DOUBLE, layout.communicator());
  return columns;
}

/// Orthonormal basis of the body motions no equality row sees.
qp::MultiVector free_motions(const CoarseSpace &coarse, const RowLayout &layout)
{
  // Gluing is among these rows, but sees no motion that moves each body rigidly.
  qp::RowSet equality = layout.bounded();
  for (auto &flag : equality)
    flag = !flag;
  CsrMatrix A = coarse.pattern();
  A.values    = coarse.gram_values(equality);
  return coarse.unseen_motions(A);
}

/// "body punch: translation (0 0 1), rotation (0 0 0)" of the body that
/// moves most under @p motion in body mode coordinates.
std::string describe_motion(const qp::MultiVector &motion, const SubdomainTable &table)
{
  const unsigned int m    = table.n_modes;
  unsigned int       body = 0;
  double             best = -1.;
  for (unsigned int b = 0; b < table.body_names.size(); ++b)
    {
      double square = 0.;
      for (unsigned int i = 0; i < m; ++i)
        square += motion(b * m + i) * motion(b * m + i);
      if (square > best)
        {
          best = square;
          body = b;
        }
    }
  // Space, plane section, axisymmetric section.
  const unsigned int n_translations = m == 6 ? 3 : (m == 3 ? 2 : 1);
  std::ostringstream text;
  text.precision(2);
  text << "body " << table.body_names[body] << " escapes: ";
  for (unsigned int i = 0; i < m; ++i)
    {
      // In orthonormal modes of the body: directions mean something, amounts of rotations do not.
      const double part = motion(body * m + i) / std::sqrt(best);
      text << (i == 0                ? "translation ("
               : i == n_translations ? "), rotation ("
                                     : " ")
           << (std::abs(part) < 5e-3 ? 0. : part);
    }
  text << ")";
  return text.str();
}
} // namespace

/// Is there lambda with G lambda = e, lambda_I >= 0? The multipliers of equality rows are free, so
/// only the motions Z Y that no equality row sees matter: Y'Z'G_I lambda_I = Y'Z'e. All ranks hold
/// the same numbers and solve the same small problem, so that all come to the same answer.
std::string TotalFeti::escaping_body() const
{
  const auto free    = free_motions(coarse, layout);
  const auto columns = contact_columns(coarse, layout);
  // Supports hold all bodies: every load can be balanced.
  if (free.n_columns() == 0)
    return "";
  const auto wrenches = transpose_times(free, columns);
  const auto load     = transpose_times(free, transpose_times(coarse.body_modes(), rigid_load));
  // Loads of single subdomains, before they cancel within a body: rounding is of their size.
  double scale = 0.;
  for (unsigned int i = 0; i < rigid_load.n_rows(); ++i)
    scale = std::max(scale, std::abs(rigid_load(i)));
  const auto balance  = qp::nnls(wrenches, load);
  double     residual = 0.;
  for (unsigned int i = 0; i < balance.residual.n_rows(); ++i)
    residual = std::max(residual, std::abs(balance.residual(i)));
  // The residual is the load that no contact resists, hence also the direction of the escape.
  if (residual > balance_tolerance * scale)
    return describe_motion(times(free, balance.residual), coarse.subdomains());
  // A body that nothing touches and nothing loads is balanced, but its position is not determined.
  return unheld_body(free, columns);
}

std::string TotalFeti::unheld_body(const qp::MultiVector &free,
                                   const qp::MultiVector &columns) const
{
  const unsigned int m = coarse.subdomains().n_modes;
  for (unsigned int body = 0; body < n_bodies(); ++body)
    {
      double held = 0., touched = 0.;
      // all its motions are free if the rows of `free` are orthonormal
      for (unsigned int i = 0; i < m; ++i)
        {
          double square = 0.;
          for (unsigned int j = 0; j < free.n_columns(); ++j)
            square += free(body * m + i, j) * free(body * m + i, j);
          // 1 - |row of free|^2: how much of body mode i the equality rows hold.
          held = std::max(held, 1. - square);
          for (unsigned int k = 0; k < columns.n_columns(); ++k)
            touched = std::max(touched, std::abs(columns(body * m + i, k)));
        }
      if (held < 1e-8 && touched == 0.)
        return "body " + coarse.subdomains().body_names[body] + " has neither supports nor contact";
    }
  return "";
}
} // namespace snug::feti
