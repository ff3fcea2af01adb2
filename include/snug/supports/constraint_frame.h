#ifndef snug_supports_constraint_frame_h
#define snug_supports_constraint_frame_h

#include <deal.II/base/tensor.h>

#include <vector>

namespace snug::supports {
/**
 * Constraints d_j . u = v_j on the displacement of one node: linearly independent unit vectors d_j
 * and, per load case, values v_j [length]. A frame of derivatives contains d_j' and v_j'.
 */
template <int dim>
struct ConstraintFrame
{
  std::vector<dealii::Tensor<1, dim>> directions;
  std::vector<std::vector<double>>    values; ///< [j][load case]
};

/**
 * This class states the same constraints as q_k . u = s_k with orthonormal q_k, by Gram-Schmidt in
 * the given order: d_j = sum_k<=j L_jk q_k, q_0 = d_0.
 */
template <int dim>
class Orthonormalised
{
public:
  explicit Orthonormalised(const ConstraintFrame<dim> &given);

  /// Return q_k and s_k.
  const ConstraintFrame<dim> &frame() const { return orthonormal; }

  /// Return the minimum L_jj, which is the sine of the minimum angle between a d_j and the span of
  /// the directions before it. Zero means that the directions are dependent and frame() is not
  /// usable.
  double independence() const;

  /// Return q_k' and s_k' where the given constraints have derivatives @p given'.
  ConstraintFrame<dim> derivative(const ConstraintFrame<dim> &given_derivative) const;

  /// Return the multipliers m of the given constraints that are equivalent to @p multipliers of the
  /// orthonormal ones: L' m = multipliers.
  std::vector<double> given_multipliers(std::vector<double> multipliers) const;

private:
  ConstraintFrame<dim>             orthonormal;
  std::vector<std::vector<double>> L;
};
} // namespace snug::supports

#endif
