#ifndef snug_tests_random_dense_problem_h
#define snug_tests_random_dense_problem_h

#include <random/linear_program.h>

#include <deal.II/lac/lapack_full_matrix.h>

#include <deque>
#include <vector>

namespace snug::test {
/// sum of coefficients times unknowns = bound where held, <= bound in contact.
struct DenseRow
{
  std::vector<std::pair<unsigned int, double>> coefficients;
  double                                       bound = 0.;
};

inline double times(const DenseRow &row, const Vector &u)
{
  double sum = 0.;
  for (const auto &[i, c] : row.coefficients)
    sum += c * u(i);
  return sum;
}

/// u += factor * row
inline void add(double factor, const DenseRow &row, Vector &u)
{
  for (const auto &[i, c] : row.coefficients)
    u(i) += factor * c;
}

/// The contact problem of whole bodies in dense matrices:
/// min 1/2 u'Ku - f'u with the rows of supports, orthonormal, and of contact.
struct DenseProblem
{
  std::vector<unsigned int> first; ///< unknown of each body, and their number
  std::vector<Matrix>       K;     ///< per body
  std::vector<Matrix>       rigid; ///< its motions: unknowns x 3 or 6
  Vector                    f;
  std::vector<DenseRow>     held, contact;
};

/// Solvability by the rigid motions that supports permit and contact does not resist.
struct Verdict
{
  enum Kind
  {
    held,      ///< none, or every one lowers f'u
    neutral,   ///< one that f'u does not feel
    escape,    ///< one along which f'u grows
    undecided, ///< too near to tell, or the linear program lost its digits
  };
  Kind              kind = undecided;
  double            rate = 0.; ///< of f'u along the worst, relative to the loads
  std::vector<bool> may_move;  ///< per body, if escape
};

/// A solution, where its own check found it to be one.
struct DenseSolution
{
  Vector u, forces;         ///< of all unknowns and contact rows
  Vector nodal;             ///< B'forces, which is unique where the forces are not
  bool   is_unique = false; ///< the forces are
  /// motions that supports and loaded rows leave, orthonormal: unknowns x n
  Matrix free;
  bool   free_is_sure = false; ///< no force is small and no motion nearly held
  double energy       = 0.;
  double length       = 0.; ///< largest elastic displacement or gap
  double force        = 0.; ///< largest load or contact force
};

/// Both answers of a problem, from dense algebra alone.
class DenseOracle
{
public:
  /// @p problem must outlive this object.
  explicit DenseOracle(const DenseProblem &problem);

  Verdict verdict() const;

  /// Where there is an equilibrium. @throws std::runtime_error if its conditions are not met to
  /// 1e-10.
  DenseSolution solve();

private:
  void   find_free_motions();
  void   factorize();
  void   find_compliance();
  Vector without_held(Vector v) const;
  Vector elastic(const Vector &load) const;
  Vector stiffness_times(const Vector &u) const;
  Vector complementary(const Vector &covering) const;
  void   refine(Vector &z) const;
  bool   is_solution(const Vector &z) const;
  void   recover(const Vector &z, DenseSolution &solution) const;
  void   describe(DenseSolution &solution) const;

  const DenseProblem       &problem;
  std::vector<unsigned int> body_of;    ///< per free motion
  Matrix                    N;          ///< free motions: unknowns x n
  Matrix                    BN;         ///< contact rows x n
  Vector                    load;       ///< N'f
  double                    gross = 0.; ///< sum of |f_i|
  /// of K where not held; a deque, as copies forget that they are factors
  std::deque<dealii::LAPACKFullMatrix<double>> factors;
  double                                       kappa = 0.; ///< mean diagonal of K
  double                                       scale = 1.; ///< of forces
  Vector                                       u_0;        ///< without contact forces
  Matrix                                       F; ///< compliance of contact rows, times kappa
  Vector                                       q; ///< their gaps at u_0, times kappa
};
} // namespace snug::test

#endif
