#ifndef snug_mortar_moment_correction_h
#define snug_mortar_moment_correction_h

#include <snug/faces/differential.h>

#include <array>
#include <vector>

namespace snug::mortar {
/**
 * What makes a mortar row free of moment. Its forces coefficient_k n at the
 * places x_k of its nodes have the sum 0, but on curved faces the moment
 * n x G, G = -sum_k coefficient_k x_k, of third order in the size of the
 * faces, which round bodies that turn freely in each other could not
 * balance. The master's coefficients are changed by
 *   -dM_k,  dM_k = w_k c . d_k,  d_k = x_k - sum_l w_l x_l / sum_l w_l,
 * with w_k >= 0, zero at slave nodes, and c at right angles to n such that
 * G + sum_k dM_k x_k is parallel to n:
 *   c = -A^+ P G,  A = P S P,  S = sum_k w_k d_k d_k',  P = I - n n'.
 * Where the weighted nodes lie on a line along which P G does not act, c = 0.
 */
template <int dim, typename Number>
class MomentCorrection
{
public:
  using Vector = std::array<Number, dim>;

  /// @p x: relative to a point near them, for their digits.
  MomentCorrection(const std::vector<Vector> &x,
                   const std::vector<Number> &coefficients,
                   const std::vector<Number> &weights,
                   const Vector              &n);

  /// dM_k
  const std::vector<Number> &masses() const { return dM; }

  /// Derivatives of a scalar with respect to what the correction is made of.
  struct Gradient
  {
    std::vector<Vector> x;
    std::vector<Number> coefficients, weights;
    Vector              n{};
  };

  /// Those of sum_k q_k dM_k for constant q.
  Gradient gradient(const std::vector<Number> &q) const;

private:
  std::vector<Vector> x, d;
  std::vector<Number> coefficients, weights, dM;
  Vector              n, G{}, c{};
  /// A + trace(A) n n'; empty where c = 0
  std::vector<Vector> A;

  void solve_for_c();
};
} // namespace snug::mortar

#endif
