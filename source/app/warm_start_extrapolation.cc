#include <snug/app/warm_start_extrapolation.h>

#include <deal.II/lac/full_matrix.h>
#include <deal.II/lac/householder.h>

#include <algorithm>
#include <cstring>
#include <numeric>

namespace snug::app {
namespace {
/// Maximum number of designs that are kept. More designs do not improve the extrapolation, even of
/// problems with as many variables.
constexpr std::size_t most = 8;

/// Error of the forces, expressed as the change of a variable, in its unit, that changes the forces
/// by as much.
constexpr double error_of_forces = 1e-6;

void append(std::string &bytes, const double *values, const std::size_t n)
{
  bytes.append(reinterpret_cast<const char *>(values), n * sizeof(double));
}
} // namespace

WarmStartExtrapolation::WarmStartExtrapolation(std::vector<double> the_units)
  : units(std::move(the_units))
{}

void WarmStartExtrapolation::add(const std::vector<double>   &design,
                                 std::vector<qp::MultiVector> forces)
{
  const auto known = std::find_if(entries.begin(), entries.end(),
                                  [&](const Entry &entry) { return entry.design == design; });
  if (known != entries.end())
    entries.erase(known);
  else if (entries.size() == most)
    entries.pop_front();
  entries.push_back({design, std::move(forces)});
}

std::vector<double> WarmStartExtrapolation::coefficients(const std::vector<double> &design) const
{
  const auto          n = units.size(), m = entries.size();
  std::vector<double> c(m, 0.);
  // columns x_j - x
  dealii::FullMatrix<double> offsets(n, m);
  std::vector<double>        weight(m, error_of_forces), distance(m, 0.);
  for (std::size_t j = 0; j < m; ++j)
    {
      for (std::size_t i = 0; i < n; ++i)
        {
          offsets(i, j) = (entries[j].design[i] - design[i]) / units[i];
          distance[j] += offsets(i, j) * offsets(i, j);
        }
      weight[j] += distance[j];
    }
  const auto nearest =
    std::size_t(std::min_element(distance.begin(), distance.end()) - distance.begin());
  c[nearest] = 1.;
  if (m == 1 || distance[nearest] == 0.)
    return c;
  // with the c of the nearest eliminated
  dealii::FullMatrix<double> A(n + m, m - 1);
  dealii::Vector<double>     b(n + m), y(m - 1);
  for (std::size_t i = 0; i < n; ++i)
    b(i) = -offsets(i, nearest);
  b(n + nearest) = -weight[nearest];
  for (std::size_t j = 0, column = 0; j < m; ++j)
    {
      if (j == nearest)
        continue;
      for (std::size_t i = 0; i < n; ++i)
        A(i, column) = offsets(i, j) - offsets(i, nearest);
      A(n + j, column)       = weight[j];
      A(n + nearest, column) = -weight[nearest];
      ++column;
    }
  dealii::Householder<double>(A).least_squares(y, b);
  for (std::size_t j = 0, column = 0; j < m; ++j)
    {
      if (j == nearest)
        continue;
      c[j] = y(column++);
      c[nearest] -= c[j];
    }
  return c;
}

std::vector<qp::WarmStart> WarmStartExtrapolation::at(const std::vector<double> &design) const
{
  std::vector<qp::WarmStart> starts;
  if (entries.empty())
    return starts;
  const auto c = coefficients(design);
  for (std::size_t i = 0; i < entries.front().forces.size(); ++i)
    {
      qp::WarmStart start{qp::MultiVector(entries.front().forces[i].n_rows()), {}};
      for (std::size_t j = 0; j < entries.size(); ++j)
        if (c[j] != 0.)
          start.lambda.add(c[j], entries[j].forces[i]);
      starts.push_back(start);
    }
  return starts;
}

std::string WarmStartExtrapolation::bytes() const
{
  std::string bytes;
  for (const Entry &entry : entries)
    {
      append(bytes, entry.design.data(), entry.design.size());
      for (const auto &forces : entry.forces)
        append(bytes, forces.column(0), forces.n_rows());
    }
  return bytes;
}

bool WarmStartExtrapolation::read(const std::string               &bytes,
                                  const std::vector<unsigned int> &n_owned)
{
  entries.clear();
  const std::size_t of_entry =
    (units.size() + std::accumulate(n_owned.begin(), n_owned.end(), std::size_t(0))) *
    sizeof(double);
  if (of_entry == 0 || bytes.size() % of_entry != 0 || bytes.size() / of_entry > most)
    return bytes.empty();
  for (const char *from = bytes.data(); from != bytes.data() + bytes.size();)
    {
      Entry entry{std::vector<double>(units.size()), {}};
      std::memcpy(entry.design.data(), from, units.size() * sizeof(double));
      from += units.size() * sizeof(double);
      for (const unsigned int n : n_owned)
        {
          entry.forces.emplace_back(n);
          std::memcpy(entry.forces.back().column(0), from, n * sizeof(double));
          from += n * sizeof(double);
        }
      entries.push_back(entry);
    }
  return true;
}
} // namespace snug::app
