#ifndef snug_app_optimize_h
#define snug_app_optimize_h

#include <snug/app/workshop.h>
#include <snug/io/history.h>
#include <snug/optimization/journal.h>
#include <snug/optimization/limit.h>
#include <snug/optimization/minimize.h>

namespace snug::app {
/**
 * The optimization of a scene: evaluates designs, keeps the journal, the
 * history and the warm start, and draws the first and the last design, and
 * those of iterations in between if asked for.
 * After a run it may pair contact anew and begin another.
 */
template <int dim>
class Optimize
{
public:
  Optimize(Workshop<dim> &workshop, bool restart);

  /// Collective. @return what is wrong with the result; see
  /// optimization::complaint().
  std::string run();

private:
  using Design = std::vector<double>;

  struct Constraint
  {
    std::string                              name;
    std::unique_ptr<response::Response<dim>> response;
    unsigned int                             load_case;
    double                                   target;
    optimization::Limit::Side                side;

    /// c = sign (J - target), c = 0 or c <= 0.
    double sign() const { return side == optimization::Limit::Side::at_least ? -1. : 1.; }
  };

  optimization::Evaluation      evaluate(const Design &design);
  void                          choose_constraints();
  Constraint                    make_constraint(const std::string &name, const std::string &limit);
  void                          note_weak_contacts();
  optimization::JournalSettings journal_settings() const;
  void                          save_warm_start(const std::string &path) const;
  void                          load_warm_start(const std::string &path);
  void                          report(const optimization::Iteration &iteration);
  void                          open_journal();
  optimization::OptimizationResult search(const Design                           &start,
                                          const optimization::OptimizationResult &before);
  void                             draw_first();
  void                             draw_last(unsigned int iteration);
  bool                             pair_anew(const Design &design);
  void                             finish(const optimization::OptimizationResult &result);

  Workshop<dim>                         &workshop;
  bool                                   restart;
  std::vector<Constraint>                constraints;
  std::vector<qp::WarmStart>             warm_starts; ///< per load case
  std::unique_ptr<optimization::Journal> journal;
  io::History                            history;
  /// in all load cases: of the last design solved, and of the first one;
  /// empty before
  std::vector<state::ContactState<dim>> last, first;
  Design                                last_design;
  sensitivity::Gradients<dim>           last_gradients;
  /// of the objective at the first design, if asked for
  std::optional<typename Workshop<dim>::Field> first_shape_gradient;
  std::vector<io::Summary::State>              first_summaries;
  bool                                         paired_anew     = false; ///< and not yet evaluated
  unsigned int                                 iterations_done = 0;     ///< of earlier searches
  unsigned int                                 drawn           = 0;     ///< iteration drawn last
};
} // namespace snug::app

#endif
