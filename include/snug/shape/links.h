#ifndef snug_shape_links_h
#define snug_shape_links_h

#include <snug/shape/shape_basis.h>

namespace snug::shape {
/// Whether each control is fixed: frozen, or in the list of the entry Fixed
/// ("border" or indices of control points). @throws InputError
template <int dim>
std::vector<bool> fixed_points(const std::vector<Control<dim>> &controls,
                               const ShapeParameters           &parameters);

/**
 * The controls that design variables move: beta = L alpha, where every
 * control is fixed, a variable, or plus or minus a variable it is tied to.
 *
 * A mirror plane ties a control at x along d to the one at the image of x
 * along the image of d, with the sign that makes these equal; one that
 * would be tied to its own opposite is fixed, and so are all that are tied
 * to a fixed one. Variables are numbered by the first control they move.
 */
class Links
{
public:
  /// @p n controls, all of them variables.
  explicit Links(unsigned int n);

  /**
   * Links by the entries Fixed and Symmetry.
   * @throws InputError naming Fixed if nothing is left to move, or
   *   Symmetry if a control has no image.
   */
  template <int dim>
  Links(const std::vector<Control<dim>> &controls, const ShapeParameters &parameters);

  unsigned int n_variables() const { return size; }

  /// Return the variable and the sign that control @p i is tied to; the sign 0: it is fixed.
  std::pair<unsigned int, double> tie(unsigned int i) const
  {
    return {ties[i].variable, ties[i].sign};
  }

  /// L alpha.
  std::vector<double> expand(const std::vector<double> &alpha) const;

  /// L' gradient.
  std::vector<double> collect(const std::vector<double> &gradient) const;

private:
  /// Control = sign * variable; sign 0: fixed.
  struct Tie
  {
    unsigned int variable;
    double       sign;
  };

  std::vector<Tie> ties;
  unsigned int     size = 0;
};
} // namespace snug::shape

#endif
