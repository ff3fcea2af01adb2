#include <snug/base/errors.h>
#include <snug/optimization/scaled_problem.h>
#include <snug/optimization/slsqp.h>

#include <algorithm>
#include <cmath>
#include <exception>
#include <limits>
#include <nlopt.hpp>
#include <sstream>

namespace snug
{
  namespace optimization
  {
    namespace
    {
      using PointPointer = std::shared_ptr<const ScaledProblem::Point>;

      /// Why a run of NLopt ended.
      enum class End
      {
        objective,
        design,
        evaluations,
        round_off,
        no_value,
        interrupted
      };

      constexpr unsigned int max_failures         = 5;
      constexpr unsigned int max_round_off_starts = 5;

      /**
       * The search. NLopt tells nothing about its iterations, but asks in a
       * fixed pattern: the full step with gradient; if that is rejected,
       * shorter steps without; the accepted one of these again with gradient.
       * So a full step is known to be accepted when the next question, too,
       * asks for a gradient, and a shortened one when the question repeats its
       * design.
       */
      class Search
      {
      public:
        Search(const DesignProblem          &problem,
               const OptimizationParameters &parameters,
               const Hooks                  &hooks);

        OptimizationResult
        run();

      private:
        void
        descend();
        void
        accept_last_step();
        bool
        begins_again();
        void
        shrink();
        bool
        is_at_move_limit() const;

        double
        objective(const double *y, double *gradient);
        void
        constraints(double *values, const double *y, double *jacobian);
        PointPointer
        values_at(const std::vector<double> &y);
        void
        accept(const PointPointer &point, bool full_step);
        void
        check_tolerances(const ScaledProblem::Point &previous, bool full_step);
        void
        report();
        bool
        is_feasible(const ScaledProblem::Point &point) const;
        bool
        is_better(const ScaledProblem::Point &a,
                  const ScaledProblem::Point &b) const;
        bool
        has_gained() const;
        [[noreturn]] void
        stop(End reason);
        template <typename Function>
        void
        guarded(const Function &work);

        OptimizationResult
        result() const;
        std::string
        stop_reason() const;

        static double
        call_objective(unsigned int,
                       const double *y,
                       double       *gradient,
                       void         *search);
        static void
        call_constraints(unsigned int,
                         double *values,
                         unsigned int,
                         const double *y,
                         double       *jacobian,
                         void         *search);

        const OptimizationParameters &parameters;
        const Hooks                  &hooks;
        ScaledProblem                 problem;

        PointPointer iterate; ///< accepted last
        PointPointer best;    ///< lowest feasible, else nearest to it
        unsigned int iterations = 0;

        std::vector<double> centre; ///< of the limits on the moves
        double              reach    = std::numeric_limits<double>::max();
        unsigned int        failures = 0, round_off_starts = 0;
        PointPointer        best_before; ///< this run of NLopt

        PointPointer        full_step;            ///< asked, not yet accepted
        std::vector<double> last;                 ///< design asked for last
        bool                last_was_full = true; ///< and with gradient
        bool                was_close     = false;

        End                 end = End::round_off;
        std::vector<double> failed_design;
        std::string         failure;
        std::exception_ptr  error;
      };

      Search::Search(const DesignProblem          &problem,
                     const OptimizationParameters &parameters,
                     const Hooks                  &hooks)
        : parameters(parameters)
        , hooks(hooks)
        , problem(problem)
        , iterate(this->problem.start())
        , best(iterate)
        , centre(iterate->y)
      {
      }

      OptimizationResult
      Search::run()
      {
        try
          {
            report();
          }
        catch (const Interrupted &)
          {
            end = End::interrupted;
            return result();
          }
        if (!centre.empty())
          do
            descend();
          while (begins_again());
        return result();
      }

