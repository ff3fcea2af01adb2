#ifndef snug_mortar_moment_correction_h
#define snug_mortar_moment_correction_h

#include <snug/faces/recording.h>

#include <deal.II/base/tensor.h>

#include <vector>

namespace snug::mortar {
/**
 * Return the changes that free a mortar row of its moment. The forces coefficient_k n of the row at
 * the places x_k of its nodes have the sum 0. On curved faces these forces have the moment n x G,
 * G = -sum_k coefficient_k x_k, of third order in the size of the faces. Round bodies that turn
 * freely in each other could not balance such a moment. The coefficients of the master are changed
 * by
 *   -dM_k,  dM_k = w_k c . d_k,  d_k = x_k - sum_l w_l x_l / sum_l w_l,
 * with w_k >= 0, zero at slave nodes, and c at right angles to n such that G + sum_k dM_k x_k is
 * parallel to n:
 *   c = -A^+ P G,  A = P S P,  S = sum_k w_k d_k d_k',  P = I - n n'.
 * Where the weighted nodes lie on a line along which P G does not act, c = 0. The result is dM_k.
 * @p x is relative to a point near the nodes, to preserve the digits of differences.
 */
template <int dim, typename Number>
std::vector<Number> moment_correction(std::vector<dealii::Tensor<1, dim, Number>> x,
                                      const std::vector<Number>                  &coefficients,
                                      const std::vector<Number>                  &weights,
                                      const dealii::Tensor<1, dim, Number>       &n);
} // namespace snug::mortar

#endif
