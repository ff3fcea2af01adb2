#include <snug/feti/contact_gram.h>

#include <deal.II/base/mpi.h>

#include <algorithm>
#include <cmath>
#include <numeric>

namespace snug::feti {
namespace {
/// Eigenvalues of S, scaled to unit diagonal, from this part of the largest on are inverted with
/// the relative error @p inverse_error. The ratio of a tenth took 5 to 20 % more F-mults in some
/// mortar scenes; ratios below 1 / 30 took as many as exact inverses.
const double least_eigenvalue = 1. / 30.;
const double inverse_error    = 0.05;

/// Part of the square of a row below which its rest is round-off, as on held components.
const double round_off = 1e-24;

/// Set v <- v minus its projections on the orthonormal vectors @p Q. Two sweeps because of
/// round-off.
void orthogonalise(const std::vector<std::vector<double>> &Q, std::vector<double> &v)
{
  for (unsigned int sweep = 0; sweep < 2; ++sweep)
    for (const auto &q : Q)
      {
        const double c = std::inner_product(q.begin(), q.end(), v.begin(), 0.);
        for (unsigned int i = 0; i < v.size(); ++i)
          v[i] -= c * q[i];
      }
}
/// Call @p use with the row and the weighted vector B D^-1/2 of each row in a list of entries.
/// @p value_of returns B and 1/D of an entry.
template <typename ValueOf, typename Use>
void for_each_row(const std::vector<ContactNodes::Entry> &list,
                  const unsigned int                      n_unknowns,
                  const ValueOf                          &value_of,
                  const Use                              &use)
{
  for (auto entry = list.begin(); entry != list.end();)
    {
      const unsigned int  row = entry->row;
      std::vector<double> v(n_unknowns, 0.);
      for (; entry != list.end() && entry->row == row; ++entry)
        {
          const auto [B, by_D] = value_of(entry->entry);
          v[entry->unknown] += B * std::sqrt(by_D);
        }
      use(row, v);
    }
}

} // namespace

ContactGram::ContactGram(const ContactNodes        &the_structure,
                         const std::vector<double> &entries,
                         const unsigned int         stride,
                         std::vector<double>        the_ground)
  : structure(the_structure), ground(std::move(the_ground))
{
  if (!structure.any)
    return;
  qp::MultiVector sent(narrow<unsigned int>(structure.sent.size()), 2);
  for (unsigned int i = 0; i < sent.n_rows(); ++i)
    for (unsigned int k = 0; k < 2; ++k)
      sent(i, k) = entries[std::size_t(structure.sent[i]) * stride + k];
  const auto received = structure.entries.to_local(sent);
  for (const auto &node : structure.nodes)
    add_node(node, entries, stride, received);
  W_EC.shrink_to_fit();
  L.shrink_to_fit();
  scale();
}

void ContactGram::add_node(const ContactNodes::Node  &node,
                           const std::vector<double> &entries,
                           const unsigned int         stride,
                           const qp::MultiVector     &received)
{
  std::vector<std::pair<unsigned int, std::vector<double>>> equalities;
  std::vector<std::vector<double>>                          Q;
  const auto square = [](const std::vector<double> &v) {
    return std::inner_product(v.begin(), v.end(), v.begin(), 0.);
  };
  const auto value_of = [&](const unsigned int e) {
    const double *entry = &entries[std::size_t(e) * stride];
    return std::make_pair(entry[0], entry[1]);
  };
  for_each_row(node.of_node_rows, node.n_unknowns, value_of,
               [&](const unsigned int row, std::vector<double> v) {
                 equalities.emplace_back(row, v);
                 const double before = square(v);
                 orthogonalise(Q, v);
                 const double after = square(v);
                 if (after <= round_off * before)
                   return;
                 for (double &value : v)
                   value /= std::sqrt(after);
                 Q.push_back(std::move(v));
               });
  for_each_row(node.of_ties, node.n_unknowns, value_of,
               [&](const unsigned int row, const std::vector<double> &v) {
                 equalities.emplace_back(row, v);
               });
  for_each_row(
    node.of_contacts, node.n_unknowns,
    [&](const unsigned int i) { return std::make_pair(received(i, 0), received(i, 1)); },
    [&](const unsigned int row, std::vector<double> v) {
      for (const auto &[equality, w] : equalities)
        if (const double value = std::inner_product(v.begin(), v.end(), w.begin(), 0.); value != 0.)
          W_EC.push_back({row, equality, value});
      const double before = square(v);
      orthogonalise(Q, v);
      for (unsigned int i = 0; i < v.size(); ++i)
        if (v[i] * v[i] > round_off * before)
          L.push_back({row, n_columns + i, v[i]});
    });
  n_columns += node.n_unknowns;
}

/// Compute the diagonal of S and bounds of the eigenvalues of S scaled to unit diagonal, by the
/// circles of Gershgorin: |L| |L|' bounds the entries of L L'.
void ContactGram::scale()
{
  const unsigned int n = narrow<unsigned int>(structure.rows_of_contact.size());
  ground.resize(n, 0.);
  qp::MultiVector squares(structure.n_rows);
  for (const Value &entry : L)
    squares(entry.row) += entry.value * entry.value;
  const auto of_owned = structure.rows.to_owned(squares);
  diagonal.assign(n, 0.);
  qp::MultiVector v(n);
  for (unsigned int i = 0; i < n; ++i)
    if (structure.rows_of_contact[i])
      {
        if (of_owned(i) + ground[i] == 0.)
          ground[i] = 1.;
        diagonal[i] = of_owned(i) + ground[i];
        v(i)        = 1. / std::sqrt(diagonal[i]);
      }
    else
      ground[i] = 0.;
  const auto          local = structure.rows.to_local(v);
  qp::MultiVector     sums(structure.n_rows);
  std::vector<double> columns(n_columns, 0.);
  for (const Value &entry : L)
    columns[entry.column] += std::abs(entry.value) * local(entry.row);
  for (const Value &entry : L)
    sums(entry.row) += std::abs(entry.value) * columns[entry.column];
  const auto radius = structure.rows.to_owned(sums);
  for (unsigned int i = 0; i < n; ++i)
    if (structure.rows_of_contact[i])
      high = std::max(high, v(i) * (radius(i) + ground[i] * v(i)));
  high = dealii::Utilities::MPI::max(high, structure.communicator);
  low  = std::max(least_eigenvalue * high, 2. - high);
  if (high > (1. + 1e-12) * low)
    n_terms = narrow<unsigned int>(std::lround(
      std::ceil(std::acosh(1. / inverse_error) / std::acosh((high + low) / (high - low)))));
}

qp::MultiVector ContactGram::from_equalities(const qp::MultiVector &y) const
{
  qp::MultiVector local(structure.n_rows, y.n_columns());
  for (unsigned int k = 0; k < y.n_columns(); ++k)
    for (const Value &entry : W_EC)
      local(entry.row, k) += entry.value * y(entry.column, k);
  return structure.rows.to_owned(local);
}

qp::MultiVector ContactGram::to_equalities(const qp::MultiVector &z) const
{
  const auto      local = structure.rows.to_local(z);
  qp::MultiVector result(z.n_rows(), z.n_columns());
  for (unsigned int k = 0; k < z.n_columns(); ++k)
    for (const Value &entry : W_EC)
      result(entry.column, k) += entry.value * local(entry.row, k);
  return result;
}

/// Return S x.
qp::MultiVector ContactGram::multiply(const qp::MultiVector &x) const
{
  const auto      local = structure.rows.to_local(x);
  qp::MultiVector of_columns(n_columns, x.n_columns()), sums(structure.n_rows, x.n_columns());
  for (unsigned int k = 0; k < x.n_columns(); ++k)
    {
      for (const Value &entry : L)
        of_columns(entry.column, k) += entry.value * local(entry.row, k);
      for (const Value &entry : L)
        sums(entry.row, k) += entry.value * of_columns(entry.column, k);
    }
  auto result = structure.rows.to_owned(sums);
  for (unsigned int k = 0; k < x.n_columns(); ++k)
    for (unsigned int i = 0; i < x.n_rows(); ++i)
      result(i, k) += ground[i] * x(i, k);
  return result;
}

void ContactGram::solve(const qp::FreeRows &free, qp::MultiVector &x) const
{
  if (!structure.any)
    return;
  // The scales commute with the projector, because both tangential rows of a slip have the same.
  auto of_scale = diagonal;
  for (const qp::Slip &slip : free.slips())
    if (slip.cone.n_tangents == 2)
      {
        const auto [a, b] = slip.cone.tangents;
        of_scale[a] = of_scale[b] = std::max(diagonal[a], diagonal[b]);
      }
  const auto scaled = [&](qp::MultiVector v) {
    for (unsigned int k = 0; k < v.n_columns(); ++k)
      for (unsigned int i = 0; i < v.n_rows(); ++i)
        v(i, k) *= of_scale[i] == 0. ? 0. : 1. / std::sqrt(of_scale[i]);
    return v;
  };
  const double    mean = 0.5 * (high + low), half = 0.5 * (high - low);
  qp::MultiVector rest = scaled(x), step(x.n_rows(), x.n_columns());
  step.add(1. / mean, rest);
  qp::MultiVector sum = step;
  // Saad, Iterative Methods for Sparse Linear Systems, Algorithm 12.1, without divisions by half.
  double rho = half / mean;
  for (unsigned int term = 1; term < n_terms; ++term)
    {
      auto image = scaled(multiply(scaled(step)));
      free.restrict(image);
      rest.add(-1., image);
      const double    next = half / (2. * mean - rho * half);
      qp::MultiVector longer(x.n_rows(), x.n_columns());
      longer.add(next * rho, step);
      longer.add(2. / (2. * mean - rho * half), rest);
      step = std::move(longer);
      rho  = next;
      sum.add(1., step);
    }
  sum = scaled(std::move(sum));
  for (unsigned int k = 0; k < x.n_columns(); ++k)
    for (unsigned int i = 0; i < x.n_rows(); ++i)
      if (structure.rows_of_contact[i])
        x(i, k) = sum(i, k);
}
} // namespace snug::feti