      /// One run of NLopt from the iterate.
      void
      Search::descend()
      {
        const unsigned int  n = centre.size();
        const unsigned int  m = iterate->evaluation.constraints.size();
        std::vector<double> lower(n), upper(n);
        for (unsigned int i = 0; i < n; ++i)
          {
            lower[i] = std::max(problem.lower()[i], centre[i] - reach);
            upper[i] = std::min(problem.upper()[i], centre[i] + reach);
          }
        nlopt::opt optimizer(nlopt::LD_SLSQP, n);
        optimizer.set_lower_bounds(lower);
        optimizer.set_upper_bounds(upper);
        optimizer.set_min_objective(&Search::call_objective, this);
        if (m > 0)
          optimizer.add_equality_mconstraint(
            &Search::call_constraints,
            this,
            std::vector<double>(m, parameters.constraint_tolerance));
        // NLopt also counts repeated questions, which cost nothing, and may
        // repeat one for ever.
        optimizer.set_maxeval(100 + 20 * parameters.maximum_evaluations);

        best_before = best;
        full_step.reset();
        last.clear();
        last_was_full = true;
        was_close     = false;
        end           = End::round_off;
        auto   y      = iterate->y;
        double f      = 0.;
        try
          {
            optimizer.optimize(y, f);
          }
        catch (const nlopt::forced_stop &)
          {
          }
        catch (const nlopt::roundoff_limited &)
          {
          }
        catch (const std::runtime_error &)
          {
            // NLopt's general failure: its quadratic program has no solution,
            // as for constraints that exclude one another.
          }
        if (!error && end == End::round_off && full_step)
          accept_last_step();
        if (error)
          std::rethrow_exception(error);
      }

      /// NLopt ended by itself right after a full step: it had accepted it.
      void
      Search::accept_last_step()
      {
        try
          {
            guarded([&] { accept(full_step, true); });
          }
        catch (const nlopt::forced_stop &)
          {
          }
      }

      /// Whether another run of NLopt should follow; prepares it.
      bool
      Search::begins_again()
      {
        switch (end)
          {
            case End::no_value:
              if (failures == max_failures)
                return false;
              ++failures;
              shrink();
              return true;
            case End::objective:
            case End::design:
              if (!is_at_move_limit())
                return false;
              centre = iterate->y;
              return true;
            case End::round_off:
              if (!has_gained() || round_off_starts == max_round_off_starts)
                return false;
              ++round_off_starts;
              centre = iterate->y;
              if (hooks.log)
                hooks.log("SLSQP stopped by round-off, begun again from "
                          "iteration " +
                          std::to_string(iterations));
              return true;
            case End::evaluations:
            case End::interrupted:
              return false;
          }
        return false;
      }

      /// Limit the moves to half the one that led to a design without value.
      void
      Search::shrink()
      {
        double move = 0.;
        for (unsigned int i = 0; i < failed_design.size(); ++i)
          move = std::max(move, std::abs(failed_design[i] - iterate->y[i]));
        centre = iterate->y;
        reach  = move / 2.;
        if (!hooks.log)
          return;
        std::ostringstream line;
        line << "design without a value (" << failure << "): restart "
             << failures << " of " << max_failures << " from iteration "
             << iterations << ", moves limited to " << reach
             << " of the bound widths";
        hooks.log(line.str());
      }

      bool
      Search::is_at_move_limit() const
      {
        for (unsigned int i = 0; i < centre.size(); ++i)
          {
            const double y = iterate->y[i];
            if (std::abs(y - centre[i]) >= reach * (1. - 1e-8) &&
                y > problem.lower()[i] && y < problem.upper()[i])
              return true;
          }
        return false;
      }

      double
      Search::objective(const double *values, double *gradient)
      {
        const std::vector<double> y(values, values + centre.size());
        const bool                repeated = y == last;
        if (gradient != nullptr && last_was_full && !repeated && full_step)
          accept(full_step, true);
        full_step.reset();
        const auto point = values_at(y);
        if (gradient != nullptr)
          {
            if (repeated && !last_was_full)
              accept(point, false);
            else
              full_step = point;
            const auto g = problem.gradient(point->evaluation);
            std::copy(g.begin(), g.end(), gradient);
          }
        last          = y;
        last_was_full = gradient != nullptr;
        return point->evaluation.objective / problem.objective_scale();
      }

      void
      Search::constraints(double *values, const double *y, double *jacobian)
      {
        const auto point = values_at(std::vector<double>(y, y + centre.size()));
        const auto c     = problem.constraints(point->evaluation);
        std::copy(c.begin(), c.end(), values);
        if (jacobian == nullptr)
          return;
        for (const auto &row : problem.jacobian(point->evaluation))
          jacobian = std::copy(row.begin(), row.end(), jacobian);
      }

      PointPointer
      Search::values_at(const std::vector<double> &y)
      {
        if (!problem.is_known(y) &&
            problem.n_evaluations() >= parameters.maximum_evaluations)
          stop(End::evaluations);
        try
          {
            const auto point = problem.at(y);
            if (is_better(*point, *best))
              best = point;
            return point;
          }
        catch (const SolveError &no_value)
          {
            failure       = no_value.what();
            failed_design = y;
            stop(End::no_value);
          }
      }

      void
      Search::accept(const PointPointer &point, const bool full)
      {
        const auto previous = iterate;
        if (point->x == previous->x)
          return;
        iterate = point;
        ++iterations;
        report();
        check_tolerances(*previous, full);
      }

