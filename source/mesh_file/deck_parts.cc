#include <snug/mesh_file/deck_parts.h>
#include <snug/mesh_file/deck_sets.h>

#include <algorithm>

namespace snug::mesh_file {
std::size_t DeckParts::end_of(const std::size_t k) const
{
  for (std::size_t e = k + 1; e < keywords.size(); ++e)
    if (keywords[e].name == "END" + keywords[k].name)
      return e;
  throw keyword_error(keywords[k], keywords[k].title + " has no *END");
}

DeckParts::DeckParts(const DeckText &deck) : keywords(deck.keywords())
{
  std::map<std::string, unsigned int> n_instances; // by name of a set of a part
  has_instances = std::any_of(keywords.begin(), keywords.end(),
                              [](const auto &keyword) { return keyword.name == "INSTANCE"; });
  for (std::size_t k = 0; has_instances && k < keywords.size(); ++k)
    {
      const auto &keyword = keywords[k];
      std::size_t end     = k;
      if (keyword.name == "PART" || keyword.name == "INSTANCE")
        end = end_of(k);
      if (keyword.name == "PART")
        keyword_of[upper_case(keyword.option("NAME"))] = k;
      std::set<std::string> names;
      const auto            part = keyword_of.find(upper_case(keyword.option("PART")));
      if (keyword.name == "INSTANCE" && part != keyword_of.end())
        for (std::size_t p = part->second; p < end_of(part->second); ++p)
          names.insert(defined_set(keywords[p]));
      for (std::size_t own = k; own < end && keyword.name == "INSTANCE"; ++own)
        names.insert(defined_set(keywords[own]));
      for (const auto &name : names)
        if (++n_instances[name] > 1)
          qualified_names.insert(name);
      if (end == k)
        qualified_names.insert(defined_set(keyword));
      k = end;
    }
}
} // namespace snug::mesh_file
