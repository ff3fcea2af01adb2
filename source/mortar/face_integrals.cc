#include <snug/mortar/mortar_coupling.h>

namespace snug::mortar {
namespace {
/// Visit all numbers of integrals whose sizes are set, always in the same order.
template <typename Integrals, typename Visit>
void for_each_number(Integrals &integrals, const Visit &visit)
{
  const auto of_table = [&](auto &table) {
    for (unsigned int i = 0; i < table.n_rows(); ++i)
      for (unsigned int j = 0; j < table.n_cols(); ++j)
        visit(table(i, j));
  };
  for (auto &number : integrals.slave)
    visit(number);
  of_table(integrals.slave_slave);
  for (auto *tables : {&integrals.slave_master, &integrals.weights})
    for (auto &table : *tables)
      of_table(table);
  of_table(integrals.offset);
}

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
FaceIntegrals<Number> from_numbers(const unsigned int                  n,
                                   const unsigned int                  n_masters,
                                   std::vector<double>::const_iterator numbers)
{
  FaceIntegrals<Number> integrals;
  integrals.slave.resize(n);
  integrals.slave_slave.reinit(n, n);
  integrals.slave_master.assign(n_masters, dealii::Table<2, Number>(n, n));
  integrals.weights = integrals.slave_master;
  integrals.offset.reinit(n, dim);
  for_each_number(integrals, [&](Number &number) { take(numbers, number); });
  return integrals;
}

#define SNUG_INSTANTIATE(Number)                                                       \
  template std::vector<double>   to_numbers(const FaceIntegrals<Number> &);            \
  template FaceIntegrals<Number> from_numbers<2>(unsigned int, unsigned int,           \
                                                 std::vector<double>::const_iterator); \
  template FaceIntegrals<Number> from_numbers<3>(unsigned int, unsigned int,           \
                                                 std::vector<double>::const_iterator);
SNUG_INSTANTIATE(double)
SNUG_INSTANTIATE(faces::Differential<1>)
#undef SNUG_INSTANTIATE
} // namespace snug::mortar
