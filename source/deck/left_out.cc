#include <snug/deck/left_out.h>


namespace snug::deck {
std::string list_of_lines(const std::vector<unsigned long> &lines)
{
  const std::size_t longest = 8, shown = 3;
  const std::size_t n = lines.size();
  std::string       text;
  for (std::size_t i = 0; i < (n > longest ? shown : n); ++i)
    text += (i == 0 ? "" : i + 1 == n ? " and " : ", ") + std::to_string(lines[i]);
  if (n > longest)
    text += ", ..., " + std::to_string(lines.back()) + " (" + std::to_string(n) + " lines)";
  return (n == 1 ? "line " : "lines ") + text;
}

void LeftOut::add(const std::string &what, const unsigned long line)
{
  auto &lines = lines_of[what];
  if (lines.empty())
    order.push_back(what);
  if (lines.empty() || lines.back() != line)
    lines.push_back(line);
}

std::vector<std::string> LeftOut::lines() const
{
  std::vector<std::string> result;
  for (const auto &what : order)
    result.push_back(what + " (" + list_of_lines(lines_of.at(what)) + ")");
  return result;
}
} // namespace snug::deck
