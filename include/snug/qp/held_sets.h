#ifndef snug_qp_held_sets_h
#define snug_qp_held_sets_h

#include <snug/base/errors.h>
#include <snug/qp/dual_problem.h>

namespace snug::qp {
/// The error of a search for sets that another method may avoid.
class UnsettledSets : public SolveError
{
public:
  using SolveError::SolveError;
};

/// The error that no sets hold the bodies. With friction, another way of changing the sets may hold
/// them.
class NoEquilibrium : public UnsettledSets
{
public:
  using UnsettledSets::UnsettledSets;
};

/// This class changes sets of contacts where they do not hold the bodies, so that the linear
/// problem on them is solvable. Its members are collective.
class HeldSets
{
public:
  /// @p problem must outlive this object.
  explicit HeldSets(const DualProblem &the_problem) : problem(the_problem) {}

  /**
   * Return a face of @p rows, changed until no equation is missing: a motion that no equation
   * resists must be without loads and without friction forces. Otherwise slips against the motion
   * turn round, the smallest first, and one contact sticks; or open contacts close that close in
   * the motion.
   * @param[in] w slips of the last solution.
   * @param[in] scale of residuals; zero if it is not known yet.
   * @param[in,out] lambda made feasible on the face, with the friction forces of slips.
   * @throws NoEquilibrium; SolveError "slides".
   */
  std::unique_ptr<FreeSet>
  balanced(FreeRows rows, const MultiVector &w, double scale, MultiVector &lambda);

  /// Return @p from with the change of one contact towards @p to, see qp::with_one_change().
  FreeRows with_one_change(const FreeRows &from, const FreeRows &to) const;

  /// Return the number of calls of balanced() that have changed the sets.
  unsigned int n_repairs() const { return repairs; }

private:
  /// A slip that a motion moves.
  struct MovedSlip
  {
    double       slip, gain; ///< |w_T|; work on the motion that turning it round gains
    bool         is_against; ///< its direction is against the motion
    unsigned int rank, index;
  };

  bool                   change(const FreeSet     &free_set,
                                const MultiVector &w,
                                double             scale,
                                const MultiVector &lambda,
                                FreeRows          &rows);
  std::vector<MovedSlip> moved_slips(const MultiVector &w,
                                     const MultiVector &rates,
                                     const MultiVector &lambda,
                                     const FreeRows    &rows) const;
  void        hold_slips(const std::vector<MovedSlip> &all, double missing, FreeRows &rows);
  bool        close(const MultiVector &rates, FreeRows &rows) const;
  FreeRows    independent(const FreeRows &rows) const;
  MultiVector given_forces(const FreeRows &rows) const;

  const DualProblem &problem;
  unsigned int       repairs = 0, unopposed = 0;
};
} // namespace snug::qp

#endif
