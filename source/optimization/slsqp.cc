#include <snug/base/errors.h>
#include <snug/optimization/progress.h>
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
      constexpr unsigned int max_failures         = 5;
      constexpr unsigned int max_round_off_starts = 5;

      /// NLopt may repeat a question for ever. More than SLSQP's six line
      /// searches of at most eleven designs before it gives up by itself.
      constexpr unsigned int max_idle_questions = 100;

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
        ask_nlopt();
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
        Progress::Point
        values_at(const std::vector<double> &y);
        void
        accept(const Progress::Point &point, bool full);
        [[noreturn]] void
        stop(End reason);
        template <typename Function>
        void
        guarded(const Function &work);

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
        Progress                      progress;

        std::vector<double> centre; ///< moves are limited to centre +- reach
        double              reach    = std::numeric_limits<double>::max();
        unsigned int        failures = 0, round_off_starts = 0;

        Progress::Point     full_step; ///< asked for, not known to be accepted
        std::vector<double> last_design;           ///< asked for
        bool                last_was_full = false; ///< and with gradient

        unsigned int idle_questions = 0; ///< answered by known values

        End                 end = End::round_off;
        std::vector<double> failed_design;
        std::string         failure;
        std::exception_ptr  error;
      };

      Search::Search(const DesignProblem          &design_problem,
                     const OptimizationParameters &parameters,
                     const Hooks                  &hooks)
        : parameters(parameters)
        , hooks(hooks)
        , problem(design_problem)
        , progress(problem, parameters, hooks)
        , centre(problem.start()->y)
      {
      }

      OptimizationResult
      Search::run()
      {
        try
          {
            progress.report();
          }
        catch (const Interrupted &)
          {
            return progress.result(End::interrupted);
          }
        if (!centre.empty())
          do
            descend();
          while (begins_again());
        return progress.result(end);
      }

      /// One run of NLopt from the iterate; sets how it ended.
      void
      Search::descend()
      {
        progress.begin_run();
        full_step.reset();
        last_design.clear();
        last_was_full  = false;
        idle_questions = 0;
        end            = End::round_off;
        try
          {
            ask_nlopt();
            // It ended by itself. If that was right after a full step, it had
            // accepted it.
            if (full_step)
              guarded([this] { accept(full_step, true); });
          }
        catch (const nlopt::forced_stop &)
          {
          }
        if (error)
          std::rethrow_exception(error);
      }

      void
      Search::ask_nlopt()
      {
        const unsigned int n = centre.size();
        const unsigned int m =
          progress.iterate()->evaluation.constraints.size();
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
        auto   y = progress.iterate()->y;
        double f = 0.;
        try
          {
            optimizer.optimize(y, f);
          }
        catch (const nlopt::forced_stop &)
          {
            throw;
          }
        catch (const std::runtime_error &)
          {
            // Round-off, or NLopt's general failure: its quadratic program has
            // no solution, as for constraints that exclude one another.
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
              centre = progress.iterate()->y;
              return true;
            case End::round_off:
              if (!progress.has_gained() ||
                  round_off_starts == max_round_off_starts)
                return false;
              ++round_off_starts;
              centre = progress.iterate()->y;
              if (hooks.log)
                hooks.log("SLSQP stopped by round-off, begun again from "
                          "iteration " +
                          std::to_string(progress.n_iterations()));
              return true;
            case End::none:
            case End::gradient:
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
        centre      = progress.iterate()->y;
        double move = 0.;
        for (unsigned int i = 0; i < centre.size(); ++i)
          move = std::max(move, std::abs(failed_design[i] - centre[i]));
        reach = move / 2.;
        if (!hooks.log)
          return;
        std::ostringstream line;
        line << "design without a value (" << failure << "): restart "
             << failures << " of " << max_failures << " from iteration "
             << progress.n_iterations() << ", moves limited to " << reach
             << " of the bound widths";
        hooks.log(line.str());
      }

      bool
      Search::is_at_move_limit() const
      {
        for (unsigned int i = 0; i < centre.size(); ++i)
          {
            const double y = progress.iterate()->y[i];
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
        const bool                is_repeated = y == last_design;
        const bool                is_full     = gradient != nullptr;
        if (is_full && !is_repeated && full_step)
          accept(full_step, true);
        full_step.reset();
        const unsigned int before = problem.n_evaluations();
        const auto         point  = values_at(y);
        idle_questions =
          problem.n_evaluations() > before ? 0 : idle_questions + 1;
        if (idle_questions > max_idle_questions)
          stop(End::round_off);
        if (is_full)
          {
            if (is_repeated && !last_was_full)
              accept(point, false);
            else
              full_step = point;
            const auto g = problem.gradient(point->evaluation);
            std::copy(g.begin(), g.end(), gradient);
          }
        last_design   = y;
        last_was_full = is_full;
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

      Progress::Point
      Search::values_at(const std::vector<double> &y)
      {
        if (!problem.is_known(y) &&
            problem.n_evaluations() >= parameters.maximum_evaluations)
          stop(End::evaluations);
        try
          {
            const auto point = problem.at(y);
            progress.consider(point);
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
      Search::accept(const Progress::Point &point, const bool full)
      {
        const End reached = progress.accept(point, full);
        if (reached != End::none)
          stop(reached);
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
