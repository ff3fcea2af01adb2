#include <snug/qp/pcpg.h>

#include <deal.II/base/exceptions.h>

#include <algorithm>
#include <cmath>
#include <limits>

namespace snug
{
  namespace qp
  {
    namespace
    {
      /// Projected residuals below this part of the residual are rounding.
      const double rounding = 16. * std::numeric_limits<double>::epsilon();

      /// Directions depend on each other if a pivot of their Gram matrix,
      /// scaled to unit diagonal, is below this.
      const double dependence_cut = 1e-3;

      /// A direction is rounding if orthogonalisation leaves less than this
      /// of the square of its F-norm.
      const double noise = 1e-12;

      /// Iterations without a smaller residual that mean it is at its floor.
      const unsigned int patience = 40;

      MultiVector
      selected_columns(const MultiVector               &x,
                       const std::vector<unsigned int> &columns)
      {
        MultiVector part(x.n_rows(), 0);
        for (const unsigned int j : columns)
          part.append(x.columns_from(j, 1));
        return part;
      }

      /// x * C
      MultiVector
      times(const MultiVector &x, const MultiVector &C)
      {
        MultiVector product(x.n_rows(), C.n_columns());
        product.add_product(1., x, C);
        return product;
      }

      /// A <- A (I - 2 v v' / v'v)
      void
      reflect(const std::vector<double> &v, MultiVector &A)
      {
        double square = 0.;
        for (const double entry : v)
          square += entry * entry;
        for (unsigned int i = 0; i < A.n_rows(); ++i)
          {
            double product = 0.;
            for (unsigned int j = 0; j < v.size(); ++j)
              product += A(i, j) * v[j];
            for (unsigned int j = 0; j < v.size(); ++j)
              A(i, j) -= 2. * product / square * v[j];
          }
      }

      /// Remembers the smallest worst column and when it was reached.
      class StagnationTest
      {
      public:
        bool
        stagnates(double worst)
        {
          ++waited;
          if (worst < 0.99 * best)
            {
              best   = worst;
              waited = 0;
            }
          return waited > patience;
        }

      private:
        double       best   = std::numeric_limits<double>::infinity();
        unsigned int waited = 0;
      };
    } // namespace

    MultiVector
    orthonormal_combinations(const MultiVector         &S,
                             const std::vector<double> &smallest,
                             double                     cut)
    {
      const unsigned int       k = S.n_rows();
      MultiVector              C(k, 0);
      std::vector<MultiVector> candidates; // S-orthogonal to C's columns
      std::vector<double>      squares;    // c'Sc of the candidates
      for (unsigned int j = 0; j < k; ++j)
        if (S(j, j) > smallest[j])
          {
            candidates.emplace_back(k);
            candidates.back()(j) = 1. / std::sqrt(S(j, j));
            squares.push_back(1.);
          }
      while (!candidates.empty())
        {
          const std::size_t pivot =
            std::max_element(squares.begin(), squares.end()) - squares.begin();
          MultiVector       c      = candidates[pivot];
          const MultiVector Sc     = times(S, c);
          const double      square = inner_products(c, Sc, MPI_COMM_SELF)(0);
          if (!(square > cut))
            break;
          candidates.erase(candidates.begin() + pivot);
          squares.erase(squares.begin() + pivot);
          for (std::size_t j = 0; j < candidates.size(); ++j)
            {
              const double part =
                inner_products(candidates[j], Sc, MPI_COMM_SELF)(0) / square;
              candidates[j].add(-part, c);
              squares[j] -= part * part * square;
            }
          for (unsigned int i = 0; i < k; ++i)
            c(i) /= std::sqrt(square);
          C.append(c);
        }
      return C;
    }

    MultiVector
    null_space(MultiVector A)
    {
      const unsigned int m = A.n_rows(), n = A.n_columns();
      MultiVector        Q(n, n); // product of the reflections
      double             largest = 0.;
      for (unsigned int j = 0; j < n; ++j)
        {
          Q(j, j) = 1.;
          for (unsigned int i = 0; i < m; ++i)
            largest = std::max(largest, std::abs(A(i, j)));
        }
      unsigned int rank = 0;
      for (unsigned int row = 0; row < m && rank < n; ++row)
        {
          std::vector<double> v(n, 0.); // of the reflection
          double              square = 0.;
          for (unsigned int j = rank; j < n; ++j)
            {
              v[j] = A(row, j);
              square += v[j] * v[j];
            }
          if (std::sqrt(square) <= noise * largest)
            continue;
          v[rank] += std::copysign(std::sqrt(square), v[rank]);
          reflect(v, A);
          reflect(v, Q);
          ++rank;
        }
      return Q.columns_from(rank, n - rank);
    }

    Pcpg::Pcpg(const DualProblem &problem,
               const Face        &face,
               DirectionBasis     known)
      : problem(problem)
      , face(face)
      , comm(problem.context().communicator())
      , basis(std::move(known))
    {
      if (basis.P.n_columns() == 0)
        basis = {MultiVector(problem.n_owned(), 0),
                 MultiVector(problem.n_owned(), 0)};
    }

    DirectionBasis
    Pcpg::directions_off(const RowSet &rows) const
    {
      const unsigned int        n = basis.P.n_columns();
      std::vector<unsigned int> mine;
      for (unsigned int i = 0; i < rows.size(); ++i)
        if (rows[i])
          mine.push_back(i);
      unsigned int count = mine.size(), first = 0, total = 0;
      MPI_Exscan(&count, &first, 1, MPI_UNSIGNED, MPI_SUM, comm);
      MPI_Allreduce(&count, &total, 1, MPI_UNSIGNED, MPI_SUM, comm);
      if (total >= n)
        return DirectionBasis();
      MultiVector on_rows(total, n);
      for (unsigned int j = 0; j < n; ++j)
        for (unsigned int i = 0; i < count; ++i)
          on_rows(first + i, j) = basis.P(mine[i], j);
      MPI_Allreduce(
        MPI_IN_PLACE, on_rows.column(0), total * n, MPI_DOUBLE, MPI_SUM, comm);
      const MultiVector N   = null_space(on_rows);
      DirectionBasis    off = {times(basis.P, N), times(basis.FP, N)};
      for (unsigned int j = 0; j < off.P.n_columns(); ++j)
        for (const unsigned int i : mine)
          off.P(i, j) = 0.;
      return off;
    }

