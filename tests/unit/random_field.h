#ifndef snug_tests_unit_random_field_h
#define snug_tests_unit_random_field_h

#include <deal.II/base/tensor.h>

#include <random>
#include <vector>

namespace snug::test {
/// Return @p n pseudo-random vectors with components in [-1, 1), which depend on @p seed alone.
template <int dim>
std::vector<dealii::Tensor<1, dim>> random_field(std::size_t n, unsigned int seed)
{
  std::mt19937                           generator(seed);
  std::uniform_real_distribution<double> random(-1., 1.);
  std::vector<dealii::Tensor<1, dim>>    field(n);
  for (auto &vector : field)
    for (unsigned int d = 0; d < dim; ++d)
      vector[d] = random(generator);
  return field;
}
} // namespace snug::test

#endif
