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

      /// The linear problems min 1/2 mu'F mu - mu'd, G mu = e on a face.
      struct FaceProblem
      {
        const feti::TotalFeti &feti;
        const qp::Face        &face;
        const DataDerivatives &data;       ///< d = B K^+ primal - dual
        const qp::MultiVector  e;          ///< R' primal
        std::vector<double>    tolerances; ///< of the projected residuals
      };

      /// d - F mu = B K^+ (primal - B' mu) - dual: with d for the price of F.
      qp::MultiVector
      true_residual(const FaceProblem &problem, const qp::MultiVector &mu)
      {
        const auto &feti   = problem.feti;
        const auto  forces = feti.multiply_Bt(mu);
        auto        loads  = problem.data.primal;
        for (unsigned int s = 0; s < forces.size(); ++s)
          loads[s].add(-1., forces[s]);
        auto residual = feti.multiply_B(feti.apply_inverse(loads));
        residual.add(-1., problem.data.dual);
        feti.context().work.f_mults += mu.n_columns();
        return residual;
      }

      /// Are all columns of G mu = e, up to round-off? B and R are orthonormal
      /// but for a few rows, so ||G mu|| is at most about ||mu||.
      bool
      feasible(const FaceProblem &problem, const qp::MultiVector &mu)
      {
        const double round_off = 1e-12;
        auto         missing   = problem.e;
        missing.add(-1., problem.feti.apply_G(mu));
        const auto errors = qp::norms(missing, MPI_COMM_SELF);
        const auto loads  = qp::norms(problem.e, MPI_COMM_SELF);
        const auto sizes = qp::norms(mu, problem.feti.context().communicator());
        for (unsigned int j = 0; j < errors.size(); ++j)
          if (!(errors[j] <= round_off * (loads[j] + sizes[j])))
            return false;
        return true;
      }

      /// Block PCPG; where round-off stops it or carries it off G mu = e,
      /// again from the true residual. @return block iterations.
      unsigned int
      solve_refined(const FaceProblem &problem,
                    unsigned int       max_iterations,
                    qp::MultiVector   &mu,
                    qp::MultiVector   &residual)
      {
        const unsigned int attempts   = 4;
        unsigned int       iterations = 0;
        for (unsigned int attempt = 0; attempt < attempts; ++attempt)
          {
            const auto solved = qp::pcpg(problem.feti,
                                         problem.face,
                                         mu,
                                         residual,
                                         problem.tolerances,
                                         max_iterations - iterations);
            iterations += solved.iterations;
            if (solved.converged && feasible(problem, mu))
              return iterations;
            if (iterations >= max_iterations)
              break;
            problem.face.make_feasible(mu, problem.e);
            residual = true_residual(problem, mu);
          }
        throw SolveError("the sensitivities were not solved to the relative "
                         "tolerance; allow a larger 'Solver/Relative "
                         "tolerance' or more 'Solver/Maximum F-mults'");
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
      const auto  face = feti.face(strong_rows(solver, state));
      FaceProblem problem{feti, *face, data, feti.rigid_part(data.primal), {}};

      StateDerivatives result;
      result.lambda = qp::MultiVector(feti.n_owned(), velocities.size());
      face->make_feasible(result.lambda, problem.e);
      qp::MultiVector residual  = true_residual(problem, result.lambda);
      qp::MultiVector projected = residual;
      face->project(projected);
      problem.tolerances = qp::norms(projected, context.communicator());
      for (double &tolerance : problem.tolerances)
        tolerance *= limits.relative_tolerance;
      result.sweeps =
        solve_refined(problem, limits.max_iterations, result.lambda, residual);
      auto alpha = face->amplitudes(residual);
      for (unsigned int j = 0; j < alpha.n_columns(); ++j)
        for (unsigned int i = 0; i < alpha.n_rows(); ++i)
          alpha(i, j) *= -1.;
      result.u       = feti.recover(data.primal, result.lambda, alpha);
      result.f_mults = context.work.f_mults - before;
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