    void
    Pcpg::correct(MultiVector &lambda, MultiVector &residual) const
    {
      if (basis.P.n_columns() == 0)
        return;
      const MultiVector a = inner_products(basis.P, residual, comm);
      lambda.add_product(1., basis.P, a);
      residual.add_product(-1., basis.FP, a);
    }

    std::vector<double>
    Pcpg::orthogonalise(MultiVector &x) const
    {
      std::vector<double> removed(x.n_columns(), 0.);
      if (basis.P.n_columns() == 0)
        return removed;
      const MultiVector parts = inner_products(basis.FP, x, comm);
      x.add_product(-1., basis.P, parts);
      for (unsigned int j = 0; j < parts.n_columns(); ++j)
        for (unsigned int i = 0; i < parts.n_rows(); ++i)
          removed[j] += parts(i, j) * parts(i, j);
      return removed;
    }

    MultiVector
    Pcpg::directions(const MultiVector &r, std::vector<double> &removed) const
    {
      MultiVector Z = face.precondition(r);
      face.project(Z);
      removed = orthogonalise(Z);
      if (Z.n_columns() == 1)
        return Z;
      // A well conditioned basis first: dependent directions cost no F-mult.
      // It amplifies round-off, so the directions are projected and made
      // F-orthogonal once more, or residuals grow again near convergence.
      std::vector<double> smallest(Z.n_columns(), 0.);
      for (unsigned int j = 0; j < Z.n_columns(); ++j)
        if (removed[j] > 0.)
          smallest[j] = noise * removed[j] / largest_rayleigh_quotient;
      Z = times(Z,
                orthonormal_combinations(inner_products(Z, Z, comm),
                                         smallest,
                                         dependence_cut));
      face.project(Z);
      orthogonalise(Z);
      removed.assign(Z.n_columns(), 0.);
      return Z;
    }

    bool
    Pcpg::step(const MultiVector         &Z,
               const std::vector<double> &removed,
               MultiVector               &lambda,
               MultiVector               &residual)
    {
      const unsigned int n = Z.n_columns(), k = residual.n_columns();
      const MultiVector  FZ    = problem.apply(Z);
      MultiVector        right = FZ;
      right.append(Z);
      right.append(residual);
      const MultiVector   products = inner_products(Z, right, comm);
      std::vector<double> smallest(n);
      for (unsigned int j = 0; j < n; ++j)
        {
          const double ZZ = products(j, n + j);
          if (ZZ > 0.)
            largest_rayleigh_quotient =
              std::max(largest_rayleigh_quotient, products(j, j) / ZZ);
          smallest[j] = std::max(std::numeric_limits<double>::epsilon() *
                                   largest_rayleigh_quotient * ZZ,
                                 noise * removed[j]);
        }
      const MultiVector C =
        orthonormal_combinations(products.columns_from(0, n),
                                 smallest,
                                 dependence_cut);
      if (C.n_columns() == 0)
        return false;
      const MultiVector a =
        inner_products(C, products.columns_from(2 * n, k), MPI_COMM_SELF);
      const MultiVector new_P = times(Z, C), new_FP = times(FZ, C);
      lambda.add_product(1., new_P, a);
      residual.add_product(-1., new_FP, a);
      basis.P.append(new_P);
      basis.FP.append(new_FP);
      return true;
    }

    PcpgResult
    Pcpg::solve(MultiVector               &lambda,
                MultiVector               &residual,
                const std::vector<double> &tolerances,
                unsigned int               max_iterations)
    {
      const unsigned int k = lambda.n_columns();
      AssertDimension(residual.n_columns(), k);
      AssertDimension(tolerances.size(), k);
      PcpgResult          result;
      StagnationTest      test;
      std::vector<double> first;
      correct(lambda, residual);
      while (true)
        {
          MultiVector r = residual;
          face.project(r);
          MultiVector both = r;
          both.append(residual);
          const auto                sizes = norms(both, comm);
          std::vector<unsigned int> remaining;
          double                    worst = 0.;
          if (result.iterations == 0)
            first = sizes;
          for (unsigned int j = 0; j < k; ++j)
            if (!(sizes[j] <= std::max(tolerances[j], rounding * sizes[k + j])))
              {
                remaining.push_back(j);
                worst = std::max(worst, sizes[j] / first[j]);
              }
          result.residual_norms.assign(sizes.begin(), sizes.begin() + k);
          result.converged = remaining.empty();
          if (result.converged || result.iterations == max_iterations ||
              test.stagnates(worst))
            return result;
          std::vector<double> removed;
          const MultiVector   Z =
            directions(selected_columns(r, remaining), removed);
          if (Z.n_columns() == 0 || !step(Z, removed, lambda, residual))
            return result;
          ++result.iterations;
        }
    }

    PcpgResult
    pcpg(const DualProblem         &problem,
         const Face                &face,
         MultiVector               &lambda,
         MultiVector               &residual,
         const std::vector<double> &tolerances,
         unsigned int               max_iterations)
    {
      return Pcpg(problem, face)
        .solve(lambda, residual, tolerances, max_iterations);
    }
  } // namespace qp
} // namespace snug
