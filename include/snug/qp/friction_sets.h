#ifndef snug_qp_friction_sets_h
#define snug_qp_friction_sets_h

#include <snug/qp/dual_problem.h>

namespace snug::qp {
/**
 * This class decides which closed contacts stick and which slip. The sets follow from
 * x = lambda_T + w_T / F_TT and the limit b of FrictionCone:
 *
 * | set   | condition                                                                            |
 * |-------|--------------------------------------------------------------------------------------|
 * | stick | |x| <= b, and a slip in the plane that turns round                                   |
 * | slip  | |x| > b, along n^ = x / |x|; D = min((|x| - b) / b, 1e6) F_TT across it              |
 *
 * A slip that turns round sticks first, because the reversed slip would turn back in the next step.
 * Without cones the sets are those of the normal rows.
 */
class FrictionSets
{
public:
  /// @p problem must outlive this object. If @p is_lagging, limits do not follow normal forces.
  FrictionSets(const DualProblem &the_problem, const bool the_is_lagging)
    : problem(the_problem), is_lagging(the_is_lagging)
  {}

  /// Return the sets of the forces @p lambda: forces at their limit slip.
  FreeRows at(const MultiVector &lambda) const;

  /**
   * Return the next sets.
   * @param[in] now present sets.
   * @param[in] closed equality rows and the normal rows that will be closed.
   * @param[in] lambda,w of the last solve.
   * @param[in] negligible forces that may be rounding errors, one per row.
   */
  FreeRows next(const FreeRows            &now,
                RowSet                     closed,
                const MultiVector         &lambda,
                const MultiVector         &w,
                const std::vector<double> &negligible) const;

private:
  FrictionCone        limited(FrictionCone cone, const MultiVector &lambda) const;
  std::optional<Slip> slip_in_corner(const FrictionCone        &cone,
                                     const MultiVector         &lambda,
                                     const MultiVector         &w,
                                     const std::vector<double> &negligible,
                                     bool                      &sticks) const;
  std::optional<Slip> slip_of(const FrictionCone        &cone,
                              const FreeRows            &now,
                              const MultiVector         &lambda,
                              const MultiVector         &w,
                              const std::vector<double> &negligible) const;

  const DualProblem &problem;
  const bool         is_lagging;
};
} // namespace snug::qp

#endif
