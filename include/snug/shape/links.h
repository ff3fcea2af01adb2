#ifndef snug_shape_links_h
#define snug_shape_links_h

#include <snug/shape/shape_basis.h>

namespace snug::shape {
/// Return, for each control, whether the control is fixed. A control is fixed if it is frozen or
/// in the list of the entry Fixed ("border" or indices of control points). @throws InputError
template <int dim>
std::vector<bool> fixed_points(const std::vector<Control<dim>> &controls,
                               const ShapeParameters           &parameters);

/**
 * The linear map beta = L alpha from design variables to controls. Every control is fixed, is a
 * variable, or equals plus or minus the variable to which the control is tied.
 *
 * A mirror plane ties a control at x along d to the control at the image of x along the image of
 * d, with the sign that makes the two directions equal. A control that would be tied to its own
 * opposite is fixed. Every control that is tied to a fixed control is fixed as well. Variables
 * are numbered in the order of the first control that each variable moves.
 */
class Links
{
public:
  /// Construct the links of @p n controls, each of which is a variable.
  explicit Links(unsigned int n);

  /**
   * Construct the links from the entries Fixed and Symmetry.
   * @throws InputError naming Fixed if nothing is left to move, or
   *   Symmetry if a control has no image.
   */
  template <int dim>
  Links(const std::vector<Control<dim>> &controls, const ShapeParameters &parameters);

  unsigned int n_variables() const { return size; }

  /// Return the variable and the sign to which control @p i is tied. The sign 0 means that the
  /// control is fixed.
  std::pair<unsigned int, double> tie(unsigned int i) const
  {
    return {ties[i].variable, ties[i].sign};
  }

  /// Return L alpha.
  std::vector<double> expand(const std::vector<double> &alpha) const;

private:
  /// The relation control = sign * variable. The sign 0 means that the control is fixed.
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
