#ifndef snug_elasticity_linear_traction_h
#define snug_elasticity_linear_traction_h

#include <deal.II/base/tensor.h>

namespace snug::elasticity {
/// Return a x b of vectors in the plane or in space. In the plane, it is the moment of b about
/// the out-of-plane axis.
dealii::Tensor<1, 3> moment_of(const dealii::Tensor<1, 2> &arm, const dealii::Tensor<1, 2> &force);
dealii::Tensor<1, 3> moment_of(const dealii::Tensor<1, 3> &arm, const dealii::Tensor<1, 3> &force);

/// Return axis x v. In the plane, the axis has only its out-of-plane component.
dealii::Tensor<1, 2> turned(const dealii::Tensor<1, 3> &axis, const dealii::Tensor<1, 2> &v);
dealii::Tensor<1, 3> turned(const dealii::Tensor<1, 3> &axis, const dealii::Tensor<1, 3> &v);

/// Return I = int (|r|^2 - r (x) r) from int r (x) r. In the plane the out-of-plane entry of I is
/// computed too.
template <int dim>
dealii::Tensor<2, 3> inertia(const dealii::Tensor<2, dim> &second);

/// Return I^-1. In the plane only the out-of-plane axis is considered.
template <int dim>
dealii::Tensor<2, 3> inverse(const dealii::Tensor<2, 3> &I);

/// Integrals over a face about a fixed origin o, with X = x - o, or their derivatives. [length^2,
/// length^3, length^4]
template <int dim>
struct AreaMoments
{
  double                 area = 0.; ///< int dA
  dealii::Tensor<1, dim> first;     ///< int X dA
  dealii::Tensor<2, dim> second;    ///< int X (x) X dA
};

/**
 * The traction t(x) = a + w x (x - c) [force / length^2] of a total force and a moment on a face
 * with centroid c, or the derivative of this traction.
 */
template <int dim>
struct LinearTraction
{
  dealii::Tensor<1, dim> uniform; ///< a
  dealii::Tensor<1, 3>   spin;    ///< w [force / length^3]
  dealii::Tensor<1, dim> centre;  ///< c

  dealii::Tensor<1, dim> value(const dealii::Tensor<1, dim> &x) const
  {
    return uniform + turned(spin, x - centre);
  }
};

/// A total force [force] and a moment about the centroid [force length]. In the plane, the moment
/// has only its out-of-plane component.
template <int dim>
struct Resultant
{
  dealii::Tensor<1, dim> force;
  dealii::Tensor<1, 3>   moment;
};

/**
 * This class distributes a resultant over a face with given AreaMoments. The force is distributed
 * uniformly, a = F / A, and the moment linearly,
 * @f[ I w = M,\quad I = \int (|r|^2 - r \otimes r) dA,\quad r = x - c . @f]
 * Force and moment of the traction are exactly F and M, because int r dA = 0. In the plane, I is
 * int |r|^2 dA.
 */
template <int dim>
class SpreadResultant
{
public:
  /// The moments are about @p origin.
  SpreadResultant(const Resultant<dim>         &resultant,
                  const AreaMoments<dim>       &moments,
                  const dealii::Tensor<1, dim> &origin);

  const LinearTraction<dim> &traction() const { return spread; }

  /// Return the derivative of the traction if the moments have derivatives @p derivative.
  LinearTraction<dim> derivative(const AreaMoments<dim> &derivative) const;

  /// Return I^-1 m.
  dealii::Tensor<1, 3> divided_by_inertia(const dealii::Tensor<1, 3> &m) const
  {
    return inverse_inertia * m;
  }

  double area() const { return moments.area; }

private:
  AreaMoments<dim>     moments;
  dealii::Tensor<2, 3> inverse_inertia;
  LinearTraction<dim>  spread;
};
} // namespace snug::elasticity

#endif
