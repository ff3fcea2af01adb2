#include <snug/base/values.h>
#include <snug/geometry/formula.h>
#include <snug/scene/cases.h>

#include <cctype>
#include <map>
#include <stdexcept>

namespace snug::scene {
namespace {
const unsigned int most_cases = 1000;

const std::string section_prefix = "Load case ", list_entry = "Load cases", cases_entry = "Cases";

bool is_part_of_name(const char c)
{
  return std::isalnum(static_cast<unsigned char>(c)) != 0 || c == '_' || c == '.';
}

/// Return whether @p text has the variable i at @p place.
bool is_case_number(const std::string &text, const std::size_t place)
{
  return text[place] == 'i' && (place == 0 || !is_part_of_name(text[place - 1])) &&
         (place + 1 == text.size() || !is_part_of_name(text[place + 1]));
}

/// Return the text of a number or formula @p word in case @p i.
std::string word_in_case(const std::string &word, const unsigned int i)
{
  std::string replaced;
  for (std::size_t place = 0; place < word.size(); ++place)
    replaced += is_case_number(word, place) ? "(" + to_text(i) + ")" : std::string(1, word[place]);
  if (replaced == word)
    return word;
  const auto value = geometry::constant_value(replaced);
  return value ? to_text(*value) : replaced;
}

/// Return the value of an entry in case @p i. Separators within parentheses belong to a formula.
std::string value_in_case(const std::string &value, const unsigned int i)
{
  std::string result, word;
  int         depth = 0;
  for (const char c : value)
    {
      depth += (c == '(') - (c == ')');
      if (depth > 0 || std::string(" \t,;:=").find(c) == std::string::npos)
        {
          word += c;
          continue;
        }
      result += word_in_case(word, i) + c;
      word.clear();
    }
  return result + word_in_case(word, i);
}

/// Return what is appended to the name of a load case for case @p i of @p n. One case is the load
/// case itself.
std::string suffix(const unsigned int i, const unsigned int n)
{
  return n == 1 ? "" : "-" + to_text(i);
}

/// Return the number of cases of each load case whose section has the entry Cases.
std::map<std::string, unsigned int> numbers_of_cases(const std::vector<Statement> &statements)
{
  std::map<std::string, unsigned int> result;
  for (const auto &statement : statements)
    if (statement.name == cases_entry && statement.section.rfind(section_prefix, 0) == 0)
      {
        unsigned int n = 0;
        try
          {
            from_text(statement.value, n);
          }
        catch (const std::invalid_argument &)
          {
            n = 0;
          }
        if (n == 0 || n > most_cases)
          throw Origins("", {statement})
            .error(statement.path(), statement.value,
                   "must be an integer between 1 and " + to_text(most_cases));
        result[statement.section.substr(section_prefix.size())] = n;
      }
  return result;
}
} // namespace

std::vector<Statement> with_cases(const std::vector<Statement> &statements)
{
  const auto             numbers = numbers_of_cases(statements);
  std::vector<Statement> result;
  for (Statement statement : statements)
    {
      const bool is_load_case = statement.section.rfind(section_prefix, 0) == 0;
      if (is_load_case && statement.type == ValueType::text)
        statement.type.reset(); // it may be a formula of the case number instead of a number
      const auto of = numbers.find(is_load_case ? statement.section.substr(section_prefix.size())
                                                : std::string());
      if (is_load_case && of != numbers.end())
        {
          for (unsigned int i = 0; i < of->second && statement.name != cases_entry; ++i)
            result.push_back({statement.section + suffix(i, of->second), statement.name,
                              value_in_case(statement.value, i), statement.origin, statement.type});
          continue;
        }
      if (statement.section.empty() && statement.name == list_entry)
        {
          std::vector<std::string> names;
          for (const auto &name : split(statement.value, ','))
            if (const auto found = numbers.find(name); found == numbers.end())
              names.push_back(name);
            else
              for (unsigned int i = 0; i < found->second; ++i)
                names.push_back(name + suffix(i, found->second));
          statement.value = to_text(names);
        }
      result.push_back(statement);
    }
  return result;
}
} // namespace snug::scene
