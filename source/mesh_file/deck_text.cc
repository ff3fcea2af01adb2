#include <snug/mesh_file/deck_text.h>

#include <deal.II/base/utilities.h>

#include <algorithm>
#include <cctype>

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

bool is_comment(const std::string &line)
{
  return line.rfind("**", 0) == 0;
}

std::string without_blanks(std::string text)
{
  text.erase(std::remove_if(text.begin(), text.end(),
                            [](const unsigned char c) { return std::isspace(c) != 0; }),
             text.end());
  return text;
}
} // namespace

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

std::string Keyword::option(const std::string &key) const
{
  const auto found = options.find(key);
  return found == options.end() ? "" : found->second;
}

DeckText::DeckText(const std::string &given) : text(given)
{
  std::size_t   place  = 0;
  unsigned long number = 0;
  while (place < text.size())
    {
      const auto  begin = place;
      std::string line  = next_line(text, place);
      ++number;
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
      all.back().data_line = number + 1;
      all.back().begin     = place;
      all.back().end       = text.size();
    }
}

void DeckText::begin_keyword(std::string line, const unsigned long number)
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
  std::size_t   place  = keyword.begin;
  unsigned long number = keyword.data_line;
  for (; place < keyword.end; ++number)
    {
      const std::string line = next_line(text, place);
      if (!line.empty() && !is_comment(line))
        read(deck_words(line), number);
    }
}
} // namespace snug::mesh_file
