#ifndef snug_app_search_progress_h
#define snug_app_search_progress_h

#include <limits>
#include <string>

namespace snug::app {
/// This class counts the evaluations of a run and describes its progress for the live line of the
/// log.
class SearchProgress
{
public:
  /// Set the @p name and the @p unit (with a blank before it, or empty) of the objective, the
  /// maximum number of evaluations, and the violation up to which a design is feasible.
  SearchProgress(const std::string &name,
                 const std::string &unit,
                 unsigned int       most,
                 double             feasible);

  /// Count an evaluation that begins, or one that a journal repeats.
  void begin() { ++n_begun; }

  /// Take the values of a design that was analysed, and the seconds since the start of the run.
  void end(double objective, double violation, double seconds);

  /// Return a line such as "evaluation 23 of at most 60, best peak pressure 812 MPa, at most 40 s
  /// left". The time left is that of the evaluations that remain, each with the mean time of those
  /// analysed so far, and is omitted as long as there are fewer than two. The gradients between the
  /// evaluations are part of the mean.
  std::string text() const;

private:
  std::string  name, unit;
  unsigned int most, n_begun = 0, n_analysed = 0;
  double       feasible;
  double       first_seconds = 0., last_seconds = 0.; ///< at the ends of analyses
  double       best           = std::numeric_limits<double>::infinity();
  double       best_violation = std::numeric_limits<double>::infinity();
};
} // namespace snug::app

#endif
