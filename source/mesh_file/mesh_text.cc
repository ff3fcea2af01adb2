#include <snug/mesh_file/mesh_text.h>

#include <deal.II/base/utilities.h>

#include <algorithm>
#include <cctype>
#include <cmath>
#include <cstdlib>

namespace snug::mesh_file {
void MeshText::advance(const std::size_t to)
{
  // Lines are only counted forward, so that the whole text is read in one pass.
  line_number += std::count(text.begin() + place, text.begin() + to, '\n');
  place = to;
}

bool MeshText::at_end()
{
  const auto next = text.find_first_not_of(" \t\r\n\f\v", place);
  advance(std::min(next, text.size()));
  return place == text.size();
}

std::string MeshText::rest_of_line()
{
  const auto        end  = std::min(text.find('\n', place), text.size());
  const std::string line = text.substr(place, end - place);
  advance(std::min(end + 1, text.size()));
  return dealii::Utilities::trim(line);
}

std::string MeshText::word(const std::string &what)
{
  if (at_end())
    fail_at_end(what);
  const auto begin = place;
  place            = std::min(text.find_first_of(" \t\r\n\f\v", begin), text.size());
  return text.substr(begin, place - begin);
}

double MeshText::number(const std::string &what)
{
  return to_number(word(what), line());
}

unsigned long MeshText::whole(const std::string &what)
{
  return to_whole(word(what), line());
}

void MeshText::skip_behind(const std::string &mark)
{
  const auto found = text.find(mark, place);
  if (found == std::string::npos)
    fail_at_end("'" + mark + "'");
  advance(found + mark.size());
}

void MeshText::fail(const std::string &message) const
{
  throw error_at_line(line(), message);
}

void MeshText::fail_at_end(const std::string &what) const
{
  // The message contains the last line, and not the line where the missing item was expected.
  const auto lines =
    std::count(text.begin(), text.end(), '\n') + (text.empty() || text.back() == '\n' ? 0 : 1);
  throw error_at_line(binary ? 0 : lines, "the file ends where " + what + " is expected");
}

InputError error_at_line(const unsigned long line, const std::string &message)
{
  return InputError((line == 0 ? "" : "line " + std::to_string(line) + ": ") + message);
}

std::string printable(std::string text)
{
  const std::size_t longest = 300;
  if (text.size() > longest)
    text.replace(longest / 2, text.size() - longest, " ... ");
  for (char &c : text)
    if (std::iscntrl(static_cast<unsigned char>(c)) != 0)
      c = '?';
  return text;
}

double to_number(const std::string &word, const unsigned long line)
{
  char        *end   = nullptr;
  const double value = std::strtod(word.c_str(), &end);
  // strtod accepts "nan" and "inf", and stops at a letter without an error.
  if (word.empty() || *end != '\0' || !std::isfinite(value))
    throw error_at_line(line, "'" + word + "' is not a number");
  return value;
}

unsigned long to_whole(const std::string &word, const unsigned long line)
{
  // stoul accepts a sign and throws its own error on overflow. 18 digits always fit.
  const bool good =
    !word.empty() && word.size() < 19 &&
    std::all_of(
      word.begin(), word.end(), [](const unsigned char c) { return std::isdigit(c) != 0; });
  if (!good)
    throw error_at_line(line, "'" + word + "' is not an integer >= 0");
  return std::stoul(word);
}
} // namespace snug::mesh_file
