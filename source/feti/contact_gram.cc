#include <snug/base/errors.h>
#include <snug/base/narrow.h>
#include <snug/feti/contact_gram.h>
#include <snug/qp/row_set.h>

#include <deal.II/base/mpi.h>

#include <algorithm>
#include <array>
#include <cmath>

namespace snug::feti {
namespace {
/// Eigenvalues of S, scaled to unit diagonal, from this part of the largest on are inverted with
/// the relative error @p inverse_error. The ratio of a tenth took 5 to 20 % more F-mults in some
/// mortar scenes; ratios below 1 / 30 took as many as exact inverses.
const double least_eigenvalue = 1. / 30.;
const double inverse_error    = 0.05;

/// Difference of products of unit rows below which rows are equal.
const double same_row = 1e-10;

/// Part of the square of a row below which its rest is round-off, as on held components.
const double round_off = 1e-24;

/// Vectors of the unknowns of a node with the inner product of the weights 1/D. No square roots are
/// taken, so that units that are powers of two change no digit of the results.
class NodeVectors
{
public:
  using Vector = std::vector<double>;

  explicit NodeVectors(const unsigned int n_unknowns) : weights(n_unknowns, 0.) {}

  /// Call @p use with the row and the vector of B of each row in a list of entries. @p value_of
  /// returns B and 1/D of an entry.
  template <typename ValueOf, typename Use>
  void for_each_row(const std::vector<ContactNodes::Entry> &list,
                    const ValueOf                          &value_of,
                    const Use                              &use)
  {
    for (auto entry = list.begin(); entry != list.end();)
      {
        const unsigned int row = entry->row;
        Vector             v(weights.size(), 0.);
        for (; entry != list.end() && entry->row == row; ++entry)
          {
            const auto [B, by_D] = value_of(entry->entry);
            v[entry->unknown] += B;
            weights[entry->unknown] = by_D;
          }
        use(row, std::move(v));
      }
  }

  double product(const Vector &a, const Vector &b) const
  {
    double sum = 0.;
    for (unsigned int i = 0; i < a.size(); ++i)
      sum += a[i] * b[i] * weights[i];
    return sum;
  }

  /// Set v <- v minus its projections on the vectors of add(). Two sweeps because of round-off.
  void orthogonalise(Vector &v) const
  {
    for (unsigned int sweep = 0; sweep < 2; ++sweep)
      for (const auto &[q, square] : orthogonal)
        {
          const double c = product(q, v) / square;
          for (unsigned int i = 0; i < v.size(); ++i)
            v[i] -= c * q[i];
        }
  }

  void add(Vector v)
  {
    const double before = product(v, v);
    orthogonalise(v);
    if (const double square = product(v, v); square > round_off * before)
      orthogonal.emplace_back(std::move(v), square);
  }

