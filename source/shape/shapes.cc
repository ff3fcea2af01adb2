#include <snug/base/assertions.h>
#include <snug/base/errors.h>
#include <snug/shape/entries.h>
#include <snug/shape/shapes.h>

#include <deal.II/base/mpi.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <set>

namespace snug::shape {
namespace {
/// Make the links of a shape. The entries Fixed and Symmetry refer to control points. A shape
/// without control points has one variable per mode.
template <int dim>
Links make_links(const Shape<dim> &basis, const ShapeParameters &parameters)
{
  const auto &controls = basis.controls();
  if (!controls.empty())
    return Links(controls, parameters);
  if (!parameters.fixed.empty())
    throw bad_entry(parameters.path("Fixed"), to_text(parameters.fixed),
                    "must be empty: " + parameters.basis + " have no control points");
  if (!parameters.symmetry.empty())
    throw bad_entry(parameters.path("Symmetry"), parameters.symmetry.begin()->first,
                    "must be empty: " + parameters.basis + " have no control points");
  return Links(basis.n_variables());
}
} // namespace

template <int dim>
Shapes<dim>::Shapes(const mesh::BodyMesh<dim>          &mesh,
                    const BodyNames                    &bodies,
                    const std::vector<ShapeParameters> &parameters)
  : ShapeBasis<dim>(mesh.communicator()), mesh(mesh)
{
  for (const auto &one : parameters)
    {
      auto basis = choose(shape_basis_table<dim>(), one.basis).make(mesh, bodies, one);
      // The first variable follows the variables of all shapes before.
      const unsigned int first = lower.size();
      Links              links = make_links(*basis, one);
      add_variables(one, links.n_variables());
      parts.push_back({one.name, first, one.modes.empty(), std::move(basis), std::move(links)});
      add_limits(parts.back(), one);
    }
  for (auto &limit : all_limits)
    limit.row.resize(lower.size(), 0.);
}

template <int dim>
std::vector<double> Shapes<dim>::first_steps() const
{
  const auto         &x = mesh.reference_positions();
  std::vector<double> moved(n_variables(), 0.); // maximum move per unit change, in cell edges
  for (unsigned int j = 0; j < moved.size(); ++j)
    {
      const auto move = this->column(j);
      for (const auto &cell : mesh.cells())
        {
          const double edge =
            (x[cell.nodes.back()] - x[cell.nodes.front()]).norm() / std::sqrt(dim);
          for (const unsigned int node : cell.nodes)
            moved[j] = std::max(moved[j], move[node].norm() / edge);
        }
    }
  dealii::Utilities::MPI::max(moved, mesh.communicator(), moved);
  for (const Part &part : parts)
    if (part.alike && part.links.n_variables() > 0)
      {
        const auto begin = moved.begin() + part.first, end = begin + part.links.n_variables();
        std::fill(begin, end, *std::max_element(begin, end));
      }
  std::vector<double> steps;
  for (const double one : moved)
    steps.push_back(one > 0. ? 0.5 / one : std::numeric_limits<double>::max());
  return steps;
}

template <int dim>
std::vector<std::pair<std::string, std::vector<double>>>
Shapes<dim>::by_shape(const std::vector<double> &alpha) const
{
  std::vector<std::pair<std::string, std::vector<double>>> result;
  for (std::size_t p = 0; p < parts.size(); ++p)
    {
      const auto end = p + 1 < parts.size() ? parts[p + 1].first : alpha.size();
      result.emplace_back(parts[p].name,
                          std::vector<double>(alpha.begin() + parts[p].first, alpha.begin() + end));
    }
  return result;
}

template <int dim>
void Shapes<dim>::add_variables(const ShapeParameters &parameters, const unsigned int n)
{
  // A shape without variables needs no bounds.
  if (n == 0)
    return;
  require_bounds(parameters);
  auto start = parameters.initial;
  if (start.empty())
    start = {0.};
  if (start.size() == 1)
    // A single number is the start of all variables.
    start.resize(n, start.front());
  if (start.size() != n)
    throw bad_entry(parameters.path("Initial"), to_text(start),
                    "must have 1 number or " + std::to_string(n) +
                      " numbers separated by commas, one per variable");
  lower.insert(lower.end(), n, parameters.bounds[0]);
  upper.insert(upper.end(), n, parameters.bounds[1]);
  initial.insert(initial.end(), start.begin(), start.end());
}

/// Fixed controls and controls that are tied to each other leave rows of zeros, and rows that occur
/// several times, which optimizers do not need.
template <int dim>
void Shapes<dim>::add_limits(const Part &part, const ShapeParameters &parameters)
{
  std::set<std::pair<std::vector<double>, double>> known;
  for (const auto &limit : part.basis->limits())
    {
      std::vector<double> row(lower.size(), 0.);
      double              largest = 0.;
      for (const auto &[control, weight] : limit.row)
        {
          const auto [variable, sign] = part.links.tie(control);
          if (sign != 0.)
            row[part.first + variable] += sign * weight;
          largest = std::max(largest, std::abs(weight));
        }
      std::vector<unsigned int> moved;
      for (unsigned int i = 0; i < row.size(); ++i)
        if (std::abs(row[i]) > 1e-12 * largest)
          moved.push_back(i);
        else
          row[i] = 0.;
      if (moved.size() > 1 && known.insert({row, limit.bound}).second)
        all_limits.push_back({row, limit.bound, parameters.path(limit.entry)});
      if (moved.size() != 1)
        continue;
      const unsigned int i     = moved.front();
      double            &bound = row[i] > 0. ? upper[i] : lower[i];
      bound =
        row[i] > 0. ? std::min(bound, limit.bound / row[i]) : std::max(bound, limit.bound / row[i]);
      if (!(lower[i] < upper[i] && initial[i] >= lower[i] && initial[i] <= upper[i]))
        throw bad_entry(parameters.path("Bounds"), to_text(parameters.bounds),
                        "and 'Initial' must agree with the limits of the shape, which leave " +
                          to_text(std::vector<double>{lower[i], upper[i]}) + " for a variable");
    }
}

template <int dim>
std::string Shapes<dim>::most_violated_limit(const std::vector<double> &alpha) const
{
  std::string entry;
  double      most = 0.;
  for (const auto &limit : all_limits)
    {
      double largest = 0., excess = -limit.bound;
      for (unsigned int i = 0; i < alpha.size(); ++i)
        {
          excess += limit.row[i] * alpha[i];
          largest = std::max(largest, std::abs(limit.row[i]));
        }
      if (excess > most * largest)
        {
          most  = excess / largest;
          entry = limit.entry;
        }
    }
  return entry;
}

template <int dim>
std::vector<double> Shapes<dim>::expanded(const Part &part, const std::vector<double> &alpha)
{
  const auto first = alpha.begin() + part.first;
  return part.links.expand({first, first + part.links.n_variables()});
}

template <int dim>
typename Shapes<dim>::Field Shapes<dim>::apply(const std::vector<double> &alpha) const
{
  SNUG_ASSERT_EQUAL(alpha.size(), n_variables());
  Field result(mesh.n_points());
  for (const Part &part : parts)
    {
      // The displacements of shapes add up: V = [V_1 L_1, V_2 L_2, ..].
      const Field moves = part.basis->apply(expanded(part, alpha));
      for (unsigned int node = 0; node < result.size(); ++node)
        result[node] += moves[node];
    }
  return result;
}

template <int dim>
std::vector<std::pair<unsigned int, unsigned int>> Shapes<dim>::faces() const
{
  std::vector<std::pair<unsigned int, unsigned int>> result;
  for (const Part &part : parts)
    for (const auto &face : part.basis->faces())
      result.push_back(face);
  std::sort(result.begin(), result.end());
  result.erase(std::unique(result.begin(), result.end()), result.end());
  return result;
}

/// The position of a point is the reference position plus the moves by all variables of the point.
template <int dim>
std::vector<MovedPoint<dim>> Shapes<dim>::control_points(const std::vector<double> &alpha) const
{
  SNUG_ASSERT_EQUAL(alpha.size(), n_variables());
  std::vector<MovedPoint<dim>> points;
  for (const Part &part : parts)
    {
      const auto         controls = part.basis->controls();
      const auto         values   = expanded(part, alpha);
      const unsigned int first    = points.size();
      for (unsigned int i = 0; i < controls.size(); ++i)
        {
          const auto &control = controls[i];
          // Several variables may move one point. Controls are sorted by their points, so the next
          // control either moves the same point or the point with the next index.
          if (first + control.point == points.size())
            {
              const auto place = control.shown ? control.shown->first : control.position;
              points.push_back({part.name,
                                control.point,
                                place,
                                {},
                                place + part.basis->move_at_point(control.point, values)});
            }
          auto      &point = points[first + control.point];
          const auto move = values[i] * (control.shown ? control.shown->second : control.direction);
          point.position += move;
          point.move += move;
          if (const auto [variable, sign] = part.links.tie(i); sign != 0.)
            point.variables.emplace_back(part.first + variable, sign);
        }
    }
  return points;
}

template class Shapes<2>;
template class Shapes<3>;
} // namespace snug::shape
