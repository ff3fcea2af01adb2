#include <snug/mesh_file/deck_text.h>

#include <deal.II/base/utilities.h>

#include <algorithm>
#include <cctype>
#include <cstdlib>

namespace snug::mesh_file {
namespace {
/// Return the line that begins at @p place without blanks at its ends, and move @p place behind it.
std::string next_line(const std::string &text, std::size_t &place)
{
  const auto        end  = std::min(text.find('\n', place), text.size());
  const std::string line = text.substr(place, end - place);
  place                  = std::min(end + 1, text.size());
  return dealii::Utilities::trim(line);
}

/// Comments around an included file; the second one has the line of *INCLUDE.
const std::string include_begin = "** begin of included file ", include_end = "** back to line ";

bool begins_with(const std::string &line, const std::string &begin)
{
  return line.compare(0, begin.size(), begin) == 0;
}

std::string without_blanks(std::string text)
{
  text.erase(std::remove_if(text.begin(), text.end(),
                            [](const unsigned char c) { return std::isspace(c) != 0; }),
             text.end());
  return text;
}

bool is_comment(const std::string &line)
{
  return begins_with(line, "**");
}

/// Return the file that a line includes, or "".
std::string included_file(const std::string &line)
{
  if (line.empty() || line[0] != '*' ||
      without_blanks(upper_case(line.substr(0, line.find(',')))) != "*INCLUDE")
    return "";
  for (const auto &word : deck_words(line))
    {
      const auto equals = word.find('=');
      if (equals != std::string::npos &&
          without_blanks(upper_case(word.substr(0, equals))) == "INPUT")
        return dealii::Utilities::trim(word.substr(equals + 1));
    }
  return "";
}

std::string spliced(const std::string                                     &text,
                    const std::function<std::string(const std::string &)> &read,
                    const unsigned int                                     depth)
{
  const unsigned int deepest = 10;
  std::string        result;
  unsigned long      number = 0;
  for (std::size_t place = 0; place < text.size();)
    {
      const auto        begin = place;
      const std::string file  = included_file(next_line(text, place));
      ++number;
      if (file.empty())
        {
          result.append(text, begin, place - begin);
          continue;
        }
      if (depth == deepest)
        throw error_at_line(number, "the file '" + file + "' is included within more than " +
                                      std::to_string(deepest) + " files");
      result += include_begin + file + '\n' + spliced(read(file), read, depth + 1) + '\n' +
                include_end + std::to_string(number) + '\n';
    }
  return result;
}

/// Follow the comments of included files: set the number of the line and the file.
void follow_include(const std::string &line, unsigned long &number, std::vector<std::string> &files)
{
  if (begins_with(line, include_begin))
    {
      files.push_back(line.substr(include_begin.size()));
      number = 0;
    }
  else if (begins_with(line, include_end))
    {
      if (files.size() > 1)
        files.pop_back();
      number = std::strtoul(line.c_str() + include_end.size(), nullptr, 10);
    }
}
} // namespace

InputError keyword_error(const Keyword &keyword, const std::string &message)
{
  return InputError((keyword.file.empty() ? "" : "'" + keyword.file + "', ") +
                    error_at_line(keyword.line, message).what());
}

std::string with_includes(const std::string                                     &text,
                          const std::function<std::string(const std::string &)> &read)
{
  const auto first = text.find_first_not_of(" \t\r\n");
  if (first == std::string::npos || text[first] != '*' ||
      upper_case(text).find("INCLUDE") == std::string::npos)
    return text;
  return spliced(text, read, 0);
}

std::string upper_case(std::string text)
{
  for (char &c : text)
    c = std::toupper(static_cast<unsigned char>(c));
  return text;
}

std::vector<std::string> deck_words(const std::string &line)
{
  std::vector<std::string> words(1);
  bool                     quoted = false;
  for (const char c : line)
    if (c == '"')
      quoted = !quoted;
    else if (c == ',' && !quoted)
      words.emplace_back();
    else
      words.back() += c;
  for (auto &word : words)
    word = dealii::Utilities::trim(word);
  // A comma at the end of a line begins no word.
  if (words.size() > 1 && words.back().empty())
    words.pop_back();
  return words;
}

std::vector<double> numbers_from(const std::vector<std::string> &words,
                                 const std::size_t               first,
                                 const unsigned long             line)
{
  std::vector<double> numbers;
  for (std::size_t i = first; i < words.size(); ++i)
    numbers.push_back(words[i].empty() ? 0. : to_number(words[i], line));
  return numbers;
}

std::string Keyword::option(const std::string &key) const
{
  const auto found = options.find(key);
  return found == options.end() ? "" : found->second;
}

DeckText::DeckText(const std::string &given) : text(given)
{
  std::size_t              place  = 0;
  unsigned long            number = 0;
  std::vector<std::string> files  = {""}; // the deck, and the files within which a line is included
  while (place < text.size())
    {
      const auto  begin = place;
      std::string line  = next_line(text, place);
      ++number;
      follow_include(line, number, files);
      if (line.empty() || is_comment(line))
        continue;
      if (line[0] != '*')
        {
          if (all.empty())
            throw error_at_line(number, "a keyword is expected, not '" + line + "'");
          continue;
        }
      if (!all.empty())
        all.back().end = begin;
      const auto first = number;
      while (line.back() == ',' && place < text.size())
        {
          line += next_line(text, place);
          ++number;
        }
      begin_keyword(line, first);
      all.back().file      = files.back();
      all.back().data_line = number + 1;
      all.back().begin     = place;
      all.back().end       = text.size();
    }
}

void DeckText::begin_keyword(const std::string &line, const unsigned long number)
{
  const auto words = deck_words(line);
  Keyword    keyword;
  keyword.line  = number;
  keyword.title = upper_case(words.front());
  keyword.name  = without_blanks(keyword.title.substr(1));
  for (std::size_t i = 1; i < words.size(); ++i)
    {
      const auto equals = words[i].find('=');
      keyword.options[without_blanks(upper_case(words[i].substr(0, equals)))] =
        equals == std::string::npos ? "" : dealii::Utilities::trim(words[i].substr(equals + 1));
    }
  all.push_back(keyword);
}

void DeckText::for_each_line(const Keyword &keyword, const ReadLine &read) const
{
  std::size_t              place  = keyword.begin;
  unsigned long            number = keyword.data_line;
  std::vector<std::string> files  = {keyword.file};
  for (; place < keyword.end; ++number)
    {
      const std::string line = next_line(text, place);
      follow_include(line, number, files);
      if (line.empty() || is_comment(line))
        continue;
      try
        {
          read(deck_words(line), number);
        }
      catch (const InputError &error)
        {
          if (files.back().empty())
            throw;
          throw InputError("'" + files.back() + "', " + error.what());
        }
    }
}
} // namespace snug::mesh_file
