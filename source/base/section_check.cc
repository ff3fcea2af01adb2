#include <snug/base/section_check.h>

#include <algorithm>

namespace snug {
std::string SectionCheck::path(const std::string &entry) const
{
  return section.empty() ? entry : section + "/" + entry;
}

InputError SectionCheck::error(const std::string &entry,
                               const std::string &value,
                               const std::string &allowed) const
{
  return origins.error(path(entry), value, allowed);
}

InputError SectionCheck::placed(const InputError  &error,
                                const std::string &entry,
                                const std::string &value) const
{
  const std::string message = error.what(), begin = "entry '";
  const auto        quote = message.find('\'', begin.size());
  if (message.rfind(begin, 0) != 0 || quote == std::string::npos)
    return this->error(entry, value, message);
  std::string named = message.substr(begin.size(), quote - begin.size());
  if (named.rfind(section + "/", 0) != 0)
    named = path(named);
  return InputError(origins.of(named) + begin + named + message.substr(quote));
}

void SectionCheck::require_default(const Entries                  &given,
                                   const Entries                  &initial,
                                   const std::vector<std::string> &read,
                                   const std::string              &allowed) const
{
  for (std::size_t i = 0; i < given.descriptions().size(); ++i)
    {
      const auto &entry = given.descriptions()[i];
      require(entry.initial == initial.descriptions()[i].initial ||
                std::find(read.begin(), read.end(), entry.name) != read.end(),
              entry.name, entry.initial, allowed);
    }
}
} // namespace snug
