#ifndef snug_io_history_h
#define snug_io_history_h

#include <string>
#include <vector>

namespace snug::io {
/// Data of one design iteration for the log and for history.csv.
struct HistoryLine
{
  unsigned int        iteration            = 0;
  unsigned int        evaluations          = 0;  ///< analyses of designs so far
  double              objective            = 0.; ///< in the units of the response
  double              constraint_violation = 0.; ///< dimensionless
  std::string         violated;                  ///< constraint with this violation, or empty
  double              projected_gradient = 0.;   ///< dimensionless
  unsigned int        active_contacts    = 0;
  unsigned long       f_mults            = 0;
  double              scaled_jacobian    = 0.; ///< minimum over cells
  double              seconds            = 0.; ///< since the start of the run
  std::vector<double> design;                  ///< [length]
  std::vector<double> values;                  ///< of the columns that History was given
};

/// Return the names of the columns of log_line().
std::string log_header();

/// Return the line of the log for @p line, without the end of line. A violated constraint is named
/// behind the columns.
std::string log_line(const HistoryLine &line);

/**
 * This class writes the file history.csv. It has one line per design iteration with the columns
 * iteration, evaluations, objective, constraint_violation, projected_gradient, active_contacts,
 * f_mults, scaled_jacobian, seconds, design_0, design_1, .., further columns with names of the
 * caller, and 17 significant digits. The file on disk is complete after every add(). The class is
 * for one rank.
 */
class History
{
public:
  /// Construct the history with further @p columns. The file is not written before the first add().
  History(const std::string              &path,
          unsigned int                    n_variables,
          const std::vector<std::string> &columns);

  /// Add a line and write the file. @throws std::runtime_error if the file cannot be written.
  void add(const HistoryLine &line);

private:
  std::string  path;
  std::string  text;
  unsigned int n_variables;
  std::size_t  n_values;
};
} // namespace snug::io

#endif
