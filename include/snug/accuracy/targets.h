#ifndef snug_accuracy_targets_h
#define snug_accuracy_targets_h

#include <string>
#include <vector>

namespace snug::accuracy {
/// This struct holds the maximum error of a response.
struct Target
{
  double value    = 0.;
  bool   relative = true; ///< relative to the size of the response

  double allowed(double response) const;
};

/// Minimum target relative to a response. Smaller targets are below the rounding of states.
constexpr double smallest_target = 1e-10;

/// Return the target of "1 %" of the response, or of a number in its units.
/// @throws std::invalid_argument for anything else, and for relative targets below smallest_target.
Target read_target(const std::string &text);

/// Share of the allowed error at which refinement aims, so that the last step neither misses nor
/// overshoots the target by much.
constexpr double aim = 0.8;

struct Marking
{
  unsigned int degree; ///< p of the elements
  double       share;  ///< maximum share of the error in the cells refined at once
};

/**
 * Return the cells to refine for one response. The function marks the minimum number of
 * cells, those with the maximum indicators first, that satisfies
 *   E - (1 - 4^-p) sum_marked <= aim * allowed,
 * where the @p indicators are scaled to the sum E = @p error. The marked cells have at most the
 * given share of E, except that cells with almost the same indicator as the last marked cell are
 * marked too. The cells must be in an order that does not depend on the ranks.
 */
std::vector<bool>
mark(const std::vector<double> &indicators, double error, double allowed, const Marking &marking);

/// Maximum tolerance of the solver on meshes for targets, unless the minimum is larger. A first
/// mesh without cells refined for the targets is solved to this tolerance.
constexpr double maximum_tolerance = 1e-2;

/**
 * Return the tolerance at which the next mesh is solved: a tenth of the relative @p error of the
 * response on the current mesh. For energies it is the root of this value, because energies depend
 * on the square of the error of the state. The tolerance is at least @p least and otherwise at most
 * maximum_tolerance.
 */
double step_tolerance(double error, bool is_energy, double least);

/// Return whether errors on meshes refined for the response do not tend to zero: the last error is
/// above two thirds of the maximum of the three errors before it.
bool is_unbounded(const std::vector<double> &errors);

/// Return whether one of the last four values differs in sign from the last value. This is typical
/// of a response that is zero except for the error of the solver.
bool changes_sign(const std::vector<double> &values);
} // namespace snug::accuracy

#endif
