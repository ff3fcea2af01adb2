#include <snug/mesh_file/deck_parts.h>
#include <snug/mesh_file/deck_sets.h>

#include <algorithm>

namespace snug::mesh_file {
void refuse_generation(const Keyword &keyword)
{
  static const std::set<std::string> others = {"NGEN",  "NFILL",  "NCOPY",   "NMAP",
                                               "ELGEN", "ELCOPY", "INCLUDE", "SYSTEM"};
  const bool                         data   = keyword.name == "NODE" || keyword.name == "ELEMENT";
  const auto                         system = upper_case(keyword.option("SYSTEM"));
  std::string                        what;
  if (keyword.name == "NODE" && !system.empty() && system != "R")
    what = "*NODE with SYSTEM = " + system;
  else if (others.count(keyword.name) > 0 || (data && keyword.has("INPUT")))
    what = keyword.title + (data ? " with INPUT" : "");
  static const std::set<std::string> named = {"NSET", "ELSET", "SURFACE"};
  if (named.count(keyword.name) > 0 && defined_set(keyword).empty())
    throw keyword_error(keyword, keyword.title + " has no name");
  if (!what.empty())
    throw keyword_error(keyword, what + " is not supported; write all nodes and elements to "
                                        "one file, in Cartesian coordinates");
}

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
