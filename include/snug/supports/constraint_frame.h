#ifndef snug_supports_constraint_frame_h
#define snug_supports_constraint_frame_h

#include <deal.II/base/array_view.h>
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

/// Frames of many nodes, in one array each of directions and values. Frames of derivatives may be
/// empty.
template <int dim>
class ConstraintFrames
{
public:
  explicit ConstraintFrames(unsigned int n_load_cases = 0) : n_cases(n_load_cases) {}

  /// Make room for @p n_nodes frames with @p n_directions directions in all.
  void reserve(std::size_t n_nodes, std::size_t n_directions);
  void push_back(const ConstraintFrame<dim> &frame);

  /// Add factor * @p other, which has the same numbers of directions.
  void add(double factor, const ConstraintFrames &other);

  unsigned int size() const { return static_cast<unsigned int>(start.size() - 1); }
  unsigned int n_load_cases() const { return n_cases; }

  /// Return the directions of a frame. The view is valid as long as this object is unchanged.
  dealii::ArrayView<const dealii::Tensor<1, dim>> directions(unsigned int frame) const
  {
    return {all_directions.data() + start[frame], start[frame + 1] - start[frame]};
  }
  double value(unsigned int frame, unsigned int direction, unsigned int load_case) const
  {
    return values[(std::size_t(start[frame]) + direction) * n_cases + load_case];
  }

private:
  unsigned int                        n_cases;
  std::vector<unsigned int>           start{0}; ///< first direction of each frame
  std::vector<dealii::Tensor<1, dim>> all_directions;
  std::vector<double>                 values; ///< n_cases per direction
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
