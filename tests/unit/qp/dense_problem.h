#ifndef snug_tests_qp_dense_problem_h
#define snug_tests_qp_dense_problem_h

#include "dense.h"

#include <snug/qp/direction_basis.h>
#include <snug/qp/dual_problem.h>
#include <snug/qp/row_set.h>

#include <iostream>
#include <sstream>

/// The data of a dual problem, whole on every rank.
struct DenseData
{
  dense::Matrix                       F, G, d, e;
  dense::Matrix                       preconditioner; ///< M^{-1} of all rows; none if empty
  snug::qp::RowSet                    bounded;
  std::vector<snug::qp::FrictionCone> cones = {}; ///< for problems with one owner
};

/// A dual problem with dense matrices; every rank owns a slice of the rows.
class DenseProblem : public snug::qp::DualProblem
{
public:
  using MultiVector = snug::qp::MultiVector;
  using RowSet      = snug::qp::RowSet;

  /// The rows go to the first @p n_owners ranks in equal parts; 0: to all.
  explicit DenseProblem(const DenseData &data, unsigned int n_owners = 0)
    : data(data), run(MPI_COMM_WORLD, log)
  {
    const unsigned int n      = data.F.n_rows();
    const unsigned int owners = n_owners == 0 ? run.n_ranks() : n_owners;
    first                     = n * std::min(run.rank(), owners) / owners;
    end                       = n * std::min(run.rank() + 1, owners) / owners;
    my_bounded.assign(data.bounded.begin() + first, data.bounded.begin() + end);
    my_d = slice(data.d);
    if (end - first == n)
      my_cones = data.cones;
    for (unsigned int i = first; i < end; ++i)
      my_diagonal.push_back(data.F(i, i));
  }

  /// Estimate F_ii by @p factor F_ii.
  void scale_diagonal(double factor)
  {
    for (double &entry : my_diagonal)
      entry *= factor;
  }

  /// This rank's rows of a vector all ranks have.
  MultiVector slice(const MultiVector &x) const
  {
    MultiVector part(end - first, x.n_columns());
    for (unsigned int j = 0; j < x.n_columns(); ++j)
      std::copy(x.column(j) + first, x.column(j) + end, part.column(j));
    return part;
  }

  RowSet slice(const RowSet &rows) const
  {
    return RowSet(rows.begin() + first, rows.begin() + end);
  }

  /// The whole vector on all ranks.
  MultiVector gather(const MultiVector &x) const
  {
    MultiVector whole(data.F.n_rows(), x.n_columns());
    for (unsigned int j = 0; j < x.n_columns(); ++j)
      std::copy(x.column(j), x.column(j) + x.n_rows(), whole.column(j) + first);
    MPI_Allreduce(MPI_IN_PLACE, whole.column(0), whole.n_rows() * whole.n_columns(), MPI_DOUBLE,
                  MPI_SUM, MPI_COMM_WORLD);
    return whole;
  }

  RowSet gather(const RowSet &rows) const
  {
    MultiVector flags(rows.size());
    for (unsigned int i = 0; i < rows.size(); ++i)
      flags(i) = rows[i];
    flags = gather(flags);
    return RowSet(flags.column(0), flags.column(0) + flags.n_rows());
  }

  snug::RunContext &context() const override { return run; }

  unsigned int n_owned() const override { return end - first; }

  const RowSet &bounded() const override { return my_bounded; }

  const snug::qp::FrictionCones &cones() const override { return my_cones; }

  const MultiVector &d() const override { return my_d; }

  const MultiVector &e() const override { return data.e; }

  const std::vector<double> &diagonal() const override { return my_diagonal; }

  MultiVector apply(const MultiVector &x) const override
  {
    EXPECT_GT(x.n_columns(), 0u);
    run.work.f_mults += x.n_columns();
    return slice(dense::product(data.F, gather(x)));
  }

  MultiVector apply_G(const MultiVector &x) const override
  {
    return dense::product(data.G, gather(x));
  }

  MultiVector apply_Gt(const MultiVector &alpha) const override
  {
    return slice(dense::product(dense::transpose(data.G), alpha));
  }

