#include <random/dense_algebra.h>
#include <random/dense_problem.h>

#include <algorithm>
#include <cmath>

namespace snug::test {
namespace {
/// Parts of a row's wrench or of a load below this part of it are rounding.
const double rounding = 1e-11;
/// Rates of f'u between these, relative to the loads, are too near to tell.
const double no_rate = 1e-10, some_rate = 1e-8;
} // namespace

DenseOracle::DenseOracle(const DenseProblem &problem) : problem(problem)
{
  find_free_motions();
  BN.reinit(problem.contact.size(), N.n());
  load.reinit(N.n());
  gross = problem.f.l1_norm();
  for (unsigned int k = 0; k < N.n(); ++k)
    {
      double most = 0.;
      for (unsigned int i = 0; i < N.m(); ++i)
        {
          load(k) += N(i, k) * problem.f(i);
          most = std::max(most, std::abs(N(i, k)));
        }
      if (std::abs(load(k)) < rounding * most * gross)
        load(k) = 0.;
      for (unsigned int r = 0; r < BN.m(); ++r)
        {
          double whole = 0.;
          for (const auto &[i, c] : problem.contact[r].coefficients)
            {
              BN(r, k) += c * N(i, k);
              whole += std::abs(c);
            }
          if (std::abs(BN(r, k)) < rounding * most * whole)
            BN(r, k) = 0.;
        }
    }
}

/// Held rows concern one body each.
void DenseOracle::find_free_motions()
{
  std::vector<Vector> columns;
  for (unsigned int b = 0; b < problem.K.size(); ++b)
    {
      const unsigned int  first = problem.first[b], last = problem.first[b + 1];
      const Matrix       &R = problem.rigid[b];
      std::vector<Vector> of_rows;
      for (const auto &row : problem.held)
        if (row.coefficients[0].first >= first && row.coefficients[0].first < last)
          {
            of_rows.emplace_back(R.n());
            for (const auto &[i, c] : row.coefficients)
              for (unsigned int k = 0; k < R.n(); ++k)
                of_rows.back()(k) += c * R(i - first, k);
          }
      // at least one row: a matrix without rows forgets its columns
      Matrix H(of_rows.size() + 1, R.n());
      for (unsigned int i = 0; i < of_rows.size(); ++i)
        for (unsigned int k = 0; k < R.n(); ++k)
          H(i, k) = of_rows[i](k);
      // motions are of size 1
      const auto left = null_space(H, 1e-8).basis;
      for (unsigned int k = 0; k < left.n(); ++k)
        {
          columns.emplace_back(problem.f.size());
          for (unsigned int i = first; i < last; ++i)
            for (unsigned int j = 0; j < R.n(); ++j)
              columns.back()(i) += R(i - first, j) * left(j, k);
          columns.back() /= columns.back().l2_norm();
          body_of.push_back(b);
        }
    }
  N.reinit(problem.f.size(), columns.size());
  for (unsigned int k = 0; k < N.n(); ++k)
    for (unsigned int i = 0; i < N.m(); ++i)
      N(i, k) = columns[k](i);
}

Verdict DenseOracle::verdict() const
{
  Verdict verdict;
  if (N.n() == 0)
    {
      verdict.kind = Verdict::held;
      return verdict;
    }
  Vector       c     = load;
  const double scale = gross / std::sqrt(double(N.m()));
  if (scale > 0.)
    c /= scale;
  Matrix A(BN.m() + 1, N.n()), rows(BN.m() + 1, N.n());
  Vector closing(N.n());
  for (unsigned int i = 0; i < BN.m(); ++i)
    {
      double square = 0.;
      for (unsigned int k = 0; k < N.n(); ++k)
        square += BN(i, k) * BN(i, k);
      for (unsigned int k = 0; k < N.n() && square > 0.; ++k)
        {
          rows(i, k) = A(i, k) = BN(i, k) / std::sqrt(square);
          closing(k) -= rows(i, k);
        }
    }
  const auto worst = largest(rows, c);
  verdict.rate     = worst.value;
  if (worst.error > 1e-9 || (worst.value > no_rate && worst.value < some_rate))
    return verdict;
  if (worst.value >= some_rate)
    {
      // whatever a body may do can be added to the escape
      verdict.kind = Verdict::escape;
      verdict.may_move.assign(problem.K.size(), false);
      for (unsigned int k = 0; k < N.n(); ++k)
        for (const double sign : {-1., 1.})
          {
            Vector e(N.n());
            e(k) = sign;
            if (largest(rows, e).value > 1e-6)
              verdict.may_move[body_of[k]] = true;
          }
      return verdict;
    }
  // A motion that opens contact, or slides, while f'u is not lowered.
  for (unsigned int k = 0; k < N.n(); ++k)
    A(BN.m(), k) = -c(k);
  const auto opening = largest(A, closing);
  const bool slides  = null_space(rows, 1e-8).basis.n() > 0;
  if (opening.error < 1e-9)
    verdict.kind = slides || opening.value > some_rate ? Verdict::neutral : Verdict::held;
  return verdict;
}

} // namespace snug::test
