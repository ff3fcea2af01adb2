#include <snug/deck/remarks.h>

#include <algorithm>

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

void LinesOfTexts::add(const std::string &text, const unsigned long line)
{
  auto &lines = lines_of[text];
  if (lines.empty())
    order.push_back(text);
  if (lines.empty() || lines.back() != line)
    lines.push_back(line);
}

std::vector<std::string> LinesOfTexts::all() const
{
  std::vector<std::string> result;
  for (const auto &text : order)
    result.push_back(text + " (" + list_of_lines(lines_of.at(text)) + ")");
  return result;
}

void Remarks::lacks(const std::string &kind, const std::string &what, const unsigned long line)
{
  auto part = std::find_if(parts.begin(), parts.end(),
                           [&](const auto &other) { return other.first == kind; });
  if (part == parts.end())
    part = parts.insert(parts.end(), {kind, {}});
  part->second.add(what, line);
}

std::string Remarks::not_needed() const
{
  std::string text;
  for (const auto &line : unneeded.all())
    text += (text.empty() ? "" : ", ") + line;
  return text;
}

std::vector<LackingPart> Remarks::lacking() const
{
  std::vector<LackingPart> result;
  for (const auto &[kind, texts] : parts)
    for (const auto &text : texts.all())
      result.push_back({kind, text});
  return result;
}
} // namespace snug::deck
