#include <snug/contact/pair.h>

#include <algorithm>

namespace snug::contact {
std::vector<std::pair<unsigned int, unsigned int>> boundaries_of(const std::vector<Pair> &pairs)
{
  std::vector<std::pair<unsigned int, unsigned int>> boundaries;
  for (const auto &pair : pairs)
    {
      boundaries.push_back(pair.slave);
      if (!pair.obstacle)
        boundaries.push_back(pair.master);
    }
  std::sort(boundaries.begin(), boundaries.end());
  boundaries.erase(std::unique(boundaries.begin(), boundaries.end()), boundaries.end());
  return boundaries;
}
} // namespace snug::contact
