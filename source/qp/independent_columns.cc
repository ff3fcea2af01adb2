#include <snug/base/narrow.h>
#include <snug/qp/independent_columns.h>

#include <algorithm>
#include <cmath>

namespace snug::qp {
MultiVector
orthonormal_combinations(const MultiVector &S, const std::vector<double> &smallest, double cut)
{
  const unsigned int       k = S.n_rows();
  MultiVector              C(k, 0);
  std::vector<MultiVector> candidates; // S-orthogonal to the columns of C
  std::vector<double>      squares;    // c'Sc of the candidates
  for (unsigned int j = 0; j < k; ++j)
    if (S(j, j) > smallest[j])
      {
        candidates.emplace_back(k);
        candidates.back()(j) = 1. / std::sqrt(S(j, j));
        squares.push_back(1.);
      }
  while (!candidates.empty())
    {
      const std::size_t pivot  = std::max_element(squares.begin(), squares.end()) - squares.begin();
      MultiVector       c      = candidates[pivot];
      const MultiVector Sc     = times(S, c);
      const double      square = transpose_times(c, Sc)(0);
      if (!(square > cut))
        break;
      candidates.erase(candidates.begin() + pivot);
      squares.erase(squares.begin() + pivot);
      for (std::size_t j = 0; j < candidates.size(); ++j)
        {
          const double part = transpose_times(candidates[j], Sc)(0) / square;
          candidates[j].add(-part, c);
          squares[j] -= part * part * square;
        }
      for (unsigned int i = 0; i < k; ++i)
        c(i) /= std::sqrt(square);
      C.append(c);
    }
  return C;
}

std::vector<unsigned int>
leading_columns(const MultiVector &S, const double distance, const double part)
{
  const unsigned int  k = S.n_rows();
  std::vector<double> squares(k); // squared distances from the span of the taken columns
  for (unsigned int j = 0; j < k; ++j)
    squares[j] = S(j, j);
  const double              longest = *std::max_element(squares.begin(), squares.end());
  const double              least   = std::max(distance * distance, part * part * longest);
  MultiVector               L(k, 0);
  std::vector<unsigned int> taken;
  do
    {
      const auto pivot =
        narrow<unsigned int>(std::max_element(squares.begin(), squares.end()) - squares.begin());
      const double root = std::sqrt(squares[pivot]);
      MultiVector  column(k);
      for (unsigned int j = 0; j < k; ++j)
        {
          double rest = S(j, pivot);
          for (unsigned int n = 0; n < taken.size(); ++n)
            rest -= L(j, n) * L(pivot, n);
          column(j) = rest / root;
          squares[j] -= column(j) * column(j);
        }
      squares[pivot] = 0.;
      L.append(column);
      taken.push_back(pivot);
  } while (*std::max_element(squares.begin(), squares.end()) > least);
  return taken;
}
} // namespace snug::qp
