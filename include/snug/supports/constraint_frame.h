#ifndef snug_supports_constraint_frame_h
#define snug_supports_constraint_frame_h

#include <deal.II/base/tensor.h>

#include <vector>

namespace snug::supports {
/**
 * The constraints d_j . u = v_j on the displacement of one node: linearly
 * independent unit vectors d_j and, per load case, values v_j [length].
 * As a derivative: d_j' and v_j'.
 */
template <int dim>
struct ConstraintFrame
{
  std::vector<dealii::Tensor<1, dim>> directions;
  std::vector<std::vector<double>>    values; ///< [j][load case]
};

/**
 * The same constraints as q_k . u = s_k with orthonormal q_k, by
 * Gram-Schmidt in the given order: d_j = sum_k<=j L_jk q_k, q_0 = d_0.
 */
template <int dim>
class Orthonormalised
{
public:
  explicit Orthonormalised(const ConstraintFrame<dim> &given);

  /// q_k and s_k.
  const ConstraintFrame<dim> &frame() const { return orthonormal; }

  /// The smallest L_jj: the sine of the smallest angle between a d_j and
  /// the span of those before it. Zero: dependent, and frame() is not
  /// usable.
  double independence() const;

  /// q_k' and s_k' where the given constraints have derivatives @p given'.
  ConstraintFrame<dim> derivative(const ConstraintFrame<dim> &given_derivative) const;

  /// Multipliers of the given constraints that do the same as
  /// @p multipliers of the orthonormal ones: L' m = multipliers.
  std::vector<double> given_multipliers(std::vector<double> multipliers) const;

private:
  ConstraintFrame<dim>             orthonormal;
  std::vector<std::vector<double>> L;
};
} // namespace snug::supports

#endif