  Vector weights;

private:
  std::vector<std::pair<Vector, double>> orthogonal; ///< with their squares
};
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
  find_equal_rows();
}

void ContactGram::add_node(const ContactNodes::Node  &node,
                           const std::vector<double> &entries,
                           const unsigned int         stride,
                           const qp::MultiVector     &received)
{
  NodeVectors                                               vectors(node.n_unknowns);
  std::vector<std::pair<unsigned int, NodeVectors::Vector>> equalities, contacts;
  const auto                                                value_of = [&](const unsigned int e) {
    const double *entry = &entries[std::size_t(e) * stride];
    return std::make_pair(entry[0], entry[1]);
  };
  const auto keep = [](auto &list) {
    return [&list](const unsigned int row, NodeVectors::Vector v) {
      list.emplace_back(row, std::move(v));
    };
  };
  vectors.for_each_row(node.of_node_rows, value_of, keep(equalities));
  vectors.for_each_row(
    node.of_contacts,
    [&](const unsigned int i) { return std::make_pair(received(i, 0), received(i, 1)); },
    keep(contacts));
  for (const auto &equality : equalities)
    vectors.add(equality.second);
  // Ties are not eliminated.
  vectors.for_each_row(node.of_ties, value_of, keep(equalities));
  const auto first = narrow<unsigned int>(weights.size());
  for (auto &[row, v] : contacts)
    {
      for (const auto &[equality, w] : equalities)
        if (const double value = vectors.product(v, w); value != 0.)
          W_EC.push_back({row, equality, value});
      const double before = vectors.product(v, v);
      vectors.orthogonalise(v);
      for (unsigned int i = 0; i < v.size(); ++i)
        if (v[i] * v[i] * vectors.weights[i] > round_off * before)
          L.push_back({row, first + i, v[i]});
    }
  weights.insert(weights.end(), vectors.weights.begin(), vectors.weights.end());
}

/// Compute the diagonal of S and bounds of the eigenvalues of S divided by it, by the circles of
/// Gershgorin: |L| D^-1 |L|' bounds the entries of S.
void ContactGram::scale()
{
  const unsigned int n = narrow<unsigned int>(structure.rows_of_contact.size());
  ground.resize(n, 0.);
  qp::MultiVector     sums(structure.n_rows, 2); // diagonal, circles
  std::vector<double> columns(weights.size(), 0.);
  for (const Value &entry : L)
    columns[entry.column] += std::abs(entry.value);
  for (const Value &entry : L)
    {
      const double weighted = weights[entry.column] * std::abs(entry.value);
      sums(entry.row, 0) += weighted * std::abs(entry.value);
      sums(entry.row, 1) += weighted * columns[entry.column];
    }
  const auto owned = structure.rows.to_owned(sums);
  diagonal.assign(n, 0.);
  for (unsigned int i = 0; i < n; ++i)
    if (structure.rows_of_contact[i])
      {
        if (owned(i, 0) + ground[i] == 0.)
          ground[i] = 1.;
        diagonal[i] = owned(i, 0) + ground[i];
        high        = std::max(high, (owned(i, 1) + ground[i]) / diagonal[i]);
      }
    else
      ground[i] = 0.;
  high = dealii::Utilities::MPI::max(high, structure.communicator);
  low  = std::max(least_eigenvalue * high, 2. - high);
  if (high > (1. + 1e-12) * low)
    n_terms = narrow<unsigned int>(std::lround(
      std::ceil(std::acosh(1. / inverse_error) / std::acosh((high + low) / (high - low)))));
}

/// Compare two products of each unit row with random numbers, which are equal for equal rows only.
/// Rows on rigid bodies may differ in the motions of these bodies, which L does not contain.
/// Rows of several nodes that depend on each other are not found; they have several solutions for
/// the multipliers, which the iterations tolerate.
void ContactGram::find_equal_rows()
{
  std::uint64_t state =
    qp::scramble(dealii::Utilities::MPI::this_mpi_process(structure.communicator));
  const auto      n_columns = narrow<unsigned int>(weights.size());
  qp::MultiVector omega(n_columns, 2), products(structure.n_rows, 2);
  for (unsigned int k = 0; k < 2; ++k)
    for (unsigned int i = 0; i < n_columns; ++i)
      omega(i, k) = std::ldexp(static_cast<double>(qp::scramble(++state) >> 11), -53) - 0.5;
  for (unsigned int k = 0; k < 2; ++k)
    for (const Value &entry : L)
      products(entry.row, k) +=
        std::sqrt(weights[entry.column]) * entry.value * omega(entry.column, k);
  const auto                         owned = structure.rows.to_owned(products);
  std::vector<std::array<double, 3>> rows; // two products and the row
  for (unsigned int i = 0; i < diagonal.size(); ++i)
    if (structure.rows_of_contact[i] && !structure.on_rigid[i] && ground[i] == 0.)
      {
        const double by = std::copysign(1. / std::sqrt(diagonal[i]), owned(i, 0));
        rows.push_back({{by * owned(i, 0), by * owned(i, 1), static_cast<double>(i)}});
      }
  std::sort(rows.begin(), rows.end());
  for (std::size_t a = 0; a < rows.size(); ++a)
    for (std::size_t b = a + 1; b < rows.size() && rows[b][0] - rows[a][0] < same_row; ++b)
      if (std::abs(rows[b][1] - rows[a][1]) < same_row)
        equal_rows.emplace_back(static_cast<unsigned int>(rows[a][2]),
                                static_cast<unsigned int>(rows[b][2]));
}

void ContactGram::check(const qp::FreeRows &free) const
{
  for (const auto &[a, b] : equal_rows)
    if (free.rows()[a] && free.rows()[b])
      throw SolveError("are two contact rows the same? Two closed contacts of a node have the same "
                       "coefficients; look for a pair or an obstacle that is given twice");
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
  qp::MultiVector sums(structure.n_rows, x.n_columns());
  for (unsigned int k = 0; k < x.n_columns(); ++k)
    {
      std::vector<double> of_columns(weights.size(), 0.);
      for (const Value &entry : L)
        of_columns[entry.column] += entry.value * local(entry.row, k);
      for (const Value &entry : L)
        sums(entry.row, k) += entry.value * weights[entry.column] * of_columns[entry.column];
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
  // The scales commute with the projector, because both tangential rows of a slip have the same:
  // the entry of S across the slip if S is diagonal, else its upper bound, as low and high are
  // bounds.
  auto of_scale = diagonal;
  for (const qp::Slip &slip : free.slips())
    if (slip.cone.n_tangents == 2)
      {
        const auto [i, j]      = slip.cone.tangents;
        const auto across      = slip.across();
        const bool is_diagonal = n_terms == 1;
        of_scale[i]            = of_scale[j] =
          is_diagonal ? across[0] * across[0] * diagonal[i] + across[1] * across[1] * diagonal[j]
                                 : std::max(diagonal[i], diagonal[j]);
      }
  const auto scaled = [&](qp::MultiVector v) {
    for (unsigned int k = 0; k < v.n_columns(); ++k)
      for (unsigned int i = 0; i < v.n_rows(); ++i)
        v(i, k) = of_scale[i] == 0. ? 0. : v(i, k) / of_scale[i];
    return v;
  };
  const double    mean = 0.5 * (high + low), half = 0.5 * (high - low);
  qp::MultiVector rest = x, step(x.n_rows(), x.n_columns());
  step.add(1. / mean, scaled(rest));
  qp::MultiVector sum = step;
  // Saad, Iterative Methods for Sparse Linear Systems, Algorithm 12.1, without divisions by half.
  double rho = half / mean;
  for (unsigned int term = 1; term < n_terms; ++term)
    {
      auto image = multiply(step);
      free.restrict(image);
      rest.add(-1., image);
      qp::MultiVector longer(x.n_rows(), x.n_columns());
      const double    by = 1. / (2. * mean - rho * half);
      longer.add(half * by * rho, step);
      longer.add(2. * by, scaled(rest));
      step = std::move(longer);
      rho  = half * by;
      sum.add(1., step);
    }
  for (unsigned int k = 0; k < x.n_columns(); ++k)
    for (unsigned int i = 0; i < x.n_rows(); ++i)
      if (structure.rows_of_contact[i])
        x(i, k) = sum(i, k);
}
} // namespace snug::feti
