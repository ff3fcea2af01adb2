#include <snug/base/errors.h>
#include <snug/qp/pcpg.h>
#include <snug/sensitivity/direct.h>

namespace snug
{
  namespace sensitivity
  {
    namespace
    {
      /// Equality rows and strongly active contact rows.
      template <int dim>
      qp::RowSet
      strong_rows(const state::StateSolver<dim>  &solver,
                  const state::ContactState<dim> &state)
      {
        qp::RowSet  rows       = solver.feti().bounded();
        const auto &of_contact = solver.gluing().contact_of_row();
        for (unsigned int i = 0; i < rows.size(); ++i)
          rows[i] = !rows[i] || state.contact[of_contact[i]].strong;
        return rows;
      }

      void
      refuse_weak_contacts(unsigned int n_weak)
      {
        if (n_weak > 0)
          throw SolveError(
            std::to_string(n_weak) +
            " contacts are weakly active (neither force nor gap): the "
            "displacement has only one-sided derivatives there; use the "
            "energy gradient, or a tolerance of at most 1e-8 if the state "
            "was solved coarsely");
      }
      /// ||G mu - e|| of every column within the tolerance of ||mu||; B and R
      /// are orthonormal but for a few rows, so ||G|| is near 1.
      bool
      balanced(const qp::MultiVector &missing,
               const qp::MultiVector &mu,
               double                 tolerance,
               const RunContext      &context)
      {
        const auto errors = qp::norms(missing, MPI_COMM_SELF);
        const auto sizes  = qp::norms(mu, context.communicator());
        for (unsigned int j = 0; j < errors.size(); ++j)
          if (errors[j] > tolerance * sizes[j])
            return false;
        return true;
      }
    } // namespace

    template <int dim>
    StateDerivatives
    direct(const state::StateSolver<dim>                          &solver,
           const state::ContactState<dim>                         &state,
           const std::vector<typename mesh::BodyMesh<dim>::Field> &velocities,
           const GradientParameters                               &parameters)
    {
      refuse_weak_contacts(state.weak_contacts);
      const auto           &feti    = solver.feti();
      RunContext           &context = solver.context();
      const auto           &limits  = solver.model().solver;
      const unsigned long   before  = context.work.f_mults;
      const DataDerivatives data =
        data_derivatives(solver, state, velocities, parameters);
      const auto face = feti.face(strong_rows(solver, state));

      qp::MultiVector d = feti.multiply_B(feti.apply_inverse(data.primal));
      d.add(-1., data.dual);
      StateDerivatives result;
      result.lambda = qp::MultiVector(feti.n_owned(), velocities.size());
      face->make_feasible(result.lambda, feti.rigid_part(data.primal));
      qp::MultiVector residual = d;
      residual.add(-1., feti.apply(result.lambda));
      qp::MultiVector projected = residual;
      face->project(projected);
      std::vector<double> tolerances =
        qp::norms(projected, context.communicator());
      for (double &tolerance : tolerances)
        tolerance *= limits.relative_tolerance;
      const auto solved  = qp::pcpg(feti,
                                   *face,
                                   result.lambda,
                                   residual,
                                   tolerances,
                                   limits.max_iterations);
      auto       missing = feti.rigid_part(data.primal);
      missing.add(-1., feti.apply_G(result.lambda));
      if (!solved.converged ||
          !balanced(missing, result.lambda, limits.relative_tolerance, context))
        throw SolveError("the sensitivities were not solved to the relative "
                         "tolerance; allow a larger 'Solver/Relative "
                         "tolerance' or more 'Solver/Maximum F-mults'");
      auto alpha = face->amplitudes(residual);
      for (unsigned int j = 0; j < alpha.n_columns(); ++j)
        for (unsigned int i = 0; i < alpha.n_rows(); ++i)
          alpha(i, j) *= -1.;
      result.u       = feti.recover(data.primal, result.lambda, alpha);
      result.f_mults = context.work.f_mults - before;
      result.sweeps  = solved.iterations;
      return result;
    }

#define SNUG_INSTANTIATE(dim)                        \
  template StateDerivatives direct(                  \
    const state::StateSolver<dim> &,                 \
    const state::ContactState<dim> &,                \
    const std::vector<mesh::BodyMesh<dim>::Field> &, \
    const GradientParameters &);
    SNUG_INSTANTIATE(2)
    SNUG_INSTANTIATE(3)
#undef SNUG_INSTANTIATE
  } // namespace sensitivity
} // namespace snug
