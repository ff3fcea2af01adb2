#ifndef snug_qp_solver_h
#define snug_qp_solver_h

#include <snug/base/choice.h>
#include <snug/qp/direction_basis.h>

#include <string>

namespace snug {
class Entries;
}

namespace snug::qp {
/// Entries of `subsection Solver` that a QP solver reads.
struct SolverParameters
{
  std::string  method             = "active set";
  double       relative_tolerance = 1e-6; ///< tolerance of the KKT residual
  unsigned int max_iterations     = 2000; ///< maximum number of F-mults of one solve

  void declare(Entries &entries);
};

/// Start of a solve. Empty vectors mean a cold start.
struct WarmStart
{
  MultiVector lambda; ///< n_owned x 1
  /// Free contact rows and all equality rows. If empty, the rows with a force in lambda are taken,
  /// unless the KKT residual of lambda is larger than that of a cold start. The solve then starts
  /// cold. With friction, tangential forces at the limit then slip.
  RowSet active;
  /// Directions of an earlier solve with the same F; may be empty.
  DirectionBasis directions = {};
  /// Contacts of the set @p active that slip; the others with free tangential rows stick.
  std::vector<Slip> slips = {};
};

/**
 * Solution of the dual QP. All solvers have the same measure, the natural KKT residual: r_E = w_E,
 * r_i = -min(lambda_i F_ii, -w_i) with w = d - F lambda + G' alpha, relative to ||P (d - F
 * lambda_Im)||, plus ||G lambda - e|| relative to the loads and forces, see kkt_residual().
 *
 * With friction there is no minimum. The solution satisfies the same conditions of normal rows, and
 * in each FrictionCone with the slip s = w_T:
 * |lambda_T| <= b, and s = 0 or lambda_T = b s / |s|.
 */
struct DualSolution
{
  MultiVector       lambda;     ///< n_owned x 1, >= 0 on bounded rows
  MultiVector       residual;   ///< d - F lambda, n_owned x 1
  MultiVector       amplitudes; ///< alpha, n_kernel x 1, on all ranks
  RowSet            active;     ///< equality rows, active contacts and tangential rows that stick
  std::vector<Slip> slips;      ///< contacts that slip
  double            kkt_residual     = 0.;
  unsigned int      outer_iterations = 0;
  unsigned long     f_mults          = 0;
  std::string       method; ///< the solver that finished
  /// Directions of the linear problem on the active set, if the solver used any.
  DirectionBasis directions;

  /// Return the rows whose motions are determined: active, and the tangential rows of slips, whose
  /// friction forces depend on them.
  RowSet determined_rows() const
  {
    RowSet rows = active;
    for (const Slip &slip : slips)
      for (unsigned int t = 0; t < slip.cone.n_tangents; ++t)
        rows[slip.cone.tangents[t]] = 1;
    return rows;
  }
};

/// A solver of the dual QP.
class Solver
{
public:
  virtual ~Solver() = default;

  /**
   * Solve to the relative tolerance of the KKT residual. Collective.
   * @throws SolveError if the tolerance is not met within the allowed
   *   F-mults.
   */
  virtual DualSolution solve(const DualProblem &problem, const WarmStart &start) const = 0;
};

/// Return the table of solvers, {"active set", "SMALSE-M"}.
const ChoiceTable<std::unique_ptr<Solver>(const SolverParameters &)> &solver_table();
} // namespace snug::qp

#endif
