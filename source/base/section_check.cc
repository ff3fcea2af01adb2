#include <snug/base/section_check.h>

#include <algorithm>

namespace snug {
std::string SectionCheck::path(const std::string &entry) const
{
  return section.empty() ? entry : section + "/" + entry;
}

InputError SectionCheck::error(const std::string &entry,
                               const std::string &value,
                               const std::string &allowed,
                               const std::string &suggestion) const
{
  return origins.error(path(entry), value, allowed, suggestion);
}

InputError SectionCheck::placed(const InputError  &error,
                                const std::string &entry,
                                const std::string &value) const
{
  auto wrong = error.wrong();
  if (wrong.entry.empty())
    return this->error(entry, value, error.what());
  if (wrong.entry.rfind(section + "/", 0) != 0)
    wrong.entry = path(wrong.entry);
  return InputError(wrong, origins.of(wrong.entry));
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
