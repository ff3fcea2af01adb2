#ifndef snug_io_history_h
#define snug_io_history_h

#include <string>
#include <vector>

namespace snug::io {
/// What is said of one design iteration, in the log and in history.csv.
struct HistoryLine
{
  unsigned int        iteration            = 0;
  double              objective            = 0.; ///< units of the response
  double              constraint_violation = 0.; ///< free of units
  double              projected_gradient   = 0.; ///< free of units
  unsigned int        active_contacts      = 0;
  unsigned long       f_mults              = 0;
  double              scaled_jacobian      = 0.; ///< least of all cells
  double              seconds              = 0.; ///< since the run began
  std::vector<double> design;                    ///< [length]
};

/// Names of the columns of log_line().
std::string log_header();

/// The line of the log for @p line, without its end.
std::string log_line(const HistoryLine &line);

/**
 * The file history.csv: one line per design iteration with the columns
 * iteration, objective, constraint_violation, projected_gradient,
 * active_contacts, f_mults, scaled_jacobian, seconds, design_0, design_1,
 * .. and 17 significant digits. The file on disk is complete after every
 * add(). For one rank.
 */
class History
{
public:
  /// Nothing is written before the first add().
  History(const std::string &path, unsigned int n_variables);

  /// @throws std::runtime_error if the file cannot be written.
  void add(const HistoryLine &line);

private:
  std::string  path;
  std::string  text;
  unsigned int n_variables;
};
} // namespace snug::io

#endif
