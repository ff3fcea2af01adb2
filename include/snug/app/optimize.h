#ifndef snug_app_optimize_h
#define snug_app_optimize_h

#include <snug/app/workshop.h>
#include <snug/io/history.h>
#include <snug/optimization/journal.h>
#include <snug/optimization/minimize.h>

namespace snug
{
  namespace app
  {
    /**
     * The optimization of a scene: evaluates designs, keeps the journal, the
     * history and the warm start, and draws the first and the last design.
     */
    template <int dim>
    class Optimize
    {
    public:
      Optimize(Workshop<dim> &workshop, bool restart);

      /// Collective. @return the exit status.
      int
      run();

    private:
      using Design = std::vector<double>;

      optimization::Evaluation
      evaluate(const Design &design);
      void
      choose_constraints();
      optimization::JournalSettings
      journal_settings() const;
      void
      save_warm_start(const std::string &path) const;
      void
      load_warm_start(const std::string &path);
      void
      report(const optimization::Iteration &iteration);
      void
      finish(const optimization::OptimizationResult &result);

      struct Constraint
      {
        std::string                              name;
        std::unique_ptr<response::Response<dim>> response;
        double                                   target;
      };

      Workshop<dim>                         &workshop;
      bool                                   restart;
      std::vector<Constraint>                constraints;
      qp::WarmStart                          warm_start;
      std::unique_ptr<optimization::Journal> journal;
      io::History                            history;
      /// the last state solved, and the first one
      std::unique_ptr<state::ContactState<dim>> last, first;
      Design                                    last_design;
      sensitivity::Gradients                    last_gradients;
    };
  } // namespace app
} // namespace snug

#endif