      void
      Search::check_tolerances(const ScaledProblem::Point &previous,
                               const bool                  full)
      {
        const double f  = iterate->evaluation.objective;
        const double df = std::abs(f - previous.evaluation.objective);
        double       dy = 0.;
        for (unsigned int i = 0; i < centre.size(); ++i)
          dy = std::max(dy, std::abs(iterate->y[i] - previous.y[i]));

        const bool by_objective =
          df <= parameters.objective_tolerance * std::abs(f);
        const bool by_design = dy <= parameters.design_tolerance;
        const bool is_close =
          is_feasible(*iterate) && (by_objective || by_design);
        if (is_close && (full || was_close))
          stop(by_objective ? End::objective : End::design);
        was_close = is_close;
      }

      void
      Search::report()
      {
        if (!hooks.on_iteration)
          return;
        Iteration iteration;
        iteration.number               = iterations;
        iteration.x                    = iterate->x;
        iteration.evaluation           = iterate->evaluation;
        iteration.constraint_violation = iterate->violation;
        iteration.projected_gradient   = problem.projected_gradient(*iterate);
        iteration.evaluations          = problem.n_evaluations();
        hooks.on_iteration(iteration);
      }

      bool
      Search::is_feasible(const ScaledProblem::Point &point) const
      {
        return point.violation <= parameters.constraint_tolerance;
      }

      bool
      Search::is_better(const ScaledProblem::Point &a,
                        const ScaledProblem::Point &b) const
      {
        if (is_feasible(a) && is_feasible(b))
          return a.evaluation.objective < b.evaluation.objective;
        return a.violation < b.violation;
      }

      /// Whether this run of NLopt was worth another.
      bool
      Search::has_gained() const
      {
        if (!is_feasible(*best_before))
          return best->violation < best_before->violation / 2.;
        const double f = best->evaluation.objective;
        return best_before->evaluation.objective - f >
               parameters.objective_tolerance * std::abs(f);
      }

      void
      Search::stop(const End reason)
      {
        end = reason;
        throw nlopt::forced_stop();
      }

      /// NLopt forgets the message and type of exceptions: keep them.
      template <typename Function>
      void
      Search::guarded(const Function &work)
      {
        try
          {
            work();
          }
        catch (const nlopt::forced_stop &)
          {
            throw;
          }
        catch (const Interrupted &)
          {
            stop(End::interrupted);
          }
        catch (...)
          {
            error = std::current_exception();
            throw nlopt::forced_stop();
          }
      }

      double
      Search::call_objective(unsigned int,
                             const double *y,
                             double       *gradient,
                             void         *search)
      {
        auto  &self  = *static_cast<Search *>(search);
        double value = 0.;
        self.guarded([&] { value = self.objective(y, gradient); });
        return value;
      }

      void
      Search::call_constraints(unsigned int,
                               double *values,
                               unsigned int,
                               const double *y,
                               double       *jacobian,
                               void         *search)
      {
        auto &self = *static_cast<Search *>(search);
        self.guarded([&] { self.constraints(values, y, jacobian); });
      }

      std::string
      Search::stop_reason() const
      {
        switch (end)
          {
            case End::objective:
              return "objective tolerance";
            case End::design:
              return "design tolerance";
            case End::evaluations:
              return "maximum evaluations";
            case End::round_off:
              return is_feasible(*best) ? "round-off" : "constraints violated";
            case End::no_value:
              return "restarts exhausted (tangled meshes)";
            case End::interrupted:
              return "interrupted";
          }
        return "";
      }

      OptimizationResult
      Search::result() const
      {
        OptimizationResult result;
        result.x                    = best->x;
        result.evaluation           = best->evaluation;
        result.iterations           = iterations;
        result.evaluations          = problem.n_evaluations();
        result.objective_initial    = problem.start()->evaluation.objective;
        result.objective_final      = best->evaluation.objective;
        result.constraint_violation = best->violation;
        result.projected_gradient   = problem.projected_gradient(*best);
        result.stop_reason          = stop_reason();
        const bool by_round_off =
          end == End::round_off && result.projected_gradient <=
                                     std::sqrt(parameters.objective_tolerance);
        result.success =
          is_feasible(*best) &&
          (end == End::objective || end == End::design || by_round_off);
        return result;
      }
    } // namespace

    OptimizationResult
    slsqp(const DesignProblem          &problem,
          const OptimizationParameters &parameters,
          const Hooks                  &hooks)
    {
      return Search(problem, parameters, hooks).run();
    }
  } // namespace optimization
} // namespace snug