  double feasibility_scale(double force) const override
  {
    double square = 0.;
    for (unsigned int j = 0; j < data.G.n_columns(); ++j)
      for (unsigned int i = 0; i < data.G.n_rows(); ++i)
        square += data.G(i, j) * data.G(i, j);
    return dense::largest(data.e) + std::sqrt(square) * force;
  }

  std::unique_ptr<snug::qp::FreeSet> free_set(const snug::qp::FreeRows &free) const override;

  const DenseData            data;
  mutable std::ostringstream log;
  mutable unsigned int       n_faces = 0;

private:
  unsigned int             first, end;
  RowSet                   my_bounded;
  MultiVector              my_d;
  snug::qp::FrictionCones  my_cones; ///< of the rank that owns all rows
  std::vector<double>      my_diagonal;
  mutable snug::RunContext run;
};

class DenseFace : public snug::qp::FreeSet
{
public:
  using MultiVector = snug::qp::MultiVector;
  using RowSet      = snug::qp::RowSet;

  using FreeRows = snug::qp::FreeRows;

  DenseFace(const DenseProblem &problem, const FreeRows &free)
    : problem(problem)
    , free(free)
    , equations(problem, free.transpose())
    , multipliers(problem, free)
    , motions(problem.data.G.n_rows() == 0
                ? MultiVector(0, 0)
                : snug::qp::null_space(dense::transpose(equations.G),
                                       1e-10 * dense::largest(problem.data.G)))
  {}

  const FreeRows &free_rows() const override { return free; }

  bool has_slips() const override
  {
    return snug::qp::any(!free.slips().empty(), problem.context().communicator());
  }

  void project(MultiVector &x) const override { subtract_rigid_part(equations, x); }

  void project_multipliers(MultiVector &y) const override { subtract_rigid_part(multipliers, y); }

  MultiVector precondition(const MultiVector &r) const override
  {
    problem.context().work.preconditioner_applications += r.n_columns();
    MultiVector z = r;
    free.restrict(z);
    if (problem.data.preconditioner.n_rows() == 0)
      return z;
    z = problem.slice(dense::product(problem.data.preconditioner, problem.gather(z)));
    free.restrict(z);
    return z;
  }

  MultiVector amplitudes(const MultiVector &x) const override
  {
    MultiVector y = x;
    free.restrict(y);
    return dense::product(equations.inverse, dense::product(equations.G, problem.gather(y)));
  }

  std::vector<double> make_feasible(MultiVector &x, const MultiVector &e) const override
  {
    free.restrict(x);
    const MultiVector missing = unbalanced(x, e);
    x.add(1., problem.slice(dense::product(dense::transpose(multipliers.G),
                                           dense::product(multipliers.inverse, missing))));
    const auto left = norms(unbalanced(x, e), MPI_COMM_SELF);
    free.expand(x);
    return left;
  }

  const MultiVector &unresisted_motions() const override { return motions; }

private:
  /// G M of one of the two maps, with (G M M'G')^+.
  struct Side
  {
    Side(const DenseProblem &problem, const FreeRows &free)
    {
      const unsigned int n = problem.data.F.n_rows();
      dense::Matrix      unit(n, n);
      for (unsigned int i = 0; i < n; ++i)
        unit(i, i) = 1.;
      MultiVector M = problem.slice(unit);
      free.restrict(M);
      free.expand(M);
      G       = dense::product(problem.data.G, problem.gather(M));
      inverse = dense::pseudo_inverse(dense::product(G, dense::transpose(G)));
    }

    dense::Matrix G, inverse;
  };

  void subtract_rigid_part(const Side &side, MultiVector &x) const
  {
    free.restrict(x);
    const auto alpha = dense::product(side.inverse, dense::product(side.G, problem.gather(x)));
    x.add(-1., problem.slice(dense::product(dense::transpose(side.G), alpha)));
  }

  MultiVector unbalanced(const MultiVector &y, const MultiVector &e) const
  {
    MultiVector result = e;
    result.add(-1., dense::product(multipliers.G, problem.gather(y)));
    return result;
  }

  const DenseProblem &problem;
  const FreeRows      free;
  const Side          equations, multipliers;
  const MultiVector   motions;
};

inline std::unique_ptr<snug::qp::FreeSet>
DenseProblem::free_set(const snug::qp::FreeRows &free) const
{
  ++n_faces;
  return std::make_unique<DenseFace>(*this, free);
}

#endif
