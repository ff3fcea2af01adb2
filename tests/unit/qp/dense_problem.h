#ifndef snug_tests_qp_dense_problem_h
#define snug_tests_qp_dense_problem_h

#include "dense.h"

#include <snug/qp/dual_problem.h>

#include <iostream>
#include <sstream>

/// The data of a dual problem, whole on every rank.
struct DenseData
{
  dense::Matrix    F, G, d, e;
  dense::Matrix    preconditioner; ///< M^{-1} of all rows; none if empty
  snug::qp::RowSet bounded;
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

  std::unique_ptr<snug::qp::FreeSet> free_set(const RowSet &free) const override;

  const DenseData            data;
  mutable std::ostringstream log;
  mutable unsigned int       n_faces = 0;

private:
  unsigned int             first, end;
  RowSet                   my_bounded;
  MultiVector              my_d;
  std::vector<double>      my_diagonal;
  mutable snug::RunContext run;
};

class DenseFace : public snug::qp::FreeSet
{
public:
  using MultiVector = snug::qp::MultiVector;
  using RowSet      = snug::qp::RowSet;

  DenseFace(const DenseProblem &problem, const RowSet &free)
    : problem(problem), free(free), whole(problem.gather(free)), G(problem.data.G)
  {
    for (unsigned int j = 0; j < G.n_columns(); ++j)
      if (!whole[j])
        for (unsigned int i = 0; i < G.n_rows(); ++i)
          G(i, j) = 0.;
    inverse = dense::pseudo_inverse(dense::product(G, dense::transpose(G)));
  }

  const RowSet &rows() const override { return free; }

  void project(MultiVector &x) const override
  {
    const MultiVector alpha = amplitudes(x);
    restrict(x);
    x.add(-1., problem.slice(dense::product(dense::transpose(G), alpha)));
  }

  MultiVector precondition(const MultiVector &r) const override
  {
    problem.context().work.preconditioner_applications += r.n_columns();
    MultiVector z = r;
    restrict(z);
    if (problem.data.preconditioner.n_rows() == 0)
      return z;
    z = problem.slice(dense::product(problem.data.preconditioner, problem.gather(z)));
    restrict(z);
    return z;
  }

  MultiVector amplitudes(const MultiVector &x) const override
  {
    return dense::product(inverse, dense::product(G, problem.gather(x)));
  }

  std::vector<double> make_feasible(MultiVector &x, const MultiVector &e) const override
  {
    restrict(x);
    const MultiVector missing = unbalanced(x, e);
    x.add(1., problem.slice(dense::product(dense::transpose(G), dense::product(inverse, missing))));
    return norms(unbalanced(x, e), MPI_COMM_SELF);
  }

  std::vector<double> gap_closing_rates(const MultiVector &e) const override
  {
    // (I - G G' (G G')^+) e moves the bodies
    MultiVector motion = e;
    motion.add(-1.,
               dense::product(G, dense::product(dense::transpose(G), dense::product(inverse, e))));
    const MultiVector rates = problem.apply_Gt(motion);
    return std::vector<double>(rates.column(0), rates.column(0) + rates.n_rows());
  }

private:
  void restrict(MultiVector &x) const
  {
    for (unsigned int j = 0; j < x.n_columns(); ++j)
      for (unsigned int i = 0; i < x.n_rows(); ++i)
        if (!free[i])
          x(i, j) = 0.;
  }

  MultiVector unbalanced(const MultiVector &x, const MultiVector &e) const
  {
    MultiVector result = e;
    result.add(-1., dense::product(G, problem.gather(x)));
    return result;
  }

  const DenseProblem &problem;
  const RowSet        free, whole;
  dense::Matrix       G, inverse;
};

inline std::unique_ptr<snug::qp::FreeSet> DenseProblem::free_set(const RowSet &free) const
{
  ++n_faces;
  return std::make_unique<DenseFace>(*this, free);
}

#endif
