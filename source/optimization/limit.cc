#include <snug/optimization/limit.h>

#include <deal.II/base/utilities.h>

#include <cmath>
#include <stdexcept>

namespace snug::optimization {
namespace {
/// Remove @p part and blanks from the front of @p text. Return false if @p text does not begin with
/// @p part.
bool take(std::string &text, const std::string &part)
{
  if (text.rfind(part, 0) != 0)
    return false;
  text = dealii::Utilities::trim(text.substr(part.size()));
  return true;
}
} // namespace

Limit read_limit(const std::string &text)
{
  auto  rest = dealii::Utilities::trim(text);
  Limit limit;
  if (take(rest, "<="))
    limit.side = Limit::Side::at_most;
  else if (take(rest, ">="))
    limit.side = Limit::Side::at_least;
  else
    take(rest, "=");
  if (rest == "initial")
    return limit;
  std::size_t end  = 0;
  limit.value      = std::stod(rest, &end);
  rest             = dealii::Utilities::trim(rest.substr(end));
  limit.of_initial = rest == "initial";
  if (!std::isfinite(limit.value) || !(rest.empty() || limit.of_initial))
    throw std::invalid_argument("no limit");
  return limit;
}

std::string constraint_text(const std::string &name, const std::string &limit)
{
  return name + (limit.find_first_of("<>=") == std::string::npos ? " = " : " ") + limit;
}
} // namespace snug::optimization
