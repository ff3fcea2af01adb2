#include <snug/mesh_file/deck_sets.h>

namespace snug::mesh_file {
namespace {
/// Throw unless @p digits are digits: the @p word, to which @p user refers, is no set.
void require_number(const std::string  &word,
                    const std::string  &digits,
                    const std::string  &user,
                    const unsigned long line)
{
  if (digits.find_first_not_of("0123456789") != std::string::npos)
    throw error_at_line(line,
                        user + " refers to '" + word + "', which is neither a set nor a number");
}
} // namespace

dealii::Point<3> InstancePlace::operator()(const dealii::Point<3> &x) const
{
  const dealii::Point<3> moved = x + shift;
  if (degrees == 0.)
    return moved;
  const auto axis   = (b - a) / (b - a).norm();
  const auto arm    = moved - a;
  const auto radian = degrees * dealii::numbers::PI / 180.;
  return a + std::cos(radian) * arm + std::sin(radian) * cross_product_3d(axis, arm) +
         (1. - std::cos(radian)) * (axis * arm) * axis;
}

InstancePlace instance_place(const DeckText &deck, const Keyword &keyword)
{
  InstancePlace place;
  unsigned int  n = 0;
  deck.for_each_line(keyword, [&](const std::vector<std::string> &words, const unsigned long line) {
    auto              values = numbers_from(words, 0, line);
    const std::size_t wanted = n == 0 ? 3 : 7;
    if (values.size() > wanted || (n == 1 && values.size() < wanted) || n > 1)
      throw error_at_line(line, "an instance must have a translation of 3 numbers, then a "
                                "rotation of 7 numbers");
    values.resize(wanted, 0.);
    for (unsigned int d = 0; d < 3; ++d)
      if (n == 0)
        place.shift[d] = values[d];
      else
        {
          place.a[d] = values[d];
          place.b[d] = values[3 + d];
        }
    if (n == 1)
      {
        place.degrees = values[6];
        if (place.a.distance(place.b) == 0.)
          throw error_at_line(line, "the points of the axis of a rotation must differ");
      }
    ++n;
  });
  return place;
}

std::string defined_set(const Keyword &keyword)
{
  static const std::map<std::string, std::string> options = {{"NODE", "NSET"},
                                                             {"NSET", "NSET"},
                                                             {"ELEMENT", "ELSET"},
                                                             {"ELSET", "ELSET"},
                                                             {"SURFACE", "NAME"}};
  const auto                                      found   = options.find(keyword.name);
  return found == options.end() ? "" : upper_case(keyword.option(found->second));
}

std::string DeckSets::key(const std::string &name, const std::string &prefix)
{
  const bool full = !prefix.empty() && qualified_names.count(upper_case(name)) > 0;
  spelling.emplace(prefix + upper_case(name),
                   (full ? scopes.at(prefix).instance + "." : "") + name);
  return prefix + upper_case(name);
}

std::string DeckSets::find(const std::map<std::string, std::set<unsigned int>> &sets,
                           const std::string                                   &word,
                           const std::string                                   &prefix) const
{
  for (const auto &key : {prefix + upper_case(word), upper_case(word)})
    if (sets.count(key) > 0)
      return key;
  return "";
}

std::pair<std::size_t, std::string> DeckSets::group(const Keyword                  &keyword,
                                                    const std::vector<std::string> &words)
{
  std::string data;
  for (std::size_t i = keyword.name == "DLOAD" ? 2 : 1; i < words.size(); ++i)
    data += words[i] + ',';
  return {keyword.begin, data};
}

std::string DeckSets::boundary_of_nodes(const std::string &key) const
{
  const auto &name = spelling.at(key);
  return surfaces.count(name) > 0 ? name + " nodes" : name;
}

/// Return the numbering to which the number @p word belongs, and the number without "INSTANCE.".
std::pair<const Scope *, std::string> DeckSets::split(const std::string &word,
                                                      const std::string &prefix) const
{
  const auto dot = word.rfind('.');
  const auto scope =
    scopes.find(dot == std::string::npos ? "" : upper_case(word.substr(0, dot + 1)));
  if (dot == std::string::npos || scope == scopes.end())
    return {&scopes.at(prefix), word};
  return {&scope->second, word.substr(dot + 1)};
}

std::vector<unsigned int> DeckSets::elements(const std::string  &word,
                                             const std::string  &prefix,
                                             const std::string  &user,
                                             const unsigned long line) const
{
  const auto set = of_elements.find(find(of_elements, word, prefix));
  if (set != of_elements.end())
    return {set->second.begin(), set->second.end()};
  const auto [scope, digits] = split(word, prefix);
  require_number(word, digits, user, line);
  const auto number = to_whole(digits, line);
  const auto found  = scope->elements.find(number);
  if (found == scope->elements.end())
    throw error_at_line(line, user + " has the element " + std::to_string(number) +
                                ", which does not exist");
  return {found->second};
}

std::vector<unsigned int> DeckSets::nodes(const std::string  &word,
                                          const std::string  &prefix,
                                          const std::string  &user,
                                          const unsigned long line) const
{
  const auto set = of_nodes.find(find(of_nodes, word, prefix));
  if (set != of_nodes.end())
    return {set->second.begin(), set->second.end()};
  const auto [scope, digits] = split(word, prefix);
  require_number(word, digits, user, line);
  return {scope->nodes.index(to_whole(digits, line), user, line)};
}
} // namespace snug::mesh_file
