#ifndef snug_advice_point_data_h
#define snug_advice_point_data_h

#include <snug/advice/advice.h>
#include <snug/advice/true_bodies.h>

#include <deal.II/base/symmetric_tensor.h>

#include <map>

namespace snug::advice {
/// x -> Q x + shift, Q orthogonal.
template <int dim>
struct Isometry
{
  dealii::Tensor<2, dim> Q;
  dealii::Tensor<1, dim> shift;

  dealii::Point<dim> operator()(const dealii::Point<dim> &x) const
  {
    return dealii::Point<dim>(Q * x + shift);
  }
};

/// This class holds the supports, loads and contact of a scene at points of its bodies, and checks
/// whether an isometry keeps them.
template <int dim>
class PointData
{
public:
  PointData(const Subject<dim> &subject, const TrueBodies<dim> &bodies);

  const std::vector<Place<dim>> &surface() const { return surface_points; }
  const std::vector<Place<dim>> &inside() const { return inner_points; }

  /// The held directions at a point as a projector.
  dealii::Tensor<2, dim> held(const Place<dim> &at) const;

  /// Return whether a face of a body is in a contact pair.
  bool is_in_contact(const Place<dim> &at) const;

  /// Return whether supports, loads, contact and material at @p from, turned by @p Q, are those at
  /// @p to.
  bool agree(const Place<dim> &from, const Place<dim> &to, const dealii::Tensor<2, dim> &Q) const;

  /// Return whether the prescribed displacement of the point is zero and no load acts there.
  bool is_free_of_loads(const Place<dim> &at) const;

private:
  using Vector = dealii::Tensor<1, dim>;

  /// One pair at a point.
  struct Touch
  {
    double gap; ///< the formula [length]
    double distance = 0.;
    Vector normal, motion; ///< of an obstacle
    bool   has_obstacle = false;
  };

  /// Supports and loads of one load case.
  struct Actions
  {
    Vector               prescribed, traction, body_force;
    Vector               force;  ///< total on the boundary
    dealii::Tensor<1, 3> moment; ///< the same
  };

  Actions            actions(const Place<dim> &at, unsigned int load_case) const;
  std::vector<Touch> touches(const Place<dim> &at) const;
  bool
  same_touches(const Place<dim> &from, const Place<dim> &to, const dealii::Tensor<2, dim> &Q) const;
  bool                        same_material(const Place<dim> &from, const Place<dim> &to) const;
  const elasticity::Material &material(const Place<dim> &at) const;

  const Subject<dim>                                  &subject;
  std::vector<Place<dim>>                              surface_points, inner_points;
  std::vector<geometry::Formula<dim>>                  gaps;      ///< per pair
  std::vector<std::unique_ptr<contact::Obstacle<dim>>> obstacles; ///< per pair, or null
  /// largest of any point, what differences are compared with
  double length = 0., prescribed = 0., traction = 0., body_force = 0., force = 0., moment = 0.,
         gap = 0.;
};
} // namespace snug::advice

#endif
