#include <snug/mortar/mortar_coupling.h>

namespace snug::mortar {
namespace {
void append(const double number, std::vector<double> &numbers)
{
  numbers.push_back(number);
}

void append(const faces::Differential<1> &number, std::vector<double> &numbers)
{
  numbers.insert(numbers.end(), {number.value, number.slope[0]});
}

void take(std::vector<double>::const_iterator &from, double &number)
{
  number = *from++;
}

void take(std::vector<double>::const_iterator &from, faces::Differential<1> &number)
{
  number.value    = *from++;
  number.slope[0] = *from++;
}
} // namespace

template <typename Number>
std::vector<double> to_numbers(const FaceIntegrals<Number> &integrals)
{
  std::vector<double> numbers;
  for_each_number(integrals, [&](const Number &number) { append(number, numbers); });
  return numbers;
}

template <int dim, typename Number>
FaceIntegrals<Number> zero_integrals(const unsigned int n, const unsigned int n_masters)
{
  FaceIntegrals<Number> integrals;
  integrals.slave.resize(n);
  integrals.slave_slave.reinit(n, n);
  integrals.slave_master.assign(n_masters, dealii::Table<2, Number>(n, n));
  integrals.weights = integrals.slave_master;
  integrals.offset.reinit(n, dim);
  return integrals;
}

template <int dim, typename Number>
FaceIntegrals<Number> from_numbers(const unsigned int                  n,
                                   const unsigned int                  n_masters,
                                   std::vector<double>::const_iterator numbers)
{
  auto integrals = zero_integrals<dim, Number>(n, n_masters);
  for_each_number(integrals, [&](Number &number) { take(numbers, number); });
  return integrals;
}

#define SNUG_INSTANTIATE_DIM(dim, Number)                                         \
  template FaceIntegrals<Number> zero_integrals<dim>(unsigned int, unsigned int); \
  template FaceIntegrals<Number> from_numbers<dim>(unsigned int, unsigned int,    \
                                                   std::vector<double>::const_iterator);
#define SNUG_INSTANTIATE(Number)                                          \
  template std::vector<double> to_numbers(const FaceIntegrals<Number> &); \
  SNUG_INSTANTIATE_DIM(2, Number)                                         \
  SNUG_INSTANTIATE_DIM(3, Number)
SNUG_INSTANTIATE(double)
SNUG_INSTANTIATE(faces::Differential<1>)
template FaceIntegrals<faces::Recorded> zero_integrals<2>(unsigned int, unsigned int);
template FaceIntegrals<faces::Recorded> zero_integrals<3>(unsigned int, unsigned int);
#undef SNUG_INSTANTIATE
#undef SNUG_INSTANTIATE_DIM
} // namespace snug::mortar
