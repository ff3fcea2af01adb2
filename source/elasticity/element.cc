#include <snug/base/assertions.h>
#include <snug/elasticity/element.h>
#include <snug/elasticity/pressure_space.h>
#include <snug/elasticity/stress.h>


#include <algorithm>
#include <cmath>
#include <limits>

namespace snug::elasticity {
template <int dim>
Element<dim>::Element(const unsigned int        degree,
                      const mesh::Idealization &idealization,
                      const Formulation         formulation)
  : degree(degree)
  , idealization(idealization)
  , formulation(formulation)
  , gauss(mesh::lagrange_gauss_points<dim>(degree))
  , nodes(mesh::lagrange_nodes<dim>(degree))
{
  using Kind = mesh::Idealization::Kind;
  SNUG_ASSERT(degree == 1 || degree == 2, "elements have degree 1 or 2");
  SNUG_ASSERT((idealization.kind == Kind::solid) == (dim == 3), "solids are 3D, sections 2D");
  // The out-of-plane strain of a sheet follows from the in-plane strains, so there is no
  // dilatation to be projected.
  SNUG_ASSERT(formulation == Formulation::standard || idealization.kind != Kind::plane_stress,
              "plane stress has no B-bar formulation");
  of_cells = Rule(gauss);
  if (dim == 3 && degree == 2)
    {
      of_straight   = rule_of_straight_tetrahedra();
      of_tetrahedra = rule_of_tetrahedra();
    }
}

template <int dim>
std::vector<CellPoint<dim>> Element<dim>::gauss_points(const Nodes &X) const
{
  std::vector<CellPoint<dim>> points;
  points.reserve(gauss.size());
  for (const auto &shape : gauss)
    points.emplace_back(shape, X, idealization);
  return points;
}

/// Project the dilatation. The functions of the projection are orthonormal in dV of this cell, so
/// they follow its shape.
template <int dim>
void Element<dim>::take_dilatation(const std::vector<CellPoint<dim>> &points,
                                   std::vector<double>               &values) const
{
  if (formulation == Formulation::standard)
    return;
  std::vector<dealii::Point<dim>> xi;
  std::vector<double>             dV;
  for (const auto &point : points)
    {
      xi.push_back(point.shape.point);
      dV.push_back(point.dV);
    }
  PressureSpace<dim>(degree, xi, dV).project(values);
}

template <int dim>
std::vector<typename Element<dim>::PointState>
Element<dim>::point_states(const std::vector<CellPoint<dim>> &points,
                           const Material                    &material,
                           const Nodes                       &u) const
{
  std::vector<PointState> states(points.size());
  std::vector<double>     dilatation(points.size());
  for (unsigned int q = 0; q < points.size(); ++q)
    {
      states[q].gradient = points[q].gradient(u);
      dilatation[q]      = trace(states[q].gradient);
    }
  take_dilatation(points, dilatation);
  for (unsigned int q = 0; q < points.size(); ++q)
    {
      auto &state = states[q];
      // The formulation replaces div u by div u + theta. Adding a third of theta to each diagonal
      // entry of the strain changes its trace only.
      state.theta = dilatation[q] - trace(state.gradient);
      state.stress =
        cauchy_stress(material, strain(idealization, material, state.gradient) +
                                  state.theta / 3. * dealii::unit_symmetric_tensor<3>());
    }
  return states;
}

/// Compute the force from stresses at the points. This is cheaper than K u if K is not needed.
template <int dim>
void Element<dim>::internal_force(const Nodes    &X,
                                  const Material &material,
                                  const Nodes    &u,
                                  Nodes          &r) const
{
  r.assign(n_nodes(), {});
  const auto points = gauss_points(X);
  const auto states = point_states(points, material, u);
  for (unsigned int q = 0; q < points.size(); ++q)
    points[q].add_flux(states[q].stress, r);
}

/// Return the points [length] at which formulas of loads are evaluated.
template <int dim>
typename Element<dim>::Nodes Element<dim>::quadrature_points(const Nodes &X) const
{
  // The order is that of the Gauss points, in which body_force() expects the loads.
  Nodes points;
  for (const auto &shape : gauss)
    points.push_back(value(shape, X));
  return points;
}

/// Compute the body force. In axisymmetric models dV contains 2 pi r, so the force is that of the
/// full revolution.
template <int dim>
void Element<dim>::body_force(const Nodes &X, const Nodes &b, Nodes &f) const
{
  SNUG_ASSERT_EQUAL(b.size(), gauss.size());
  f.assign(n_nodes(), {});
  const auto points = gauss_points(X);
  for (unsigned int q = 0; q < points.size(); ++q)
    points[q].add_source(b[q], f);
}

/// Compute the volume without inverting J, so that cells with det J = 0 at some point have a
/// volume.
template <int dim>
double Element<dim>::volume(const Nodes &X) const
{
  double sum = 0.;
  for (const auto &shape : gauss)
    sum += shape.weight * determinant(jacobian(shape, X)) * idealization.weight(value(shape, X));
  return sum;
}

template <int dim>
typename Element<dim>::Stresses
Element<dim>::stresses(const Nodes                                 &X,
                       const Material                              &material,
                       const Nodes                                 &u,
                       const std::vector<mesh::LagrangePoint<dim>> &shapes,
                       const ThermalStrain<dim>                    &thermal) const
{
  return stresses(X, material, {{u, thermal}}, shapes).front();
}

template <int dim>
std::vector<typename Element<dim>::Stresses>
Element<dim>::stresses(const Nodes                                 &X,
                       const Material                              &material,
                       const std::vector<Strained>                 &fields,
                       const std::vector<mesh::LagrangePoint<dim>> &shapes) const
{
  std::vector<Stresses> result(fields.size());
  const bool            is_plain =
    formulation == Formulation::standard &&
    std::none_of(fields.begin(), fields.end(), [](const auto &field) { return field.thermal; });
  if (!is_plain)
    {
      for (unsigned int i = 0; i < fields.size(); ++i)
        result[i] = projected_stresses(X, material, fields[i], shapes);
      return result;
    }
  for (auto &of_field : result)
    of_field.reserve(shapes.size());
  for (const auto &shape : shapes)
    {
      const InverseJacobian<dim> at(shape, X, idealization);
      for (unsigned int i = 0; i < fields.size(); ++i)
        result[i].push_back(
          cauchy_stress(material, strain(idealization, material, at.gradient(fields[i].u))));
    }
  return result;
}

/// Return the stresses with projected dilatations and thermal strains.
template <int dim>
typename Element<dim>::Stresses
Element<dim>::projected_stresses(const Nodes                                 &X,
                                 const Material                              &material,
                                 const Strained                              &field,
                                 const std::vector<mesh::LagrangePoint<dim>> &shapes) const
{
  Stresses result;
  // The points of a projection come first, the points that receive values follow.
  std::vector<CellPoint<dim>> points;
  if (is_mixed())
    points = gauss_points(X);
  const unsigned int first = points.size();
  points.reserve(first + shapes.size());
  for (const auto &shape : shapes)
    {
      points.emplace_back(shape, X, idealization);
      points.back().dV = 0.;
    }
  const auto states = point_states(points, material, field.u);
  for (unsigned int q = first; q < states.size(); ++q)
    result.push_back(states[q].stress);
  if (field.thermal)
    subtract_thermal(points, material, field.thermal, result);
  return result;
}

template <int dim>
double Element<dim>::aspect(const Nodes &X) const
{
  double largest = 1.;
  for (const auto &shape : gauss)
    {
      // The columns of the Jacobian are the axes of the cell.
      const auto axes    = transpose(jacobian(shape, X));
      double     longest = 0., shortest = std::numeric_limits<double>::max();
      for (unsigned int axis = 0; axis < dim; ++axis)
        {
          longest  = std::max(longest, axes[axis].norm());
          shortest = std::min(shortest, axes[axis].norm());
        }
      largest = std::max(largest, longest / shortest);
    }
  return largest;
}

/// Return det J / prod_d |J e_d|.
template <int dim>
static double scaled_determinant(const dealii::Tensor<2, dim> &J)
{
  double volume = 1.; // of the box with these edges
  for (int d = 0; d < dim; ++d)
    volume *= (transpose(J)[d]).norm();
  return determinant(J) / volume;
}

template <int dim>
std::pair<double, double> Element<dim>::qualities(const Nodes &X) const
{
  // Use nodes as well as Gauss points, because the minimum determinant of a bilinear cell is at a
  // corner. Nodes have no quadrature weight, so the mean is over the Gauss points.
  double smallest = std::numeric_limits<double>::max(), least_ratio = 1.;
  double mean = 0.;
  for (const auto *points : {&gauss, &nodes})
    for (const auto &shape : *points)
      {
        // Use the section alone, because the weight 2 pi r would give cells near the axis a low
        // quality.
        const auto   J     = jacobian(shape, X);
        const double det   = determinant(J);
        const double ratio = scaled_determinant(J);
        smallest           = std::min(smallest, det);
        mean += shape.weight * std::abs(det);
        // A comparison with NaN is false, and NaN counts as 0.
        if (!(ratio > least_ratio))
          least_ratio = std::isnan(ratio) ? 0. : ratio;
      }
  double quality = mean > 0. ? smallest / mean : 0.;
  if (idealization.is_axisymmetric())
    {
      // Negative radii make negative volumes. Rounding of nodes on the axis is allowed.
      const auto radii =
        std::minmax_element(X.begin(), X.end(), [](auto &x, auto &y) { return x[0] < y[0]; });
      const double round_off = 1e-10;
      if ((*radii.first)[0] < -round_off * (*radii.second)[0])
        quality = 0.;
    }
  return {quality, least_ratio};
}

template <int dim>
double Element<dim>::distortion(const Nodes &X, const double p, const double scale) const
{
  double sum = 0.;
  for (const auto *points : {&gauss, &nodes})
    for (const auto &shape : *points)
      // At right angles rounding may make the base negative, so take the maximum with 0.
      sum += std::pow(std::max(0., 1. - scaled_determinant(jacobian(shape, X))) / scale, p);
  return sum;
}

/// Compute the gradient with q = det J / prod_d |J e_d|, q' = q tr(J^-1 J') - q sum_d J e_d . J'
/// e_d / |J e_d|^2.
template <int dim>
void Element<dim>::add_distortion_gradient(const Nodes &X,
                                           const double p,
                                           const double scale,
                                           const double factor,
                                           Nodes       &gradient) const
{
  for (const auto *points : {&gauss, &nodes})
    for (const auto &shape : *points)
      {
        const auto   J = jacobian(shape, X);
        const double q = scaled_determinant(J);
        const double weight =
          -factor * p * q / scale * std::pow(std::max(0., 1. - q) / scale, p - 1.);
        if (weight == 0.)
          continue;
        const auto inverse = invert(J);
        for (unsigned int a = 0; a < n_nodes(); ++a)
          for (int d = 0; d < dim; ++d)
            {
              // J' e_d = V N_a,d
              const dealii::Tensor<1, dim> edge = transpose(J)[d];
              gradient[a] += weight * shape.gradient[a][d] *
                             (dealii::Tensor<1, dim>(inverse[d]) - edge / edge.norm_square());
            }
      }
}

template class Element<2>;
template class Element<3>;
} // namespace snug::elasticity
