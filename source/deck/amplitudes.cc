#include <snug/deck/amplitudes.h>

#include <algorithm>
#include <set>

namespace snug::deck {
using mesh_file::Keyword;
using mesh_file::keyword_error;
using mesh_file::upper_case;

Amplitudes::Amplitudes(const mesh_file::DeckText &text)
{
  const std::set<std::string> known = {"NAME", "DEFINITION", "TIME", "VALUE", "SMOOTH"};
  const auto n_steps                = std::count_if(text.keywords().begin(), text.keywords().end(),
                                                    [](const auto &keyword) { return keyword.name == "STEP"; });
  for (const auto &keyword : text.keywords())
    if (keyword.name == "STEP")
      periods.push_back(1.);
    else if (keyword.name == "STATIC" && !periods.empty())
      text.for_each_line(keyword, [&](const auto &words, const unsigned long line) {
        const auto numbers = mesh_file::numbers_from(words, 0, line);
        if (numbers.size() > 1 && numbers[1] > 0.)
          periods.back() = numbers[1];
      });
    else if (keyword.name == "AMPLITUDE")
      {
        const auto definition = upper_case(keyword.option("DEFINITION"));
        if (!definition.empty() && definition != "TABULAR" && definition != "SMOOTH STEP")
          throw keyword_error(keyword, "*AMPLITUDE with DEFINITION = " + definition +
                                         " is not supported; write a table");
        if (upper_case(keyword.option("TIME")) == "TOTAL TIME" && n_steps > 1)
          throw keyword_error(keyword,
                              "*AMPLITUDE with TIME = TOTAL TIME is not supported in a deck "
                              "of several steps; write a table for each step");
        for (const auto &[option, value] : keyword.options)
          if (known.count(option) == 0 || upper_case(value) == "ABSOLUTE")
            throw keyword_error(keyword, "*AMPLITUDE with " + option +
                                           (value.empty() ? "" : " = " + value) +
                                           " is not supported; write a table");
        Table table{{}, definition == "SMOOTH STEP"};
        text.for_each_line(keyword, [&](const auto &words, const unsigned long line) {
          const auto numbers = mesh_file::numbers_from(words, 0, line);
          for (std::size_t i = 0; i + 1 < numbers.size(); i += 2)
            table.points.emplace_back(numbers[i], numbers[i + 1]);
        });
        if (table.points.empty())
          throw keyword_error(keyword, "*AMPLITUDE has no times and values");
        tables[upper_case(keyword.option("NAME"))] = table;
      }
}

double Amplitudes::at_end(const Keyword &keyword, const unsigned int step) const
{
  if (!keyword.has("AMPLITUDE"))
    return 1.;
  const auto found = tables.find(upper_case(keyword.option("AMPLITUDE")));
  if (found == tables.end())
    throw keyword_error(keyword, "there is no *AMPLITUDE '" + keyword.option("AMPLITUDE") + "'");
  const auto  &table = found->second;
  const double time  = step > 0 ? periods[step - 1] : 0.;
  const auto   next  = std::find_if(table.points.begin(), table.points.end(),
                                    [&](const auto &point) { return point.first >= time; });
  if (next == table.points.end())
    return table.points.back().second;
  if (next == table.points.begin() || next->first == time)
    return next->second;
  const auto &[t0, a0] = *(next - 1);
  const double share   = (time - t0) / (next->first - t0);
  const double rise =
    table.is_smooth ? share * share * share * (10. + share * (-15. + 6. * share)) : share;
  return a0 + rise * (next->second - a0);
}
} // namespace snug::deck
