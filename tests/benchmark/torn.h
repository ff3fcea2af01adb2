#ifndef snug_tests_benchmark_torn_h
#define snug_tests_benchmark_torn_h

#include <snug/qp/solver.h>
#include <snug/state/state_solver.h>

#include <benchmark/stopwatch.h>

#include <string>

namespace snug::benchmark {
/// Part of a state: its name, how often it occurs, seconds of one.
struct Stage
{
  std::string  name;
  unsigned int count;
  Seconds      each;
};

/**
 * The contact state by Total FETI with everything assembled and symbolic
 * factorizations kept: what StateSolver::solve() does after assembly, from
 * a cold start and with all subdomains factorized anew.
 */
class Torn
{
public:
  /// All must outlive this object; @p dual is the solver's. One rank.
  Torn(const state::StateSolver<3> &solver, const feti::LoadedProblem &dual, RunContext &context);

  /// Numeric factorizations, coarse space, d.
  void factorize();

  /// The QP, u and the certificate, until that meets the tolerance.
  void solve();

  /// F-mults of the last solve().
  unsigned long f_mults() const { return work.f_mults; }

  /// Return the times of the stages of a state, measured one by one. @p whole is the time of
  /// factorize() and solve() together.
  std::vector<Stage> stages(const Seconds &whole);

private:
  void  linearize(feti::SharedOperators shared);
  Stage factorization_of_inverses() const;
  Stage factorization_of_interiors() const;

  const state::StateSolver<3>                    &solver;
  const feti::LoadedProblem                      &dual; ///< whose systems, loads and gaps are taken
  RunContext                                     &context;
  const feti::FactorCache                         cache;
  const feti::DualStructure                       structure;
  std::shared_ptr<const feti::DeflationStructure> soft_modes; ///< none
  feti::ContactPairs                              pairs;      ///< there is one pair
  std::unique_ptr<feti::Linearization>            linearization;
  std::unique_ptr<feti::LoadedProblem>            problem;
  qp::RowSet                                      active;
  unsigned int                                    outer_iterations = 0;
  Work                                            work; ///< of the last solve
};
} // namespace snug::benchmark

#endif
