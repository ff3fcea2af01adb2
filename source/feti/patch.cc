#include <snug/base/narrow.h>
#include <snug/feti/patch.h>

#include <algorithm>
#include <cmath>
#include <numeric>

namespace snug::feti {
namespace {
/// Shift relative to the maximum diagonal entry of G_L G_L'. It does not affect motions that G_L
/// resists. It makes the matrix definite for motions that G_L does not resist, as hinges between
/// parts of a patch.
const double shift = 1e-10;

/// A vector is set to zero if equilibrium leaves less than this part: the rest is rounding error.
const double rounding = 1e-6;

/// Each pass multiplies a component of G_L c by shift / (s + shift), where s is the eigenvalue of
/// G_L G_L' of this component, relative to the maximum diagonal entry.
const unsigned int balancing_passes = 3;

double norm(const std::vector<double> &c)
{
  return std::sqrt(std::inner_product(c.begin(), c.end(), c.begin(), 0.));
}
} // namespace

Patch::Patch(std::vector<Touch> touches,
             const unsigned int n_members,
             const unsigned int the_n_modes)
  : n_modes(the_n_modes), n(n_members * the_n_modes), gram(n)
{
  std::sort(touches.begin(), touches.end(), [](const Touch &a, const Touch &b) {
    return std::make_pair(a.row, a.member) < std::make_pair(b.row, b.member);
  });
  for (auto first = touches.begin(); first != touches.end();)
    {
      const auto last = std::find_if(first, touches.end(),
                                     [&](const Touch &touch) { return touch.row != first->row; });
      if (last - first == narrow<std::ptrdiff_t>(first->copies))
        {
          start.push_back(narrow<unsigned int>(inner.size()));
          inner.insert(inner.end(), first, last);
        }
      first = last;
    }
  start.push_back(narrow<unsigned int>(inner.size()));
  factorize();
}

void Patch::balance(std::vector<double> &c) const
{
  const double whole = norm(c);
  for (unsigned int pass = 0; pass < balancing_passes; ++pass)
    {
      dealii::Vector<double> alpha(n);
      for (unsigned int i = 0; i < n_rows(); ++i)
        for (const Touch *t = begin(i); t != end(i); ++t)
          for (unsigned int m = 0; m < n_modes; ++m)
            alpha[t->member * n_modes + m] += t->G[m] * c[i];
      gram.solve(alpha);
      for (unsigned int i = 0; i < n_rows(); ++i)
        for (const Touch *t = begin(i); t != end(i); ++t)
          for (unsigned int m = 0; m < n_modes; ++m)
            c[i] -= t->G[m] * alpha[t->member * n_modes + m];
    }
  if (norm(c) < rounding * whole)
    c.assign(c.size(), 0.);
}

void Patch::factorize()
{
  for (unsigned int i = 0; i < n_rows(); ++i)
    for (const Touch *a = begin(i); a != end(i); ++a)
      // LAPACK reads the lower triangle only
      for (const Touch *b = begin(i); b <= a; ++b)
        for (unsigned int k = 0; k < n_modes; ++k)
          for (unsigned int l = 0; l < n_modes; ++l)
            gram(a->member * n_modes + k, b->member * n_modes + l) += a->G[k] * b->G[l];
  double largest = 0.;
  for (unsigned int i = 0; i < n; ++i)
    largest = std::max(largest, gram(i, i));
  for (unsigned int i = 0; i < n; ++i)
    gram(i, i) += shift * largest;
  gram.set_property(dealii::LAPACKSupport::symmetric);
  gram.compute_cholesky_factorization();
}
} // namespace snug::feti
