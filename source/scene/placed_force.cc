#include <snug/base/values.h>
#include <snug/scene/placed_force.h>
#include <snug/scene/scene.h>

#include <cmath>
#include <limits>
#include <map>
#include <sstream>
#include <stdexcept>

namespace snug::scene {
namespace {
/// Limit of numbers, as of other entries.
const double largest_number = 1e60;

std::vector<double> vector_from(const std::string &text, const unsigned int dimension)
{
  std::vector<double> numbers;
  for (const auto &word : components(text))
    {
      double number = 0.;
      try
        {
          from_text(word, number);
        }
      catch (const std::invalid_argument &)
        {
          number = std::numeric_limits<double>::quiet_NaN();
        }
      numbers.push_back(number);
      // The condition is written so that it excludes NaN.
      if (!(std::abs(number) <= largest_number))
        throw std::invalid_argument("'" + word + "' must be a number up to " +
                                    to_text(largest_number));
    }
  if (numbers.size() != dimension)
    throw std::invalid_argument("'" + text + "' must have " + to_text(dimension) +
                                " components separated by blanks");
  return numbers;
}

/// Return the text before the first word of @p words, by "", and after each of the words.
std::map<std::string, std::string> parts_of(const std::string              &text,
                                            const std::vector<std::string> &words)
{
  std::map<std::string, std::string> parts;
  std::string                        current;
  std::istringstream                 stream(text);
  for (std::string word; stream >> word;)
    {
      bool is_word = false;
      for (const auto &known : words)
        is_word = is_word || known == word;
      if (is_word && parts.count(word) > 0)
        throw std::invalid_argument("'" + word + "' occurs twice");
      if (is_word)
        current = word;
      std::string &part = parts[current];
      if (!is_word)
        part += (part.empty() ? "" : " ") + word;
    }
  return parts;
}
} // namespace

PlacedForce placed_force(const std::string &text, const unsigned int dimension)
{
  const auto  parts = parts_of(text, {"at", "from", "to", "along"});
  PlacedForce result;
  for (const auto &[word, part] : parts)
    if (word == "along")
      result.along = part;
    else
      (word.empty()     ? result.force
       : word == "at"   ? result.at
       : word == "from" ? result.from
                        : result.to) = vector_from(part, dimension);
  if (result.force.empty())
    throw std::invalid_argument("the force is missing");
  return result;
}

PointHold point_hold(const std::string &text, const unsigned int dimension)
{
  const auto parts          = parts_of(text, {"at"});
  const auto at             = parts.find("at");
  const auto [words, value] = split_displacement(parts.at(""));
  PointHold result;
  if (at == parts.end())
    throw std::invalid_argument("the point is missing");
  result.at         = vector_from(at->second, dimension);
  result.components = component_list(words, dimension);
  if (!value.empty())
    from_text(value, result.value);
  for (const unsigned int c : result.components)
    if (c == dimension)
      throw std::invalid_argument("a point has no normal");
  if (result.components.empty())
    throw std::invalid_argument("the components are missing");
  return result;
}
} // namespace snug::scene
