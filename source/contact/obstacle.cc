#include <snug/base/assertions.h>
#include <snug/contact/level_set.h>
#include <snug/contact/obstacle.h>

#include <deal.II/base/symmetric_tensor.h>

namespace snug::contact {
namespace {
template <int dim>
class Plane : public Obstacle<dim>
{
public:
  Plane(const dealii::Point<dim> &point, const dealii::Tensor<1, dim> &normal)
    : point(point), normal(normal / normal.norm())
  {}

  std::optional<ObstacleDistance<dim>> distance(const dealii::Point<dim> &x) const override
  {
    // The Hessian is zero.
    return ObstacleDistance<dim>{(x - point) * normal, normal, {}};
  }

private:
  const dealii::Point<dim>     point;
  const dealii::Tensor<1, dim> normal;
};

/// This class is a ball, or a round bar if the distance is taken at right angles to its axis. The
/// hollow shape is the space outside of the ball or bar.
template <int dim>
class Round : public Obstacle<dim>
{
public:
  Round(const ObstacleParameters &parameters, bool bar, bool hollow)
    : centre(to_point<dim>(parameters.point))
    , across(dealii::unit_symmetric_tensor<dim>())
    , radius(parameters.radius)
    , side(hollow ? -1. : 1.)
  {
    const dealii::Tensor<1, dim> axis = to_point<dim>(parameters.axis);
    if (bar && dim == 3)
      across -= outer_product(axis, axis) / axis.norm_square();
  }

  std::optional<ObstacleDistance<dim>> distance(const dealii::Point<dim> &x) const override
  {
    const dealii::Tensor<1, dim> r      = across * (x - centre);
    const double                 length = r.norm();
    // At the centre or on the axis, the closest point is not unique.
    if (!(length > 1e-10 * radius))
      return std::nullopt;
    const dealii::Tensor<1, dim> n = r / length;
    // H = (I - n n')/|r| within the directions of `across`. The hollow shape has all signs
    // reversed.
    return ObstacleDistance<dim>{side * (length - radius), side * n,
                                 side / length * (across - outer_product(n, n))};
  }

private:
  const dealii::Point<dim> centre;
  dealii::Tensor<2, dim>   across; ///< I, or I - axis axis'
  const double             radius, side;
};

template <int dim>
using Make = std::unique_ptr<Obstacle<dim>>(const ObstacleParameters &, double);

template <int dim>
Choice<Make<dim>> round(const std::string &name, const std::string &meaning, bool bar, bool hollow)
{
  return {name, meaning, [bar, hollow](const ObstacleParameters &parameters, double) {
            return std::make_unique<Round<dim>>(parameters, bar, hollow);
          }};
}
} // namespace

/// Return the coordinates as a point. The lists come from parameter files, for which the number of
/// entries has been checked.
template <int dim>
dealii::Point<dim> to_point(const std::vector<double> &coordinates)
{
  SNUG_ASSERT_EQUAL(coordinates.size(), dim);
  dealii::Point<dim> point;
  for (unsigned int c = 0; c < dim; ++c)
    point[c] = coordinates[c];
  return point;
}

template <int dim>
const ChoiceTable<Make<dim>> &obstacle_table()
{
  static const ChoiceTable<Make<dim>> table = {
    {"plane", "half-space behind the plane through 'Point' with 'Normal'",
     [](const ObstacleParameters &parameters, double) {
       return std::make_unique<Plane<dim>>(to_point<dim>(parameters.point),
                                           to_point<dim>(parameters.normal));
     }},
    round<dim>("sphere", "sphere about 'Point' with 'Radius'", false, false),
    round<dim>("hollow sphere", "space outside the sphere", false, true),
    round<dim>("cylinder", "cylinder about 'Axis' through 'Point' with 'Radius'; in 2D a circle",
               true, false),
    round<dim>("hollow cylinder", "space outside the cylinder", true, true),
    {"formula",
     "space where 'Formula' is negative, with 'Point' as origin and 'Axis' as last coordinate "
     "direction",
     [](const ObstacleParameters &parameters, double element_size) {
       return std::make_unique<LevelSet<dim>>(parameters, element_size);
     },
     {"Point", "Axis", "Formula"}}};
  return table;
}

template dealii::Point<2>            to_point(const std::vector<double> &);
template dealii::Point<3>            to_point(const std::vector<double> &);
template const ChoiceTable<Make<2>> &obstacle_table();
template const ChoiceTable<Make<3>> &obstacle_table();
} // namespace snug::contact
