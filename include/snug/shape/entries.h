#ifndef snug_shape_entries_h
#define snug_shape_entries_h

#include <sstream>
#include <string>
#include <vector>

namespace snug
{
  namespace shape
  {
    /// "a, b, c" as users write lists, for messages.
    template <typename T>
    std::string
    listed(const std::vector<T> &values)
    {
      std::ostringstream text;
      for (std::size_t i = 0; i < values.size(); ++i)
        text << (i == 0 ? "" : ", ") << values[i];
      return text.str();
    }
  } // namespace shape
} // namespace snug

#endif
