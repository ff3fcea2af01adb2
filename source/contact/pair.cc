#include <snug/contact/pair.h>

#include <algorithm>

namespace snug::contact {
void Side::add(const Boundary &boundary)
{
  const auto place = std::lower_bound(members.begin(), members.end(), boundary);
  if (place == members.end() || *place != boundary)
    members.insert(place, boundary);
}

bool Side::has(const Boundary &boundary) const
{
  return std::binary_search(members.begin(), members.end(), boundary);
}

std::vector<Boundary> boundaries_of(const std::vector<Pair> &pairs)
{
  Side all;
  for (const auto &pair : pairs)
    for (const Side *side : {&pair.slave, &pair.master})
      for (const Boundary &boundary : side->boundaries())
        all.add(boundary);
  return all.boundaries();
}
} // namespace snug::contact
