#ifndef snug_accuracy_adaptation_h
#define snug_accuracy_adaptation_h

#include <string>
#include <vector>

namespace snug::accuracy {
/// How large the error of a response may be.
struct Target
{
  double value    = 0.;
  bool   relative = true; ///< to the size of the response

  double allowed(double response) const;
};

/// The smallest target relative to a response: the rounding of states is above it.
constexpr double smallest_target = 1e-10;

/// Return the target of "1 %" of the response, or of a number in its units.
/// @throws std::invalid_argument for anything else, and for relative targets below smallest_target.
Target read_target(const std::string &text);

/// The part of the allowed error that a mesh is refined for, so that the last step neither misses
/// nor overshoots by much.
constexpr double aim = 0.8;

struct Marking
{
  unsigned int degree; ///< p of the elements
  double       share;  ///< of the error, that is refined at once
};

/**
 * The cells to refine for one response: the fewest, those with the largest indicators first, with
 *   E - (1 - 4^-p) sum_marked <= aim * allowed,
 * where the @p indicators are scaled to the sum E = @p error, but cells with no more than
 * the share of E, and those that are all but equal to the last. Cells in an order that does not
 * depend on the ranks.
 */
std::vector<bool>
mark(const std::vector<double> &indicators, double error, double allowed, const Marking &marking);

/// Solver tolerances between meshes.
constexpr double first_tolerance = 1e-2;

/**
 * The tolerance at which the next mesh is solved: a tenth of the relative @p error of the response
 * of this one, of energies, which feel errors of the state squared, its root; between @p least and
 * first_tolerance.
 */
double step_tolerance(double error, bool is_energy, double least);

/// Whether errors on meshes refined for them have no limit zero: the last is above two thirds of
/// the largest of the three before.
bool is_unbounded(const std::vector<double> &errors);

/// Whether one of the last four values has another sign than the last, as what a solver leaves of a
/// response that is zero.
bool changes_sign(const std::vector<double> &values);
} // namespace snug::accuracy

#endif
