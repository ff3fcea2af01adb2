#include <snug/base/values.h>
#include <snug/contact/pair.h>

#include <algorithm>

namespace snug::contact {
/// Split at plus signs between blanks, because names of mesh files may have a plus sign.
std::vector<std::string> faces_of_side(const std::string &side)
{
  const std::string        plus = " + ";
  std::vector<std::string> faces;
  std::size_t              begin = 0;
  for (auto end = side.find(plus); end != std::string::npos; end = side.find(plus, begin))
    {
      faces.push_back(trim(side.substr(begin, end - begin)));
      begin = end + plus.size();
    }
  faces.push_back(trim(side.substr(begin)));
  return faces;
}

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
