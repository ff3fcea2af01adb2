#include <snug/base/narrow.h>
#include <snug/feti/neighbourhood_rows.h>

#include <algorithm>
#include <cmath>
#include <numeric>
#include <tuple>

namespace snug::feti {
namespace {
/// Shift relative to the maximum diagonal entry of G_L G_L'. It does not affect motions that G_L
/// resists. It makes the matrix definite for motions that G_L does not resist, as hinges between
/// parts of a neighbourhood.
const double gram_shift = 1e-10;

/// A vector is set to zero if equilibrium leaves less than this part: the rest is rounding error.
const double rounding = 1e-6;

/// Each pass multiplies a component of G_L c by gram_shift / (s + gram_shift), where s is the
/// eigenvalue of G_L G_L' of this component, relative to the maximum diagonal entry.
const unsigned int balancing_passes = 3;

double norm(const std::vector<double> &c)
{
  return std::sqrt(std::inner_product(c.begin(), c.end(), c.begin(), 0.));
}
} // namespace

NeighbourhoodRows::NeighbourhoodRows(std::vector<RowCopy>             copies,
                                     const std::vector<unsigned int> &members,
                                     const unsigned int               the_n_modes)
  : n_modes(the_n_modes), n(narrow<unsigned int>(members.size()) * the_n_modes), gram(n)
{
  std::sort(copies.begin(), copies.end(), [](const RowCopy &a, const RowCopy &b) {
    return std::tie(a.row, a.subdomain) < std::tie(b.row, b.subdomain);
  });
  for (auto of_row = copies.begin(); of_row != copies.end();)
    {
      const auto last = std::find_if(of_row, copies.end(),
                                     [&](const RowCopy &copy) { return copy.row != of_row->row; });
      if (last - of_row == narrow<std::ptrdiff_t>(of_row->multiplicity))
        {
          start.push_back(narrow<unsigned int>(inner.size()));
          inner.insert(inner.end(), of_row, last);
        }
      of_row = last;
    }
  start.push_back(narrow<unsigned int>(inner.size()));
  for (const RowCopy &copy : inner)
    first.push_back(n_modes * narrow<unsigned int>(
                                std::lower_bound(members.begin(), members.end(), copy.subdomain) -
                                members.begin()));
  factorize();
}

void NeighbourhoodRows::balance(std::vector<double> &c) const
{
  const double whole = norm(c);
  for (unsigned int pass = 0; pass < balancing_passes; ++pass)
    {
      dealii::Vector<double> alpha(n);
      for (unsigned int i = 0; i < n_rows(); ++i)
        for (const RowCopy *t = begin(i); t != end(i); ++t)
          for (unsigned int m = 0; m < n_modes; ++m)
            alpha[first_mode(t) + m] += t->G[m] * c[i];
      gram.solve(alpha);
      for (unsigned int i = 0; i < n_rows(); ++i)
        for (const RowCopy *t = begin(i); t != end(i); ++t)
          for (unsigned int m = 0; m < n_modes; ++m)
            c[i] -= t->G[m] * alpha[first_mode(t) + m];
    }
  if (norm(c) < rounding * whole)
    c.assign(c.size(), 0.);
}

void NeighbourhoodRows::factorize()
{
  for (unsigned int i = 0; i < n_rows(); ++i)
    for (const RowCopy *a = begin(i); a != end(i); ++a)
      // LAPACK reads the lower triangle only
      for (const RowCopy *b = begin(i); b <= a; ++b)
        for (unsigned int k = 0; k < n_modes; ++k)
          for (unsigned int l = 0; l < n_modes; ++l)
            gram(first_mode(a) + k, first_mode(b) + l) += a->G[k] * b->G[l];
  double largest = 0.;
  for (unsigned int i = 0; i < n; ++i)
    largest = std::max(largest, gram(i, i));
  // G_L is zero in sections of revolution that only the axis holds.
  for (unsigned int i = 0; i < n; ++i)
    gram(i, i) += largest > 0. ? gram_shift * largest : 1.;
  gram.set_property(dealii::LAPACKSupport::symmetric);
  gram.compute_cholesky_factorization();
}
} // namespace snug::feti
