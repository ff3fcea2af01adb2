#include <snug/base/values.h>
#include <snug/geometry/face_list.h>

namespace snug::geometry {
/// Split at plus signs between blanks, because names of mesh files may have a plus sign.
std::vector<std::string> face_list(const std::string &faces)
{
  const std::string        plus = " + ";
  std::vector<std::string> result;
  std::size_t              begin = 0;
  for (auto end = faces.find(plus); end != std::string::npos; end = faces.find(plus, begin))
    {
      result.push_back(trim(faces.substr(begin, end - begin)));
      begin = end + plus.size();
    }
  result.push_back(trim(faces.substr(begin)));
  return result;
}
} // namespace snug::geometry
