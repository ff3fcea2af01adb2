#include <snug/base/statements.h>
#include <snug/base/values.h>

#include <algorithm>
#include <cctype>
#include <numeric>
#include <sstream>

namespace snug {
namespace {
constexpr const char *white_space = " \t\r\n\v\f";

/// Return the text without white space at the ends and with single blanks inside.
std::string tidy(const std::string &text)
{
  std::istringstream words(text);
  std::string        word, result;
  while (words >> word)
    result += (result.empty() ? "" : " ") + word;
  return result;
}

std::string joined(const std::vector<std::string> &sections)
{
  std::string path;
  for (const auto &section : sections)
    path += (path.empty() ? "" : "/") + section;
  return path;
}

/// Read a line without its comment, joined with the lines on which it continues.
bool next_line(std::istream &in, std::string &line, unsigned int &number)
{
  line.clear();
  std::string piece;
  bool        found = false;
  while (std::getline(in, piece))
    {
      ++number;
      found = true;
      piece = trim(piece.substr(0, piece.find('#')));
      if (piece.empty() || piece.back() != '\\')
        {
          line += piece;
          break;
        }
      piece.pop_back();
      line += piece;
    }
  return found;
}

/// Get the rest of @p line after @p keyword and a blank. Return false if the line begins
/// differently.
bool begins_with(const std::string &line, const std::string &keyword, std::string &rest)
{
  std::string first = line.substr(0, line.find_first_of(white_space));
  rest              = trim(line.substr(first.size()));
  std::transform(first.begin(), first.end(), first.begin(), ::tolower);
  return first == keyword;
}

unsigned int edit_distance(const std::string &a, const std::string &b)
{
  std::vector<unsigned int> row(b.size() + 1);
  std::iota(row.begin(), row.end(), 0U);
  for (const char letter : a)
    {
      unsigned int diagonal = row[0]++;
      for (std::size_t j = 0; j < b.size(); ++j)
        {
          const unsigned int replaced = diagonal + (std::tolower(letter) != std::tolower(b[j]));
          diagonal                    = row[j + 1];
          row[j + 1]                  = std::min({replaced, row[j] + 1, row[j + 1] + 1});
        }
    }
  return row.back();
}

/// This class collects the statements of a text line by line.
class StatementParser
{
public:
  explicit StatementParser(const std::string &name) { place.file = name; }

  void read(const std::string &line, const unsigned int number)
  {
    place.line = number;
    std::string rest;
    if (line.empty())
      return;
    // Reject a zero byte, because messages, which quote the text, would end there.
    if (line.find('\0') != std::string::npos)
      throw InputError("contains a null byte; not a text file", place);
    if (begins_with(line, "subsection", rest) && !rest.empty())
      {
        sections.push_back(tidy(rest));
        opened_at.push_back(place);
        statements.push_back({joined(sections), "", "", place});
      }
    else if (begins_with(line, "end", rest) && rest.empty())
      close();
    else if (begins_with(line, "set", rest) && rest.find('=') != std::string::npos &&
             rest[0] != '=')
      {
        const auto equals = rest.find('=');
        statements.push_back(
          {joined(sections), tidy(rest.substr(0, equals)), trim(rest.substr(equals + 1)), place});
      }
    else
      throw InputError("'" + quotable(line) +
                         "' must read 'set NAME = VALUE', "
                         "'subsection NAME', 'end' or '# comment'",
                       place);
  }

  std::vector<Statement> finish()
  {
    if (!sections.empty())
      throw InputError("'subsection " + quotable(sections.back()) + "' has no 'end'",
                       opened_at.back());
    return std::move(statements);
  }

private:
  void close()
  {
    if (sections.empty())
      throw InputError("'end' without a 'subsection'", place);
    sections.pop_back();
    opened_at.pop_back();
  }

  Place                    place;
  std::vector<std::string> sections;
  std::vector<Place>       opened_at;
  std::vector<Statement>   statements;
};
} // namespace

std::string Statement::path() const
{
  return section.empty() ? name : section + "/" + name;
}

std::vector<Statement> parse_statements(const std::string &text, const std::string &file)
{
  const std::string  byte_order_mark = "\xEF\xBB\xBF";
  const bool         marked          = text.rfind(byte_order_mark, 0) == 0;
  std::istringstream in(text.substr(marked ? byte_order_mark.size() : 0));
  StatementParser    parser(file);
  std::string        line;
  unsigned int       number = 0;
  for (unsigned int first = 1; next_line(in, line, number); first = number + 1)
    parser.read(line, first);
  return parser.finish();
}

Statement parse_override(const std::string &argument)
{
  const auto equals = argument.find('=');
  if (equals == std::string::npos || equals == 0)
    throw InputError("--set '" + quotable(argument) +
                     "': must read --set \"Subsection/Entry=value\"");
  const std::string path  = argument.substr(0, equals);
  const auto        slash = path.rfind('/');
  const bool        top   = slash == std::string::npos;
  return {top ? "" : tidy(path.substr(0, slash)),
          tidy(top ? path : path.substr(slash + 1)),
          trim(argument.substr(equals + 1)),
          {"--set"}};
}

Origins::Origins(const std::string &name, const std::vector<Statement> &statements) : file(name)
{
  for (const auto &statement : statements)
    places[statement.path()] = statement.origin;
}

Place Origins::of(const std::string &path) const
{
  const auto found = places.find(path);
  return found != places.end() ? found->second : Place{file};
}

InputError Origins::error(const std::string &path,
                          const std::string &value,
                          const std::string &allowed,
                          const std::string &suggestion) const
{
  return InputError(WrongEntry{quotable(path), quotable(value), allowed, suggestion}, of(path));
}

std::string quotable(const std::string &text)
{
  constexpr std::size_t most = 80;
  std::string           line = text.substr(0, most);
  std::replace_if(
    line.begin(), line.end(), [](const unsigned char c) { return c < 32 || c == 127; }, ' ');
  return text.size() > most ? line + "..." : line;
}

std::string suggestion(const std::string &word, const std::vector<std::string> &known)
{
  const auto worse = [&word](const std::string &a, const std::string &b) {
    return edit_distance(word, a) < edit_distance(word, b);
  };
  const auto best = std::min_element(known.begin(), known.end(), worse);
  if (best == known.end() ||
      edit_distance(word, *best) > std::max<std::size_t>(2, best->size() / 3))
    return "";
  return *best;
}
} // namespace snug
