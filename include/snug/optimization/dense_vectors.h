#ifndef snug_optimization_dense_vectors_h
#define snug_optimization_dense_vectors_h

#include <algorithm>
#include <cmath>
#include <numeric>
#include <vector>

namespace snug::optimization {
/// Return a'b for vectors of equal length.
inline double dot(const std::vector<double> &a, const std::vector<double> &b)
{
  return std::inner_product(a.begin(), a.end(), b.begin(), 0.);
}

/// Return the Euclidean norm.
inline double norm(const std::vector<double> &v)
{
  return std::sqrt(dot(v, v));
}

/// Return max |v_i|; 0 for an empty vector.
inline double largest(const std::vector<double> &v)
{
  double result = 0.;
  for (const double entry : v)
    result = std::max(result, std::abs(entry));
  return result;
}

/// Add factor b to a.
inline void add(std::vector<double> &a, const double factor, const std::vector<double> &b)
{
  for (unsigned int i = 0; i < b.size(); ++i)
    a[i] += factor * b[i];
}
} // namespace snug::optimization

#endif
