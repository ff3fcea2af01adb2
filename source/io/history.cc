#include <snug/base/assertions.h>
#include <snug/io/history.h>
#include <snug/io/text_file.h>


#include <cstdio>

namespace snug::io {
/// Return the header, whose columns have the widths of log_line().
std::string log_header()
{
  return "iter evals           objective   gradient   violation contacts dual-its"
         "  quality    seconds";
}

std::string log_line(const HistoryLine &line)
{
  // The widths are those of log_header(). Every column fits, so nothing is cut off.
  char text[160];
  std::snprintf(text, sizeof(text), "%4u %5u %19.12e %10.3e %11.3e %7u %8lu %9.3f %10.2f",
                line.iteration, line.evaluations, line.objective, line.projected_gradient,
                line.constraint_violation, line.active_contacts, line.f_mults, line.scaled_jacobian,
                line.seconds);
  return text + (line.violated.empty() ? "" : "  " + line.violated);
}

History::History(const std::string              &path,
                 unsigned int                    n_variables,
                 const std::vector<std::string> &columns)
  : path(path)
  , text("iteration,evaluations,objective,constraint_violation,projected_gradient,"
         "active_contacts,f_mults,scaled_jacobian,seconds")
  , n_variables(n_variables)
  , n_values(columns.size())
{
  for (unsigned int i = 0; i < n_variables; ++i)
    text += ",design_" + std::to_string(i);
  for (const auto &column : columns)
    text += ',' + column;
  text += '\n';
}

void History::add(const HistoryLine &line)
{
  SNUG_ASSERT_EQUAL(line.design.size(), n_variables);
  SNUG_ASSERT_EQUAL(line.values.size(), n_values);
  text += std::to_string(line.iteration) + ',' + std::to_string(line.evaluations) + ',' +
          exact(line.objective) + ',' + exact(line.constraint_violation) + ',' +
          exact(line.projected_gradient) + ',' + std::to_string(line.active_contacts) + ',' +
          std::to_string(line.f_mults) + ',' + exact(line.scaled_jacobian) + ',' +
          exact(line.seconds);
  for (const auto *numbers : {&line.design, &line.values})
    for (const double value : *numbers)
      text += ',' + exact(value);
  text += '\n';
  // Write all lines again: a file is replaced as a whole, so a run that is stopped leaves a
  // complete file.
  write_text_file(path, text);
}
} // namespace snug::io
